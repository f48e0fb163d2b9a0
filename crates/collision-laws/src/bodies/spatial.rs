//! A rigid body in space.

use super::{
    RigidBody, positive,
    rigid::{Inertia, symmetric},
};
use crate::{Body, Delassus, Error, Twist, across::across};
use nalgebra::{Matrix3, SVector, Unit};

/// A rigid body in space, of any shape: mass and inertia tensor about the centre of mass, in the space frame.
///
/// `K = 1/m + [r]ₓ I⁻¹ [r]ₓᵀ`. The tensor is that of the present pose: a body that has turned is a new value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spatial {
    mass: f64,
    tensor: Matrix3<f64>,
    inverse: Matrix3<f64>,
}

impl Spatial {
    /// A body of the given mass \[M\] and inertia tensor about its centre of mass, in the space frame \[M L²\].
    ///
    /// # Errors
    /// Those of [`RigidBody::new`].
    pub fn new(mass: f64, tensor: Matrix3<f64>) -> Result<Self, Error> {
        let mass = positive("the mass", mass)?;
        let principal = RigidBody::<3>::new(mass, Inertia::Tensor(tensor))?;
        Ok(Self { mass, tensor: symmetric("the inertia", &tensor)?, inverse: principal.inverse_tensor() })
    }

    /// The mass `m`.
    #[inline]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// The inertia tensor about the centre of mass, in the space frame.
    #[inline]
    pub fn tensor(&self) -> &Matrix3<f64> {
        &self.tensor
    }
}

impl Body<3> for Spatial {
    type Velocity = Twist<3>;

    #[inline]
    fn inner_product(&self, v: &Twist<3>, w: &Twist<3>) -> f64 {
        self.mass * v.linear.dot(&w.linear) + v.angular_velocity().dot(&(self.tensor * w.angular_velocity()))
    }

    #[inline]
    fn apply_impulse(&self, arm: &SVector<f64, 3>, p: &SVector<f64, 3>, v: &Twist<3>) -> Twist<3> {
        Twist::spatial(v.linear + p / self.mass, v.angular_velocity() + self.inverse * arm.cross(&across(p, arm)))
    }

    #[inline]
    fn delassus(&self, arm: &SVector<f64, 3>, _: &Unit<SVector<f64, 3>>) -> Delassus<3> {
        let cross = arm.cross_matrix();
        let mut k = cross * self.inverse * cross.transpose();
        for i in 0..3 {
            k[(i, i)] += 1.0 / self.mass;
        }
        Delassus::Dense(k * 0.5 + k.transpose() * 0.5) // halved first: the sum may overflow
    }
}

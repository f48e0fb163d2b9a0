//! A rigid body in the plane.

use super::positive;
use crate::{Body, Delassus, Error, Twist};
use nalgebra::{SVector, Unit, Vector2};

/// A rigid body in the plane, of any shape: mass and moment of inertia about the centre of mass.
///
/// `K = 1/m + (J r)(J r)ᵀ/I` with `J r = (−r₂, r₁)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Planar {
    mass: f64,
    moment: f64,
}

impl Planar {
    /// A body of the given mass \[M\] and moment of inertia about its centre of mass \[M L²\].
    ///
    /// # Errors
    /// [`Error::NotPositive`].
    pub fn new(mass: f64, moment: f64) -> Result<Self, Error> {
        Ok(Self { mass: positive("the mass", mass)?, moment: positive("the moment of inertia", moment)? })
    }

    /// The mass `m`.
    #[inline]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// The moment of inertia `I` about the centre of mass.
    #[inline]
    pub fn moment(&self) -> f64 {
        self.moment
    }
}

/// The quarter turn `J(x, y) = (−y, x)`.
#[inline]
fn quarter_turn(x: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-x.y, x.x)
}

impl Body<2> for Planar {
    type Velocity = Twist<2>;

    #[inline]
    fn inner_product(&self, v: &Twist<2>, w: &Twist<2>) -> f64 {
        self.mass * v.linear.dot(&w.linear) + self.moment * v.angular_velocity() * w.angular_velocity()
    }

    #[inline]
    fn apply_impulse(&self, arm: &SVector<f64, 2>, p: &SVector<f64, 2>, v: &Twist<2>) -> Twist<2> {
        let torque = quarter_turn(arm).dot(p);
        Twist::planar(v.linear + p / self.mass, v.angular_velocity() + torque / self.moment)
    }

    #[inline]
    fn delassus(&self, arm: &SVector<f64, 2>, _: &Unit<SVector<f64, 2>>) -> Delassus<2> {
        let turned = quarter_turn(arm);
        let mut k = turned / self.moment * turned.transpose();
        k[(0, 0)] += 1.0 / self.mass;
        k[(1, 1)] += 1.0 / self.mass;
        Delassus::Dense(k)
    }
}

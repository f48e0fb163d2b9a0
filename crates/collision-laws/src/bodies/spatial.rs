//! A rigid body in space.

use super::{
    RigidBody, positive,
    rigid::{Inertia, symmetric},
};
use crate::{Body, Delassus, Error, Twist, across::across, symmetric::symmetric_part};
use nalgebra::{Matrix3, Rotation3, SVector, Unit};

/// A rigid body in space, of any shape: mass and inertia tensor about the centre of mass, in the space frame.
///
/// `K = 1/m + [r]ₓ I⁻¹ [r]ₓᵀ`. The tensor is that of the present pose: a body that has turned is a new value, [`turned`](Self::turned).
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

    /// The body after it has been turned by the rotation `R`: its tensor is `R I Rᵀ` in the space frame.
    ///
    /// As with [`RigidBody::turned`], the rounding errors of successive turns accumulate.
    #[must_use]
    pub fn turned(&self, by: &Rotation3<f64>) -> Self {
        let turn = |of: &Matrix3<f64>| symmetric_part(&(by.matrix() * of * by.matrix().transpose()));
        Self { mass: self.mass, tensor: turn(&self.tensor), inverse: turn(&self.inverse) }
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
        Delassus::Dense(symmetric_part(&k))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn a_body_turned_is_the_rigid_body_turned() {
        let tensor = Matrix3::new(2.0, 0.25, -0.5, 0.25, 1.5, 0.125, -0.5, 0.125, 1.25);
        let (axis, arm) = (Unit::new_normalize(Vector3::new(1.0, -2.0, 0.5)), Vector3::new(0.3, -0.7, 0.4));
        let turn = Rotation3::from_axis_angle(&axis, 0.9);
        let body = Spatial::new(3.0, tensor).unwrap().turned(&turn);
        let same = RigidBody::<3>::new(3.0, Inertia::Tensor(tensor)).unwrap().turned(&turn);
        assert_eq!(body.tensor, body.tensor.transpose());
        let (k, other) = (body.delassus(&arm, &axis).to_matrix(&axis), same.delassus(&arm, &axis).to_matrix(&axis));
        assert!((k - other).amax() < 1e-15 * 4.0, "{k} for {other}");
        let v = Twist::spatial(Vector3::new(0.2, 0.1, -0.3), Vector3::new(1.0, 0.5, -2.0));
        let (energy, other) = (body.kinetic_energy(&v), same.kinetic_energy(&v));
        assert!((energy / other - 1.0).abs() < 1e-14, "{energy} for {other}");
    }
}

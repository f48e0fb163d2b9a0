//! A point mass: it has no spin, and no arm.

use super::positive;
use crate::{Body, Delassus, Error};
use nalgebra::{SVector, Unit};

/// A point mass in ℝᴺ.
///
/// Its contact point is its position, so its arm is zero. `K = 1/m`, so no-slip reverses its velocity: `v⁺ = −v`. A ball with γ → 0 does
/// not approach this, since it spins: see [`NoSlip`](crate::laws::NoSlip).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    mass: f64,
}

impl Point {
    /// A point of the given mass \[M\].
    ///
    /// # Errors
    /// [`Error::NotPositive`].
    pub fn new(mass: f64) -> Result<Self, Error> {
        Ok(Self { mass: positive("the mass", mass)? })
    }

    /// The mass `m`.
    #[inline]
    pub fn mass(&self) -> f64 {
        self.mass
    }
}

impl<const N: usize> Body<N> for Point {
    type Velocity = SVector<f64, N>;

    #[inline]
    fn inner_product(&self, v: &SVector<f64, N>, w: &SVector<f64, N>) -> f64 {
        self.mass * v.dot(w)
    }

    #[inline]
    fn apply_impulse(&self, _: &SVector<f64, N>, p: &SVector<f64, N>, v: &SVector<f64, N>) -> SVector<f64, N> {
        v + p / self.mass
    }

    #[inline]
    fn delassus(&self, _: &SVector<f64, N>, _: &Unit<SVector<f64, N>>) -> Delassus<N> {
        Delassus::Isotropic { normal: 1.0 / self.mass, tangent: 1.0 / self.mass }
    }
}

//! Paths: how a free particle moves between collisions.
use lanes::{two_prod, two_sum};
use nalgebra::SVector;

/// Uniform straight motion `x(t) = point + t·velocity`, `t ≥ 0`.
///
/// `point` \[L\], `velocity` [L T⁻¹].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line<const N: usize> {
    /// Where the particle is at time 0.
    pub point: SVector<f64, N>,
    /// Its constant velocity, not normalised.
    pub velocity: SVector<f64, N>,
}

impl<const N: usize> Line<N> {
    /// The position at time `t` \[T\].
    #[inline]
    pub fn at(&self, t: f64) -> SVector<f64, N> {
        self.point + self.velocity * t
    }

    /// The position as a rounded value and its rounding error.
    ///
    /// A rounded position lies off the path by half an ulp, and so meets a wall too early or too late by that divided by the sine of
    /// the angle between path and wall.
    pub(crate) fn at_exactly(&self, t: f64) -> [SVector<f64, N>; 2] {
        let mut rest = SVector::zeros();
        let rounded = SVector::from_fn(|i, _| {
            let (way, of_way) = two_prod(self.velocity[i], t);
            let (place, of_place) = two_sum(self.point[i], way);
            rest[i] = of_way + of_place;
            place
        });
        [rounded, rest]
    }
}

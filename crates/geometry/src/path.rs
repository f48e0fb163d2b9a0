//! Paths: how a free particle moves between collisions.
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
}

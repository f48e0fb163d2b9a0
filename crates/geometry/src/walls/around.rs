//! A container with obstacles inside.
use super::{WallHit, Walls};
use lanes::{Lane, Mask};

/// The table inside the convex `container` and outside `obstacles`, which lie within it: an obstacle that is hit is hit
/// before the container.
#[derive(Clone, Debug)]
pub struct Around<A, B> {
    /// The outer walls.
    pub container: A,
    /// The inner ones.
    pub obstacles: B,
}

impl<A: Walls<N>, B: Walls<N>, const N: usize> Walls<N> for Around<A, B> {
    fn rounds_normals(&self) -> bool {
        self.container.rounds_normals() || self.obstacles.rounds_normals()
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let inner = self.obstacles.first_hit(x, v);
        let missed = inner.missed();
        if missed.any() { inner.or(missed, &self.container.first_hit(x, v)) } else { inner }
    }
}

//! Two walls in one table.
use super::{WallHit, Walls};
use lanes::{Lane, Mask};

/// The table bounded by both: whichever is hit first.
#[derive(Clone, Debug)]
pub struct Both<A, B>(pub A, pub B);

impl<A: Walls<N>, B: Walls<N>, const N: usize> Walls<N> for Both<A, B> {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let (a, b) = (self.0.first_hit(x, v), self.1.first_hit(x, v));
        let second = b.time.lt(a.time);
        if second.any() { a.or(second, &b) } else { a }
    }
}

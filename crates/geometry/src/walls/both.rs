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
        let mut hit = a;
        hit.time = second.select(b.time, a.time);
        for i in 0..N {
            hit.point[i] = second.select(b.point[i], a.point[i]);
            hit.normal[i] = second.select(b.normal[i], a.normal[i]);
        }
        hit.piece = second.select(b.piece, a.piece);
        hit.corner = (second & b.corner) | (!second & a.corner);
        hit
    }
}

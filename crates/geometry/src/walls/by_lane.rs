//! Any boundary as walls: one lane after another.
use super::{WallHit, Walls};
use crate::{Boundary, Line};
use lanes::{Lane, MOST_LANES, stored};
use nalgebra::SVector;

/// A boundary that answers for one path at a time, adapted to lanes.
///
/// This is how a boundary of your own runs in ensembles, at the speed of its scalar code. A boundary whose formula
/// is written for [`Lane`]s can implement [`Walls`] itself, and is as fast as those here.
#[derive(Clone, Debug)]
pub struct ByLane<B>(pub B);

impl<B: Boundary<N> + Sync, const N: usize> Walls<N> for ByLane<B> {
    fn rounds_normals(&self) -> bool {
        true
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let zero = v[0].same(0.0);
        // per lane: time, piece, corner, point, normal
        let mut found = [[0.0; MOST_LANES]; 3];
        let (mut point, mut normal) = ([[0.0; MOST_LANES]; N], [[0.0; MOST_LANES]; N]);
        let (from, along) = (stored(x), stored(v));
        for lane in 0..F::LANES {
            let at = |a: &[[f64; MOST_LANES]; N]| SVector::from(a.each_ref().map(|a| a[lane]));
            let Some(hit) = self.0.first_hit(&Line { point: at(&from), velocity: at(&along) }) else {
                found[0][lane] = f64::INFINITY;
                continue;
            };
            let numbers = [hit.time, hit.piece as f64, if hit.corner { 1.0 } else { 0.0 }];
            for (to, number) in found.iter_mut().zip(numbers) {
                to[lane] = number;
            }
            for i in 0..N {
                point[i][lane] = hit.point[i];
                normal[i][lane] = hit.normal[i];
            }
        }
        let [time, piece, corner] = found.map(|a| zero.load(&a));
        let [point, normal] = [point, normal].map(|a| a.map(|a| zero.load(&a)));
        let one = zero.same(1.0);
        WallHit { time, point, normal, inverse: one, piece, corner: zero.lt(corner) }
    }
}

//! Any boundary as walls: one lane after another.
use super::{WallHit, Walls};
use crate::{Boundary, Line};
use lanes::Lane;

/// A boundary that answers for one path at a time, made to answer for lanes.
///
/// This is how a boundary of your own runs in ensembles: at the speed of its scalar code.
#[derive(Clone, Debug)]
pub struct ByLane<B>(pub B);

impl<B: Boundary<N> + Sync, const N: usize> Walls<N> for ByLane<B> {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let zero = v[0].same(0.0);
        let (mut time, mut piece, mut corner) = ([f64::INFINITY; lanes::MOST], [0.0; lanes::MOST], [0.0; lanes::MOST]);
        let (mut point, mut normal) = ([[0.0; lanes::MOST]; N], [[0.0; lanes::MOST]; N]);
        for lane in 0..F::LANES {
            let path = Line { point: x.map(|x| x.lane(lane)).into(), velocity: v.map(|v| v.lane(lane)).into() };
            if let Some(hit) = self.0.first_hit(&path) {
                time[lane] = hit.time;
                for i in 0..N {
                    (point[i][lane], normal[i][lane]) = (hit.point[i], hit.normal[i]);
                }
                piece[lane] = hit.piece as f64;
                corner[lane] = if hit.corner { 1.0 } else { 0.0 };
            }
        }
        let one = zero.same(1.0);
        WallHit {
            time: zero.load(&time),
            point: core::array::from_fn(|i| zero.load(&point[i])),
            normal: core::array::from_fn(|i| zero.load(&normal[i])),
            inverse: one,
            inverse_square: one,
            piece: zero.load(&piece),
            corner: zero.lt(zero.load(&corner)),
        }
    }
}

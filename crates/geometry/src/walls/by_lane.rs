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
        let (mut time, mut piece, mut corner) = (zero, zero, zero);
        let (mut point, mut normal) = (*x, *x);
        for lane in 0..F::LANES {
            let path = Line { point: x.map(|x| x.lane(lane)).into(), velocity: v.map(|v| v.lane(lane)).into() };
            let hit = self.0.first_hit(&path);
            let put = |to: F, value: f64| to.each(|k| if k == lane { value } else { to.lane(k) });
            time = put(time, hit.map_or(f64::INFINITY, |h| h.time));
            if let Some(h) = hit {
                for i in 0..N {
                    point[i] = put(point[i], h.point[i]);
                    normal[i] = put(normal[i], h.normal[i]);
                }
                piece = put(piece, h.piece as f64);
                corner = put(corner, if h.corner { 1.0 } else { 0.0 });
            }
        }
        let one = zero.same(1.0);
        WallHit { time, point, normal, inverse: one, inverse_square: one, piece, corner: zero.lt(corner) }
    }
}

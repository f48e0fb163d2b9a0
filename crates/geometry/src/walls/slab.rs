//! The space between two parallel planes: strip and slab.
use super::{WallHit, Walls};
use crate::Error;
use lanes::{Lane, Mask};

/// `low < x_AXIS < high` in ℝᴺ, axes counted from 0.
#[derive(Clone, Debug)]
pub struct Slab<const N: usize, const AXIS: usize> {
    low: f64,
    high: f64,
    /// Numbers of the lower and of the upper wall.
    pieces: [f64; 2],
}

impl<const N: usize, const AXIS: usize> Slab<N, AXIS> {
    /// The slab between two heights \[L\], with the numbers of its lower and its upper wall.
    ///
    /// # Errors
    /// [`Error::Parameter`] unless `low < high`, both finite.
    pub fn new(low: f64, high: f64, pieces: [usize; 2]) -> Result<Self, Error> {
        if !(low < high && low.is_finite() && high.is_finite()) {
            return Err(Error::Parameter { name: "width", must: "positive and finite", value: high - low });
        }
        Ok(Slab { low, high, pieces: pieces.map(|p| p as f64) })
    }
}

impl<const N: usize, const AXIS: usize> Walls<N> for Slab<N, AXIS> {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let zero = v[0].same(0.0);
        let up = zero.lt(v[AXIS]);
        let wall = up.select(zero.same(self.high), zero.same(self.low));
        let distance = wall - x[AXIS];
        // a start beyond the wall is rounding: it hits at time 0
        let outside = up.select(distance, -distance).lt(zero);
        let time = outside.select(zero, distance) / v[AXIS];
        let moving = up | v[AXIS].lt(zero);
        let mut point = *x;
        let mut normal = [zero; N];
        for i in 0..N {
            point[i] = x[i] + time * v[i];
        }
        point[AXIS] = wall;
        normal[AXIS] = up.select(zero.same(-1.0), zero.same(1.0));
        WallHit {
            time: moving.select(time, zero.same(f64::INFINITY)),
            point,
            normal,
            inverse: zero.same(1.0),
            inverse_square: zero.same(1.0),
            piece: up.select(zero.same(self.pieces[1]), zero.same(self.pieces[0])),
            corner: zero.lt(zero),
        }
    }
}

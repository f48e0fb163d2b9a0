//! The space between two parallel planes: strip and slab.
use super::{WallHit, Walls};
use crate::Error;
use lanes::{Lane, Mask};

/// `low < x_axis < high` in ℝᴺ.
#[derive(Clone, Debug)]
pub struct Slab<const N: usize> {
    axis: usize,
    low: f64,
    high: f64,
    /// Numbers of the lower and of the upper wall.
    pieces: [f64; 2],
}

impl<const N: usize> Slab<N> {
    /// The slab `low < x_axis < high` [L], axes counted from 0, with the numbers of its lower and its upper wall.
    ///
    /// # Errors
    /// [`Error::Parameter`] unless `low < high`, both finite, and `axis < N`.
    pub fn new(axis: usize, low: f64, high: f64, pieces: [usize; 2]) -> Result<Self, Error> {
        if axis >= N {
            return Err(Error::Parameter { name: "axis", must: "less than the dimension", value: axis as f64 });
        }
        if !(low < high && low.is_finite() && high.is_finite()) {
            return Err(Error::Parameter { name: "width", must: "positive and finite", value: high - low });
        }
        Ok(Slab { axis, low, high, pieces: pieces.map(|p| p as f64) })
    }
}

impl<const N: usize> Walls<N> for Slab<N> {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let k = self.axis;
        let zero = v[0].same(0.0);
        let up = zero.lt(v[k]);
        let wall = up.select(zero.same(self.high), zero.same(self.low));
        let distance = wall - x[k];
        // a start beyond the wall is rounding: it hits at time 0
        let outside = up.select(distance, -distance).lt(zero);
        let time = outside.select(zero, distance) / v[k];
        let moving = up | v[k].lt(zero);
        let mut point = *x;
        let mut normal = [zero; N];
        for i in 0..N {
            point[i] = x[i] + time * v[i];
        }
        point[k] = wall;
        normal[k] = up.select(zero.same(-1.0), zero.same(1.0));
        WallHit {
            time: moving.select(time, zero.same(f64::INFINITY)),
            point,
            normal,
            piece: up.select(zero.same(self.pieces[1]), zero.same(self.pieces[0])),
            corner: zero.lt(zero),
        }
    }
}

//! A box with sides along the axes: rectangle and cuboid.
use super::{CORNER, WallHit, Walls};
use crate::Error;
use lanes::{Lane, Mask};

/// `low_i < x_i < high_i` in ℝᴺ.
#[derive(Clone, Debug)]
pub struct Cuboid<const N: usize> {
    low: [f64; N],
    high: [f64; N],
    /// Within these bounds a point of a wall is no corner.
    inner: [[f64; 2]; N],
    /// Numbers of the lower and the upper wall of each axis.
    pieces: [[f64; 2]; N],
}

impl<const N: usize> Cuboid<N> {
    /// The box between two opposite corners \[L\], with the numbers of the lower and the upper wall of each axis.
    ///
    /// # Errors
    /// [`Error::Parameter`] unless `low < high` in each coordinate, all finite.
    pub fn new(low: [f64; N], high: [f64; N], pieces: [[usize; 2]; N]) -> Result<Self, Error> {
        let mut inner = [[0.0; 2]; N];
        for i in 0..N {
            if !(low[i] < high[i] && low[i].is_finite() && high[i].is_finite()) {
                return Err(Error::Parameter { name: "size", must: "positive and finite", value: high[i] - low[i] });
            }
            let margin = CORNER * low[i].abs().max(high[i].abs());
            inner[i] = [low[i] + margin, high[i] - margin];
        }
        Ok(Cuboid { low, high, inner, pieces: pieces.map(|p| p.map(|p| p as f64)) })
    }
}

impl<const N: usize> Walls<N> for Cuboid<N> {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let zero = v[0].same(0.0);
        let never = zero.same(f64::INFINITY);
        // per axis: the wall ahead, the distance to it and the speed towards it
        let (mut num, mut den) = (never, zero.same(1.0));
        let mut first = [zero.lt(zero); N];
        let mut ahead = [zero; N];
        for i in 0..N {
            let up = zero.lt(v[i]);
            ahead[i] = up.select(zero.same(self.high[i]), zero.same(self.low[i]));
            let d = ahead[i] - x[i];
            let d = up.select(d, -d).max(zero);
            let s = v[i].abs();
            // a component of 0 never arrives, even from the wall itself
            let sooner = (d * den).lt(num * s) & zero.lt(s);
            num = sooner.select(d, num);
            den = sooner.select(s, den);
            for j in 0..i {
                first[j] = first[j] & !sooner;
            }
            first[i] = sooner;
        }
        let time = num / den;
        let (mut point, mut normal, mut piece, mut corner) = (*x, [zero; N], zero, zero.lt(zero));
        for i in 0..N {
            let up = zero.lt(v[i]);
            let p = x[i] + time * v[i];
            point[i] = first[i].select(ahead[i], p);
            let [lower, upper] = self.inner[i];
            corner = corner | (!first[i] & (p.lt(zero.same(lower)) | zero.same(upper).lt(p)));
            normal[i] = first[i].select(up.select(zero.same(-1.0), zero.same(1.0)), zero);
            let number = up.select(zero.same(self.pieces[i][1]), zero.same(self.pieces[i][0]));
            piece = first[i].select(number, piece);
        }
        WallHit { time, point, normal, inverse: zero.same(1.0), inverse_square: zero.same(1.0), piece, corner }
    }
}

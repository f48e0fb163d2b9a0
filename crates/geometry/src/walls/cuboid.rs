//! A box with sides along the axes: rectangle and cuboid.
use super::{CORNER, WallHit, Walls, sooner};
use crate::Error;
use lanes::{Lane, Mask};

/// `low_i < x_i < high_i` in ℝᴺ.
#[derive(Clone, Debug)]
pub struct Cuboid<const N: usize> {
    low: [f64; N],
    high: [f64; N],
    /// Within this distance of the middle a point of a wall is no corner.
    middle: [f64; N],
    inner: [f64; N],
    /// Numbers of the lower and the upper wall of each axis.
    pieces: [[f64; 2]; N],
}

impl<const N: usize> Cuboid<N> {
    /// The box between two opposite corners \[L\], with the numbers of the lower and the upper wall of each axis.
    ///
    /// # Errors
    /// [`Error::Parameter`] unless `low < high` in each coordinate, all finite.
    pub fn new(low: [f64; N], high: [f64; N], pieces: [[usize; 2]; N]) -> Result<Self, Error> {
        let (mut middle, mut inner) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            if !(low[i] < high[i] && low[i].is_finite() && high[i].is_finite()) {
                return Err(Error::Parameter { name: "size", must: "positive and finite", value: high[i] - low[i] });
            }
            let margin = CORNER * low[i].abs().max(high[i].abs());
            middle[i] = 0.5 * low[i] + 0.5 * high[i];
            inner[i] = 0.5 * high[i] - 0.5 * low[i] - margin;
        }
        Ok(Cuboid { low, high, middle, inner, pieces: pieces.map(|p| p.map(|p| p as f64)) })
    }
}

impl<const N: usize> Walls<N> for Cuboid<N> {
    fn is_along_axes(&self) -> bool {
        true
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let zero = v[0].same(0.0);
        let one = zero.same(1.0);
        let never = zero.never();
        // per axis: the wall ahead, the distance to it and the speed towards it
        let (mut num, mut den, mut piece) = (zero.same(f64::INFINITY), one, zero);
        let mut first = [never; N];
        let (mut ahead, mut inward) = ([zero; N], [zero; N]);
        for i in 0..N {
            let [low, high] = [self.low[i], self.high[i]].map(|x| zero.same(x));
            let [below, above] = self.pieces[i].map(|p| zero.same(p));
            let number;
            let distance;
            [ahead[i], distance, inward[i], number] =
                zero.lt(v[i]).choose([high, high - x[i], -one, above], [low, x[i] - low, one, below]);
            let speed = v[i].abs();
            if i == 0 {
                [num] = zero.lt(speed).choose([distance], [num]);
                [den, piece] = [speed, number];
                first[0] = !never;
                continue;
            }
            let sooner = sooner([distance.max(zero), speed], [num, den]);
            [num, den, piece] = sooner.choose([distance, speed, number], [num, den, piece]);
            for j in 0..i {
                first[j] = sooner.either(never, first[j]);
            }
            first[i] = sooner.either(!never, never);
        }
        let time = num / den;
        let (mut point, mut normal) = (*x, [zero; N]);
        let mut corner = never;
        for i in 0..N {
            let p = x[i] + time * v[i];
            let outer = zero.same(self.inner[i]).lt((p - self.middle[i]).abs());
            corner = corner | first[i].either(never, outer);
            [point[i], normal[i]] = first[i].choose([ahead[i], inward[i]], [p, zero]);
        }
        WallHit { time, point, normal, inverse: one, piece, corner }
    }
}

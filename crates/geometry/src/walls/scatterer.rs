//! The outside of a sphere: a scatterer.
use super::{WallHit, Walls};
use crate::{Error, plane::slack};
use lanes::{Lane, Mask, dot};
use nalgebra::SVector;

/// The complement of the ball of radius `r` about `c` in ℝᴺ.
#[derive(Clone, Debug)]
pub struct Scatterer<const N: usize> {
    center: [f64; N],
    square: f64,
    inverse: f64,
    /// `1/(2 r²)`
    half: f64,
    /// By how much `|x − c|² − r²` may be negative through rounding.
    off: f64,
    piece: f64,
}

impl<const N: usize> Scatterer<N> {
    /// The scatterer about `center` \[L\] with a positive radius \[L\].
    ///
    /// # Errors
    /// [`Error::Radius`] unless the radius is positive and finite.
    pub fn new(center: SVector<f64, N>, radius: f64, piece: usize) -> Result<Self, Error> {
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(Error::Radius { radius });
        }
        let square = radius * radius;
        Ok(Scatterer {
            center: center.into(),
            square,
            inverse: 1.0 / radius,
            half: 0.5 / square,
            off: 2.0 * radius * slack(center.iter().copied().chain([radius])),
            piece: piece as f64,
        })
    }
}

impl<const N: usize> Walls<N> for Scatterer<N> {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let mut y = *x;
        for i in 0..N {
            y[i] = y[i] - self.center[i];
        }
        let zero = v[0].same(0.0);
        let b = dot(&y, v);
        let approaches = b.lt(zero);
        let (a, c) = (dot(v, v), dot(&y, &y) - self.square);
        // the earlier root of |y + t v|² = r², without cancellation, where the path approaches and meets the ball
        // b² − a c = |v|² r² − |y ∧ v|², in which the distance of a far start does not cancel
        let mut discriminant = a * self.square;
        for i in 1..N {
            for j in 0..i {
                let moment = y[j] * v[i] - y[i] * v[j];
                discriminant = discriminant - moment * moment;
            }
        }
        let meets = zero.lt(discriminant) & approaches & zero.same(-self.off).lt(c);
        if !meets.any() {
            return WallHit::never(*x);
        }
        let q = discriminant.sqrt() - b;
        let time = meets.select(c.max(zero) / q, zero.same(f64::INFINITY));
        let mut lacks = zero.same(self.square);
        for i in 0..N {
            y[i] = y[i] + time * v[i];
            lacks = lacks - y[i] * y[i];
        }
        // |y|² is r² up to rounding: one Newton step each for y on the sphere and 1/|y|
        let change = lacks * self.half;
        let mut point = y;
        for i in 0..N {
            point[i] = y[i] + y[i] * change + self.center[i];
        }
        WallHit {
            time,
            point,
            normal: y,
            inverse: change * self.inverse + self.inverse,
            piece: zero.same(self.piece),
            corner: zero.never(),
        }
    }
}

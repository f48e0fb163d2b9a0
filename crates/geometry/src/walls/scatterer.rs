//! The outside of a sphere: a scatterer.
use super::{WallHit, Walls};
use crate::{
    Error,
    plane::{finite, is_radius, slack},
};
use lanes::{Double, Lane, Mask, dot};
use nalgebra::SVector;

/// The complement of the ball of radius `r` about `c` in ℝᴺ. The ball must not be tiny compared with the flights to it: where the
/// radius is 10⁻⁸ of a flight or less, [`Few`](super::Few) and [`Solid`](crate::parry::Solid) give more digits of the normal.
#[derive(Clone, Debug)]
pub struct Scatterer<const N: usize>(Round<f64, N>);

/// The data of a ball that a hit needs, with another ball in each lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round<F, const N: usize> {
    pub(super) center: [F; N],
    pub(super) square: F,
    pub(super) inverse: F,
    /// `1/(2 r²)`
    pub(super) half: F,
    /// How far below zero rounding may take `|x − c|² − r²`.
    pub(super) off: F,
    pub(super) piece: F,
}

/// How a path comes to a ball.
#[derive(Clone, Copy, Debug)]
pub(super) struct Approach<F: Lane, const N: usize> {
    /// Whether it meets it.
    pub(super) meets: F::Mask,
    discriminant: F,
    /// `|v|²`
    a: F,
    b: F,
    c: F,
    /// The point of its line closest to the centre, relative to the centre, times `|v|²`.
    aside: [F; N],
}

impl<const N: usize> Scatterer<N> {
    /// The scatterer about `center` \[L\] with a positive radius \[L\].
    ///
    /// # Errors
    /// [`Error::Radius`] unless the radius is positive and finite, [`Error::Length`] unless it is between 10⁻¹⁵⁰ and 10¹⁵⁰,
    /// [`Error::Parameter`] for a centre that is not finite.
    pub fn new(center: SVector<f64, N>, radius: f64, piece: usize) -> Result<Self, Error> {
        finite("center", &center)?;
        is_radius(radius)?;
        let square = radius * radius;
        // the inverse of the length that a normal really has, so that the energy changes as little as possible at every hit
        let inverse = Double::new(1.0).over(Double::new(square).root()).value();
        Ok(Scatterer(Round {
            center: center.into(),
            square,
            inverse,
            half: 0.5 / square,
            off: 2.0 * radius * slack(center.iter().copied().chain([radius])),
            piece: piece as f64,
        }))
    }

    /// The ball's data.
    pub(super) fn round(&self) -> &Round<f64, N> {
        &self.0
    }

    /// The same ball in as many lanes as `zero` has.
    #[inline(always)]
    pub(super) fn in_lanes<F: Lane>(&self, zero: F) -> Round<F, N> {
        let mut center = [zero; N];
        for i in 0..N {
            center[i] = zero.same(self.0.center[i]);
        }
        let Round { square, inverse, half, off, piece, .. } = self.0;
        Round {
            center,
            square: zero.same(square),
            inverse: zero.same(inverse),
            half: zero.same(half),
            off: zero.same(off),
            piece: zero.same(piece),
        }
    }
}

impl<F: Lane, const N: usize> Round<F, N> {
    /// `other` in the lanes where `second` is set, and this ball elsewhere.
    #[inline(always)]
    pub(super) fn or(mut self, second: F::Mask, other: &Self) -> Self {
        for i in 0..N {
            self.center[i] = second.select(other.center[i], self.center[i]);
        }
        self.square = second.select(other.square, self.square);
        self.inverse = second.select(other.inverse, self.inverse);
        self.half = second.select(other.half, self.half);
        self.off = second.select(other.off, self.off);
        self.piece = second.select(other.piece, self.piece);
        self
    }

    /// How the path `x + t v` comes to the ball.
    #[inline(always)]
    pub(super) fn approach(&self, x: &[F; N], v: &[F; N]) -> Approach<F, N> {
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
        let mut aside = [zero; N];
        for i in 1..N {
            for j in 0..i {
                let moment = y[i] * v[j] - y[j] * v[i];
                discriminant = discriminant - moment * moment;
                aside[i] = aside[i] + moment * v[j];
                aside[j] = aside[j] - moment * v[i];
            }
        }
        let meets = zero.lt(discriminant) & approaches & (-self.off).lt(c);
        Approach { meets, discriminant, a, b, c, aside }
    }

    /// The hit at that time.
    #[inline(always)]
    pub(super) fn landing(&self, x: &[F; N], v: &[F; N], time: F) -> WallHit<F, N> {
        let mut y = *x;
        let mut lacks = self.square;
        for i in 0..N {
            y[i] = (x[i] - self.center[i]) + time * v[i];
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
            piece: self.piece,
            corner: time.never(),
        }
    }
}

impl<F: Lane, const N: usize> Approach<F, N> {
    /// When the path comes in; infinite where it does not.
    #[inline(always)]
    pub(super) fn time(&self) -> F {
        self.time_of(self.discriminant.sqrt())
    }

    #[inline(always)]
    fn time_of(&self, root: F) -> F {
        let q = root - self.b;
        self.meets.select(self.c.max(q.same(0.0)) / q, q.same(f64::INFINITY))
    }

    /// The hit of that ball.
    ///
    /// `(aside − √discriminant v)/|v|²` relative to the centre: the division finishes before the square root, the next flight does not
    /// wait for the time, and the length is the radius to rounding however far away the path starts.
    #[inline(always)]
    fn hit(&self, ball: &Round<F, N>, v: &[F; N]) -> WallHit<F, N> {
        let root = self.discriminant.sqrt();
        let inverse = root.same(1.0) / self.a;
        let (mut normal, mut point) = (*v, *v);
        for i in 0..N {
            normal[i] = (self.aside[i] - root * v[i]) * inverse;
            point[i] = normal[i] + ball.center[i];
        }
        let time = self.time_of(root);
        WallHit { time, point, normal, inverse: ball.inverse, piece: ball.piece, corner: time.never() }
    }
}

impl<const N: usize> Walls<N> for Scatterer<N> {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let ball = self.in_lanes(v[0]);
        let approach = ball.approach(x, v);
        if !approach.meets.any() {
            return WallHit::never(*x);
        }
        approach.hit(&ball, v)
    }
}

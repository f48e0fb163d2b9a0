//! Capsules in space.
use super::round::{Pass, Round, across, along, seen};
use crate::crossing::Candidate;
use lanes::{Lane, Mask};
use nalgebra::Vector3;

/// All points within `r` of a segment: a tube between two balls.
#[derive(Clone, Debug)]
pub(super) struct Pill {
    middle: [f64; 3],
    axis: [f64; 3],
    half_length: f64,
    radius: f64,
    /// Its parts: the tube, and the balls at its start and its end.
    pub(super) parts: [Round; 3],
}

impl Pill {
    /// The capsule about the segment between two different points \[L\].
    pub(super) fn new([a, b]: [Vector3<f64>; 2], radius: f64) -> Pill {
        let (middle, way) = (a * 0.5 + b * 0.5, b - a);
        let axis = way / way.norm();
        let parts = [Round::new(middle, Some(axis), radius), Round::new(a, None, radius), Round::new(b, None, radius)];
        Pill { middle: middle.into(), axis: axis.into(), half_length: 0.5 * way.norm(), radius, parts }
    }

    /// Where a path that starts inside goes out, and through which part.
    #[inline(always)]
    pub(super) fn leaves<F: Lane>(&self, x: &[F; 3], v: &[F; 3]) -> (Candidate<F>, F) {
        let (tube, [height, rise]) = self.tube(x, v);
        let [num, den] = tube.exit();
        let (end, part) = self.end(height * den + rise * num, den);
        let [num, den] = part.lt(part.same(0.5)).choose([num, den], self.ball(x, v, end).exit());
        (Candidate { really: !num.never(), num, den }, part)
    }

    /// Where a path comes in from outside, and through which part. A start may lie inside by `slack` \[L\].
    ///
    /// It enters the infinite tube first. Where that is beyond an end it can only meet the ball there.
    #[inline(always)]
    pub(super) fn enters<F: Lane>(&self, x: &[F; 3], v: &[F; 3], slack: F) -> (Candidate<F>, F) {
        let off = slack * (-2.0 * self.radius);
        let (tube, [height, rise]) = self.tube(x, v);
        let side = tube.enters(off);
        let [num, den] = tube.entry();
        let (end, part) = self.end(height * den + rise * num, den);
        let cap = self.ball(x, v, end).enters(off);
        let flat = part.lt(part.same(0.5));
        let [num, den] = flat.choose([side.num, side.den], [cap.num, cap.den]);
        (Candidate { really: flat.either(side.really, cap.really), num, den }, part)
    }

    /// How a path passes the tube, its height above the middle, and the rate at which that grows.
    #[inline(always)]
    fn tube<F: Lane>(&self, x: &[F; 3], v: &[F; 3]) -> (Pass<F>, [F; 2]) {
        let y = seen(x, &self.middle);
        let pass = Pass::of(&across(&y, &self.axis), &across(v, &self.axis), self.radius * self.radius);
        (pass, [along(&y, &self.axis), along(v, &self.axis)])
    }

    /// For a crossing of the tube at the height `num/den`: the height of the ball at that end, and the part that
    /// is hit.
    #[inline(always)]
    fn end<F: Lane>(&self, num: F, den: F) -> (F, F) {
        let zero = num.same(0.0);
        let flat = num.abs().lt(den * self.half_length);
        let cap = zero.lt(num).select(zero.same(2.0), zero.same(1.0));
        (zero.same(self.half_length).copysign(num), flat.select(zero, cap))
    }

    /// How a path passes the ball at this height.
    #[inline(always)]
    fn ball<F: Lane>(&self, x: &[F; 3], v: &[F; 3], height: F) -> Pass<F> {
        let y = seen(x, &self.middle);
        let w = [y[0] - height * self.axis[0], y[1] - height * self.axis[1], y[2] - height * self.axis[2]];
        Pass::of(&w, v, self.radius * self.radius)
    }
}

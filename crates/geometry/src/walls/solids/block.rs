//! Obstacles with flat faces.
use super::round::{Round, along};
use crate::crossing::Candidate;
use lanes::{Lane, Mask};
use nalgebra::Vector3;

/// All points with `n·x ≤ d`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// `n`, a unit vector that points out.
    pub(super) normal: [f64; 3],
    /// `d` \[L\]
    pub(super) distance: f64,
}

impl Plane {
    pub(super) fn new(through: &Vector3<f64>, normal: &Vector3<f64>) -> Plane {
        Plane { normal: (*normal).into(), distance: normal.dot(through) }
    }

    /// The same plane facing the other way.
    pub(super) fn turned(&self) -> Plane {
        Plane { normal: self.normal.map(|n| -n), distance: -self.distance }
    }

    /// How far beyond the plane a point lies \[L\].
    #[inline(always)]
    pub(super) fn off<F: Lane>(&self, point: &[F; 3]) -> F {
        along(point, &self.normal) - self.distance
    }

    /// Where a path that starts behind the plane crosses it.
    #[inline(always)]
    pub(super) fn leaves<F: Lane>(&self, x: &[F; 3], v: &[F; 3]) -> Candidate<F> {
        let speed = along(v, &self.normal);
        Candidate { really: speed.same(0.0).lt(speed), num: -self.off(x), den: speed }
    }
}

/// The points behind some planes, and in a tube or a ball where there is one.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) planes: Vec<Plane>,
    pub(super) round: Option<Round>,
}

impl Block {
    /// Where a path comes in from outside, and through which face: the planes in their order, then the tube.
    ///
    /// A start may lie inside by `slack` \[L\].
    #[inline(always)]
    pub(super) fn enters<F: Lane>(&self, x: &[F; 3], v: &[F; 3], slack: F) -> (Candidate<F>, F) {
        let zero = v[0].same(0.0);
        let one = zero.same(1.0);
        // the last entry and the first exit; whether the entry lies ahead; whether there is none
        let (mut enter, mut exit) = ([zero.same(f64::NEG_INFINITY), one], [zero.same(f64::INFINITY), one]);
        let (mut face, mut ahead, mut gone) = (zero, zero.never(), zero.never());
        let mut number = 0.0;
        for plane in &self.planes {
            let (off, speed) = (plane.off(x), along(v, &plane.normal));
            let comes = speed.lt(zero);
            let later = comes & (enter[0] * -speed).lt(off * enter[1]);
            let [num, den, at] = later.choose([off, -speed, zero.same(number)], [enter[0], enter[1], face]);
            (enter, face) = ([num, den], at);
            ahead = later.either((-slack).lt(off), ahead);
            let sooner = !comes & (-off * exit[1]).lt(exit[0] * speed);
            exit = sooner.choose([-off, speed], exit);
            gone = gone | (!comes & slack.lt(off));
            number += 1.0;
        }
        if let Some(round) = &self.round {
            let (pass, off) = (round.pass(x, v), slack * (2.0 * round.radius));
            let [num, den] = pass.entry();
            let later = (enter[0] * den).lt(num * enter[1]);
            let [num, den, at] = later.choose([num, den, zero.same(number)], [enter[0], enter[1], face]);
            (enter, face) = ([num, den], at);
            ahead = later.either(pass.approaches(-off), ahead);
            let [num, den] = pass.exit();
            let sooner = (num * exit[1]).lt(exit[0] * den);
            exit = sooner.choose([num, den], exit);
            gone = gone | pass.is_along().either(off.lt(pass.c), !pass.meets());
        }
        let really = ahead & !gone & (enter[0] * exit[1]).lt(exit[0] * enter[1]);
        (Candidate { really, num: enter[0], den: enter[1] }, face)
    }
}

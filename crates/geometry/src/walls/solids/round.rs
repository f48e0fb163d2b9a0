//! Balls and tubes.
use crate::{chord::is_chord, crossing::Candidate};
use lanes::{Lane, Mask, dot};
use nalgebra::Vector3;

/// All points within `r` of a centre, or of a line through it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round {
    pub(super) center: [f64; 3],
    /// A unit vector along the line; a ball has none.
    pub(super) axis: Option<[f64; 3]>,
    pub(super) radius: f64,
    square: f64,
}

/// How the line of a path `x + t v` passes a ball or a tube: inside while `a t² + 2 b t + c ≤ 0`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pass<F: Lane> {
    a: F,
    pub(super) b: F,
    pub(super) c: F,
    /// `b² − a c`
    discriminant: F,
    /// Whether it is a chord from the surface.
    is_chord: F::Mask,
}

/// The component perpendicular to a unit vector.
#[inline(always)]
pub(super) fn across<F: Lane>(w: &[F; 3], axis: &[f64; 3]) -> [F; 3] {
    let along = along(w, axis);
    [w[0] - along * axis[0], w[1] - along * axis[1], w[2] - along * axis[2]]
}

/// The component along a vector.
#[inline(always)]
pub(super) fn along<F: Lane>(w: &[F; 3], axis: &[f64; 3]) -> F {
    w[0] * axis[0] + w[1] * axis[1] + w[2] * axis[2]
}

/// A point relative to another one.
#[inline(always)]
pub(super) fn seen<F: Lane>(x: &[F; 3], from: &[f64; 3]) -> [F; 3] {
    [x[0] - from[0], x[1] - from[1], x[2] - from[2]]
}

impl Round {
    pub(super) fn new(center: Vector3<f64>, axis: Option<Vector3<f64>>, radius: f64) -> Round {
        Round { center: center.into(), axis: axis.map(Into::into), radius, square: radius * radius }
    }

    /// The distance of a nearby point from the surface \[L\].
    #[inline(always)]
    pub(super) fn off<F: Lane>(&self, point: &[F; 3]) -> F {
        let mut w = seen(point, &self.center);
        if let Some(axis) = &self.axis {
            w = across(&w, axis);
        }
        (dot(&w, &w) - self.square) * (0.5 / self.radius)
    }

    #[inline(always)]
    pub(super) fn pass<F: Lane>(&self, x: &[F; 3], v: &[F; 3]) -> Pass<F> {
        let (mut w, mut u) = (seen(x, &self.center), *v);
        if let Some(axis) = &self.axis {
            (w, u) = (across(&w, axis), across(v, axis));
        }
        Pass::of(&w, &u, self.square)
    }
}

impl<F: Lane> Pass<F> {
    /// The passage by a ball or a tube with this squared radius, from position and velocity relative to its middle
    /// (perpendicular to the axis of a tube).
    #[inline(always)]
    pub(super) fn of(w: &[F; 3], u: &[F; 3], square: f64) -> Pass<F> {
        let (a, b, c) = (dot(u, u), dot(w, u), dot(w, w) - square);
        // b² − a c = |u|² r² − |w ∧ u|², in which the distance of a far start does not cancel
        let mut discriminant = a * square;
        for [i, j] in [[1, 0], [2, 0], [2, 1]] {
            let moment = w[j] * u[i] - w[i] * u[j];
            discriminant = discriminant - moment * moment;
        }
        Pass { a, b, c, discriminant, is_chord: is_chord([a, b, c], square) }
    }

    /// Whether the line comes in at all; undetermined for a line along a tube.
    #[inline(always)]
    pub(super) fn meets(&self) -> F::Mask {
        self.b.same(0.0).lt(self.discriminant)
    }

    /// Whether the path is parallel to the axis.
    #[inline(always)]
    pub(super) fn is_along(&self) -> F::Mask {
        !self.b.same(0.0).lt(self.a)
    }

    /// When a line that meets it comes in, as a fraction: the earlier root; along a tube −∞.
    ///
    /// Where the terms of a root cancel, so do those of `c`: computing the root from the product of the roots would give no
    /// more digits of the position.
    #[inline(always)]
    pub(super) fn entry(&self) -> [F; 2] {
        self.root([-(self.b + self.half_chord()), self.a], f64::NEG_INFINITY)
    }

    /// When it goes out: the later root; along a tube +∞.
    #[inline(always)]
    pub(super) fn exit(&self) -> [F; 2] {
        self.root([self.is_chord.select(-self.b, self.half_chord()) - self.b, self.a], f64::INFINITY)
    }

    /// Half of the time inside, times `a`.
    #[inline(always)]
    fn half_chord(&self) -> F {
        self.discriminant.max(self.a.same(0.0)).sqrt()
    }

    #[inline(always)]
    fn root(&self, root: [F; 2], endless: f64) -> [F; 2] {
        self.is_along().choose([self.a.same(endless), self.a.same(1.0)], root)
    }

    /// Where a path that is inside goes out.
    #[inline(always)]
    pub(super) fn leaves(&self) -> Candidate<F> {
        let [num, den] = self.exit();
        Candidate { really: num.lt(num.same(f64::INFINITY)), num, den }
    }

    /// Where a path comes in; a start counts as outside down to this value of `c`.
    #[inline(always)]
    pub(super) fn enters(&self, off: F) -> Candidate<F> {
        let [num, den] = self.entry();
        Candidate { really: self.meets() & self.approaches(off), num, den }
    }

    /// Whether a path approaches from outside, down to this value of `c`.
    #[inline(always)]
    pub(super) fn approaches(&self, off: F) -> F::Mask {
        self.b.lt(self.b.same(0.0)) & off.lt(self.c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_along_a_tube_neither_enters_nor_leaves_it() {
        let tube = Round::new(Vector3::new(0.5, 0.0, 0.0), Some(Vector3::z()), 1.0);
        let pass = tube.pass(&[0.75, 0.25, 3.0], &[0.0, 0.0, -2.0]);
        assert!(pass.is_along());
        assert_eq!((pass.entry(), pass.exit()), ([f64::NEG_INFINITY, 1.0], [f64::INFINITY, 1.0]));
        assert!(!pass.leaves().really && !pass.enters(0.0).really);
    }
}

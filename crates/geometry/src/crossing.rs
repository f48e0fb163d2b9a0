//! Times as fractions, so that comparing two needs no division.
use lanes::{Lane, Mask};

/// The time `num / den` at which a path crosses a piece outwards; `den > 0`, and `num` is infinite where it never does.
///
/// Fractions are compared by cross-multiplication, so that finding the first of many crossings costs one division,
/// at the end.
#[derive(Clone, Copy, Debug)]
pub struct Crossing<F = f64> {
    /// Numerator, never negative.
    pub num: F,
    /// Denominator, positive.
    pub den: F,
}

impl<F: Lane> Crossing<F> {
    /// A crossing at time `num / den` where `really` holds, and none elsewhere. A negative numerator (a start that
    /// rounding put outside) counts as 0.
    #[inline(always)]
    pub fn when(really: F::Mask, num: F, den: F) -> Self {
        let zero = num.same(0.0);
        Crossing {
            num: really.select(zero.lt(num).select(num, zero), num.same(f64::INFINITY)),
            den: really.select(den, num.same(1.0)),
        }
    }

    /// Whether this comes strictly before the other one.
    #[inline(always)]
    pub fn before(&self, other: &Self) -> F::Mask {
        (self.num * other.den).lt(other.num * self.den)
    }

    /// The time itself; infinite where there is none.
    #[inline(always)]
    pub fn time(&self) -> F {
        self.num / self.den
    }
}

/// What a piece finds in every lane: a crossing at time `num / den` where `really` holds and `den > 0`.
///
/// Comparing it with another crossing by cross-multiplication needs no test of the sign of `den`: a numerator ≥ 0 times a
/// positive denominator is never less than a time ≥ 0 times a `den` ≤ 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate<F: Lane> {
    pub(crate) really: F::Mask,
    /// Negative where rounding put the start outside, which counts as 0.
    pub(crate) num: F,
    pub(crate) den: F,
}

impl<F: Lane> From<Candidate<F>> for Crossing<F> {
    #[inline(always)]
    fn from(candidate: Candidate<F>) -> Self {
        let Candidate { really, num, den } = candidate;
        Crossing::when(really & num.same(0.0).lt(den), num, den)
    }
}

impl Crossing {
    /// No crossing.
    pub const NEVER: Crossing = Crossing { num: f64::INFINITY, den: 1.0 };
}

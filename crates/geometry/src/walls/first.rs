//! The first of several crossings.
use crate::crossing::Candidate;
use lanes::{Lane, Mask};

/// The first of the crossings considered so far, and the index in some list of what is crossed.
pub(super) struct First<F: Lane> {
    pub(super) num: F,
    pub(super) den: F,
    pub(super) place: F,
}

impl<F: Lane> First<F> {
    /// None so far, in lanes like those of `zero`.
    #[inline(always)]
    pub(super) fn none(zero: F) -> Self {
        First { num: zero.same(f64::INFINITY), den: zero.same(1.0), place: zero }
    }

    /// Takes a crossing if it comes before; what is crossed has the same index in every lane.
    #[inline(always)]
    pub(super) fn look(&mut self, candidate: Candidate<F>, place: f64) {
        self.look_at(candidate, candidate.num.same(place));
    }

    /// Takes a crossing if it comes before, with an index for each lane.
    #[inline(always)]
    pub(super) fn look_at(&mut self, candidate: Candidate<F>, place: F) {
        let Candidate { really, num, den } = candidate;
        // most pieces are not met: for a single path return at once
        if F::LANES == 1 && !really.any() {
            return;
        }
        let num = num.max(num.same(0.0));
        let sooner = really & (num * self.den).lt(self.num * den);
        [self.num, self.den, self.place] = sooner.choose([num, den, place], [self.num, self.den, self.place]);
    }
}

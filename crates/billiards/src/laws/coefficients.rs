//! The numbers of a law, the same in all lanes or one set for each.
use lanes::{Lane, Rows};

/// Four coefficients that stand together, and one more.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coefficients<F = f64>(pub(super) [F; 4], pub(super) F);

impl Coefficients {
    /// The coefficients in lanes like those of `like`.
    #[inline(always)]
    pub(super) fn in_lanes<F: Lane>(&self, like: F) -> Coefficients<F> {
        let [a, b, c, d] = self.0;
        Coefficients([like.same(a), like.same(b), like.same(c), like.same(d)], like.same(self.1))
    }
}

/// The coefficients of several laws.
#[derive(Clone, Debug)]
pub(super) struct Table {
    four: Rows,
    other: Rows,
}

impl Table {
    /// Those of some laws, one after another.
    pub(super) fn new<'a>(laws: impl Iterator<Item = &'a Coefficients> + Clone) -> Table {
        let other = laws.clone().map(|law| [law.1, 0.0, 0.0, 0.0]);
        Table { four: Rows::new(laws.map(|law| law.0).collect()), other: Rows::new(other.collect()) }
    }

    /// The coefficients of the law at a place in each lane.
    #[inline(always)]
    pub(super) fn at<F: Lane>(&self, place: F) -> Coefficients<F> {
        let [other, ..] = self.other.at(place);
        Coefficients(self.four.at(place), other)
    }
}

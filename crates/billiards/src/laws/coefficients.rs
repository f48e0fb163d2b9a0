//! The numbers of a law, the same in all lanes or one set for each.
use lanes::Lane;

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

    /// The coefficients that `of` has for each lane, as many as `like` has.
    #[inline(always)]
    pub(super) fn by_lane<'a, F: Lane>(like: F, of: impl Fn(usize) -> &'a Self) -> Coefficients<F> {
        Coefficients(like.columns(|lane| &of(lane).0), like.each(|lane| of(lane).1))
    }
}

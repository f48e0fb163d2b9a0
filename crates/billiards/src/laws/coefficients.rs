//! The numbers of a law, the same in all lanes or one set for each.
use lanes::{Lane, MOST_LANES};

/// `K` coefficients.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coefficients<const K: usize, F = f64>(pub(super) [F; K]);

impl<const K: usize> Coefficients<K> {
    /// The coefficients in lanes like those of `like`.
    #[inline(always)]
    pub(super) fn in_lanes<F: Lane>(&self, like: F) -> Coefficients<K, F> {
        let mut lanes = [like; K];
        for i in 0..K {
            lanes[i] = like.same(self.0[i]);
        }
        Coefficients(lanes)
    }

    /// The coefficients that `of` has for each lane, as many as `like` has.
    #[inline(always)]
    pub(super) fn by_lane<'a, F: Lane>(like: F, of: impl Fn(usize) -> &'a Self) -> Coefficients<K, F> {
        let mut numbers = [[0.0; MOST_LANES]; K];
        for lane in 0..F::LANES {
            let Coefficients(of_lane) = of(lane);
            for i in 0..K {
                numbers[i][lane] = of_lane[i];
            }
        }
        let mut lanes = [like; K];
        for i in 0..K {
            lanes[i] = like.load(&numbers[i]);
        }
        Coefficients(lanes)
    }
}

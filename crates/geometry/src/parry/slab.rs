//! What tree traversals in the plane and in space share, made so that rounding never loses a piece.
use crate::{Crossing, Line};
use core::cell::Cell;
use nalgebra::SVector;

/// A path prepared for box tests.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab<const N: usize> {
    point: SVector<f64, N>,
    velocity: SVector<f64, N>,
    inverse: SVector<f64, N>,
    /// By how much boxes grow on each side \[L\].
    margin: f64,
}

/// No entry. parry's traversal skips a box with this cost.
const MISS: f64 = f64::MAX;

impl<const N: usize> Slab<N> {
    /// The path, for boxes whose coordinates do not exceed `size`.
    ///
    /// A piece decides for itself with an error of a few ulp of its distance from the start of the path, which is at
    /// most |x| + size; a box that is larger by ten times that holds every crossing the piece can find.
    pub(crate) fn new(path: &Line<N>, size: f64) -> Self {
        let far = path.point.amax() + size;
        Slab {
            point: path.point,
            velocity: path.velocity,
            inverse: path.velocity.map(|v| 1.0 / v),
            margin: 64.0 * f64::EPSILON * far,
        }
    }

    /// A lower bound of the time at which the path enters the box; `f64::MAX` if it never does.
    #[inline(always)]
    pub(crate) fn enters(&self, min: &[f64; N], max: &[f64; N]) -> f64 {
        // three roundings in each time: 8 ulp on either side cover them
        const SURE: f64 = 8.0 * f64::EPSILON;
        let (mut enter, mut exit) = (0.0_f64, f64::INFINITY);
        for i in 0..N {
            let (low, high) = ((min[i] - self.point[i]) - self.margin, (max[i] - self.point[i]) + self.margin);
            if self.velocity[i] == 0.0 {
                if low > 0.0 || high < 0.0 {
                    return MISS;
                }
                continue;
            }
            let (a, b) = (low * self.inverse[i], high * self.inverse[i]);
            enter = enter.max(a.min(b));
            exit = exit.min(a.max(b));
        }
        let enter = enter * (1.0 - SURE);
        if enter <= exit * (1.0 + SURE) { enter } else { MISS }
    }
}

/// The square of the distance from a point to a box, rounded down.
#[inline(always)]
pub(crate) fn distance_squared<const N: usize>(point: &SVector<f64, N>, min: &[f64; N], max: &[f64; N]) -> f64 {
    let mut sum = 0.0;
    for i in 0..N {
        let d = (min[i] - point[i]).max(point[i] - max[i]).max(0.0);
        sum += d * d;
    }
    sum * (1.0 - 8.0 * f64::EPSILON)
}

/// The power of two that brings a length to about 1; 1 for zero and what is not finite.
///
/// Multiplying by it is exact, so a table of any size behaves alike to the last bit.
pub(crate) fn to_unit(size: f64) -> f64 {
    if size > 0.0 && size.is_finite() { libm::ldexp(1.0, -libm::frexp(size).1) } else { 1.0 }
}

/// The first of the crossings offered, in whatever order: of equal times the lowest number.
pub(crate) struct First(Cell<(usize, Crossing)>);

impl First {
    pub(crate) fn new() -> Self {
        First(Cell::new((usize::MAX, Crossing::NEVER)))
    }

    /// Takes the crossing if it is the first so far, and returns the new limit.
    pub(crate) fn offer(&self, number: usize, crossing: Crossing) -> Option<f64> {
        let (best, first) = self.0.get();
        let earlier =
            crossing.before(&first) || (number < best && crossing.num < f64::INFINITY && !first.before(&crossing));
        if earlier {
            self.0.set((number, crossing));
        }
        earlier.then(|| self.limit())
    }

    /// A box entered after this time cannot change the answer: the best so far, and what rounding makes equal to it.
    pub(crate) fn limit(&self) -> f64 {
        (self.0.get().1.time() * (1.0 + 4.0 * f64::EPSILON) + f64::MIN_POSITIVE).min(f64::MAX)
    }

    pub(crate) fn found(&self) -> Option<(usize, Crossing)> {
        let (number, crossing) = self.0.get();
        (number != usize::MAX).then_some((number, crossing))
    }
}

//! Kinks that bounds on a second derivative do not tell from what is around them.
//!
//! About the kink of `√(1 − sin² φ)` the bounds on `r″` grow without end, as they do about the harmless places of `√(1 − sin² φ)³`,
//! and waves that are short hide kinks among them. Such places are looked at in numbers: across a kink the direction turns as much over
//! a millionth of a radian as over a hundred times as much.
use super::{Interval, PolarFormula};

/// Halvings until parts of a turn are places: below 10⁻⁷ radians the rounding of `1 − sin² φ` hides where it is 0.
const HALVINGS: u32 = 14;

/// Most parts of one width that are halved again, as for kinks that bounds tell: where there are more, they are looked at as they are.
const MOST: usize = 4096;

/// A kink is told at this distance (radians): there the slope of `√(1 − sin² φ)`, in which 10⁻¹⁶ is rounding of 10⁻¹², is right to
/// a thousandth.
const NEAR: f64 = 1e-6;

/// So many times as far around it a bend that merely has no bound turns more than twice as much, if it is that of a power above 1.17.
const AROUND: f64 = 64.0;

/// What turns by less (radians) over [`NEAR`] turns by rounding.
const ROUNDING: f64 = 1e-4;

/// Parts are cut here, not in the middle: at halves and quarters of a turn formulas have their kinks, and there perhaps no slope.
const CUT: f64 = 0.47;

/// The parts of a turn in which the second derivative has no bound.
fn unbounded<F: PolarFormula>(formula: &F, sectors: &[(Interval, [Interval; 3])]) -> Vec<Interval> {
    let is_bounded = |[.., second]: &[Interval; 3]| second.magnitude().is_finite();
    let mut parts: Vec<_> = sectors.iter().filter(|(_, jet)| !is_bounded(jet)).map(|(sector, _)| *sector).collect();
    for _ in 0..HALVINGS {
        if parts.len() > MOST {
            break;
        }
        let halves = parts.iter().flat_map(|&Interval { low, high }| {
            let middle = 0.5 * (low + high);
            [Interval { low, high: middle }, Interval { low: middle, high }]
        });
        parts = halves.filter(|half| !is_bounded(&formula.jet_over(*half))).collect();
    }
    parts
}

/// About where the first kink is, if there is one; `sectors` are those of a turn, with `r` and its derivatives in each.
pub(super) fn kink<F: PolarFormula>(formula: &F, sectors: &[(Interval, [Interval; 3])]) -> Option<f64> {
    let direction = |angle: f64| {
        let [r, slope, _] = formula.jet(angle);
        libm::atan2(slope, r)
    };
    let turning = |low: f64, high: f64| (direction(high) - direction(low)).abs();
    unbounded(formula, sectors).into_iter().find_map(|part| {
        // the kink may be an end of it
        let room = 0.5 * part.width().max(NEAR);
        let (mut low, mut high) = (part.low - room, part.high + room);
        while high - low > 2.0 * NEAR {
            let middle = low + CUT * (high - low);
            if turning(low, middle) > turning(middle, high) { high = middle } else { low = middle }
        }
        let angle = 0.5 * (low + high);
        let [here, around] = [NEAR, AROUND * NEAR].map(|far| turning(angle - far, angle + far));
        (here > ROUNDING && here > 0.5 * around).then_some(angle)
    })
}

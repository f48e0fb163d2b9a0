//! Where a radius as a function of the angle jumps.
use super::{Interval, PolarFormula, kinks::places};

/// The distance around a place (radians) at which a jump is told from an unbounded slope: a thousand times the width to which
/// places are known.
const NEAR: f64 = 4096.0 * f64::EPSILON;

/// Most parts of one width that may be doubtful: two about each of 2000 places.
const MOST: usize = 4096;

/// The angles on both sides of the first jump of `r(φ)` by more than `rounding`. `sectors` are those examined, with `r` and its
/// derivatives in each.
pub(super) fn jump<F: PolarFormula>(
    formula: &F,
    sectors: &[(Interval, [Interval; 3])],
    rounding: f64,
) -> Option<Interval> {
    let change = |a: f64, b: f64| formula.jet(b)[0] - formula.jet(a)[0];
    // whether `r` changes between two angles by no more than its slope allows
    let steady = |part: Interval, slope: Interval| {
        let (change, allowed) = (change(part.low, part.high), slope * part.width());
        let within = allowed.low - rounding <= change && change <= allowed.high + rounding;
        within && slope.magnitude().is_finite()
    };
    // an unbounded slope continues around a place, a jump does not
    let jumps = |place: &Interval| {
        let here = change(place.low, place.high).abs();
        let around = [(place.low - NEAR, place.high), (place.low, place.high + NEAR)];
        here > rounding && around.iter().all(|(a, b)| here > 0.5 * change(*a, *b).abs())
    };
    let unsteady = sectors.iter().filter(|(sector, [_, slope, _])| !steady(*sector, *slope)).map(|(sector, _)| *sector);
    places(unsteady, |part| steady(part, formula.jet_over(part)[1]), MOST)?.into_iter().find(jumps)
}

//! Kinks that bounds on a second derivative cannot separate from their surroundings.
//!
//! Around the kink of `√(1 − sin² φ)` the bounds on `r″` grow without limit, as they do around the harmless places of `√(1 − sin² φ)³`,
//! and short waves hide kinks among them. Such places are examined numerically: across a kink the direction turns as much over a
//! millionth of a radian as over a hundred times that.
use super::{Interval, PolarFormula};

/// Halvings until parts of a turn count as places: below 10⁻⁷ radians the rounding of `1 − sin² φ` hides where it is 0.
const HALVINGS: u32 = 14;

/// Most parts of one width that are halved again, as for kinks that bounds reveal: where there are more, they are examined as they are.
const MOST: usize = 4096;

/// A kink is recognised at this distance (radians): there the slope of `√(1 − sin² φ)`, whose radicand 10⁻¹² has a rounding of 10⁻¹⁶,
/// is accurate to a thousandth.
const NEAR: f64 = 1e-6;

/// Up to this many times [`NEAR`] from a kink, the slopes on either side are the same as close to it.
const AROUND: f64 = 64.0;

/// They differ there by less than this fraction of the jump of the slope; they differ by more at a cusp or where the bend is merely
/// unbounded, as for powers below 0.91 and above 1.06, and along the flank of a step.
const STEADY: f64 = 0.15;

/// Number of parts into which a part is cut first; the one where the slope changes most is examined more closely. (There may be a whole
/// wave in it.)
const FIRST: u32 = 16;

/// Least jump of the slope, in units of the radius: less may be rounding.
const ROUNDING: f64 = 1e-4;

/// Parts are cut here, not in the middle: formulas often have kinks, and perhaps no slope, at halves and quarters of a turn.
const CUT: f64 = 0.47;

/// The parts of a turn in which the second derivative has no known bound; none for a formula that gives no bounds at all, even on the
/// shortest parts, and so must be taken as it is.
fn unbounded<F: PolarFormula>(formula: &F, sectors: &[(Interval, [Interval; 3])]) -> Vec<Interval> {
    let is_bounded = |[.., second]: &[Interval; 3]| second.magnitude().is_finite();
    let mut parts: Vec<_> = sectors.iter().filter(|(_, jet)| !is_bounded(jet)).map(|(sector, _)| *sector).collect();
    let tells = |sector: &Interval| {
        let low = sector.low + CUT * sector.width();
        is_bounded(&formula.jet_over(Interval { low, high: low + NEAR }))
    };
    if !sectors.iter().any(|(sector, _)| tells(sector)) {
        return vec![];
    }
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

/// About where the first kink is, if there is one and the second derivative is bounded everywhere except at kinks; `sectors` are those
/// of a turn, with `r` and its derivatives in each.
///
/// Next to a cusp, or to a bend like that of `|φ|^1.5`, no arc can be represented by polynomials, so that knowing the kinks would be of
/// no use.
pub(super) fn kink<F: PolarFormula>(formula: &F, sectors: &[(Interval, [Interval; 3])]) -> Option<f64> {
    let slope = |angle: f64| {
        let [r, slope, _] = formula.jet(angle);
        slope / r
    };
    let change = |low: f64, high: f64| (slope(high) - slope(low)).abs();
    let parts = unbounded(formula, sectors);
    let are_places = parts.len() <= MOST;
    let mut kinks = parts.into_iter().map(|part| {
        // the kink may lie at its end
        let room = 0.5 * part.width().max(NEAR);
        let (mut low, width) = (part.low - room, (part.width() + 2.0 * room) / f64::from(FIRST));
        let starts = (0..FIRST).map(|k| low + f64::from(k) * width);
        let sharpest = starts.max_by(|a, b| change(*a, a + width).total_cmp(&change(*b, b + width)));
        low = sharpest.unwrap_or(low);
        let mut high = low + width;
        while high - low > 2.0 * NEAR {
            let middle = low + CUT * (high - low);
            if change(low, middle) > change(middle, high) { high = middle } else { low = middle }
        }
        let angle = 0.5 * (low + high);
        let here = change(angle - NEAR, angle + NEAR);
        let beside = [-NEAR, NEAR].map(|far| change(angle + far, angle + AROUND * far));
        (here > ROUNDING && beside.iter().all(|beside| *beside < STEADY * here)).then_some(angle)
    });
    if are_places { kinks.collect::<Option<Vec<f64>>>()?.first().copied() } else { kinks.find_map(|kink| kink) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{FRAC_PI_2, PI};

    /// `r = 2 + (1 − sin² φ)ᵖ`
    #[derive(Debug)]
    struct Power(f64);

    impl PolarFormula for Power {
        fn jet(&self, angle: f64) -> [f64; 3] {
            let (sin, cos) = libm::sincos(angle);
            let (base, p) = (1.0 - sin * sin, self.0);
            [2.0 + libm::pow(base, p), -2.0 * p * libm::pow(base, p - 1.0) * sin * cos, f64::NAN]
        }
        fn jet_over(&self, angle: Interval) -> [Interval; 3] {
            let [sin, cos] = angle.sin_cos();
            let (base, p) = (-sin.square() + 1.0, self.0);
            let slope = base.powf((p - 1.0).into()) * sin * cos * (-2.0 * p);
            let second = base.powf((p - 1.0).into()) * (sin.square() + -cos.square()) * (2.0 * p)
                + base.powf((p - 2.0).into()) * (sin * cos).square() * (4.0 * p * (p - 1.0));
            [base.powf(p.into()) + 2.0, slope, second]
        }
    }

    #[test]
    fn of_powers_of_the_same_formula_the_one_with_a_kink_is_told() {
        let sector = |k: u32| Interval::new(f64::from(k) * PI / 512.0, f64::from(k + 1) * PI / 512.0);
        for (p, has_kink) in [(0.25, false), (0.5, true), (0.7, false), (1.5, false), (2.0, false)] {
            let formula = Power(p);
            let sectors: Vec<_> = (0..1024).map(|k| (sector(k), formula.jet_over(sector(k)))).collect();
            let found = kink(&formula, &sectors);
            assert_eq!(found.is_some(), has_kink, "{p}: {found:?}");
            assert!(found.is_none_or(|angle| (angle - FRAC_PI_2).abs() < 1e-5), "{p}: {found:?}");
        }
    }
}

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

/// So far from a kink as this many times [`NEAR`], the slopes on either side are what they are near by.
const AROUND: f64 = 64.0;

/// They differ there by less than this part of what the slope jumps by; by more at a cusp or where a bend merely has no bound, as those
/// of powers below 0.91 and above 1.06, and along the flank of a step.
const STEADY: f64 = 0.15;

/// Parts of a part of which the one where the slope changes most is looked at more closely: there may be a whole wave in it.
const FIRST: u32 = 16;

/// What the slope, in units of the radius, jumps by at least: less may be rounding.
const ROUNDING: f64 = 1e-4;

/// Parts are cut here, not in the middle: at halves and quarters of a turn formulas have their kinks, and there perhaps no slope.
const CUT: f64 = 0.47;

/// The parts of a turn in which the second derivative has no bound; none of a formula that gives no bounds at all, even on the shortest
/// parts, so that it must be taken as it is.
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

/// About where the first kink is, if there is one and nothing else that the second derivative has no bound at; `sectors` are those of a
/// turn, with `r` and its derivatives in each.
///
/// Beside a cusp, or a bend like that of `|φ|^1.5`, no arc can be told by polynomials, so that there is no use in knowing kinks.
pub(super) fn kink<F: PolarFormula>(formula: &F, sectors: &[(Interval, [Interval; 3])]) -> Option<f64> {
    let slope = |angle: f64| {
        let [r, slope, _] = formula.jet(angle);
        slope / r
    };
    let change = |low: f64, high: f64| (slope(high) - slope(low)).abs();
    let parts = unbounded(formula, sectors);
    let are_places = parts.len() <= MOST;
    let mut kinks = parts.into_iter().map(|part| {
        // the kink may be an end of it
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

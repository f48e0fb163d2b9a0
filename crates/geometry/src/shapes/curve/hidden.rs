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

/// Where slopes differ on the two sides of a place by less than this fraction of what they differ by [`AROUND`] times as far away, there
/// is nothing: a 64th for a steady bend, a 55th for `|φ|^1.96`.
const LINEAR: f64 = 1.0 / 55.0;

/// Nor is there anything where they differ by less than this, in units of the radius.
const NOTHING: f64 = 1e-8;

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
        let halves = parts.iter().flat_map(|part| part.halves());
        parts = halves.filter(|half| !is_bounded(&formula.jet_over(*half))).collect();
    }
    parts
}

/// What there is at a place without a bound on the second derivative.
enum Place {
    /// About where the kink is.
    Kink(f64),
    /// Nothing, but for the bounds.
    Smooth,
    /// A cusp, or a bend like that of `|φ|^1.5`.
    Rough,
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
    let mut places = parts.into_iter().map(|part| {
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
        let around = change(angle - AROUND * NEAR, angle + AROUND * NEAR);
        if here > ROUNDING && beside.iter().all(|beside| *beside < STEADY * here) {
            Place::Kink(angle)
        } else if here <= LINEAR * around || here <= NOTHING {
            Place::Smooth
        } else {
            Place::Rough
        }
    });
    let kink = |place: Place| if let Place::Kink(angle) = place { Some(angle) } else { None };
    if !are_places {
        return places.find_map(kink);
    }
    let places: Vec<_> = places.collect();
    let is_known = !places.iter().any(|place| matches!(place, Place::Rough));
    places.into_iter().filter(|_| is_known).find_map(kink)
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

    /// `r = 2 + 0.2 arctan(1/cos² φ) + 0.1 |sin φ|`: at π/2 there is nothing, but bounds on the quotient do not show it.
    #[derive(Debug)]
    struct Quotient;

    impl PolarFormula for Quotient {
        fn jet(&self, angle: f64) -> [f64; 3] {
            let (sin, cos) = libm::sincos(angle);
            let square = cos * cos;
            let slope = 0.4 * sin * cos / (1.0 + square * square) + libm::copysign(0.1, sin) * cos;
            [2.0 + 0.2 * libm::atan(1.0 / square) + 0.1 * sin.abs(), slope, f64::NAN]
        }
        fn jet_over(&self, angle: Interval) -> [Interval; 3] {
            let [sin, cos] = angle.sin_cos();
            let is_known = !sin.contains(0.0) && !cos.contains(0.0);
            let some = Interval::new(-2.0, 2.0);
            [some + 2.0, some, if is_known { some } else { Interval::ENTIRE }]
        }
    }

    #[test]
    fn a_kink_is_told_although_another_place_is_smooth() {
        let sector = |k: u32| Interval::new(f64::from(k) * PI / 512.0, f64::from(k + 1) * PI / 512.0);
        let sectors: Vec<_> = (0..1024).map(|k| (sector(k), Quotient.jet_over(sector(k)))).collect();
        let found = kink(&Quotient, &sectors);
        assert!(found.is_some_and(|angle| angle.abs() < 1e-5), "{found:?}");
    }
}

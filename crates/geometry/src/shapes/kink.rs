//! Where a curve has a kink.
use crate::Piece;
use nalgebra::Vector2;

/// A sudden turn of a curve by less than this (radians) is due to rounding of its normals.
const ROUNDING: f64 = 1e-6;

/// The fraction of a curve's length that counts as a single place: nearer to a kink, rounding may spoil the direction of a formula.
const NARROW: f64 = 1e-7;

/// A kink that points away from the table and turns by more than this (radians) is the tip of a cusp: beyond it the parallels of its two
/// flanks cross.
const SHARP: f64 = 1.5;

/// The curve on an interval this many times wider around a place distinguishes a kink from an unbounded curvature.
const AROUND: f64 = 128.0;

/// Most intervals examined: where the formula's curvature does not belong to the curve, halving would never end.
const MOST: u32 = 1 << 16;

/// The angle from one unit vector to another, counter-clockwise.
pub(super) fn turning(a: &Vector2<f64>, b: &Vector2<f64>) -> f64 {
    libm::atan2(a.perp(b), a.dot(b))
}

/// The arc length of the first kink of a curve that points to the table, or of the tip of a cusp: a place where its direction turns by more
/// than its curvature explains. (A disk in the table does not reach other kinks.) It is searched for in parts between arc lengths, which
/// should not be much longer than the curve's features.
pub(crate) fn kink(curve: &dyn Piece, parts: impl Iterator<Item = [f64; 2]>) -> Option<f64> {
    let length = curve.length();
    let at = |s: f64| {
        let landing = curve.landing_at(s);
        (landing.normal, curve.curvature(&landing.point))
    };
    let mut open: Vec<_> = parts.map(|[low, high]| ([low, high], [at(low), at(high)])).collect();
    open.reverse();
    let mut looked_at = 0;
    while let Some(([low, high], [a, b])) = open.pop() {
        looked_at += 1;
        if looked_at > MOST {
            return None;
        }
        let s = 0.5 * (low + high);
        let middle = at(s);
        // Simpson's rule
        let told = (high - low) / 6.0 * (a.1 + 4.0 * middle.1 + b.1);
        if (turning(&a.0, &b.0) - told).abs() <= ROUNDING {
            continue;
        }
        if high - low > NARROW * length {
            open.extend([([s, high], [middle, b]), ([low, s], [a, middle])]);
            continue;
        }
        // at the kink itself the direction may be undefined
        let [here, around] = [2.0, AROUND].map(|times| {
            let [before, after] = [low, high].map(|end| (s + times * (end - s)).clamp(0.0, length));
            let [a, b] = [at(before), at(after)];
            let told = 0.5 * (after - before) * (a.1 + b.1);
            turning(&a.0, &b.0) - if told.is_finite() { told } else { 0.0 }
        });
        let matters = !(-ROUNDING..=SHARP).contains(&around);
        if matters && (here.abs() > 0.5 * around.abs() || here.is_nan()) {
            return Some(s);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{
        Ellipse,
        curve::{Interval, Polar, PolarFormula},
    };

    /// `r = 2 + a g(φ)`, with or without kinks, which do not show in the second derivative.
    #[derive(Clone, Copy, Debug)]
    struct Untold {
        size: f64,
        jet: fn(f64) -> [f64; 3],
    }

    impl PolarFormula for Untold {
        fn jet(&self, angle: f64) -> [f64; 3] {
            let [r, slope, bend] = (self.jet)(angle).map(|x| x * self.size);
            [2.0 + r, slope, bend]
        }
        fn jet_over(&self, _: Interval) -> [Interval; 3] {
            let [r, slope] = [1.6, 8.0].map(|most| Interval::new(-most, most) * self.size);
            [r + 2.0, slope, Interval::from(0.0)]
        }
    }

    fn found(size: f64, jet: fn(f64) -> [f64; 3]) -> Option<Vector2<f64>> {
        let curve = Polar::new(Vector2::zeros(), Untold { size, jet }, true).unwrap();
        let at = |k: u32| curve.length() * f64::from(k) / 128.0;
        kink(&curve, (0..128).map(|k| [at(k), at(k + 1)])).map(|s| curve.point_at(s))
    }

    #[test]
    fn kinks_of_every_size_are_found() {
        // arcsin sin φ has kinks at π/2, pointing away from the centre, and at 3π/2, pointing towards it; a disk reaches only the latter
        let sawtooth = |angle: f64| {
            let (sin, cos) = libm::sincos(angle);
            [libm::asin(sin), libm::copysign(1.0, cos), 0.0]
        };
        for size in [0.5, 0.1, 1e-3, 1e-5] {
            let at = found(size, sawtooth).expect("a kink");
            assert!(at.x.abs() < 1e-5 && at.y < -1.2, "{size}: {at:?}");
        }
    }

    #[test]
    fn a_kink_is_found_where_rounding_hides_it() {
        // the quotient has no correct digits within 1e-8 of the kinks, and no value at them
        let quotient = |angle: f64| {
            let (sin, cos) = libm::sincos(angle);
            let slope = cos / (1.0 - sin * sin).sqrt();
            [libm::asin(sin), slope, (slope * slope - 1.0) * sin / (1.0 - sin * sin).sqrt()]
        };
        let at = found(0.1, quotient).expect("a kink");
        assert!(at.x.abs() < 1e-5 && at.y < -1.2, "{at:?}");
    }

    #[test]
    fn smooth_curves_have_no_kink_however_they_bend() {
        let waves = |angle: f64| {
            let (sin, cos) = libm::sincos(5.0 * angle);
            [cos, -5.0 * sin, -25.0 * cos]
        };
        assert_eq!(found(0.3, waves), None);
        // |sin φ|^1.5 has an unbounded second derivative, (sin φ)₊² one that jumps
        let power = |angle: f64| {
            let (sin, cos) = libm::sincos(angle);
            let root = sin.abs().sqrt();
            [
                root * root * root,
                1.5 * libm::copysign(root, sin) * cos,
                0.75 / root * cos * cos - 1.5 * root * root * root,
            ]
        };
        assert_eq!(found(0.3, power), None);
        let half = |angle: f64| {
            let (sin, cos) = libm::sincos(angle);
            let up = sin.max(0.0);
            [up * up, 2.0 * up * cos, if sin > 0.0 { 2.0 * (cos * cos - sin * sin) } else { 0.0 }]
        };
        assert_eq!(found(0.3, half), None);
        let flat = Ellipse::new(Vector2::new(1.0, 2.0), [1.0, 1e-3], 0.4, false).unwrap();
        let at = |k: u32| flat.length() * f64::from(k) / 32.0;
        assert_eq!(kink(&flat, (0..32).map(|k| [at(k), at(k + 1)])), None);
    }
}

//! Curves about a centre by their points.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
use core::f64::consts::{PI, TAU};
use geometry::{
    Error, Line, Piece, Table, Vector2, enclosed_area,
    shapes::curve::{Interval, ParametricCurve, ParametricFormula, Polar, PolarFormula, PolarPoints},
};
use proptest::prelude::*;

/// `r = 1 + a cos(φ − φ₀)`
#[derive(Clone, Copy, Debug)]
struct Limacon {
    a: f64,
    start: f64,
}

impl PolarFormula for Limacon {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let (sin, cos) = libm::sincos(angle - self.start);
        [1.0 + self.a * cos, -self.a * sin, -self.a * cos]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let [sin, cos] = (angle + -self.start).sin_cos();
        [cos * self.a + 1.0, sin * -self.a, cos * -self.a]
    }
}

fn points(formula: Limacon, center: Vector2<f64>) -> PolarPoints<Limacon> {
    PolarPoints { center, formula }
}

#[test]
fn a_limacon_by_its_points_is_the_limacon() {
    let (formula, center) = (Limacon { a: 0.8, start: 0.3 }, Vector2::new(0.5, -2.0));
    let polar = Polar::new(center, formula, true).unwrap();
    let pieces = ParametricCurve::around(points(formula, center), [0.0, TAU], true).unwrap();
    let [curve] = &pieces[..] else { panic!("{} pieces", pieces.len()) };
    assert!((curve.length() / polar.length() - 1.0).abs() < 4e-15);
    assert!((curve.area() / polar.area() - 1.0).abs() < 4e-15);
    for k in 0..1000 {
        let (sin, cos) = libm::sincos(0.7 * f64::from(k));
        let path = Line { point: center + Vector2::new(0.1 * sin, 0.1 * cos), velocity: Vector2::new(cos, sin) };
        let (time, other) = (curve.crossing(&path).time(), polar.crossing(&path).time());
        assert!((time - other).abs() < 4e-15, "{path:?}: {time} {other}");
        let (here, there) = (curve.landing(&path, time), polar.landing(&path, other));
        assert!((here.normal - there.normal).amax() < 1e-14, "{path:?}");
    }
}

#[test]
fn a_curve_through_its_centre_has_a_cusp_there() {
    // wherever the cusp is, at the start of the range as well
    for (k, center) in (0..16).zip([Vector2::zeros(), Vector2::new(3.0, -1.0)].into_iter().cycle()) {
        let start = PI * f64::from(k) / 8.0;
        for inside in [true, false] {
            let formula = points(Limacon { a: 1.0, start }, center);
            let pieces = ParametricCurve::around(formula, [0.0, TAU], inside).unwrap();
            assert!(pieces.iter().flat_map(|piece| piece.ends().unwrap()).any(|end| (end - center).amax() < 1e-15));
            let length: f64 = pieces.iter().map(Piece::length).sum();
            let area = enclosed_area(pieces.iter().map(|piece| piece as &dyn Piece));
            assert!((length / 8.0 - 1.0).abs() < 4e-15, "{start}: {length}");
            let expected = if inside { 1.5 * PI } else { -1.5 * PI };
            assert!((area / expected - 1.0).abs() < 4e-15, "{start}: {area}");
        }
    }
}

/// `r = |cos(kφ/2 − p)|`
#[derive(Clone, Copy, Debug)]
struct Rose {
    petals: f64,
    phase: f64,
}

impl PolarFormula for Rose {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let k = 0.5 * self.petals;
        let (sin, cos) = libm::sincos(k * angle - self.phase);
        let sign = libm::copysign(1.0, cos);
        [sign * cos, -k * sign * sin, -k * k * sign * cos]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let k = 0.5 * self.petals;
        let [sin, cos] = (angle * k + -self.phase).sin_cos();
        if cos.contains(0.0) {
            return [cos.abs(), sin.union(-sin) * k, Interval::ENTIRE];
        }
        let sign = libm::copysign(1.0, cos.low);
        [cos.abs(), sin * (-k * sign), cos.abs() * (-k * k)]
    }
}

#[test]
fn the_petals_of_a_rose_touch_in_its_centre() {
    let roses = [(2.0, 0.0), (3.0, 0.4), (4.0, 1.0), (6.0, 0.5 * PI), (20.0, 0.5 * PI), (60.0, 0.1)];
    // steep ones, whose formula leads past the common point by more than the rounding of coordinates
    let steep = [(101.0, 1.3), (150.0, 1.0), (202.0, 0.0)];
    for (petals, phase) in roses.into_iter().chain(steep) {
        for center in [Vector2::zeros(), Vector2::new(7.0, -0.3)] {
            let rose = PolarPoints { center, formula: Rose { petals, phase } };
            let pieces = ParametricCurve::around(rose, [0.0, TAU], true).unwrap();
            // one more where the turn begins within a petal
            let count = pieces.len() as f64;
            assert!(count == 2.0 * petals || count == 2.0 * petals + 1.0, "{petals} {phase}: {count}");
            let starts: Vec<_> = pieces.iter().map(|piece| piece.ends().unwrap()[0]).collect();
            let near: Vec<_> = starts.iter().filter(|start| (*start - center).amax() < 1e-12).collect();
            assert!(near.len() as f64 == petals && near.iter().all(|start| *start == near[0]), "{petals} {phase}");
            let table = Table::new(pieces.into_iter().map(|piece| Box::new(piece) as _).collect()).unwrap();
            assert_eq!(table.validate(), Ok(()), "{petals} {phase} {center:?}");
            // petals end where rounding of the angle, times their number, tells that they do
            let bound = 1e-15 * (8.0 + petals);
            assert!((table.area() / (0.5 * PI) - 1.0).abs() < bound, "{petals} {phase}: {}", table.area());
        }
    }
}

/// `r = cos(kφ/2 − p)`, one petal.
#[derive(Clone, Copy, Debug)]
struct Petal(Rose);

impl PolarFormula for Petal {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let k = 0.5 * self.0.petals;
        let (sin, cos) = libm::sincos(k * angle - self.0.phase);
        [cos, -k * sin, -k * k * cos]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let k = 0.5 * self.0.petals;
        let [sin, cos] = (angle * k + -self.0.phase).sin_cos();
        [cos, sin * -k, cos * (-k * k)]
    }
}

/// A petal in the direction `turn`.
fn petal(petals: f64, center: Vector2<f64>, turn: f64) -> Vec<Box<dyn Piece>> {
    let formula = Petal(Rose { petals, phase: 0.5 * petals * turn });
    let range = [-PI, PI].map(|half| turn + half / petals);
    let pieces = ParametricCurve::around(PolarPoints { center, formula }, range, true).unwrap();
    pieces.into_iter().map(|piece| Box::new(piece) as _).collect()
}

#[test]
fn petals_that_overlap_at_their_tips_cross() {
    // facing each other like the halves of a lemniscate, and beside each other, as in a rose
    let next = |petals: f64, number: f64| (petals, number * TAU / petals);
    for (petals, apart) in [(2.0, PI), (3.0, PI), next(25.0, 1.0), next(41.0, 2.0), next(101.0, 2.0)] {
        for turn in [0.0, 0.7, 2.0] {
            // the second one is moved towards the first
            let [first, second] = [turn, turn + apart].map(|angle| Vector2::new(libm::cos(angle), libm::sin(angle)));
            let towards = (first - second).normalize();
            for deep in [1e-9, 1e-10] {
                let pieces = petal(petals, Vector2::zeros(), turn).into_iter();
                let pieces = pieces.chain(petal(petals, towards * deep, turn + apart));
                let found = Table::new(pieces.collect()).unwrap().validate();
                assert!(matches!(found, Err(Error::Crossing { .. })), "{petals} {turn} {deep}: {found:?}");
            }
        }
    }
}

proptest! {
    #[test]
    fn derivatives_of_points_are_those_of_the_points(a in -2.0..2.0_f64, start in -9.0..9.0_f64, angle in -9.0..9.0_f64) {
        let curve = points(Limacon { a, start }, Vector2::new(1.0, 2.0));
        let step = 1e-5;
        let [before, here, after] = [-step, 0.0, step].map(|change| curve.jet(angle + change));
        for i in 0..2 {
            for order in 0..2 {
                let difference = (after[order][i] - before[order][i]) / (2.0 * step);
                // h² c‴/6 and ε/h
                prop_assert!((difference - here[order + 1][i]).abs() < 1e-9);
            }
        }
        let over = curve.jet_over(Interval::new(angle, angle + 0.1));
        for part in 0..10 {
            let at = curve.jet(angle + 0.01 * f64::from(part));
            let is_within = (0..3).all(|order| (0..2).all(|i| over[order][i].contains(at[order][i])));
            prop_assert!(is_within, "{at:?} {over:?}");
        }
    }
}

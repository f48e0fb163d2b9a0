//! Curves given by an equation: followed without a jump, and alone in their box.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]

mod formulas;

use core::{
    f64::consts::PI,
    sync::atomic::{AtomicU64, Ordering},
};
use formulas::Conic;
use geometry::{
    Error, Extent, ImplicitRule, Piece, Vector2,
    shapes::curve::{Implicit, ImplicitFormula, Interval},
};

fn square(half_side: f64) -> Extent {
    Extent { min: Vector2::repeat(-half_side), max: Vector2::repeat(half_side) }
}

/// `(y − ½ sin kx)² = (1 − (x/a)²)/100`: a band that is folded, with strands beside each other, in a square.
#[derive(Clone, Copy, Debug)]
struct Folded {
    waves: f64,
    reach: f64,
    half_side: f64,
}

impl ImplicitFormula for Folded {
    fn value(&self, [x, y]: [f64; 2]) -> f64 {
        let (u, part) = (y - 0.5 * libm::sin(self.waves * x), x / self.reach);
        u * u - 0.01 * (1.0 - part * part)
    }
    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = libm::sincos(self.waves * x);
        let [u, slope] = [y - 0.5 * sin, -0.5 * self.waves * cos];
        [2.0 * u * slope + 0.02 * x / (self.reach * self.reach), 2.0 * u]
    }
    fn hessian(&self, point: [f64; 2]) -> [f64; 3] {
        self.hessian_over(point.map(Interval::from)).map(|over| 0.5 * (over.low + over.high))
    }
    fn hessian_over(&self, [x, y]: [Interval; 2]) -> [Interval; 3] {
        let k = self.waves;
        let [sin, cos] = (x * k).sin_cos();
        let [u, slope, bend] = [y - sin * 0.5, cos * (-0.5 * k), sin * (0.5 * k * k)];
        [(slope.square() + u * bend) * 2.0 + 0.02 / (self.reach * self.reach), slope * 2.0, Interval::from(2.0)]
    }
    fn extent(&self) -> Extent {
        square(self.half_side)
    }
}

#[test]
fn where_strands_of_a_curve_run_beside_each_other_none_is_left_out() {
    // the lengths from mpmath
    for (waves, reach, half_side, length) in
        [(80.0, 0.25, 1.5, 25.874_529_207_279_306), (100.0, 0.125, 1.0, 15.891_280_904_359_618)]
    {
        let curve = Implicit::new(Folded { waves, reach, half_side }, true).unwrap();
        // at each x as high as an ellipse
        assert!((curve.area() - 0.1 * PI * reach).abs() < 1e-13, "{waves}: {}", curve.area());
        assert!((curve.length() - length).abs() < 1e-12, "{waves}: {}", curve.length());
    }
}

/// `√(x² + y²) = 1`, whose derivatives at the origin have no bound, in a square.
#[derive(Clone, Copy, Debug)]
struct Distance {
    half_side: f64,
}

impl ImplicitFormula for Distance {
    fn value(&self, [x, y]: [f64; 2]) -> f64 {
        (x * x + y * y).sqrt() - 1.0
    }
    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let r = (x * x + y * y).sqrt();
        [x / r, y / r]
    }
    fn hessian(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let r = (x * x + y * y).sqrt();
        [y * y, -x * y, x * x].map(|a| a / (r * r * r))
    }
    fn hessian_over(&self, [x, y]: [Interval; 2]) -> [Interval; 3] {
        let cube = (x.square() + y.square()).sqrt().powi(3);
        [y.square(), -(x * y), x.square()].map(|a| a / cube)
    }
    fn value_over(&self, [x, y]: [Interval; 2]) -> Interval {
        (x.square() + y.square()).sqrt() + -1.0
    }
    fn extent(&self) -> Extent {
        square(self.half_side)
    }
}

#[test]
fn a_formula_whose_derivatives_have_no_bound_in_the_middle_of_its_box_does_not_vanish_there() {
    for k in 0..30 {
        let half_side = 1.02 + 0.02 * f64::from(k);
        let curve = Implicit::new(Distance { half_side }, true).unwrap_or_else(|e| panic!("{half_side}: {e}"));
        assert!((curve.area() - PI).abs() < 1e-13, "{half_side}");
    }
}

/// Two ellipses by one equation, in a square.
#[derive(Clone, Copy, Debug)]
struct Both([Conic; 2]);

impl ImplicitFormula for Both {
    fn value(&self, p: [f64; 2]) -> f64 {
        let [f, g] = self.0.map(|conic| conic.value(p));
        f * g
    }
    fn gradient(&self, p: [f64; 2]) -> [f64; 2] {
        let [f, g] = self.0.map(|conic| conic.value(p));
        let [df, dg] = self.0.map(|conic| conic.gradient(p));
        [0, 1].map(|i| f * dg[i] + g * df[i])
    }
    fn hessian(&self, p: [f64; 2]) -> [f64; 3] {
        self.hessian_over(p.map(Interval::from)).map(|over| 0.5 * (over.low + over.high))
    }
    fn hessian_over(&self, p: [Interval; 2]) -> [Interval; 3] {
        let scaled = self.0.map(|conic| [0, 1].map(|i| (p[i] + -conic.center[i]) * (1.0 / conic.semi_axes[i])));
        let [f, g] = scaled.map(|[x, y]| x.square() + y.square() + -1.0);
        let [df, dg] = [0, 1].map(|k| [0, 1].map(|i| scaled[k][i] * (2.0 / self.0[k].semi_axes[i])));
        let [ddf, ddg] = self.0.map(|conic| conic.hessian_over(p));
        let crossed = [(0, 0), (0, 1), (1, 1)].map(|(i, j)| df[i] * dg[j] + df[j] * dg[i]);
        [0, 1, 2].map(|k| f * ddg[k] + g * ddf[k] + crossed[k])
    }
    fn extent(&self) -> Extent {
        square(1.5)
    }
}

#[test]
fn a_curve_beside_a_sharp_bend_of_another_is_found_although_there_are_long_chords_elsewhere() {
    let flat = Conic { center: [0.0; 2], semi_axes: [1.0, 0.05] };
    for (x, y) in [(-1.04, 0.0), (-1.03, 0.01), (-1.02, -0.02)] {
        let small = Conic { center: [x, y], semi_axes: [0.005, 0.005] };
        let found = Implicit::new(Both([flat, small]), true).map(|_| ());
        let Err(Error::Curve { must: ImplicitRule::Alone, at }) = found else { panic!("{x}: {found:?}") };
        assert!((Vector2::from(at) - Vector2::new(x, y)).norm() < 0.01, "{x}: {at:?}");
    }
}

/// `|x| + |y| − 1`, which counts how often it is asked.
#[derive(Debug, Default)]
struct Rhombus(AtomicU64);

impl ImplicitFormula for &'static Rhombus {
    fn value(&self, [x, y]: [f64; 2]) -> f64 {
        self.0.fetch_add(1, Ordering::Relaxed);
        x.abs() + y.abs() - 1.0
    }
    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [1.0_f64.copysign(x), 1.0_f64.copysign(y)]
    }
    fn hessian(&self, _: [f64; 2]) -> [f64; 3] {
        [0.0; 3]
    }
    fn hessian_over(&self, [x, y]: [Interval; 2]) -> [Interval; 3] {
        let bend = |x: Interval| if x.contains(0.0) { Interval::ENTIRE } else { 0.0.into() };
        [bend(x), 0.0.into(), bend(y)]
    }
    fn gradient_over(&self, [x, y]: [Interval; 2]) -> [Interval; 2] {
        [x, y].map(|x| Interval::new(1.0_f64.copysign(x.low), 1.0_f64.copysign(x.high)))
    }
    fn extent(&self) -> Extent {
        Extent { min: Vector2::repeat(-2.0), max: Vector2::repeat(2.0) }
    }
}

/// At a kink, steps that led back to where they began had been taken a hundred thousand times, and each proved in vain.
#[test]
fn a_curve_with_a_kink_is_refused_at_once() {
    static RHOMBUS: Rhombus = Rhombus(AtomicU64::new(0));
    let refused = Implicit::new(&RHOMBUS, true).unwrap_err();
    assert!(matches!(refused, Error::Curve { must: ImplicitRule::Smooth, .. }), "{refused:?}");
    let asked = RHOMBUS.0.load(Ordering::Relaxed);
    assert!(asked < 10_000, "{asked}");
}

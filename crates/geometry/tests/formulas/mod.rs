//! Curves given by formulas, and tables of them.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    reason = "no test needs all of it, and a test may stop at the first surprise"
)]

use geometry::{
    Extent, Piece, Table, Vector2,
    shapes::{
        Circle, Parallel, Segment,
        curve::{Implicit, ImplicitFormula, Interval, ParametricFormula, Polar, PolarFormula},
    },
};
use std::sync::Arc;

/// `(t, t²)`
#[derive(Clone, Copy, Debug)]
pub struct Parabola;

impl ParametricFormula for Parabola {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        [[t, t * t], [1.0, 2.0 * t], [0.0, 2.0]]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        [[t, t * t], [Interval::from(1.0), t * 2.0], [Interval::from(0.0), Interval::from(2.0)]]
    }
}

/// `(x/a)⁴ + (y/b)⁴ + twist·(xy/ab) = 1`, lengths in units of `unit`.
#[derive(Clone, Copy, Debug)]
pub struct Quartic {
    pub semi_axes: [f64; 2],
    pub twist: f64,
}

impl Quartic {
    fn scaled(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [x / self.semi_axes[0], y / self.semi_axes[1]]
    }
}

impl ImplicitFormula for Quartic {
    fn value(&self, p: [f64; 2]) -> f64 {
        let [x, y] = self.scaled(p);
        x * x * x * x + y * y * y * y + self.twist * x * y - 1.0
    }
    fn gradient(&self, p: [f64; 2]) -> [f64; 2] {
        let ([x, y], [a, b]) = (self.scaled(p), self.semi_axes);
        [(4.0 * x * x * x + self.twist * y) / a, (4.0 * y * y * y + self.twist * x) / b]
    }
    fn hessian(&self, p: [f64; 2]) -> [f64; 3] {
        let ([x, y], [a, b]) = (self.scaled(p), self.semi_axes);
        [12.0 * x * x / (a * a), self.twist / (a * b), 12.0 * y * y / (b * b)]
    }
    fn hessian_over(&self, [x, y]: [Interval; 2]) -> [Interval; 3] {
        let [a, b] = self.semi_axes;
        [
            x.square() * (12.0 / (a * a * a * a)),
            Interval::from(self.twist / (a * b)),
            y.square() * (12.0 / (b * b * b * b)),
        ]
    }
    fn extent(&self) -> Extent {
        let [a, b] = self.semi_axes;
        Extent { min: Vector2::new(-1.25 * a, -1.25 * b), max: Vector2::new(1.25 * a, 1.25 * b) }
    }
}

/// An ellipse as an equation.
#[derive(Clone, Copy, Debug)]
pub struct Conic {
    pub center: [f64; 2],
    pub semi_axes: [f64; 2],
}

impl ImplicitFormula for Conic {
    fn value(&self, p: [f64; 2]) -> f64 {
        let [x, y] = [0, 1].map(|i| (p[i] - self.center[i]) / self.semi_axes[i]);
        x * x + y * y - 1.0
    }
    fn gradient(&self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| 2.0 * (p[i] - self.center[i]) / (self.semi_axes[i] * self.semi_axes[i]))
    }
    fn hessian(&self, _: [f64; 2]) -> [f64; 3] {
        let [xx, yy] = self.semi_axes.map(|a| 2.0 / (a * a));
        [xx, 0.0, yy]
    }
    fn hessian_over(&self, _: [Interval; 2]) -> [Interval; 3] {
        self.hessian([0.0; 2]).map(|h| Interval::from(h) * Interval::new(1.0f64.next_down(), 1.0f64.next_up()))
    }
    fn extent(&self) -> Extent {
        let (c, a) = (Vector2::from(self.center), Vector2::from(self.semi_axes));
        Extent { min: c - a, max: c + a }
    }
}

/// `r = R (1 + a cos nφ)`
#[derive(Clone, Copy, Debug)]
pub struct Clover {
    pub radius: f64,
    pub amount: f64,
    pub leaves: u32,
}

impl PolarFormula for Clover {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let n = f64::from(self.leaves);
        let (sin, cos) = (libm::sin(n * angle), libm::cos(n * angle));
        [1.0 + self.amount * cos, -n * self.amount * sin, -n * n * self.amount * cos].map(|r| self.radius * r)
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let n = f64::from(self.leaves);
        let (sin, cos) = ((angle * n).sin(), (angle * n).cos());
        [cos * self.amount + 1.0, sin * (-n * self.amount), cos * (-n * n * self.amount)].map(|r| r * self.radius)
    }
}

/// Tables of smooth curves about `center`, as large as `size`: alone, with obstacles, as obstacles, and offset.
pub fn tables(center: Vector2<f64>, size: f64) -> Vec<(&'static str, Table)> {
    let clover = |amount: f64, leaves: u32, inside: bool| -> Box<dyn Piece> {
        let radius = size * if inside { 1.0 } else { 0.5 };
        Box::new(Polar::new(center, Clover { radius, amount, leaves }, inside).unwrap())
    };
    let quartic = |twist: f64| -> Box<dyn Piece> {
        Box::new(Implicit::new(Quartic { semi_axes: [size, 0.7 * size], twist }, true).unwrap())
    };
    let parallel = |base: Box<dyn Piece>| -> Box<dyn Piece> {
        let base: Arc<dyn Piece> = Arc::from(base);
        let range = [0.0, base.length()];
        Box::new(Parallel::new(base, 0.0625 * size, range, None).unwrap())
    };
    let circle = || -> Box<dyn Piece> { Box::new(Circle::new(center, 0.25 * size, false).unwrap()) };
    let mut around: Vec<Box<dyn Piece>> = vec![clover(0.2, 5, false)];
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|c| center + Vector2::from(c) * size);
    for i in 0..4 {
        around.push(Box::new(Segment::new(corners[i], corners[(i + 1) % 4]).unwrap()));
    }
    let all = vec![
        ("egg", vec![clover(0.1, 3, true)]),
        ("five leaves", vec![clover(0.2, 5, true)]),
        ("cogwheel", vec![clover(0.05, 20, true)]),
        ("quartic", vec![quartic(0.0)]),
        ("twisted quartic", vec![quartic(0.5)]),
        ("parallel egg", vec![parallel(clover(0.1, 3, true))]),
        ("parallel quartic", vec![parallel(quartic(0.5))]),
        ("egg about a disk", vec![clover(0.1, 3, true), circle()]),
        ("rectangle about five leaves", around),
    ];
    all.into_iter().map(|(name, pieces)| (name, Table::new(pieces).unwrap())).collect()
}

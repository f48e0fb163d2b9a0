//! Scaled curves given by formulas.

use billiards::geometry::Extent;
use billiards::geometry::shapes::curve::{ImplicitFormula, Interval, ParametricFormula, PolarFormula};

/// A curve whose formula is in the user's units, all lengths multiplied by a power of two.
#[derive(Clone, Debug)]
pub(super) struct Scaled<F> {
    pub(super) formula: F,
    pub(super) factor: f64,
}

impl<F: PolarFormula> PolarFormula for Scaled<F> {
    fn jet(&self, angle: f64) -> [f64; 3] {
        self.formula.jet(angle).map(|r| r * self.factor)
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        self.formula.jet_over(angle).map(|r| scaled(r, self.factor))
    }
}

impl<F: ParametricFormula> ParametricFormula for Scaled<F> {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        self.formula.jet(t).map(|pair| pair.map(|x| x * self.factor))
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        self.formula.jet_over(t).map(|pair| pair.map(|x| scaled(x, self.factor)))
    }
}

impl<F: ImplicitFormula> ImplicitFormula for Scaled<F> {
    fn value(&self, point: [f64; 2]) -> f64 {
        self.formula.value(point.map(|x| x / self.factor))
    }
    fn gradient(&self, point: [f64; 2]) -> [f64; 2] {
        self.formula.gradient(point.map(|x| x / self.factor)).map(|g| g / self.factor)
    }
    fn hessian(&self, point: [f64; 2]) -> [f64; 3] {
        self.formula.hessian(point.map(|x| x / self.factor)).map(|h| h / self.factor / self.factor)
    }
    fn hessian_over(&self, region: [Interval; 2]) -> [Interval; 3] {
        let back = |x: Interval| scaled(x, 1.0 / self.factor);
        self.formula.hessian_over(region.map(back)).map(|h| back(back(h)))
    }
    fn gradient_over(&self, region: [Interval; 2]) -> [Interval; 2] {
        let back = |x: Interval| scaled(x, 1.0 / self.factor);
        self.formula.gradient_over(region.map(back)).map(back)
    }
    fn value_over(&self, region: [Interval; 2]) -> Interval {
        self.formula.value_over(region.map(|x| scaled(x, 1.0 / self.factor)))
    }
    fn extent(&self) -> Extent {
        let Extent { min, max } = self.formula.extent();
        Extent { min: min * self.factor, max: max * self.factor }
    }
}

/// An interval times a power of two: exact.
fn scaled(of: Interval, factor: f64) -> Interval {
    Interval { low: of.low * factor, high: of.high * factor }
}

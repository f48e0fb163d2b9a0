//! Formulas as boundaries: what the geometry of curves asks of `r(t)` and `f(x, y)`.

use billiards::geometry::shapes::curve::{ImplicitFormula, Interval, PolarFormula};
use billiards::geometry::{Extent, Vector2};

use super::{Expression, Program};

/// A radius `r(t)` as a formula, with its first two derivatives.
#[derive(Clone, Debug)]
pub struct PolarCurve(Program<3>);

impl PolarCurve {
    /// The curve of a formula in one variable, the polar angle.
    pub fn new(radius: &Expression) -> Self {
        let slope = radius.derivative(0);
        Self(Program::new([radius, &slope, &slope.derivative(0)]))
    }
}

impl PolarFormula for PolarCurve {
    fn jet(&self, angle: f64) -> [f64; 3] {
        self.0.evaluate(&[angle])
    }

    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        self.0.evaluate(&[angle])
    }
}

/// A function `f(x, y)` as a formula, with its gradient and Hessian, and a box that holds its zeros.
#[derive(Clone, Debug)]
pub struct ImplicitCurve {
    value: Program<1>,
    gradient: Program<2>,
    hessian: Program<3>,
    extent: Extent,
}

impl ImplicitCurve {
    /// The curve of a formula in two variables, within a box given by its lower left and upper right corner.
    pub fn new(f: &Expression, [low, high]: [[f64; 2]; 2]) -> Self {
        let (fx, fy) = (f.derivative(0), f.derivative(1));
        Self {
            value: Program::new([f]),
            gradient: Program::new([&fx, &fy]),
            hessian: Program::new([&fx.derivative(0), &fx.derivative(1), &fy.derivative(1)]),
            extent: Extent { min: Vector2::from(low), max: Vector2::from(high) },
        }
    }
}

impl ImplicitFormula for ImplicitCurve {
    fn value(&self, point: [f64; 2]) -> f64 {
        let [value] = self.value.evaluate(&point);
        value
    }

    fn gradient(&self, point: [f64; 2]) -> [f64; 2] {
        self.gradient.evaluate(&point)
    }

    fn hessian(&self, point: [f64; 2]) -> [f64; 3] {
        self.hessian.evaluate(&point)
    }

    fn hessian_over(&self, region: [Interval; 2]) -> [Interval; 3] {
        self.hessian.evaluate(&region)
    }

    fn gradient_over(&self, region: [Interval; 2]) -> [Interval; 2] {
        self.gradient.evaluate(&region)
    }

    fn extent(&self) -> Extent {
        self.extent
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use billiards::geometry::shapes::curve::{Implicit, Polar};
    use billiards::geometry::{Line, Piece};

    #[test]
    fn a_polar_formula_is_a_table_with_the_area_of_its_integral() {
        let r = Expression::parse("1 + 0.2*cos(5*t)", &["t"]).unwrap();
        let table = Polar::new(Vector2::zeros(), PolarCurve::new(&r), true).unwrap();
        // Area = ½∫r² = π (1 + 0.2²/2); the quadrature is good to rounding for trigonometric polynomials.
        let area = core::f64::consts::PI * 1.02;
        assert!((table.area() / area - 1.0).abs() < 1e-13, "{}", table.area());
    }

    #[test]
    fn an_implicit_formula_is_hit_where_its_equation_says() {
        let f = Expression::parse("x^2/4 + y^2 - 1", &["x", "y"]).unwrap();
        let table = Implicit::new(ImplicitCurve::new(&f, [[-2.5, -1.5], [2.5, 1.5]]), true).unwrap();
        let path = Line { point: Vector2::new(0.0, 0.0), velocity: Vector2::new(1.0, 0.5) };
        // t²/4 + t²/4 = 1; a few roundings.
        assert!((table.crossing(&path).time() - 2f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn enclosures_contain_the_values() {
        let f = Expression::parse("sin(x)^3*exp(-y) + atan2(y, 2+x)/sqrt(4+x*y) - abs(x-y)^1.5 + x^-2", &["x", "y"])
            .unwrap();
        let program = Program::new([&f, &f.derivative(0), &f.derivative(1).derivative(0)]);
        let over = program.evaluate(&[Interval::new(0.5, 0.75), Interval::new(1.0, 1.25)]);
        for i in 0..=10 {
            for j in 0..=10 {
                let point = [0.5 + 0.025 * f64::from(i), 1.0 + 0.025 * f64::from(j)];
                let at = program.evaluate(&point);
                assert!(over.iter().zip(at).all(|(over, at)| over.contains(at)), "{point:?} {at:?} {over:?}");
            }
        }
    }
}

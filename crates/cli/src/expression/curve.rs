//! Formulas as boundaries: what the geometry of curves needs of `r(t)`, `(x(t), y(t))` and `f(x, y)`.

use core::f64::consts::TAU;

use billiards::geometry::shapes::curve::{ImplicitFormula, Interval, ParametricFormula, PolarFormula};
use billiards::geometry::{Extent, Vector2};

use super::{Expression, Program};

/// A radius `r(t)` for angles from 0 to 2π as a formula, with its first two derivatives.
#[derive(Clone, Debug)]
pub struct PolarCurve {
    jet: Program<3>,
    /// Whether the formula itself is periodic: most are, and then the angle need not be reduced to the first turn.
    returns: bool,
}

/// Some ulp of a turn.
const ROUNDING: f64 = 4.0 * TAU * f64::EPSILON;

impl PolarCurve {
    /// The curve of a formula in one variable, the polar angle.
    pub fn new(radius: &Expression) -> Self {
        let slope = radius.derivative(0);
        let jet = Program::new([radius, &slope, &slope.derivative(0)]);
        Self { jet, returns: radius.comes_back() }
    }
}

impl PolarFormula for PolarCurve {
    fn jet(&self, angle: f64) -> [f64; 3] {
        if self.returns || (0.0..=TAU).contains(&angle) {
            return self.jet.evaluate(&[angle]);
        }
        self.jet.evaluate(&[(angle - TAU * libm::floor(angle / TAU)).clamp(0.0, TAU)])
    }

    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        if self.returns || (angle.low > 0.0 && angle.high < TAU) {
            return self.jet.evaluate(&[angle]);
        }
        let within = |low: f64, high: f64| -> [Interval; 3] { self.jet.evaluate(&[Interval::new(low, high)]) };
        if !(angle.width() < TAU) {
            let [r, slope, _] = within(0.0, TAU);
            return [r, slope, Interval::ENTIRE];
        }
        let turns = TAU * libm::floor(angle.low / TAU);
        // these differences are rounded
        let (low, high) = ((angle.low - turns - ROUNDING).max(0.0), angle.high - turns + ROUNDING);
        let [before, after] = [TAU, 0.0].map(|seam| within(seam, seam));
        // the parts on either side of the seam, and the seam itself
        let [r, slope, bend] = match (low > 0.0, high < TAU) {
            (true, true) => return within(low, high),
            (true, false) => union(within(low, TAU), within(0.0, high - TAU)),
            (false, true) => union(before, within(0.0, high)),
            (false, false) => union(within(0.0, TAU), before),
        };
        let jumps = (before[1].low - after[1].low).abs() > 1e-9 * before[0].magnitude();
        [r, slope, if jumps { Interval::ENTIRE } else { bend }]
    }
}

/// The smallest intervals around both.
fn union(a: [Interval; 3], b: [Interval; 3]) -> [Interval; 3] {
    [0, 1, 2].map(|i| a[i].union(b[i]))
}

/// A point `(x(t), y(t))` as two formulas, with their first two derivatives.
#[derive(Clone, Debug)]
pub struct ParametricCurve {
    jet: Program<6>,
}

impl ParametricCurve {
    /// The curve of two formulas in one variable, the parameter.
    pub fn new([x, y]: [&Expression; 2]) -> Self {
        let [dx, dy] = [x, y].map(|of| of.derivative(0));
        Self { jet: Program::new([x, y, &dx, &dy, &dx.derivative(0), &dy.derivative(0)]) }
    }
}

impl ParametricFormula for ParametricCurve {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        pairs(self.jet.evaluate(&[t]))
    }

    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        pairs(self.jet.evaluate(&[t]))
    }
}

fn pairs<T>([a, b, c, d, e, f]: [T; 6]) -> [[T; 2]; 3] {
    [[a, b], [c, d], [e, f]]
}

/// A function `f(x, y)` as a formula, with its gradient and Hessian, and a box that contains its zeros.
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

    fn value_over(&self, region: [Interval; 2]) -> Interval {
        let [value] = self.value.evaluate(&region);
        value
    }

    fn extent(&self) -> Extent {
        self.extent
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use billiards::geometry::shapes::curve::{Implicit, Polar};
    use billiards::geometry::{Error, ImplicitRule, Line, MeetingKind, Piece, Table, meetings, shapes::Circle};
    use core::f64::consts::PI;

    #[test]
    fn a_polar_formula_is_a_table_with_the_area_of_its_integral() {
        let r = Expression::parse("1 + 0.2*cos(5*t)", &["t"]).unwrap();
        let table = Polar::new(Vector2::zeros(), PolarCurve::new(&r), true).unwrap();
        // Area = ½∫r² = π (1 + 0.2²/2); the quadrature is accurate to rounding for trigonometric polynomials.
        let area = core::f64::consts::PI * 1.02;
        assert!((table.area() / area - 1.0).abs() < 1e-13, "{}", table.area());
    }

    #[test]
    fn a_formula_that_does_not_come_back_is_meant_for_one_turn() {
        let r = |text: &str| PolarCurve::new(&Expression::parse(text, &["t"]).unwrap());
        assert!(r("1 + 0.2*cos(5*t) + abs(sin(t/2))").returns);
        let (parabola, bump) = (r("1 + 0.2*t*(2*pi-t)"), r("1 + 0.01*t^2*(2*pi-t)^2"));
        for formula in [&parabola, &bump] {
            assert!(!formula.returns);
            for k in -40..40 {
                let (angle, width) = (0.5 * f64::from(k), 0.07);
                let [r, slope, bend] = formula.jet_over(Interval::new(angle, angle + width));
                for part in 0..=10 {
                    let here = angle + width * f64::from(part) / 10.0;
                    let turned = here - TAU * libm::floor(here / TAU);
                    for (jet, over) in formula.jet(here).into_iter().zip([r, slope, bend]) {
                        assert!(over.contains(jet), "{here}: {jet} {over:?}");
                    }
                    let exact: [f64; 3] = formula.jet.evaluate(&[turned]);
                    assert_eq!(formula.jet(here), exact);
                }
            }
        }
        // its slope jumps from 0.4π to −0.4π; that of the other one is 0 from both sides
        let around = Interval::new(-0.01, 0.01);
        assert_eq!(parabola.jet_over(around)[2], Interval::ENTIRE);
        assert!(bump.jet_over(around)[2].magnitude() < 10.0);
        let pieces = |formula: PolarCurve| Polar::new(Vector2::zeros(), formula, true).unwrap().pieces();
        let [corner] =
            [pieces(parabola)].map(|arcs| arcs.iter().filter_map(|arc| arc.ends()).flatten().collect::<Vec<_>>());
        assert!(corner.iter().any(|end| (end - Vector2::new(1.0, 0.0)).amax() < 1e-14), "{corner:?}");
    }

    #[test]
    fn a_narrow_bump_meant_for_one_turn_is_there_at_every_angle() {
        let r = Expression::parse("2-0.05*exp(-((t-pi)/0.01)^2)", &["t"]).unwrap();
        let bump = PolarCurve::new(&r);
        assert_eq!([bump.jet(PI), bump.jet(-PI)].map(|[r, ..]| r), [1.95; 2]);
        let table = Polar::new(Vector2::zeros(), bump, true).unwrap();
        let path = Line { point: Vector2::zeros(), velocity: Vector2::new(-1.0, -1e-4) };
        assert!((table.crossing(&path).time() - 1.95).abs() < 1e-4);
    }

    #[test]
    fn the_length_of_a_curve_counts_its_narrow_bumps() {
        for width in [3e-4, 1e-5, 1e-8] {
            let r = Expression::parse(&format!("2+0.1*exp(-((t-1.05)/{width})^2)"), &["t"]).unwrap();
            let curve = Polar::new(Vector2::zeros(), PolarCurve::new(&r), true).unwrap();
            // up and down, and between them less than twice ten widths of the circle
            let expected = 2.0 * TAU + 0.2;
            assert!((curve.length() - expected).abs() < 20.0 * width, "{width}: {}", curve.length() - expected);
        }
    }

    #[test]
    fn the_length_of_a_curve_counts_its_steep_flanks() {
        let polar = |text: &str| {
            Polar::new(Vector2::zeros(), PolarCurve::new(&Expression::parse(text, &["t"]).unwrap()), true).unwrap()
        };
        // lengths by Gauss' rule on a ladder towards each flank
        for (text, length) in [
            ("2+0.1*atan(1e6*sin(12*t-1))", 20.0957),
            ("2+0.1*atan(1e5*sin(13*t-1))", 20.69998),
            ("2+0.1*atan(1e4*sin(40*t-1))", 37.5076),
            ("2+0.1*atan(1e11*sin(t-1))", 13.1946),
            ("2+0.1*atan(1e12*(t-1)*(t-2))", 13.8675),
            ("2+0.001*sqrt(abs(sin(100*t)))", 12.5948),
        ] {
            let found = polar(text).length();
            assert!((found / length - 1.0).abs() < 1e-5, "{text}: {found}");
        }
        // 600 flanks of height π/1000 that hardly lean
        let found = polar("2+0.001*atan(1e9*sin(300*t-1))").length();
        assert!((found / (2.0 * TAU + 0.6 * PI) - 1.0).abs() < 1e-4, "{found}");
    }

    #[test]
    fn lines_cross_the_steepest_flanks_and_circles_on_them_are_seen_to() {
        let polar = |text: &str| -> Box<dyn Piece> {
            Box::new(
                Polar::new(Vector2::zeros(), PolarCurve::new(&Expression::parse(text, &["t"]).unwrap()), true).unwrap(),
            )
        };
        for text in ["2+0.3*atan(100*sin(40*t-1))", "2+0.1*atan(500*sin(40*t-1))", "2+0.1*atan(1e4*sin(40*t-1))"] {
            assert_eq!(Table::new(vec![polar(text)]).unwrap().validate(), Ok(()), "{text}");
        }
        // a circle around a point of a flank, which is almost radial, meets two points of it
        for (text, waves) in [("2+0.1*atan(1e5*sin(5*t-1))", 5.0), ("2+0.1*atan(1e6*sin(3*t-1))", 3.0)] {
            let curve = polar(text);
            for k in 0..6 {
                let (sin, cos) = libm::sincos((1.0 + f64::from(k) * PI) / waves);
                let disk = Circle::new(Vector2::new(cos, sin) * 2.0, 0.03, false).unwrap();
                let found = meetings(&disk, &*curve);
                assert!(
                    found.len() == 2 && found.iter().all(|m| m.kind == MeetingKind::Crossing),
                    "{text} {k}: {found:?}"
                );
            }
        }
    }

    #[test]
    fn points_inside_a_curve_lie_on_its_inner_side_whatever_flank_or_cusp_is_nearest() {
        for text in ["2+0.1*atan(1e6*sin(12*t-1))", "2+0.1*atan(1e11*sin(t-1))", "2+0.1*sqrt(abs(sin(3*t-1)))"] {
            let r = Expression::parse(text, &["t"]).unwrap();
            let curve = Polar::new(Vector2::zeros(), PolarCurve::new(&r), true).unwrap();
            for k in 0..2000 {
                let angle = 0.01 * f64::from(k);
                let (sin, cos) = libm::sincos(angle);
                let radius: f64 = r.evaluate(&[angle]);
                for part in [0.01, 0.3, 0.6, 0.9, 0.99, 1.01, 1.2] {
                    let at = Vector2::new(cos, sin) * (radius * part);
                    let foot = curve.closest(&at);
                    assert_eq!(foot.normal.dot(&(at - foot.point)) > 0.0, part < 1.0, "{text}: {at}");
                }
            }
        }
    }

    #[test]
    fn formulas_that_jump_are_no_curves() {
        for text in [
            "2+0.1*atan(tan(t))",
            "2+0.1*atan2(sin(t),cos(t))",
            "2+0.1*atan(1/sin(t-0.1))",
            "2+1e-7*atan(100*tan(t+1))",
            "2+0.1*atan(tan(t/2-1))*(2*pi-t)*t",
        ] {
            let found = Polar::new(Vector2::zeros(), PolarCurve::new(&Expression::parse(text, &["t"]).unwrap()), true);
            assert!(matches!(found, Err(Error::PolarJump { .. })), "{text}: {found:?}");
        }
        // steep, and without a bound on the slope, but closed
        for text in [
            "2+0.1*atan(1e6*sin(t))",
            "2-0.3*sqrt(abs(sin(t-1)))",
            "2-0.3*abs(sin(t-1))^(1/3)",
            "2+0.1*sin(3*t)*atan2(sin(t),2+cos(t))",
        ] {
            let found = Polar::new(Vector2::zeros(), PolarCurve::new(&Expression::parse(text, &["t"]).unwrap()), true);
            assert!(found.is_ok(), "{text}: {found:?}");
        }
    }

    fn polar(text: &str) -> Result<Polar<PolarCurve>, Error> {
        Polar::new(Vector2::zeros(), PolarCurve::new(&Expression::parse(text, &["t"]).unwrap()), true)
    }

    #[test]
    fn kinks_that_are_not_written_as_abs_are_cut_at_or_refused() {
        for text in ["2+0.5*(cos(t)^2)^0.5", "2+0.1*(cos(t)^4)^0.25", "2+0.1*exp((cos(t)^2)^0.5-1)"] {
            let arcs = polar(text).unwrap().pieces();
            let ends: Vec<_> = arcs.iter().filter_map(|arc| arc.ends()).flatten().collect();
            assert_eq!(ends.len(), 4, "{text}");
            assert!(ends.iter().all(|end| end.x.abs() < 1e-14), "{text}: {ends:?}");
        }
        for (text, at) in [
            ("2+0.1*asin(sin(t))", 0.5 * PI),
            ("2+0.1*acos(cos(t-1))", 1.0),
            ("2+0.1*sqrt(1-sin(t)^2)", 0.5 * PI),
            ("2+0.1*(1+cos(t))^0.5", PI),
            ("2+0.1*sqrt(1-sin(t)^2)*sin(3*t)", 0.5 * PI),
        ] {
            let found = polar(text);
            // where an examined place lies so near that rounding leaves no slope, this is reported
            let is_told = matches!(
                found,
                Err(Error::PolarKink { angle } | Error::PolarSlope { angle }) if (angle - at).abs() < 1e-4
            );
            assert!(is_told, "{text}: {:?}", found.err());
        }
        // formulas that only seem to have a kink stay whole
        for text in
            ["2+0.1*(cos(t)^2)^1.5", "2+0.1*(1+cos(t-1))^1.5", "2+0.2*atan(1/cos(t)^2)", "2+0.1*(1-sin(t)^2)^1.5"]
        {
            let pieces = polar(text).unwrap().pieces();
            assert!(pieces.len() == 1 && pieces[0].ends().is_none(), "{text}");
        }
    }

    #[test]
    fn a_radius_is_positive_where_terms_cancel_if_short_sectors_say_so() {
        // 2 √b E(m = 1/b), from mpmath
        let oval = polar("sqrt(cos(2*t)+sqrt(1.0001-sin(2*t)^2))").unwrap();
        assert!((oval.area() - 2.000_649_139_903_114).abs() < 1e-12, "{}", oval.area());
        assert!(matches!(polar("sqrt(cos(2*t)+sqrt(1-sin(2*t)^2))"), Err(Error::PolarRadius { .. })));
    }

    #[test]
    fn a_curve_is_cut_at_each_of_up_to_two_thousand_kinks_or_refused() {
        for (text, count) in [
            ("2+0.01*abs(cos(160*t))", 320),
            ("2+0.01*abs(cos(170*t))", 340),
            ("2+0.01*abs(cos(200*t))", 400),
            ("2+0.001*abs(cos(1000*t+0.1))", 2000),
            ("2+0.1*abs(sin(t-1))+0.01*cos(300*t)", 2),
        ] {
            assert_eq!(polar(text).unwrap().pieces().len(), count, "{text}");
        }
        let found = polar("2+0.0001*abs(cos(2500*t))");
        assert!(matches!(found, Err(Error::PolarKink { .. })), "{:?}", found.err());
    }

    /// Where a formula changes its sign in a turn, by bisection of a fine grid.
    fn roots(text: &str) -> Vec<f64> {
        let u = Expression::parse(text, &["t"]).unwrap();
        let is_positive = |t: f64| u.evaluate(&[t]) > 0.0;
        let at = |k: u32| TAU * (f64::from(k) + 0.37) / 20_000.0;
        let changes = (0..20_000).map(|k| [at(k), at(k + 1)]).filter(|[a, b]| is_positive(*a) != is_positive(*b));
        changes
            .map(|[mut a, mut b]| {
                let before = is_positive(a);
                for _ in 0..60 {
                    let middle = 0.5 * (a + b);
                    if is_positive(middle) == before { a = middle } else { b = middle }
                }
                0.5 * (a + b)
            })
            .collect()
    }

    /// Checks that `2.4 + 0.2 |u|` is cut where `u` changes its sign, and only there.
    fn is_cut_at_roots(u: &str) {
        let text = format!("2.4+0.2*abs({u})");
        let (pieces, roots) = (polar(&text).unwrap().pieces(), roots(u));
        // an arc needs two distinct ends
        assert_eq!(pieces.len(), if roots.len() == 1 { 2 } else { roots.len().max(1) }, "{text}: {roots:?}");
        let radius = Expression::parse(&text, &["t"]).unwrap();
        for at in roots {
            let (sin, cos) = libm::sincos(at);
            let kink = Vector2::new(cos, sin) * radius.evaluate(&[at]);
            let mut ends = pieces.iter().filter_map(|arc| arc.ends()).flatten();
            assert!(ends.any(|end| (end - kink).amax() < 1e-12), "{text}: {at}");
        }
    }

    #[test]
    fn a_curve_is_cut_at_the_kinks_of_formulas_that_repeat_their_variable() {
        for u in [
            "sin(t)*cos(3*t)-0.3",
            "sin(t)*cos(t)-0.3",
            "sin(t)^2-0.3*sin(t)-0.2",
            "sin(t)*sin(t)-sin(t)/2",
            "cos(t)/(2+sin(t))-0.3",
            "cos(t)/(2+sin(t))-0.57",
            "cos(t)/(2+sin(t))-0.576",
            "cos(t)*sin(3*t)-0.715",
            "cos(t)+cos(2*t)+0.1",
            "sin(2*t)-cos(3*t)",
            // flat enough for rounding to blur kinks
            "sin(t)*cos(3*t)+0.1837",
            "cos(t)+0.4*cos(3*t)-0.0027",
            "cos(t)+0.4*cos(3*t)+0.0249",
        ] {
            is_cut_at_roots(u);
        }
        let forms = [
            "sin(t)*cos(3*t)",
            "cos(t)/(2+sin(t))",
            "cos(t)+0.4*cos(3*t)",
            "sin(t)+0.4*sin(2*t)",
            "cos(t)*exp(sin(t))",
            "sin(2*t)*(1+0.3*cos(t))",
            "cos(t)^2-0.3*sin(t)",
        ];
        for (form, k) in forms.iter().cycle().zip(0..105_u32) {
            // all over [−0.6, 0.6]
            let c = 0.0012 * f64::from(k * 619 % 1000) - 0.6;
            is_cut_at_roots(&format!("{form}-({c:.4})"));
        }
    }

    #[test]
    fn where_the_argument_of_abs_touches_zero_a_curve_is_whole_and_its_kinks_elsewhere_are_kept() {
        for (text, kinks) in [
            ("1+0.15*abs(cos(t)+cos(2*t))", 2),
            ("1-0.15*abs(cos(t)+cos(2*t))", 2),
            ("((1+0.3*cos(t))+(1-0.3*cos(2*t))+abs((1+0.3*cos(t))-(1-0.3*cos(2*t))))/2", 2),
            ("((1+0.3*cos(t))+(1-0.3*cos(2*t))-abs((1+0.3*cos(t))-(1-0.3*cos(2*t))))/2", 2),
            ("1+0.15*abs(cos(t+1)+cos(2*(t+1)))", 2),
            ("2+0.1*abs(cos(t)-1)+0.1*abs(sin(t-1))", 2),
            ("2+0.1*(1-sin(t)^2)^1.5+0.1*abs(sin(t-1))", 2),
            // touches 0 at ±π/2 as well, where it is cut
            ("2+0.1*abs(cos(t)-cos(2*t)*cos(t))", 2),
            ("2+0.1*abs(cos(t)-1)", 1),
            // two kinks with a slope of 10⁻⁶ between them
            ("2+0.1*abs(cos(t)-0.99999999999)", 2),
        ] {
            assert_eq!(polar(text).unwrap().pieces().len(), kinks, "{text}");
        }
        // where neither bounds nor rounding tell, the curve is refused
        let found = polar("2+0.1*abs(cos(t)^2-cos(t)+0.25)*abs(sin(3*t))");
        assert!(matches!(found, Err(Error::PolarKink { .. })), "{:?}", found.err());
    }

    #[test]
    fn points_given_by_formulas_that_repeat_their_variable_are_cut_at_the_same_places() {
        use billiards::geometry::shapes::curve::ParametricCurve as Curve;
        let along = |y: &str| {
            let [x, y] = ["t", y].map(|text| Expression::parse(text, &["t"]).unwrap());
            let formula = ParametricCurve::new([&x, &y]);
            let ends = [-1.0, 1.0].map(|t| ParametricFormula::jet(&formula, t)[0].into());
            Curve::along(formula, [-1.0, 1.0], ends).unwrap()
        };
        let [short, long] = ["abs((t-0.25)^2-0.0625)", "abs(t^2-0.5*t)"].map(along);
        assert_eq!(short.len(), 3);
        assert_eq!(long.len(), 3);
        for (short, long) in short.iter().zip(&long) {
            let [a, b] = [short.ends().unwrap(), long.ends().unwrap()];
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).amax() < 1e-15), "{a:?} {b:?}");
        }
        for (radius, arcs) in [("1+0.15*abs(cos(t)+cos(2*t))", 3), ("2.4+0.2*abs(sin(t)*cos(3*t)-0.3)", 5)] {
            let points = ["cos", "sin"].map(|f| Expression::parse(&format!("({radius})*{f}(t)"), &["t"]).unwrap());
            let formula = ParametricCurve::new([&points[0], &points[1]]);
            // between the kinks and the start
            assert_eq!(Curve::around(formula, [0.0, TAU], true).unwrap().len(), arcs, "{radius}");
        }
    }

    #[test]
    fn paths_by_cusps_and_quotients_end_on_the_curve() {
        for text in [
            "1+0.3*abs(cos(t))^0.9",
            "2+0.5*(cos(t)^2)^0.5",
            "2+0.2*atan(1/cos(t)^2)",
            "2+0.3*(((1+cos(5*t+0.3))/2)^2)^0.5",
            "2+0.01*cos(300*t)+0.1*abs(sin(t-1))",
        ] {
            let r = Expression::parse(text, &["t"]).unwrap();
            let pieces = polar(text).unwrap().pieces();
            for path in fan(Vector2::new(-0.5, 0.02)) {
                let time = pieces.iter().map(|piece| piece.crossing(&path).time()).fold(f64::INFINITY, f64::min);
                let p = path.at(time);
                let radius = r.evaluate(&[libm::atan2(p.y, p.x)]);
                // near a cusp the radius turns a rounding error of the angle into its square root
                assert!((p.norm() - radius).abs() < 1e-7, "{text} {path:?} {p}");
            }
        }
    }

    #[test]
    fn an_implicit_formula_is_hit_where_its_equation_says() {
        let f = Expression::parse("x^2/4 + y^2 - 1", &["x", "y"]).unwrap();
        let table = Implicit::new(ImplicitCurve::new(&f, [[-2.5, -1.5], [2.5, 1.5]]), true).unwrap();
        let path = Line { point: Vector2::new(0.0, 0.0), velocity: Vector2::new(1.0, 0.5) };
        // t²/4 + t²/4 = 1; a few roundings.
        assert!((table.crossing(&path).time() - 2f64.sqrt()).abs() < 1e-15);
    }

    /// Paths from one point into all directions.
    fn fan(point: Vector2<f64>) -> impl Iterator<Item = Line<2>> {
        let angles = (0..1000).map(|k| 0.37 + 0.011 * f64::from(k));
        angles.map(move |angle| Line { point, velocity: Vector2::new(libm::cos(angle), libm::sin(angle)) })
    }

    #[test]
    fn no_path_leaves_a_circle_whose_exponents_are_formulas() {
        for two in ["sqrt(4)", "4/2"] {
            let f = Expression::parse(&format!("x^({two}) + y^({two}) - 1"), &["x", "y"]).unwrap();
            let table = Implicit::new(ImplicitCurve::new(&f, [[-2.0; 2], [2.0; 2]]), true).unwrap();
            for path in fan(Vector2::new(-0.5, 0.02)) {
                let distance = path.at(table.crossing(&path).time()).norm();
                // a few roundings
                assert!((distance - 1.0).abs() < 1e-15, "{two} {path:?} {distance}");
            }
        }
    }

    #[test]
    fn no_path_leaves_a_curve_with_whole_exponents_of_any_size() {
        for (exponent, n) in [("sqrt(4)", 2.0), ("1002", 1002.0), ("2000", 2000.0)] {
            let r = Expression::parse(&format!("2 + 0.5*cos(t)^{exponent}"), &["t"]).unwrap();
            let table = Polar::new(Vector2::zeros(), PolarCurve::new(&r), true).unwrap();
            for path in fan(Vector2::new(-0.5, 0.02)) {
                let p = path.at(table.crossing(&path).time());
                let radius = r.evaluate(&[libm::atan2(p.y, p.x)]);
                // the power of a rounded cosine, and a few roundings
                assert!((p.norm() - radius).abs() < (n + 8.0) * f64::EPSILON, "{exponent} {path:?} {p}");
            }
        }
    }

    #[test]
    fn a_curve_that_is_not_alone_in_its_box_is_refused() {
        let curve = |f: &str| {
            let f = Expression::parse(f, &["x", "y"]).unwrap();
            Implicit::new(ImplicitCurve::new(&f, [[-2.0, -2.0], [2.0, 2.0]]), true)
        };
        for f in [
            "(x^2+y^2-1)*((x-0.25)^2+(y-0.25)^2-0.0004)",
            "(x^2+y^2-1)*((x+0.3)^2+(y-0.51)^2-1e-7)",
            "(x^2+y^2-1)*((x-1.7)^2+(y+1.6)^2-1e-6)",
            // a single point
            "(x^2+y^2-1)*((x-0.25)^2+(y-0.25)^2)",
        ] {
            let found = curve(f);
            assert!(matches!(found, Err(Error::Curve { must: ImplicitRule::Alone, .. })), "{f}: {found:?}");
        }
        for f in [
            "x^2+y^2-1",
            "sqrt(x^2+y^2)-1",
            "abs(x)^2.5+abs(y)^2.5-1",
            "(x^2+y^2)^20-1",
            "x^4+y^4-1",
            "0.5-exp(-x^2-y^2)",
            "(x^2+y^2-1)*exp(-20*(x^2+y^2))",
            "x^2/3+y^2-1+0.1*cos(20*x)*y",
        ] {
            let found = curve(f);
            assert!(found.is_ok(), "{f}: {found:?}");
        }
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

//! Curves given by their points.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
use core::f64::consts::{PI, TAU};
use geometry::{
    Error, Extent, Line, ParametricRule, Piece, Table, Vector2, check, enclosed_area,
    shapes::{
        Ellipse,
        curve::{Interval, ParametricCurve, ParametricFormula},
    },
};
use proptest::prelude::*;

/// `(a cos ωt, b sin ωt)`, with further waves of `k` times the frequency.
#[derive(Clone, Copy, Debug)]
struct Waves {
    axes: [f64; 2],
    rate: f64,
    size: [f64; 2],
    number: f64,
    /// Whether the further waves of the second coordinate have kinks.
    is_bent: bool,
}

const ELLIPSE: Waves = Waves { axes: [2.0, 1.0], rate: 1.0, size: [0.0; 2], number: 1.0, is_bent: false };

impl ParametricFormula for Waves {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        let Waves { axes: [a, b], rate, size: [c, d], number: k, is_bent } = *self;
        let ((sin, cos), (wave, crest)) = (libm::sincos(rate * t), libm::sincos(k * rate * t));
        let sign = if is_bent { libm::copysign(1.0, wave) } else { 1.0 };
        let [w, w2, k2] = [rate, rate * rate, k * rate];
        [
            [a * cos + c * crest, b * sin + d * wave * sign],
            [-a * w * sin - c * k2 * wave, b * w * cos + d * k2 * crest * sign],
            [-a * w2 * cos - c * k2 * k2 * crest, -b * w2 * sin - d * k2 * k2 * wave * sign],
        ]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        let Waves { axes: [a, b], rate, size: [c, d], number: k, is_bent } = *self;
        let ([sin, cos], [wave, crest]) = ((t * rate).sin_cos(), (t * (k * rate)).sin_cos());
        let [w, w2, k2] = [rate, rate * rate, k * rate];
        let sign = libm::copysign(1.0, wave.low);
        let [height, slope, bend] = if !is_bent {
            [wave, crest, wave]
        } else if wave.contains(0.0) {
            [wave.abs(), crest.union(-crest), Interval::ENTIRE]
        } else {
            [wave.abs(), crest * sign, wave.abs()]
        };
        [
            [cos * a + crest * c, sin * b + height * d],
            [sin * (-a * w) + wave * (-c * k2), cos * (b * w) + slope * (d * k2)],
            [cos * (-a * w2) + crest * (-c * k2 * k2), sin * (-b * w2) + bend * (-d * k2 * k2)],
        ]
    }
}

fn around(formula: Waves, inside: bool) -> Vec<ParametricCurve<Waves>> {
    ParametricCurve::around(formula, [0.0, TAU / formula.rate.abs()], inside).unwrap()
}

/// Paths from points well inside in many directions.
fn paths() -> impl Iterator<Item = Line<2>> {
    (0..2000).map(|k| {
        let turn = 0.7 * f64::from(k);
        let point = Vector2::new(0.6 * libm::sin(3.0 * turn), 0.3 * libm::cos(2.0 * turn));
        Line { point, velocity: Vector2::new(libm::cos(turn), libm::sin(turn)) * 1.5 }
    })
}

fn first(pieces: &[ParametricCurve<Waves>], path: &Line<2>) -> (usize, f64) {
    let times = pieces.iter().map(|piece| piece.crossing(path).time());
    times.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap()
}

#[test]
fn curves_given_by_their_points_keep_the_promises_of_a_piece() {
    let region = Extent { min: Vector2::repeat(-2.5), max: Vector2::repeat(2.5) };
    let waves = Waves { size: [0.0, 0.05], number: 3.0, is_bent: true, ..ELLIPSE };
    let ends = [0.5, 2.0].map(|t| Vector2::from(ELLIPSE.jet(t)[0]));
    let all = [
        ParametricCurve::around(ELLIPSE, [0.0, TAU], true),
        ParametricCurve::around(ELLIPSE, [0.0, TAU], false),
        ParametricCurve::along(ELLIPSE, [0.5, 2.0], ends),
        ParametricCurve::along(ELLIPSE, [2.0, 0.5], [ends[1], ends[0]]),
        ParametricCurve::around(waves, [0.0, TAU], true),
    ];
    for (k, pieces) in all.into_iter().enumerate() {
        for piece in pieces.unwrap() {
            let report = check::piece(&piece, region, 200);
            assert!(report.missed == 0 && report.hits > 5, "{k}: {report:?}");
            assert!(report.rounding() < 2e-15, "{k}: {report:?}");
            assert!(report.normal_direction < 1e-7 && report.curvature < 1e-5, "{k}: {report:?}");
            assert!(report.length < 1e-10 && report.area < 1e-10, "{k}: {report:?}");
            assert!(report.graphs < 1e-15 && report.graph_normals < 1e-13, "{k}: {report:?}");
        }
    }
}

#[test]
fn an_ellipse_by_its_points_is_the_ellipse() {
    let exact = Ellipse::new(Vector2::zeros(), [2.0, 1.0], 0.0, true).unwrap();
    // run through either way, in a turn or in any other range
    for rate in [1.0, -1.0, 1000.0, -1e-3, 0.3] {
        let pieces = around(Waves { rate, ..ELLIPSE }, true);
        let [curve] = &pieces[..] else { panic!("{} pieces", pieces.len()) };
        assert!((curve.length() / exact.length() - 1.0).abs() < 4e-15, "{rate}");
        assert!((curve.area() / (2.0 * PI) - 1.0).abs() < 4e-15, "{rate}");
        let (extent, of_exact) = (curve.extent(), exact.extent());
        assert!((extent.min - of_exact.min).amax().max((extent.max - of_exact.max).amax()) < 1e-15);
        for path in paths() {
            let time = curve.crossing(&path).time();
            assert!((time - exact.crossing(&path).time()).abs() < 2e-15, "{rate} {path:?}");
            let (here, there) = (curve.landing(&path, time), exact.landing(&path, time));
            assert!((here.point - there.point).amax() < 4e-15, "{rate} {path:?}");
            assert!((here.normal - there.normal).amax() < 4e-15, "{rate} {path:?}");
            let bend = curve.curvature(&here.point) / exact.curvature(&there.point);
            assert!((bend - 1.0).abs() < 1e-13, "{rate} {path:?} {bend}");
            let s = curve.arc_length_at(&here.point);
            assert!((curve.point_at(s) - here.point).amax() < 4e-15, "{rate} {path:?}");
        }
    }
}

#[test]
fn from_outside_a_curve_is_met_on_its_other_side() {
    let pieces = around(ELLIPSE, false);
    assert!(pieces[0].area() < 0.0);
    let path = Line { point: Vector2::new(-5.0, 0.5), velocity: Vector2::x() };
    let time = pieces[0].crossing(&path).time();
    // x = −2 √(1 − ¼)
    assert!((time - (5.0 - 3_f64.sqrt())).abs() < 2e-15);
    assert!(pieces[0].landing(&path, time).normal.x < 0.0);
    assert!((around(ELLIPSE, true)[0].crossing(&path).time() - (5.0 + 3_f64.sqrt())).abs() < 2e-15);
}

#[test]
fn a_curve_is_cut_at_its_kinks_and_where_its_range_begins() {
    for inside in [true, false] {
        for number in [2.0, 3.0, 8.0] {
            let bent = Waves { size: [0.0, 0.05], number, is_bent: true, ..ELLIPSE };
            let pieces = around(bent, inside);
            assert_eq!(pieces.len() as f64, 2.0 * number);
            let ends: Vec<_> = pieces.iter().map(|piece| piece.ends().unwrap()).collect();
            assert!((0..ends.len()).all(|k| ends[k][1] == ends[(k + 1) % ends.len()][0]));
            // ∮ x dy of the further waves is 2 d ∫ |sin kt| sin t dt, odd about π
            let area = enclosed_area(pieces.iter().map(|piece| piece as &dyn Piece)) * if inside { 1.0 } else { -1.0 };
            assert!((area - 2.0 * PI).abs() < 4e-14, "{number} {area}");
            let table = Table::new(pieces.into_iter().map(|piece| Box::new(piece) as _).collect()).unwrap();
            let table = if inside { table } else { table.unbounded() };
            assert_eq!(table.validate(), Ok(()));
        }
    }
}

#[test]
fn a_path_ends_where_the_formula_says() {
    for formula in [
        Waves { size: [0.05, 0.1], number: 3.0, ..ELLIPSE },
        Waves { size: [0.05, 0.1], number: 7.0, ..ELLIPSE },
        Waves { size: [0.0, 0.05], number: 5.0, is_bent: true, ..ELLIPSE },
    ] {
        let pieces = around(formula, true);
        for path in paths() {
            let (k, time) = first(&pieces, &path);
            let landing = pieces[k].landing(&path, time);
            assert!((landing.point - path.at(time)).amax() < 4e-15, "{formula:?} {path:?}");
            // nothing was crossed before: halfway it is inside
            let half = path.at(0.5 * time);
            let near = pieces.iter().map(|piece| piece.closest(&half));
            let near = near.min_by(|a, b| (a.point - half).norm().total_cmp(&(b.point - half).norm())).unwrap();
            assert!(near.normal.dot(&(half - near.point)) > 0.0, "{formula:?} {path:?}");
        }
    }
}

#[test]
fn a_curve_may_have_a_corner_where_its_range_begins() {
    /// `(sin πt, t (1 − t)(1 − 2t))` for `t` in [0, 1]
    #[derive(Debug)]
    struct Drop;
    impl ParametricFormula for Drop {
        fn jet(&self, t: f64) -> [[f64; 2]; 3] {
            let (sin, cos) = libm::sincos(PI * t);
            let y = [t * (1.0 - t) * (1.0 - 2.0 * t), 1.0 - 6.0 * t + 6.0 * t * t, 12.0 * t - 6.0];
            [[sin, y[0]], [PI * cos, y[1]], [-PI * PI * sin, y[2]]]
        }
        fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
            let [sin, cos] = (t * PI).sin_cos();
            let one = Interval::from(1.0);
            let y = [t * (one - t) * (one - t * 2.0), one - t * 6.0 + t.square() * 6.0, t * 12.0 - Interval::from(6.0)];
            [[sin, y[0]], [cos * PI, y[1]], [-sin * (PI * PI), y[2]]]
        }
    }
    let pieces = ParametricCurve::around(Drop, [0.0, 1.0], true).unwrap();
    let boxed: Vec<Box<dyn Piece>> = pieces.into_iter().map(|piece| Box::new(piece) as _).collect();
    let table = Table::new(boxed).unwrap();
    assert_eq!((table.validate(), table.pieces().len(), table.corners().len()), (Ok(()), 2, 1));
    assert!(table.corners()[0].amax() < 1e-15);
    // |∫ y x′ dt| = |∫ (1 − 6t + 6t²) sin πt dt|
    assert!((table.area() - (24.0 / (PI * PI * PI) - 2.0 / PI)).abs() < 1e-15, "{}", table.area());
}

#[test]
fn what_is_no_curve_is_refused() {
    let refused = |formula: Waves, range: [f64; 2]| ParametricCurve::around(formula, range, true).unwrap_err();
    let must = |error: Error| match error {
        Error::Parametrised { must, parameter } => (must, parameter),
        other => panic!("{other}"),
    };
    let (open, at) = must(refused(ELLIPSE, [0.0, PI]));
    assert_eq!((open, at), (ParametricRule::Closed, PI));
    for range in [[0.0, 0.0], [1.0, 0.0], [0.0, f64::NAN], [0.0, f64::INFINITY]] {
        assert!(matches!(refused(ELLIPSE, range), Error::Parameter { name: "range", .. }));
    }
    // the tips of an ellipse this flat are as narrow as the rounding of their points
    for (width, is_wide) in [(1e-7, true), (1e-8, false)] {
        let found = ParametricCurve::around(Waves { axes: [1.0, width], ..ELLIPSE }, [0.0, TAU], true);
        assert_eq!(found.is_ok(), is_wide, "{width}");
        if let Err(error) = found {
            assert!(error.to_string().contains("no bend as narrow as rounding"), "{error}");
        }
    }
    // a figure of eight crosses itself, and an ellipse that goes around twice runs along itself
    let eight = Waves { axes: [1.0, 0.1], size: [0.0, 0.5], number: 2.0, ..ELLIPSE };
    for (formula, range) in [(eight, [0.0, TAU]), (ELLIPSE, [0.0, 2.0 * TAU])] {
        let pieces = ParametricCurve::around(formula, range, true).unwrap();
        let table = Table::new(pieces.into_iter().map(|piece| Box::new(piece) as _).collect()).unwrap();
        assert!(matches!(table.validate(), Err(Error::SelfCrossing { .. })));
    }
}

/// A circle about a point on the x-axis.
#[derive(Clone, Copy, Debug)]
struct Round {
    center: f64,
}

impl ParametricFormula for Round {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        let (sin, cos) = libm::sincos(t);
        [[self.center + cos, sin], [-sin, cos], [-cos, -sin]]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        let [sin, cos] = t.sin_cos();
        [[cos + self.center, sin], [-sin, cos], [-cos, -sin]]
    }
}

#[test]
fn whether_a_curve_is_closed_does_not_depend_on_its_distance_from_the_origin() {
    for center in [0.0, 1e3, 1e6] {
        assert!(ParametricCurve::around(Round { center }, [0.0, TAU], true).is_ok(), "{center}");
        let found = ParametricCurve::around(Round { center }, [0.0, TAU - 2e-4], true).map(|_| ());
        assert!(matches!(found, Err(Error::Parametrised { must: ParametricRule::Closed, .. })), "{center}: {found:?}");
    }
}

/// `(t, √(b − t)⁷)`, not defined beyond `t = b`.
#[derive(Clone, Copy, Debug)]
struct Ending {
    end: f64,
}

impl ParametricFormula for Ending {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        let root = (self.end - t).sqrt();
        let cube = root * root * root;
        [[t, cube * cube * root], [1.0, -3.5 * cube * root * root], [0.0, 8.75 * cube]]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        let root = (-t + self.end).sqrt();
        [[t, root.powi(7)], [Interval::from(1.0), root.powi(5) * -3.5], [Interval::from(0.0), root.powi(3) * 8.75]]
    }
}

#[test]
fn a_formula_is_asked_nowhere_beyond_its_range() {
    // ranges that are longer when written as a share of a turn
    let ends = (1..400).map(|k| 0.01 * f64::from(k)).filter(|end| end / TAU * TAU > *end);
    for end in ends.take(4) {
        let formula = Ending { end };
        let points = [0.0, end].map(|t| Vector2::from(formula.jet(t)[0]));
        for (range, points) in [([0.0, end], points), ([end, 0.0], [points[1], points[0]])] {
            let arcs = ParametricCurve::along(formula, range, points).unwrap();
            assert!(arcs.len() == 1 && arcs[0].ends() == Some(points), "{end}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]

    // the circle with a point that turns k times as fast about the one that goes around has loops from |k| d = 1 on
    #[test]
    fn a_trochoid_crosses_itself_where_it_has_loops(
        number in prop_oneof![2..8, -8..-1],
        share in prop_oneof![0.1..0.99, 1.01..1.4],
        (inside, turn) in (any::<bool>(), 0.0..TAU),
    ) {
        let number = f64::from(number);
        let formula = Waves { axes: [1.0; 2], rate: 1.0, size: [share / number.abs(); 2], number, is_bent: false };
        let pieces = ParametricCurve::around(formula, [turn, turn + TAU], inside).unwrap();
        let table = Table::new(pieces.into_iter().map(|piece| Box::new(piece) as _).collect()).unwrap();
        let crosses = matches!(table.validate(), Err(Error::SelfCrossing { .. }));
        prop_assert_eq!(crosses, share > 1.0);
    }
}

#[test]
fn an_arc_has_the_table_on_its_left() {
    for (range, inside) in [([0.0, PI], true), ([PI, 0.0], false)] {
        let ends = range.map(|t| Vector2::from(ELLIPSE.jet(t)[0]));
        let [arc] = &ParametricCurve::along(ELLIPSE, range, ends).unwrap()[..] else { panic!("it has no kinks") };
        assert_eq!(arc.ends(), Some(ends));
        let top = arc.closest(&Vector2::new(0.0, 0.5));
        assert_eq!(top.normal.y < 0.0, inside);
        assert!((top.point - Vector2::new(0.0, 1.0)).amax() < 1e-15);
        assert!((arc.area() - if inside { PI } else { -PI }).abs() < 4e-15);
        let bent = Waves { size: [0.0, 0.05], number: 3.0, is_bent: true, ..ELLIPSE };
        let arcs = ParametricCurve::along(bent, range, ends).unwrap();
        assert_eq!(arcs.len(), 3);
        assert_eq!([arcs[0].ends().unwrap()[0], arcs[2].ends().unwrap()[1]], ends);
        assert!((0..2).all(|k| arcs[k].ends().unwrap()[1] == arcs[k + 1].ends().unwrap()[0]));
    }
}

#[test]
fn a_disk_fits_into_a_curve_as_into_the_ellipse_that_it_is() {
    let table = |piece: Box<dyn Piece>| Table::new(vec![piece]).unwrap();
    let exact = table(Box::new(Ellipse::new(Vector2::zeros(), [2.0, 1.0], 0.0, true).unwrap()));
    let [curve] = <[_; 1]>::try_from(around(ELLIPSE, true)).unwrap();
    let curve = table(Box::new(curve));
    for radius in [0.1, 0.45, 0.7] {
        let [here, there] = [&curve, &exact].map(|table| table.offset(radius).unwrap().table);
        assert_eq!(here.pieces().len(), there.pieces().len());
        assert!((here.area() - there.area()).abs() < 1e-13, "{radius}: {} {}", here.area(), there.area());
        assert!((here.perimeter() - there.perimeter()).abs() < 1e-13, "{radius}");
    }
}

#[test]
fn a_narrow_bump_is_counted_or_refused() {
    /// `(cos t, sin t + exp(−s²)/20)` with `s = (t − 1)/w`
    #[derive(Debug)]
    struct Bump(f64);
    impl ParametricFormula for Bump {
        fn jet(&self, t: f64) -> [[f64; 2]; 3] {
            let ((sin, cos), w, s) = (libm::sincos(t), self.0, (t - 1.0) / self.0);
            let g = 0.05 * libm::exp(-s * s);
            [[cos, sin + g], [-sin, cos - 2.0 * s * g / w], [-cos, -sin + (4.0 * s * s - 2.0) * g / (w * w)]]
        }
        fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
            let ([sin, cos], w, s) = (t.sin_cos(), self.0, (t + -1.0) * (1.0 / self.0));
            let g = (-s.square()).exp() * 0.05;
            let bend = (s.square() * 4.0 + -2.0) * g * (1.0 / (w * w));
            [[cos, sin + g], [-sin, cos - s * g * (2.0 / w)], [-cos, bend - sin]]
        }
    }
    let mut refused = 0;
    for width in [0.1, 0.03, 0.02, 0.01, 7e-3, 5e-3, 3e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 1e-6] {
        let Ok(pieces) = ParametricCurve::around(Bump(width), [0.0, TAU], true) else {
            refused += 1;
            continue;
        };
        assert_eq!((pieces.len(), refused), (1, 0), "{width}");
        // on both sides of the bump it is a circle
        let count = 100_000;
        let at = |k: i32| Vector2::from(Bump(width).jet(1.0 + 10.0 * width * f64::from(k) / f64::from(count))[0]);
        let bump: f64 = (-count..count).map(|k| (at(k + 1) - at(k)).norm()).sum();
        let length = TAU - 20.0 * width + bump;
        assert!((pieces[0].length() / length - 1.0).abs() < 1e-8, "{width}: {} {length}", pieces[0].length());
        // a path that meets the top of the bump from below
        let (start, top) = (Vector2::new(libm::cos(1.0), 0.0), libm::sin(1.0) + 0.05);
        let time = pieces[0].crossing(&Line { point: start, velocity: Vector2::y() }).time();
        assert!((time - top).abs() < 1e-15, "{width}: {time} {top}");
    }
    assert!(refused > 0);
}

/// `(1 + k) a (cos t, sin t) − a (cos, sin)((1 + k) t)`: an epicycloid with `k` cusps, or for `k < 0`, with the sign of the second sine
/// turned, a hypocycloid with `|k|` of them.
fn cycloid(cusps: f64) -> Waves {
    let number = 1.0 + cusps;
    Waves { axes: [number; 2], size: [-1.0; 2], number, ..ELLIPSE }
}

#[test]
fn a_curve_is_cut_at_its_cusps() {
    // cardioid, nephroid, deltoid, astroid
    for cusps in [1.0, 2.0, 5.0, -3.0, -4.0_f64] {
        for inside in [true, false] {
            let pieces = around(cycloid(cusps), inside);
            let count = cusps.abs();
            assert_eq!(pieces.len() as f64, count.max(2.0));
            let length: f64 = pieces.iter().map(Piece::length).sum();
            let expected = 8.0 * (1.0 + cusps).abs();
            assert!((length / expected - 1.0).abs() < 1e-14, "{cusps}: {length} {expected}");
            let area = enclosed_area(pieces.iter().map(|piece| piece as &dyn Piece)).abs();
            let expected = PI * ((1.0 + cusps) * (2.0 + cusps)).abs();
            assert!((area / expected - 1.0).abs() < 1e-14, "{cusps}: {area} {expected}");
            let table = Table::new(pieces.into_iter().map(|piece| Box::new(piece) as _).collect()).unwrap();
            let table = if inside { table } else { table.unbounded() };
            assert_eq!(table.validate(), Ok(()));
            // the tips are as far from the middle as there are cusps, and from each other
            let tips: Vec<Vector2<f64>> = table.corners().to_vec();
            assert_eq!(tips.len() as f64, count);
            for (k, tip) in tips.iter().enumerate() {
                let turn = libm::atan2(tips[0].perp(tip), tips[0].dot(tip)) * count / TAU;
                assert!((tip.norm() / count - 1.0).abs() < 1e-15, "{cusps}: {tip}");
                assert!((turn - libm::round(turn)).abs() < 4e-16 * count * count, "{cusps}: {turn}");
                assert!(tips[..k].iter().all(|other| (other - tip).norm() > 1.0));
            }
        }
    }
}

/// A curve mapped by `x → A x + b`.
#[derive(Debug)]
struct Mapped([[f64; 2]; 2], [f64; 2], Waves);

impl ParametricFormula for Mapped {
    fn jet(&self, t: f64) -> [[f64; 2]; 3] {
        let Mapped([p, q], [b0, b1], formula) = self;
        let row = |row: &[f64; 2], c: [f64; 2]| row[0] * c[0] + row[1] * c[1];
        let [[x, y], first, second] = formula.jet(t).map(|c| [row(p, c), row(q, c)]);
        [[x + b0, y + b1], first, second]
    }
    fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
        let Mapped([p, q], [b0, b1], formula) = self;
        let row = |row: &[f64; 2], c: [Interval; 2]| c[0] * row[0] + c[1] * row[1];
        let [[x, y], first, second] = formula.jet_over(t).map(|c| [row(p, c), row(q, c)]);
        [[x + *b0, y + *b1], first, second]
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn cusps_are_found_wherever_a_curve_lies_and_begins(
        cusps in prop::sample::select(vec![1.0, 2.0, 3.0, -3.0, -4.0, -5.0_f64]),
        map in prop::array::uniform4(-1.0..1.0),
        shift in prop::array::uniform2(-3.0..3.0),
        size in -100.0..100.0,
        start in -3.0..3.0,
        rate in prop::sample::select(vec![1.0, -1.0, 0.3, 6.0]),
    ) {
        let [a, b, c, d] = map.map(|x: f64| x * libm::exp2(size));
        let det = (a * d - b * c) / libm::exp2(2.0 * size);
        prop_assume!(det.abs() > 0.1);
        let formula = Mapped([[a, b], [c, d]], shift.map(|x| x * libm::exp2(size)), Waves { rate, ..cycloid(cusps) });
        let range = [start, start + TAU / rate.abs()];
        let pieces = ParametricCurve::around(formula, range, true).unwrap();
        let table = Table::new(pieces.into_iter().map(|piece| Box::new(piece) as _).collect()).unwrap();
        prop_assert_eq!(table.validate(), Ok(()));
        prop_assert_eq!(table.corners().len() as f64, cusps.abs());
        let area = PI * ((1.0 + cusps) * (2.0 + cusps) * det).abs() * libm::exp2(2.0 * size);
        prop_assert!((table.area() / area - 1.0).abs() < 1e-13, "{} {}", table.area(), area);
    }
}

#[test]
fn the_sides_of_a_cusp_have_one_tangent_at_its_tip_and_bend_without_end() {
    // of the cardioid, (1 + s − …, ± s^(3/2) …) at a way s from the tip
    let tip = Vector2::new(1.0, 0.0);
    for piece in around(cycloid(1.0), true) {
        let starts = piece.ends().unwrap()[0] == tip;
        let side = if starts { 1.0 } else { -1.0 };
        let away = |s: f64| piece.landing_at(if starts { s } else { piece.length() - s });
        let at_tip = away(0.0);
        assert_eq!(at_tip.point, tip);
        assert!((at_tip.normal - Vector2::new(0.0, side)).amax() < 1e-15, "{at_tip:?}");
        for s in [1e-12, 1e-10, 1e-8, 1e-6, 1e-4_f64] {
            // the next terms are so much less; ways are known to a rounding of the length
            let (next, rounding) = (4.0 * s, 8.0 * f64::EPSILON);
            let (root, landing) = (s.sqrt(), away(s));
            assert!((landing.point.x - 1.0 - s).abs() < next * s + rounding, "{s:e}");
            assert!((landing.point.y - side * s * root).abs() < next * s * root + rounding * 1.5 * root, "{s:e}");
            let slope = -side * landing.normal.x / landing.normal.y * side;
            assert!((slope - 1.5 * root * side).abs() < next * root + rounding * 0.75 / root, "{s:e} {slope}");
            let bend = piece.curvature(&landing.point) * root / 0.75;
            assert!((bend - 1.0).abs() < next + rounding / s, "{s:e} {bend}");
        }
    }
}

#[test]
fn directions_beside_a_cusp_follow_the_waves_of_its_flanks() {
    /// `x = t²`, `y′ = t² (3 + sin(ωt)/10)`
    #[derive(Debug)]
    struct Rippled(f64);
    impl ParametricFormula for Rippled {
        fn jet(&self, t: f64) -> [[f64; 2]; 3] {
            let (w, (sin, cos)) = (self.0, libm::sincos(self.0 * t));
            let y = t * t * t + 0.1 * ((2.0 / (w * w) - t * t) * cos + 2.0 * t / w * sin) / w;
            let slope = 3.0 + 0.1 * sin;
            [[t * t, y], [2.0 * t, t * t * slope], [2.0, t * (2.0 * slope + 0.1 * w * t * cos)]]
        }
        fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
            let (w, [sin, cos]) = (self.0, (t * self.0).sin_cos());
            let y = t * t.square() + ((-t.square() + 2.0 / (w * w)) * cos + t * sin * (2.0 / w)) * (0.1 / w);
            let slope = sin * 0.1 + 3.0;
            [[t.square(), y], [t * 2.0, t.square() * slope], [2.0.into(), t * (slope * 2.0 + t * cos * (0.1 * w))]]
        }
    }
    for waves in [10.0, 300.0, 800.0] {
        let ends = [-1.0, 1.0].map(|t| Vector2::from(Rippled(waves).jet(t)[0]));
        let pieces = ParametricCurve::along(Rippled(waves), [-1.0, 1.0], ends).unwrap();
        assert_eq!(pieces.len(), 2);
        for k in 1..200 {
            let t = 0.0005 * f64::from(k);
            let [point, along, _] = Rippled(waves).jet(t).map(Vector2::from);
            let landing = pieces[1].closest(&point);
            let turned = landing.normal.dot(&along) / along.norm();
            assert!((landing.point - point).amax() < 4e-16 && turned.abs() < 4e-16 / t, "{waves} {t}: {turned:e}");
        }
    }
}

#[test]
fn where_a_curve_stands_still_otherwise_it_is_refused() {
    /// `(cos t, sin t)` at the angle `t + a sin kt`
    #[derive(Debug)]
    struct Uneven(f64, f64);
    impl ParametricFormula for Uneven {
        fn jet(&self, t: f64) -> [[f64; 2]; 3] {
            let Uneven(a, k) = *self;
            let (wave, crest) = libm::sincos(k * t);
            let [angle, rate, change] = [t + a * wave, 1.0 + a * k * crest, -a * k * k * wave];
            let (sin, cos) = libm::sincos(angle);
            let square = rate * rate;
            [[cos, sin], [-sin * rate, cos * rate], [-cos * square - sin * change, cos * change - sin * square]]
        }
        fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
            let Uneven(a, k) = *self;
            let [wave, crest] = (t * k).sin_cos();
            let [angle, rate, change] = [t + wave * a, crest * (a * k) + 1.0, wave * (-a * k * k)];
            let [sin, cos] = angle.sin_cos();
            let square = rate.square();
            [[cos, sin], [-(sin * rate), cos * rate], [-(cos * square) - sin * change, cos * change - sin * square]]
        }
    }
    let around = |a: f64, k: f64| ParametricCurve::around(Uneven(a, k), [0.0, TAU], true);
    assert_eq!(around(0.25, 3.0).unwrap().len(), 1);
    // the angle goes on beyond a place where its rate vanishes with the rate of the rate, and turns back twice where it is negative
    let Err(Error::Parametrised { must, parameter }) = around(-0.5, 2.0) else { panic!("it stands still") };
    assert!(must == ParametricRule::Moving && (parameter / PI - libm::round(parameter / PI)).abs() < 1e-6);
    let turning = around(-0.75, 2.0).map(|pieces| {
        let boxed = pieces.into_iter().map(|piece| Box::new(piece) as _).collect();
        Table::new(boxed).unwrap().validate()
    });
    assert!(!matches!(turning, Ok(Ok(()))), "{turning:?}");
}

#[test]
fn two_cusps_too_near_to_be_told_apart_are_refused() {
    /// `(t³/3 − a²t, t⁴/4 − a²t²/2)`: cusps at `t = ±a`
    #[derive(Debug)]
    struct Swallowtail(f64);
    impl ParametricFormula for Swallowtail {
        fn jet(&self, t: f64) -> [[f64; 2]; 3] {
            let (a2, t2) = (self.0 * self.0, t * t);
            let c = [t * (t2 / 3.0 - a2), t2 * (t2 / 4.0 - a2 / 2.0)];
            [c, [t2 - a2, t * (t2 - a2)], [2.0 * t, 3.0 * t2 - a2]]
        }
        fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
            let (a2, t2) = (self.0 * self.0, t.square());
            let c = [t * (t2 * (1.0 / 3.0) + -a2), t2 * (t2 * 0.25 + -a2 / 2.0)];
            [c, [t2 + -a2, t * (t2 + -a2)], [t * 2.0, t2 * 3.0 + -a2]]
        }
    }
    for (a, apart) in [(0.5, true), (0.1, true), (0.01, true), (1e-6, false), (1e-8, false), (0.0, false)] {
        let ends = [-1.0, 1.0].map(|t| Vector2::from(Swallowtail(a).jet(t)[0]));
        match ParametricCurve::along(Swallowtail(a), [-1.0, 1.0], ends) {
            Ok(pieces) => {
                assert!(apart && pieces.len() == 3, "{a}");
                let inner = pieces[1].ends().unwrap();
                assert!((inner[0].x - inner[1].x - 4.0 / 3.0 * a * a * a).abs() < 1e-15, "{a}: {inner:?}");
            }
            Err(error) => assert!(!apart && error.to_string().contains("stand still"), "{a}: {error}"),
        }
    }
}

#[test]
fn a_range_may_end_next_to_a_cusp() {
    /// The astroid `(cos³ t, sin³ t)`, which stands still at 2π and not at the nearest double
    #[derive(Debug)]
    struct Cubes;
    impl ParametricFormula for Cubes {
        fn jet(&self, t: f64) -> [[f64; 2]; 3] {
            let (s, c) = libm::sincos(t);
            let [x, y] = [c * (6.0 * s * s - 3.0 * c * c), s * (6.0 * c * c - 3.0 * s * s)];
            [[c * c * c, s * s * s], [-3.0 * c * c * s, 3.0 * s * s * c], [x, y]]
        }
        fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
            let [s, c] = t.sin_cos();
            let [s2, c2] = [s.square(), c.square()];
            let [x, y] = [c * (s2 * 6.0 - c2 * 3.0), s * (c2 * 6.0 - s2 * 3.0)];
            [[c * c2, s * s2], [c2 * s * -3.0, s2 * c * 3.0], [x, y]]
        }
    }
    let pieces = ParametricCurve::around(Cubes, [0.0, TAU], true).unwrap();
    assert_eq!(pieces.len(), 4);
    assert!(pieces.iter().all(|piece| (piece.length() - 1.5).abs() < 2e-15));
    assert_eq!(pieces[0].ends().unwrap(), [Vector2::x(), pieces[1].ends().unwrap()[0]]);
    assert_eq!(pieces[3].ends().unwrap()[1], Vector2::x());
}

#[test]
fn the_sides_of_a_flat_cusp_meet_at_its_tip_only() {
    /// `(cosⁿ t, sinⁿ t)`, whose cusps are all the flatter and whose bends between them all the sharper
    #[derive(Debug)]
    struct Powers(i32);
    impl ParametricFormula for Powers {
        fn jet(&self, t: f64) -> [[f64; 2]; 3] {
            let (s, c) = libm::sincos(t);
            let power = |x: f64, n: i32| (0..n).fold(1.0, |product, _| product * x);
            let (k, m) = (f64::from(self.0), self.0 - 2);
            let [x, y] = [power(c, m), power(s, m)];
            let bend = |own: f64, other: f64| k * ((k - 1.0) * other * other - own * own);
            [[x * c * c, y * s * s], [-k * x * c * s, k * y * s * c], [x * bend(c, s), y * bend(s, c)]]
        }
        fn jet_over(&self, t: Interval) -> [[Interval; 2]; 3] {
            let [s, c] = t.sin_cos();
            let (k, n) = (f64::from(self.0), self.0);
            let bend =
                |own: Interval, other: Interval| own.powi(n - 2) * other.square() * (k * (k - 1.0)) - own.powi(n) * k;
            [[c.powi(n), s.powi(n)], [c.powi(n - 1) * s * -k, s.powi(n - 1) * c * k], [bend(c, s), bend(s, c)]]
        }
    }
    for n in [5, 15] {
        let pieces = ParametricCurve::around(Powers(n), [0.0, TAU], true).unwrap();
        let table = Table::new(pieces.into_iter().map(|piece| Box::new(piece) as _).collect()).unwrap();
        assert_eq!(table.validate(), Ok(()), "{n}");
    }
}

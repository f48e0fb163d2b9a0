//! Every shape keeps what [`geometry::Piece`] promises, and pieces that are the same curve agree.
#![allow(clippy::unwrap_used, clippy::float_cmp, reason = "tests panic where they fail, and claim exact values")]

mod formulas;

use formulas::{Clover, Conic, Quartic};
use geometry::{
    Error, Extent, Line, MeetingKind, Piece, Table, Vector2, check, enclosed_area, meetings,
    shapes::{
        Arc, Bump, Circle, Ellipse, EllipticArc, FullLine, Parallel, Ray, Screen, Segment, Translated,
        curve::{Implicit, ImplicitFormula, Interval, Polar, PolarFormula},
    },
    tables,
};

fn v(x: f64, y: f64) -> Vector2<f64> {
    Vector2::new(x, y)
}

/// A circle about a point other than the centre of the polar coordinates.
#[derive(Clone, Copy, Debug)]
struct OffCentre {
    offset: f64,
}

impl PolarFormula for OffCentre {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let (e, sin, cos) = (self.offset, libm::sin(angle), libm::cos(angle));
        let root = (1.0 - e * e * sin * sin).sqrt();
        let first = -e * e * sin * cos / root;
        let second = -(e * e * (cos * cos - sin * sin) + first * first) / root;
        [e * cos + root, -e * sin + first, -e * cos + second]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let (e, sin, cos) = (self.offset, angle.sin(), angle.cos());
        let root = (Interval::from(1.0) - sin.square() * (e * e)).sqrt();
        let first = sin * cos * (-e * e) / root;
        let second = -((cos.square() - sin.square()) * (e * e) + first.square()) / root;
        [cos * e + root, first - sin * e, second - cos * e]
    }
}

/// A piece of every kind, about as large as `scale`.
fn pieces(scale: f64) -> Vec<(&'static str, Box<dyn Piece>)> {
    let v = |x: f64, y: f64| v(scale * x, scale * y);
    let (c, a, b) = (v(0.3, -0.2), v(-0.5, -0.2), v(0.7, 0.1));
    let mut all: Vec<(&'static str, Box<dyn Piece>)> = vec![
        ("segment", Box::new(Segment::new(a, b).unwrap())),
        ("screen", Box::new(Screen::new(a, b).unwrap())),
        ("line", Box::new(FullLine::new(v(0.1, 0.2), v(1.0, 0.5)).unwrap())),
        ("ray", Box::new(Ray::new(v(0.1, 0.2), v(1.0, 0.5), true).unwrap())),
        ("ray to its end", Box::new(Ray::new(v(0.1, 0.2), v(1.0, 0.5), false).unwrap())),
        ("bump out", Box::new(Bump::new(a, b, 0.2 * scale).unwrap())),
        ("bump in", Box::new(Bump::new(a, b, -0.2 * scale).unwrap())),
    ];
    for inside in [true, false] {
        let circle = Circle::new(c, 0.75 * scale, inside).unwrap();
        let ellipse = Ellipse::new(c, [scale, 0.4 * scale], 0.5, inside).unwrap();
        let quartic = Quartic { semi_axes: [scale, 0.7 * scale], twist: 0.5 };
        let clover = Clover { radius: 0.8 * scale, amount: 0.2, leaves: 3 };
        let [a, b] = [0.5, 4.0].map(|s| circle.point_at(s * scale));
        all.push(("circle", Box::new(circle)));
        all.push(("arc", Box::new(Arc::new(c, a, b, inside).unwrap())));
        all.push(("ellipse", Box::new(ellipse)));
        let [a, b] = [0.5, 3.5].map(|s| ellipse.point_at(s * scale));
        all.push(("long elliptic arc", Box::new(EllipticArc::new(ellipse, a, b).unwrap())));
        all.push(("short elliptic arc", Box::new(EllipticArc::new(ellipse, b, a).unwrap())));
        all.push(("implicit", Box::new(Implicit::new(quartic, inside).unwrap())));
        all.push(("polar", Box::new(Polar::new(c, clover, inside).unwrap())));
    }
    all
}

/// Deterministic numbers in [0, 1).
fn noise(k: u32) -> f64 {
    let x = 43_758.545_312_3 * libm::sin(12.989_8 * f64::from(k) + 0.5);
    x - libm::floor(x)
}

fn specular(velocity: Vector2<f64>, normal: Vector2<f64>) -> Vector2<f64> {
    velocity - normal * (2.0 * normal.dot(&velocity) / normal.norm_squared())
}

/// Curves that are made of others.
fn derived() -> Vec<(&'static str, Box<dyn Piece>)> {
    let shared = |piece: Box<dyn Piece>| -> std::sync::Arc<dyn Piece> { piece.into() };
    let quartic = shared(Box::new(Implicit::new(Quartic { semi_axes: [1.0, 0.7], twist: 0.5 }, true).unwrap()));
    let ellipse = Ellipse::new(v(0.3, -0.2), [1.0, 0.7], 0.5, true).unwrap();
    let [a, b] = [0.5, 3.0].map(|s| ellipse.point_at(s));
    let arc = shared(Box::new(EllipticArc::new(ellipse, a, b).unwrap()));
    let whole = [0.0, quartic.length()];
    vec![
        ("parallel of a closed curve", Box::new(Parallel::new(quartic.clone(), 0.1, whole, None).unwrap())),
        ("parallel of an arc", Box::new(Parallel::new(arc.clone(), 0.1, [0.25, 1.5], None).unwrap())),
        ("translated curve", Box::new(Translated::new(quartic, v(0.25, 0.125)))),
        ("translated arc", Box::new(Translated::new(arc, v(0.25, 0.125)))),
    ]
}

#[test]
fn every_shape_keeps_its_promises() {
    let region = Extent { min: v(-1.5, -1.5), max: v(1.5, 1.5) };
    for (name, piece) in pieces(1.0).into_iter().chain(derived()) {
        let report = check::piece(piece.as_ref(), region, 300);
        assert!(report.hits > 15, "{name}: {report:?}");
        assert_eq!(report.missed, 0, "{name}: {report:?}");
        // some ten operations on numbers of size 1, each good to 1e-16
        assert!(report.rounding() < 2e-15, "{name}: {report:?}");
        // difference quotients with steps of 3e-5, and a polygon of 2048 sides, on curves with radii of curvature down to 0.1
        assert!(report.normal_direction < 1e-7 && report.curvature < 1e-5, "{name}: {report:?}");
        assert!(report.length < 1e-10 && report.area < 1e-10, "{name}: {report:?}");
        assert!(report.graphs < 1e-15 && report.graph_normals < 1e-14, "{name}: {report:?}");
    }
}

#[test]
fn the_pieces_of_all_named_tables_keep_their_promises() {
    for entry in tables::all().iter().filter(|entry| entry.dimension() == 2) {
        let table = entry.planar(&entry.typical()).unwrap();
        for (number, piece) in table.pieces().iter().enumerate() {
            let Extent { min, max } = piece.extent();
            let region = Extent { min: min.map(|x| x.max(-2.0)), max: max.map(|x| x.min(2.0)) };
            // of a straight wall, what is beside it as well
            let region = Extent { min: region.min.add_scalar(-0.25), max: region.max.add_scalar(0.25) };
            let report = check::piece(&**piece, region, 60);
            let name = entry.name;
            assert!(report.missed == 0 && report.hits > 0, "{name}, piece {number}: {report:?}");
            assert!(report.rounding() < 2e-15, "{name}, piece {number}: {report:?}");
            assert!(report.normal_direction < 1e-7 && report.curvature < 1e-5, "{name}, piece {number}: {report:?}");
            assert!(report.length < 1e-10 && report.area < 1e-10, "{name}, piece {number}: {report:?}");
        }
    }
}

#[test]
fn questions_about_nowhere_have_an_end() {
    /// `r = 2 − |cos φ|`, left whole: nothing bounds its second derivative about the kinks.
    #[derive(Clone, Debug)]
    struct Limacons;
    impl PolarFormula for Limacons {
        fn jet(&self, angle: f64) -> [f64; 3] {
            let (sin, cos) = libm::sincos(angle);
            [2.0 - cos.abs(), sin.copysign(sin * cos), cos.abs()]
        }
        fn jet_over(&self, angle: Interval) -> [Interval; 3] {
            let [sin, cos] = angle.sin_cos();
            [-cos.abs() + 2.0, sin.union(-sin), Interval::ENTIRE]
        }
    }
    let mut all = pieces(1.0);
    all.push(("kinks", Box::new(Polar::new(v(0.3, -0.2), Limacons, true).unwrap())));
    let odd = [0.25, 1e300, f64::MAX, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    for (name, piece) in &all {
        for (x, y) in odd.iter().flat_map(|x| odd.map(|y| (*x, y))) {
            for (point, velocity) in [(v(x, 0.1), v(0.5, y)), (v(0.1, x), v(y, y)), (v(x, y), v(0.3, -1.0))] {
                let path = Line { point, velocity };
                let time = piece.crossing(&path).time();
                if point.iter().chain(&velocity).any(|x| x.is_nan()) {
                    assert!(!time.is_finite(), "{name} is hit from nowhere: {path:?}, {time}");
                }
                piece.landing(&path, x);
                piece.curvature(&point);
                piece.closest(&point);
                piece.arc_length_at(&point);
                piece.point_at(x);
            }
        }
    }
}

#[test]
fn powers_of_two_scale_every_answer_to_the_last_bit() {
    for k in [-100, -40, 7, 100] {
        let scale = libm::exp2(f64::from(k));
        for ((name, one), (_, other)) in pieces(1.0).into_iter().zip(pieces(scale)) {
            let length = one.length();
            assert!(other.length() == scale * length || length == f64::INFINITY, "{name}");
            for i in 0..50 {
                let n = |j: u32| 2.0 * noise(10 * i + j) - 1.0;
                let path = Line { point: v(n(0), n(1)), velocity: v(n(2), n(3)) };
                let scaled = Line { point: path.point * scale, velocity: path.velocity * scale };
                let fast = Line { point: path.point, velocity: path.velocity * 0.25 };
                let time = one.crossing(&path).time();
                assert_eq!(other.crossing(&scaled).time(), time, "{name} {k} {path:?}");
                assert_eq!(one.crossing(&fast).time(), 4.0 * time, "{name} {path:?}");
                if time < f64::INFINITY {
                    let (at, there) = (one.landing(&path, time), other.landing(&scaled, time));
                    assert_eq!((at.point * scale, at.normal), (there.point, there.normal), "{name}");
                    assert_eq!(other.curvature(&there.point), one.curvature(&at.point) / scale, "{name}");
                    let s = one.arc_length_at(&at.point);
                    assert_eq!(other.arc_length_at(&there.point), scale * s, "{name}");
                    assert_eq!(other.point_at(scale * s), one.point_at(s) * scale, "{name}");
                }
            }
        }
    }
}

/// Every path of a kind, on two pieces that are the same curve; `tolerance` for times and lengths of order 1.
fn agree(one: &dyn Piece, other: &dyn Piece, tolerance: f64) {
    assert!((one.length() - other.length()).abs() < tolerance);
    assert!((one.area() - other.area()).abs() < tolerance);
    let (a, b) = (one.extent(), other.extent());
    assert!((a.min - b.min).norm() < tolerance && (a.max - b.max).norm() < tolerance);
    for k in 0..2000 {
        let n = |j: u32| 2.0 * noise(10 * k + j) - 1.0;
        let at = one.point_at(one.length() * noise(10 * k + 4));
        let (normal, velocity) = (one.closest(&at).normal, v(n(2), n(3)));
        let inwards = if velocity.dot(&normal) > 0.0 { velocity } else { -velocity };
        let from_inside = Line { point: at + normal * (0.1 * noise(10 * k + 5)), velocity };
        let from_boundary = Line { point: at, velocity: inwards };
        let from_afar = Line { point: at + normal * 1e3 - velocity * 1e3, velocity };
        let divides =
            (from_afar.point - one.closest(&from_afar.point).point).dot(&one.closest(&from_afar.point).normal);
        for path in [from_inside, from_boundary, from_afar] {
            if path == from_afar && divides < 0.0 {
                continue;
            }
            let [s, t] = [one, other].map(|piece| piece.crossing(&path).time());
            if s == f64::INFINITY || t == f64::INFINITY {
                // only a graze may be seen by one and not by the other
                let time = s.min(t);
                let steep = (time < f64::INFINITY).then(|| {
                    let at = one.landing(&path, time);
                    at.normal.dot(&velocity).abs() / velocity.norm()
                });
                assert!(steep.is_none_or(|sine| sine < 1e-5), "{path:?}: {s} {t}");
                continue;
            }
            let [p, q] = [(one, s), (other, t)].map(|(piece, time)| piece.landing(&path, time));
            let sine = (p.normal.dot(&velocity) / velocity.norm()).abs();
            // a path that comes in at a small angle meets the curve late or early by rounding over that angle
            let far = if path == from_afar { 1e3 } else { 1.0 };
            assert!((s - t).abs() * velocity.norm() * sine < far * tolerance, "{path:?}: {s} {t}");
            assert!((p.point - q.point).norm() * sine < far * tolerance);
            assert!((one.curvature(&p.point) - other.curvature(&p.point)).abs() < 100.0 * tolerance);
            assert!((other.closest(&p.point).point - p.point).norm() < tolerance);
        }
    }
}

#[test]
fn an_equation_agrees_with_the_ellipse_it_describes() {
    for inside in [true, false] {
        let conic = Conic { center: [0.25, -0.5], semi_axes: [1.0, 0.5] };
        let ellipse = Ellipse::new(v(0.25, -0.5), [1.0, 0.5], 0.0, inside).unwrap();
        agree(&ellipse, &Implicit::new(conic, inside).unwrap(), 1e-14);
    }
}

#[test]
fn an_equation_times_any_power_of_two_is_the_same_curve_to_the_last_bit() {
    /// `2ᵏ f`
    #[derive(Debug)]
    struct Times(i32, Quartic);
    impl Times {
        fn times(&self, x: f64) -> f64 {
            libm::ldexp(x, self.0)
        }
    }
    impl ImplicitFormula for Times {
        fn value(&self, p: [f64; 2]) -> f64 {
            self.times(self.1.value(p))
        }
        fn gradient(&self, p: [f64; 2]) -> [f64; 2] {
            self.1.gradient(p).map(|x| self.times(x))
        }
        fn hessian(&self, p: [f64; 2]) -> [f64; 3] {
            self.1.hessian(p).map(|x| self.times(x))
        }
        fn hessian_over(&self, over: [Interval; 2]) -> [Interval; 3] {
            self.1.hessian_over(over).map(|x| Interval { low: self.times(x.low), high: self.times(x.high) })
        }
        fn extent(&self) -> Extent {
            self.1.extent()
        }
    }
    let quartic = Quartic { semi_axes: [1.0, 0.75], twist: 0.25 };
    let curve = |k: i32| Implicit::new(Times(k, quartic), true).unwrap();
    let once = Implicit::new(quartic, true).unwrap();
    for curve in [0, 500, 1015, -500, -950].map(curve) {
        assert_eq!([curve.area(), curve.length()], [once.area(), once.length()]);
        for k in 0..50 {
            let (sin, cos) = libm::sincos(0.13 * f64::from(k));
            let path = Line { point: v(0.1, -0.2), velocity: v(cos, sin) };
            let (time, same) = (once.crossing(&path).time(), curve.crossing(&path).time());
            assert_eq!(time, same);
            assert_eq!(once.landing(&path, time), curve.landing(&path, time));
            let at = once.landing(&path, time).point;
            assert_eq!(once.curvature(&at), curve.curvature(&at));
        }
    }
}

#[test]
fn a_circle_about_another_point_is_a_circle() {
    for inside in [true, false] {
        let circle = Circle::new(v(1.5, 0.25), 1.0, inside).unwrap();
        let polar = Polar::new(v(1.0, 0.25), OffCentre { offset: 0.5 }, inside).unwrap();
        agree(&circle, &polar, 1e-14);
    }
}

#[test]
fn paths_through_the_centre_of_polar_coordinates_meet_the_curve() {
    let clover = Clover { radius: 1.0, amount: 0.2, leaves: 3 };
    let c = v(0.5, 0.25);
    let [inside, outside] = [true, false].map(|inside| Polar::new(c, clover, inside).unwrap());
    for k in 0..64 {
        let angle = f64::from(k) * core::f64::consts::PI / 32.0;
        let direction = v(libm::cos(angle), libm::sin(angle));
        let [r, ..] = clover.jet(angle);
        // exactly from the centre, through it within rounding, and towards it from outside
        for (piece, from, expected) in [(&inside, 0.0, r), (&inside, -0.5, r + 0.5), (&inside, 0.5, r - 0.5)] {
            let time = piece.crossing(&Line { point: c + direction * from, velocity: direction }).time();
            assert!((time - expected).abs() < 1e-15, "{angle} {from}: {time} {expected}");
        }
        let time = outside.crossing(&Line { point: c + direction * 3.0, velocity: -direction }).time();
        assert!((time - (3.0 - r)).abs() < 1e-15, "{angle}: {time}");
        let away = Line { point: c + direction * 3.0, velocity: direction };
        assert_eq!(outside.crossing(&away).num, f64::INFINITY);
    }
}

#[test]
fn grazing_chords_have_the_length_of_the_osculating_circle() {
    for (name, piece) in pieces(1.0).iter().filter(|(_, piece)| piece.length().is_finite()) {
        for (k, angle) in (0..40).flat_map(|k| [(k, 1e-3), (k, 1e-5), (k, 1e-7)]) {
            let s = piece.length() * (f64::from(k) + 0.5) / 40.0;
            let p = piece.point_at(s);
            let (normal, curvature) = (piece.closest(&p).normal, piece.curvature(&p));
            if curvature < 0.2 {
                continue;
            }
            let tangent = v(normal.y, -normal.x);
            let velocity = tangent * libm::cos(angle) + normal * libm::sin(angle);
            let path = Line { point: p, velocity };
            let time = piece.crossing(&path).time();
            let chord = 2.0 * libm::sin(angle) / curvature;
            // the curvature changes along the chord; the osculating circle differs in the third order; and where the
            // start is off the curve by rounding, 2e-16, the chord changes by that over the angle
            let change = (piece.curvature(&piece.landing(&path, time).point) / curvature - 1.0).abs();
            let tolerance = change + 10.0 * angle * angle + 1e-15 * curvature / (angle * angle);
            assert!((time / chord - 1.0).abs() < tolerance, "{name} at {s}, {angle:e}: {time:e} for {chord:e}");
        }
    }
}

#[test]
fn a_path_along_a_curve_lands_where_its_time_says() {
    for (name, piece) in pieces(1.0).iter().filter(|(_, piece)| piece.length().is_finite()) {
        for k in 0..200 {
            let at = piece.landing_at(piece.length() * (f64::from(k) + 0.5) / 200.0);
            if piece.curvature(&at.point) < 0.2 {
                continue;
            }
            for slope in [0.0, 1e-17, -1e-17, 1e-16, -1e-16, 1e-15, -1e-15, 1e-12, -1e-12] {
                for turn in [-1.0, 1.0] {
                    let along = v(at.normal.y, -at.normal.x) * turn;
                    let path = Line { point: at.point, velocity: along + at.normal * slope };
                    let time = piece.crossing(&path).time();
                    if time < f64::INFINITY {
                        let off = (path.at(time) - piece.landing(&path, time).point).norm();
                        assert!(off < 1e-14, "{name} {k} {slope:e}: {off:e} off after {time:e}");
                    }
                }
            }
        }
    }
}

#[test]
fn orbits_on_closed_curves_never_leave() {
    for (name, piece) in pieces(1.0).iter().filter(|(_, piece)| piece.ends().is_none() && piece.area() > 0.0) {
        for k in 0..20 {
            let mut path = Line { point: v(0.3, -0.2), velocity: v(libm::cos(f64::from(k)), libm::sin(f64::from(k))) };
            for n in 0..2000 {
                let time = piece.crossing(&path).time();
                assert!(time < 4.0, "{name}: orbit {k} is lost at {path:?} after {n} bounces");
                let at = piece.landing(&path, time);
                let velocity = specular(path.velocity, at.normal);
                path = Line { point: at.point, velocity: velocity / velocity.norm() };
            }
        }
    }
}

#[test]
fn the_angular_momenta_about_the_foci_of_an_ellipse_have_a_constant_product() {
    let ellipse = Ellipse::new(v(0.1, 0.2), [2.0, 1.0], 0.4, true).unwrap();
    let product =
        |path: &Line<2>| ellipse.foci().map(|focus| (path.point - focus).perp(&path.velocity)).iter().product::<f64>();
    for k in 0..8 {
        let mut path = Line { point: v(0.2, 0.5), velocity: v(libm::cos(f64::from(k)), libm::sin(f64::from(k))) };
        let start = product(&path);
        for _ in 0..10_000 {
            let at = ellipse.landing(&path, ellipse.crossing(&path).time());
            path = Line { point: at.point, velocity: specular(path.velocity, at.normal) };
            path.velocity /= path.velocity.norm();
        }
        // the directions of the axes are rounded, once for places and once for normals: 10⁴ bounces of about 1e-16 each, in step, of
        // momenta up to 2
        assert!((product(&path) - start).abs() < 2e-12, "{} {start}", product(&path));
    }
}

#[test]
fn a_polygon_of_bumps_is_closed() {
    // the perturbed pentagon: every path from inside meets exactly what is first, corners included
    let corner = |k: u32| {
        let angle = f64::from(k) * 0.4 * core::f64::consts::PI;
        v(libm::cos(angle), libm::sin(angle))
    };
    for height in [0.0, 0.02, -0.02, 0.15, -0.15] {
        let corners: Vec<Vector2<f64>> = (0..5).map(corner).collect();
        let sides: Vec<Bump> = (0..5).map(|k| Bump::new(corners[k], corners[(k + 1) % 5], height).unwrap()).collect();
        let area = enclosed_area(sides.iter().map(|side| side as &dyn Piece));
        let pentagon = 2.5 * libm::sin(0.4 * core::f64::consts::PI);
        let side = (corners[1] - corners[0]).norm();
        assert!((area - pentagon - 5.0 * 16.0 / 35.0 * height * side).abs() < 1e-14);
        for k in 0..40 {
            let target = if k < 5 { corner(k) - v(0.1, 0.2) } else { v(noise(k) - 0.5, noise(k + 99) - 0.5) };
            let mut path = Line { point: v(0.1, 0.2), velocity: target / target.norm() };
            for n in 0..500 {
                let first = sides.iter().map(|side| (side.crossing(&path).time(), side));
                let (time, side) = first.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
                assert!(time < 3.0, "{height}: orbit {k} is lost at {path:?} after {n} bounces");
                let at = side.landing(&path, time);
                let velocity = specular(path.velocity, at.normal);
                path = Line { point: at.point, velocity: velocity / velocity.norm() };
                // an orbit ends in a corner
                if corners.contains(&path.point) {
                    break;
                }
            }
        }
    }
}

#[test]
fn formulas_that_are_no_single_smooth_closed_curve_are_refused() {
    /// `f` with its gradient by differences: only the construction is tried.
    #[derive(Debug)]
    struct Plain(fn(f64, f64) -> f64);
    impl ImplicitFormula for Plain {
        fn value(&self, [x, y]: [f64; 2]) -> f64 {
            self.0(x, y)
        }
        fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
            let f = self.0;
            [(f(x + 1e-6, y) - f(x - 1e-6, y)) / 2e-6, (f(x, y + 1e-6) - f(x, y - 1e-6)) / 2e-6]
        }
        fn hessian(&self, _: [f64; 2]) -> [f64; 3] {
            [f64::NAN; 3]
        }
        fn hessian_over(&self, _: [Interval; 2]) -> [Interval; 3] {
            [Interval::ENTIRE; 3]
        }
        fn extent(&self) -> Extent {
            Extent { min: v(-2.0, -1.5), max: v(2.0, 1.5) }
        }
    }
    let refused = |f| Implicit::new(Plain(f), true).is_err();
    let cut_near = |f| match Implicit::new(Plain(f), true) {
        Err(Error::Curve { at, .. }) => v(at[0], at[1]),
        other => panic!("{:?}", other.err()),
    };
    assert!(!refused(|x, y| x * x + y * y - 1.0));
    assert!(refused(|x, y| 1.0 - x * x - y * y), "positive inside");
    assert!(refused(|x, y| x * x + y * y + 1.0), "empty");
    assert!(cut_near(|x, y| x * x + y * y - 3.0).y.abs() > 1.4, "larger than its box");
    assert!(refused(|x, y| (x * x + y * y) * (x * x + y * y) - 2.0 * (x * x - y * y)), "a lemniscate crosses itself");
    assert!(
        refused(|x, y| ((x - 1.0) * (x - 1.0) + y * y - 0.25) * ((x + 1.0) * (x + 1.0) + y * y - 0.25)),
        "two ovals"
    );
    assert!(refused(|x, y| (x * x + y * y - 1.0) * (x * x + y * y - 0.25)), "an annulus");
    let corner = cut_near(|x, y| x.abs() + y.abs() - 1.0);
    assert!((corner.amax() - 1.0).abs() < 1e-3 && corner.amin() < 1e-3, "corners, named: {corner}");
    assert!(refused(|x, _| x), "open");
}

/// `r = 2 + √(a − cos φ)/5`
#[derive(Clone, Copy, Debug)]
struct Rooted(f64);

impl PolarFormula for Rooted {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let (sin, cos) = libm::sincos(angle);
        let root = (self.0 - cos).sqrt();
        let slope = 0.5 * sin / root;
        [2.0 + 0.2 * root, 0.2 * slope, 0.2 * (0.5 * cos - slope * slope) / root]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let [sin, cos] = angle.sin_cos();
        let root = (-cos + self.0).sqrt();
        let slope = sin * 0.5 / root;
        [root * 0.2 + 2.0, slope * 0.2, (cos * 0.5 - slope.square()) / root * 0.2]
    }
}

#[test]
fn a_radius_is_positive_and_real_in_every_direction_or_refused_with_one_where_it_is_not() {
    let clover = |amount| Polar::new(v(0.0, 0.0), Clover { radius: 1.0, amount, leaves: 3 }, true).map(|_| ());
    assert_eq!(clover(0.9), Ok(()));
    let Err(Error::PolarRadius { angle, radius, certain: true }) = clover(1.1) else { panic!("a negative radius") };
    // 1 + 1.1 cos 3φ
    assert!(radius < 0.0 && (radius - 1.0 - 1.1 * libm::cos(3.0 * angle)).abs() < 1e-14);
    let rooted = |a| Polar::new(v(0.0, 0.0), Rooted(a), true).map(|_| ());
    assert_eq!(rooted(1.01), Ok(()));
    // on an arc of 16° about 0; half of a turn
    for (a, half) in [(0.99, 0.1415), (0.0, 1.571)] {
        let error = rooted(a).unwrap_err();
        let Error::PolarRadius { angle, radius, certain: true } = error else { panic!("{error}") };
        assert!(radius.is_nan() && angle < half, "{error}");
        assert!(error.to_string().contains("it has no real value"), "{error}");
    }
    // at φ = 0 the derivative is 0/0
    assert_eq!(rooted(1.0), Err(Error::PolarSlope { angle: 0.0 }));
}

#[test]
fn lines_cross_a_curve_of_a_thousand_waves_as_often_as_its_formula_changes_sign() {
    let (radius, amount, leaves) = (1.3, 0.3, 1000);
    let curve = Polar::new(v(0.0, 0.0), Clover { radius, amount, leaves }, true).unwrap();
    for k in 0..4 {
        let (angle, distance) = (0.1 + 1.7 * f64::from(k), 0.3 * f64::from(k));
        let (sin, cos) = libm::sincos(angle);
        let at = |s: f64| v(distance * cos - s * sin, distance * sin + s * cos);
        let line = Segment::new(at(-3.0), at(3.0)).unwrap();
        let found = meetings(&line, &curve).iter().filter(|m| m.kind == MeetingKind::Crossing).count();
        // the distance of its points from the line, 10 000 times a wave
        let steps = 10_000 * leaves;
        let beyond = |i: u32| {
            let t = core::f64::consts::TAU * f64::from(i) / f64::from(steps);
            radius * (1.0 + amount * libm::cos(f64::from(leaves) * t)) * libm::cos(t - angle) > distance
        };
        let (mut expected, mut last) = (0, beyond(0));
        for i in 1..=steps {
            let next = beyond(i);
            expected += usize::from(next != last);
            last = next;
        }
        assert!(k < 3 || expected > 200, "{expected}");
        assert_eq!(found, expected, "{k}");
    }
    assert_eq!(Table::new(vec![Box::new(curve)]).unwrap().validate(), Ok(()));
}

/// An ellipse with semi-axes 1 and `width`, as a radius for every direction.
#[derive(Clone, Debug)]
struct Flat {
    width: f64,
}

impl PolarFormula for Flat {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let (sin, cos) = libm::sincos(angle);
        let (w, gap) = (self.width, 1.0 - self.width * self.width);
        let square = sin * sin + w * w * cos * cos;
        let r = w / square.sqrt();
        let first = -gap * sin * cos / square;
        let second = -gap * (cos * cos - sin * sin) / square + 3.0 * first * first;
        [r, r * first, r * second]
    }
    fn jet_over(&self, angle: Interval) -> [Interval; 3] {
        let [sin, cos] = angle.sin_cos();
        let (w, gap) = (self.width, 1.0 - self.width * self.width);
        let square = sin.square() + cos.square() * (w * w);
        let r = Interval::from(w) / square.sqrt();
        let first = sin * cos * -gap / square;
        let second = (cos.square() + -sin.square()) * -gap / square + first.square() * 3.0;
        [r, r * first, r * second]
    }
}

#[test]
fn a_path_lands_on_a_flat_curve_where_it_crosses_it() {
    for width in [0.3, 0.1, 0.03, 0.01] {
        let center = v(0.3, 0.1);
        let curve = Polar::new(center, Flat { width }, false).unwrap();
        let truth = Ellipse::new(center, [1.0, width], 0.0, false).unwrap();
        let mut hits = 0;
        for k in 0..300 {
            let (u, angle) = (0.95 * libm::cos(f64::from(k)), 0.7 * f64::from(k));
            let heading = v(libm::cos(angle), libm::sin(angle));
            let path = Line { point: center + v(u, 0.0) - heading * 1.75, velocity: heading };
            let time = curve.crossing(&path).time();
            if heading.y.abs() < 0.3 || time.is_infinite() {
                continue;
            }
            hits += 1;
            let landing = curve.landing(&path, time);
            let off = (landing.point - path.at(time)).norm();
            // angles are rounded to an ulp, which takes the wall of the formula, and the time, by that times r′ = 1/width sideways
            let allowed = (16.0 + 0.5 / width) * f64::EPSILON;
            assert!(off <= allowed, "{width} {k}: {:e}", off / f64::EPSILON);
            let turned = landing.normal.perp(&truth.closest(&landing.point).normal);
            let allowed = allowed * (1.0 + truth.curvature(&landing.point).abs());
            assert!(turned.abs() <= allowed, "{width} {k}: {turned:e} {allowed:e}");
        }
        assert!(hits > 200, "{hits}");
    }
}

/// A conic in another box.
#[derive(Clone, Debug)]
struct Boxed(Conic, [f64; 2]);

impl ImplicitFormula for Boxed {
    fn value(&self, p: [f64; 2]) -> f64 {
        self.0.value(p)
    }
    fn gradient(&self, p: [f64; 2]) -> [f64; 2] {
        self.0.gradient(p)
    }
    fn hessian(&self, p: [f64; 2]) -> [f64; 3] {
        self.0.hessian(p)
    }
    fn hessian_over(&self, region: [Interval; 2]) -> [Interval; 3] {
        self.0.hessian_over(region)
    }
    fn extent(&self) -> Extent {
        let (c, room) = (Vector2::from(self.0.center), Vector2::from(self.1));
        Extent { min: c - room, max: c + room }
    }
}

#[test]
fn flat_curves_are_followed_around_their_tips() {
    for width in [0.3, 0.05, 0.03, 0.02, 0.01, 0.003, 1e-3] {
        for (axes, room) in [([1.0, width], [1.5, 0.5]), ([1.0, width], [1.1, 2.0 * width]), ([width, 1.0], [0.5, 1.5])]
        {
            let conic = Conic { center: [0.0, 0.0], semi_axes: axes };
            let curve = Implicit::new(Boxed(conic, room), true).unwrap_or_else(|e| panic!("{axes:?} {room:?}: {e}"));
            let ellipse = Ellipse::new(v(0.0, 0.0), axes, 0.0, true).unwrap();
            assert!((curve.length() - ellipse.length()).abs() < 1e-12, "{axes:?}: {}", curve.length());
            assert!((curve.area() / ellipse.area() - 1.0).abs() < 1e-12, "{axes:?}: {}", curve.area());
        }
    }
}

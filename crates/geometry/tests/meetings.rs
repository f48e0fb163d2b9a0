//! Where segments meet curves: as often, and where, as bisection tells.
mod formulas;
mod random;

use core::f64::consts::TAU;
use formulas::Clover;
use geometry::{
    Meeting, MeetingKind, Piece, Table, Vector2, meetings,
    shapes::{
        Ellipse, EllipticArc, Segment,
        curve::{ParametricCurve, Polar, PolarFormula, PolarPoints},
    },
};
use random::Random;

fn v(x: f64, y: f64) -> Vector2<f64> {
    Vector2::new(x, y)
}

/// Where a function changes sign on the way between two points; `None` where it is so near 0 that samples do not tell.
fn roots(f: impl Fn(Vector2<f64>) -> f64, [from, to]: [Vector2<f64>; 2]) -> Option<Vec<Vector2<f64>>> {
    const SAMPLES: u32 = 200;
    let at = |t: f64| from + (to - from) * t;
    let times: Vec<f64> = (0..=SAMPLES).map(|k| f64::from(k) / f64::from(SAMPLES)).collect();
    let values: Vec<f64> = times.iter().map(|&t| f(at(t))).collect();
    let step = (to - from).norm() / f64::from(SAMPLES);
    // between samples, a curve with a curvature below 100 deviates from straight by less than that
    let flat = 100.0 * step * step;
    let turns = |w: &[f64]| w[1].abs() < flat && w[1].abs() <= w[0].abs().min(w[2].abs()) && w[0] * w[2] > 0.0;
    let ends = [values[0], values[values.len() - 1]];
    if values.windows(3).any(turns) || ends.iter().any(|f| f.abs() < 1e-9) {
        return None;
    }
    let changes = times.windows(2).zip(values.windows(2)).filter(|(_, f)| f[0] * f[1] < 0.0);
    let roots = changes.map(|(t, values)| {
        let (mut low, mut high) = (t[0], t[1]);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if f(at(middle)) * values[0] > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        at(low)
    });
    Some(roots.collect())
}

/// A segment that begins within half its length of a point of a piece, before it or behind.
fn segment_near(piece: &dyn Piece, random: &mut Random) -> [Vector2<f64>; 2] {
    let (sin, cos) = libm::sincos(random.between(0.0, TAU));
    let length = 0.01 + random.unit() * random.unit() * random.unit();
    let along = v(cos, sin) * length;
    let from = piece.point_at(random.unit() * piece.length()) + along * random.between(-0.5, 0.5);
    [from, from + along]
}

fn check(name: &str, pieces: &[Box<dyn Piece>], f: impl Fn(Vector2<f64>) -> f64) {
    let (mut told, mut short) = (0, 0);
    for seed in 0..4000 {
        let mut random = Random(seed);
        let ends = segment_near(&*pieces[random.below(pieces.len())], &mut random);
        let Some(expected) = roots(&f, ends) else { continue };
        told += 1;
        short += usize::from(expected.is_empty());
        let segment = Segment::new(ends[0], ends[1]).unwrap();
        let mut found: Vec<Meeting> = pieces.iter().flat_map(|piece| meetings(&segment, &**piece)).collect();
        found.sort_by(|m, n| m.at[0].total_cmp(&n.at[0]));
        assert_eq!(found.len(), expected.len(), "{name} {seed}: {found:?} {expected:?}");
        for (meeting, root) in found.iter().zip(&expected) {
            assert_eq!(meeting.kind, MeetingKind::Crossing, "{name} {seed}");
            let nearest = pieces.iter().map(|piece| piece.closest(root));
            let nearest = nearest.min_by(|a, b| (a.point - root).norm().total_cmp(&(b.point - root).norm())).unwrap();
            let sine = nearest.normal.dot(&(ends[1] - ends[0]).normalize()).abs();
            // the error of points of curves, 64 ulp of the greatest coordinate, divided by the angle
            let off = (meeting.point - root).norm() * sine;
            assert!(off < 64.0 * f64::EPSILON * 2.0, "{name} {seed}: {off:e}");
        }
    }
    assert!(told > 3000 && short > 1000, "{name}: {told} {short}");
}

#[test]
fn segments_meet_an_ellipse_where_its_equation_changes_sign() {
    for semi_axes in [[2.0, 0.2], [2.0, 0.7], [2.0, 1.0], [2.0, 1.9]] {
        let ellipse = Ellipse::new(v(0.0, 0.0), semi_axes, 0.0, true).unwrap();
        let [a, b] = semi_axes;
        check("ellipse", &[Box::new(ellipse)], |p| libm::hypot(p.x / a, p.y / b) - 1.0);
        let half = |from: f64, to: f64| EllipticArc::new(ellipse, v(from, 0.0), v(to, 0.0)).unwrap();
        let halves: [Box<dyn Piece>; 2] = [Box::new(half(a, -a)), Box::new(half(-a, a))];
        check("elliptic arcs", &halves, |p| libm::hypot(p.x / a, p.y / b) - 1.0);
    }
}

#[test]
fn segments_meet_a_curve_given_by_a_formula_where_its_equation_changes_sign() {
    for (amount, leaves) in [(0.1, 3), (0.2, 5), (0.05, 20)] {
        let clover = Clover { radius: 1.0, amount, leaves };
        let outside = |p: Vector2<f64>| libm::hypot(p.x, p.y) - clover.jet(libm::atan2(p.y, p.x))[0];
        let polar = Polar::new(v(0.0, 0.0), clover, true).unwrap();
        check("polar", &[Box::new(polar)], outside);
        let points = PolarPoints { center: v(0.0, 0.0), formula: clover };
        let curves = ParametricCurve::around(points, [0.0, TAU], true).unwrap();
        let pieces: Vec<_> = curves.into_iter().map(|curve| Box::new(curve) as Box<dyn Piece>).collect();
        check("parametric", &pieces, outside);
    }
}

/// The sides of a triangle, clockwise.
fn triangle(corners: [Vector2<f64>; 3]) -> [Box<dyn Piece>; 3] {
    let [a, b, c] = corners;
    let [b, c] = if (b - a).perp(&(c - a)) < 0.0 { [b, c] } else { [c, b] };
    [[a, b], [b, c], [c, a]].map(|[p, q]| Box::new(Segment::new(p, q).unwrap()) as Box<dyn Piece>)
}

#[test]
fn a_triangle_with_its_corners_in_an_ellipse_does_not_cross_it() {
    let walls = |semi_axes| -> Box<dyn Piece> { Box::new(Ellipse::new(v(0.0, 0.0), semi_axes, 0.0, true).unwrap()) };
    let inside = |semi_axes: [f64; 2], corners: [Vector2<f64>; 3]| {
        let table = Table::new(core::iter::once(walls(semi_axes)).chain(triangle(corners)).collect()).unwrap();
        assert_eq!(table.validate(), Ok(()), "{semi_axes:?} {corners:?}");
    };
    inside([2.0, 1.0], [v(0.33, 0.94), v(0.39, 0.97), v(0.41, 0.92)]);
    inside([2.0, 1.0], [v(-0.9, -0.86), v(-0.94, -0.86), v(-0.92, -0.79)]);
    let (mut seed, mut tried) = (0, 0);
    while tried < 3000 {
        seed += 1;
        let mut random = Random(seed);
        let semi_axes = [2.0, random.between(0.1, 1.9)];
        let [a, b] = semi_axes;
        let near = v(random.between(-a, a), random.between(-b, b));
        let size = 0.2 * random.unit() * random.unit();
        let corners = [0; 3].map(|_| near + v(random.between(-size, size), random.between(-size, size)));
        let [p, q, r] = corners;
        let wide = (q - p).perp(&(r - p)).abs() > 1e-3 * size * size;
        if wide && corners.iter().all(|p| libm::hypot(p.x / a, p.y / b) < 1.0 - 1e-6) {
            tried += 1;
            inside(semi_axes, corners);
        }
    }
}

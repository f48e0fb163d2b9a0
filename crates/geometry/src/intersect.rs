//! Where two pieces of boundary meet.
//!
//! Segments, rays, lines, arcs and circles are intersected in closed form; where an end of one piece lies on the other, that end is taken
//! as the meeting exactly, and the second point of a pair follows by reflection instead of a square root. All other curves are intersected
//! by subdivision, which cannot lose a transversal crossing, and Newton's method.
mod exact;
mod self_crossing;
mod subdivision;

use crate::{Piece, shapes::Segment};
use exact::Curve;
use nalgebra::Vector2;
pub(crate) use self_crossing::self_crossing;

/// How two pieces meet at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeetingKind {
    /// They pass through one another.
    Crossing,
    /// They touch, both of them continuing beyond the point, and do not pass through one another by more than rounding.
    Tangency,
    /// An end of one lies on the other: a shared vertex, or a junction.
    End,
    /// A stretch that both have in common begins or ends here.
    Overlap,
}

/// A point that two pieces have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meeting {
    /// Where \[L\].
    pub point: Vector2<f64>,
    /// Its arc length on the first and on the second piece \[L\].
    pub at: [f64; 2],
    /// How they meet there.
    pub kind: MeetingKind,
}

/// The points that two pieces have in common, in the order of the first piece.
///
/// Points closer together than rounding of the coordinates (16 ulp of the greatest) are one point. A stretch in common
/// appears as its two ends. The position of a tangency of curves without a closed form is known only to the square root of rounding, since
/// the curves run together over about that length. A piece has no meetings with itself here; see
/// [`Table::validate`](crate::Table::validate).
///
/// ```
/// use geometry::{MeetingKind, Vector2, meetings, shapes::{Circle, FullLine}};
/// let circle = Circle::new(Vector2::new(0.0, 0.0), 1.0, true)?;
/// let line = FullLine::new(Vector2::new(0.0, 0.6), Vector2::new(1.0, 0.0))?;
/// let points = meetings(&line, &circle);
/// assert_eq!(points.iter().map(|m| m.at[0]).collect::<Vec<_>>(), [-0.8, 0.8]);
/// assert!(points.iter().all(|m| m.kind == MeetingKind::Crossing));
/// # Ok::<(), geometry::Error>(())
/// ```
pub fn meetings(a: &dyn Piece, b: &dyn Piece) -> Vec<Meeting> {
    // a wall without thickness is met as one of its faces; a meeting at one of its tips is a touch, for nothing passes through there
    let tips = [a, b].map(Piece::tips);
    if tips.iter().any(Option::is_some) {
        let faces = tips.map(|t| t.and_then(|[p, q]| Segment::new(p, q).ok()));
        let [c, d] = [(a, &faces[0]), (b, &faces[1])].map(|(p, face)| face.as_ref().map_or(p, |f| f as &dyn Piece));
        let mut found = meetings(c, d);
        for m in found.iter_mut().filter(|m| m.kind == MeetingKind::End) {
            if tips.iter().flatten().flatten().any(|tip| *tip == m.point) {
                m.kind = MeetingKind::Tangency;
            }
        }
        return found;
    }
    let mut found = match (Curve::of(&a.figure()), Curve::of(&b.figure())) {
        (Some(c), Some(d)) => exact::meetings(&c, &d),
        _ => subdivision::meetings(a, b),
    };
    found.sort_by(|m, n| m.at[0].total_cmp(&n.at[0]));
    found
}

/// Unit direction of traversal at a point of the piece.
pub(crate) fn direction_at(piece: &dyn Piece, point: &Vector2<f64>) -> Vector2<f64> {
    along(&piece.closest(point).normal)
}

/// The direction in which a piece with this inward normal is traversed.
pub(crate) fn along(normal: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(normal.y, -normal.x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{Arc, Bump, Circle, Ellipse, Ray, Segment};

    fn v(x: f64, y: f64) -> Vector2<f64> {
        Vector2::new(x, y)
    }
    fn segment(a: [f64; 2], b: [f64; 2]) -> Segment {
        Segment::new(a.into(), b.into()).unwrap()
    }
    fn kinds(a: &dyn Piece, b: &dyn Piece) -> Vec<MeetingKind> {
        let found = meetings(a, b);
        // the other order finds the same
        let mut swapped = meetings(b, a);
        swapped.sort_by(|m, n| m.at[1].total_cmp(&n.at[1]));
        assert_eq!(swapped.len(), found.len());
        for (m, n) in found.iter().zip(&swapped) {
            assert_eq!(m.kind, n.kind);
            // the position of a tangency found by subdivision is known to the square root of rounding
            let close = if m.kind == Tangency { 1e-6 } else { 1e-14 };
            assert!((m.point - n.point).norm() < close, "{m:?} {n:?}");
        }
        found.iter().map(|m| m.kind).collect()
    }
    use MeetingKind::{Crossing, End, Overlap, Tangency};

    #[test]
    fn segments_cross_touch_and_overlap() {
        let base = segment([0.0, 0.0], [2.0, 0.0]);
        assert_eq!(kinds(&base, &segment([1.0, -1.0], [1.5, 1.0])), [Crossing]);
        assert_eq!(kinds(&base, &segment([2.0, 0.0], [3.0, 1.0])), [End]);
        assert_eq!(kinds(&base, &segment([1.0, 0.0], [1.0, 1.0])), [End]);
        assert_eq!(kinds(&base, &segment([1.0, 0.1], [1.0, 1.0])), []);
        assert_eq!(kinds(&base, &segment([3.0, 0.0], [1.0, 0.0])), [Overlap, Overlap]);
        assert_eq!(kinds(&base, &segment([2.0, 0.0], [3.0, 0.0])), [End]);
        assert_eq!(kinds(&base, &segment([0.0, 1.0], [2.0, 1.0])), []);
    }

    #[test]
    fn infinite_walls_meet_like_others() {
        let ray = Ray::new(v(0.0, 0.0), v(1.0, 1.0), true).unwrap();
        let back = Ray::new(v(0.0, 0.0), v(1.0, 1.0), false).unwrap();
        assert_eq!(kinds(&ray, &segment([1.0, 0.0], [1.0, 2.0])), [Crossing]);
        assert_eq!(kinds(&ray, &segment([-1.0, 0.0], [-1.0, -2.0])), []);
        assert_eq!(kinds(&ray, &Ray::new(v(0.0, 0.0), v(-1.0, 1.0), false).unwrap()), [End]);
        assert_eq!(kinds(&ray, &back), [Overlap, Overlap]);
        assert!((meetings(&back, &segment([1.0, 0.0], [1.0, 2.0]))[0].at[0] + 2.0_f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn a_smooth_joint_is_one_point() {
        // a stadium's side and cap at odd places, where rounding splits a double root
        for k in 1..200 {
            let (angle, far) = (f64::from(k), f64::from(k * k));
            let u = v(libm::cos(angle), libm::sin(angle));
            let center = v(far, -0.3 * far);
            let across = v(u.y, -u.x);
            let (a, b) = (center + across, center - across);
            let cap = Arc::new(center, a, b, true).unwrap();
            let side = Segment::new(a - u * 3.0, a).unwrap();
            assert_eq!(kinds(&side, &cap), [End], "{k}");
            assert_eq!(meetings(&side, &cap)[0].point, a);
        }
    }

    #[test]
    fn circles_cross_touch_and_coincide() {
        let unit = Circle::new(v(0.0, 0.0), 1.0, true).unwrap();
        let at = |x: f64, r: f64| Circle::new(v(x, 0.0), r, false).unwrap();
        assert_eq!(kinds(&unit, &at(1.0, 1.0)), [Crossing, Crossing]);
        assert_eq!(kinds(&unit, &at(2.0, 1.0)), [Tangency]);
        assert_eq!(kinds(&unit, &at(0.5, 0.5)), [Tangency]);
        assert_eq!(kinds(&unit, &at(0.25, 0.5)), []);
        assert_eq!(kinds(&unit, &at(2.0, 0.5)), []);
        assert_eq!(kinds(&unit, &at(0.0, 1.0)), [Overlap, Overlap]);
    }

    #[test]
    fn near_tangent_circles_meet_where_they_should() {
        // overlap depth 2⁻³⁰: the points are ±√(depth) apart; cancellation in r² − a² would leave 1e-8
        let depth = 1.0 / f64::from(1 << 30);
        let a = Circle::new(v(0.0, 0.0), 1.0, true).unwrap();
        let b = Circle::new(v(2.0 - depth, 0.0), 1.0, false).unwrap();
        for m in meetings(&a, &b) {
            let y = (depth - 0.25 * depth * depth).sqrt();
            assert!((m.point.y.abs() - y).abs() < 1e-16 + 4.0 * f64::EPSILON * y, "{m:?}");
        }
        assert_eq!(kinds(&a, &b), [Crossing, Crossing]);
    }

    /// An arc of the given radius that bends a little to the left of the way between two points.
    fn flat(a: Vector2<f64>, b: Vector2<f64>, radius: f64) -> Arc {
        let chord = b - a;
        let height = (radius * radius - 0.25 * chord.norm_squared()).sqrt();
        let center = (a + b) * 0.5 + v(-chord.y, chord.x) * (height / chord.norm());
        Arc::with_radius(center, radius, a, b, true).unwrap()
    }

    #[test]
    fn a_flat_arc_meets_a_wall_on_the_wall() {
        for k in 0..400 {
            let t = f64::from(k);
            let radius = libm::exp2(8.0 + 0.03 * t);
            let arc = flat(v(-1.0, 0.1 * libm::sin(t)), v(1.0, 0.1 * libm::cos(2.0 * t)), radius);
            let (sin, cos) = libm::sincos(1.0 + 0.002 * t);
            let along = v(cos, sin);
            let wall = Segment::new(v(0.3, 0.1) - along, v(0.3, 0.1) + along).unwrap();
            let found = meetings(&wall, &arc);
            let [Meeting { point, kind: Crossing, .. }] = found[..] else { panic!("{radius}: {found:?}") };
            // whereas along the wall it is known only as well as the arc is
            let off = (point - v(0.3, 0.1)).dot(&wall.closest(&point).normal);
            assert!(off.abs() < 3e-16, "{radius}: {off:e}");
        }
    }

    #[test]
    fn a_curve_shares_a_vertex_with_a_flat_arc_and_does_not_cross_it_there() {
        for k in 0..200 {
            let t = f64::from(k);
            let (sin, cos) = libm::sincos(t);
            let vertex = v(0.6, -0.3);
            let arc = flat(v(-0.4, 0.2), vertex, libm::exp2(4.0 + 0.08 * t));
            let bump = Bump::new(vertex, vertex + v(cos, sin), 0.2).unwrap();
            let found = meetings(&arc, &bump);
            let at_vertex: Vec<_> = found.iter().filter(|m| (m.point - vertex).norm() < 1e-6).map(|m| m.kind).collect();
            assert_eq!(at_vertex, [End], "{k}: {found:?}");
        }
    }

    #[test]
    fn arcs_of_one_circle_share_ends_or_stretches() {
        let arc = |a: [f64; 2], b: [f64; 2]| Arc::new(v(0.0, 0.0), a.into(), b.into(), true).unwrap();
        let (east, north, west) = ([1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]);
        assert_eq!(kinds(&arc(east, north), &arc(north, west)), [End]);
        assert_eq!(kinds(&arc(east, north), &arc(north, east)), [End, End]);
        assert_eq!(kinds(&arc(east, west), &arc([0.6, 0.8], [-1.0, 0.0])), [Overlap, Overlap]);
    }

    #[test]
    fn subdivision_agrees_with_the_closed_form() {
        // an ellipse with equal axes is a circle, but is not known as one
        for k in 0..60 {
            let t = f64::from(k);
            let center = v(0.7 * libm::sin(t), 1.1 * libm::cos(2.0 * t));
            let round = Ellipse::new(center, [0.8, 0.8], 0.3, true).unwrap();
            let circle = Circle::new(center, 0.8, true).unwrap();
            let others: [Box<dyn Piece>; 3] = [
                Box::new(Circle::new(v(0.0, 0.0), 0.9, true).unwrap()),
                Box::new(segment([-2.0, 0.1 * t - 3.0], [1.0, 0.9])),
                Box::new(Ray::new(v(0.2, 0.1), v(1.0, t - 30.0), true).unwrap()),
            ];
            for other in &others {
                let (exact, numeric) = (meetings(&**other, &circle), meetings(&**other, &round));
                assert_eq!(exact.len(), numeric.len(), "{k} {other:?} {exact:?} {numeric:?}");
                for (m, n) in exact.iter().zip(&numeric) {
                    assert!((m.point - n.point).norm() < 1e-13, "{m:?} {n:?}");
                }
            }
        }
    }

    #[test]
    fn two_ellipses_meet_four_times() {
        let a = Ellipse::new(v(0.0, 0.0), [2.0, 1.0], 0.0, true).unwrap();
        let b = Ellipse::new(v(0.0, 0.0), [1.0, 2.0], 0.0, true).unwrap();
        let found = meetings(&a, &b);
        assert_eq!(found.len(), 4);
        let x = 0.8_f64.sqrt(); // x²/4 + x² = 1
        assert!(found.iter().all(|m| (m.point.map(f64::abs) - v(x, x)).norm() < 1e-14));
        let touching = Ellipse::new(v(3.0, 0.0), [1.0, 2.0], 0.0, true).unwrap();
        assert_eq!(kinds(&a, &touching), [Tangency]);
    }

    #[test]
    fn curves_that_cross_at_a_tiny_angle_meet_there() {
        // an ellipse and a copy turned about one of its points: with equal curvature there they separate by the angle alone
        for k in 0..600 {
            let t = 0.01 * f64::from(k);
            let [x, y] = [5.0 * libm::sin(t), 3.0 * libm::cos(0.7 * t)];
            let ellipse = Ellipse::new(v(x, y), [1.0, 0.75], t, true).unwrap();
            let pivot = ellipse.point_at(ellipse.length() * (0.5 + 0.5 * libm::sin(3.1 * t)));
            let angle = libm::exp2(-17.0 + 2.0 * t);
            let (sin, cos) = libm::sincos(angle);
            let away = v(x, y) - pivot;
            let center = pivot + v(cos * away.x - sin * away.y, sin * away.x + cos * away.y);
            let turned = Ellipse::new(center, [1.0, 0.75], t + angle, true).unwrap();
            let found = meetings(&ellipse, &turned);
            // the error of points of curves, 64 ulp of the greatest coordinate, divided by the angle
            let near = |m: &Meeting| (m.point - pivot).norm() < 64.0 * f64::EPSILON * 6.0 / angle;
            assert!(found.iter().any(near), "{k}, angle {angle:e}: {found:?}");
        }
    }

    #[test]
    fn meetings_scale_with_the_pieces() {
        let scaled = |k: f64| {
            let a = Arc::new(v(0.1, 0.2) * k, v(1.1, 0.2) * k, v(0.1, 1.2) * k, true).unwrap();
            let b = segment([0.2 * k, 0.1 * k], [1.3 * k, 1.4 * k]);
            let c = Circle::new(v(0.7, 0.9) * k, 0.45 * k, true).unwrap();
            let mut all = meetings(&a, &b);
            all.extend(meetings(&a, &c));
            all
        };
        let small = libm::ldexp(1.0, -200);
        let (one, tiny) = (scaled(1.0), scaled(small));
        assert!(!one.is_empty() && one.len() == tiny.len());
        for (m, n) in one.iter().zip(&tiny) {
            assert_eq!(m.point * small, n.point);
        }
    }
}

//! A whole circle, with the table inside or outside.
use crate::{
    Error,
    afar::{NEWTON, on_circle},
    chord::is_chord,
    crossing::{Candidate, Crossing},
    path::Line,
    piece::{Extent, Landing, Piece},
    plane::{along, cross, finite, from, moved, slack},
    shapes::{Ground, Shape},
};
use core::f64::consts::PI;
use lanes::{Lane, Mask, dot};
use nalgebra::Vector2;

/// A circle of radius `r` about `c`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle {
    pub(crate) center: [f64; 2],
    pub(crate) radius: f64,
    pub(crate) inside: bool,
    /// `r²` and `1/(2 r²)`
    square: f64,
    half: f64,
    /// `±1/r`: from `p − c` to the inward normal.
    to_normal: f64,
    pub(crate) slack: f64,
    /// The rounding of `|x − c|² − r²`. For one side of a two-sided wall, minus the margin by which a start must lie inside.
    off: f64,
}

/// The roots of `|x + v t − c|² = r²`, and the quantities that tell them apart.
pub(crate) struct Roots<F: Lane> {
    /// `(x − c)·v`: negative while the path comes closer to the centre.
    pub(crate) b: F,
    /// `|x − c|² − r²`
    pub(crate) c: F,
    /// `|v|²`
    pub(crate) a: F,
    /// `b² − a c`
    pub(crate) discriminant: F,
    /// Its square root, 0 where the path misses the circle.
    pub(crate) root: F,
    /// Whether the path's line meets the circle in two points.
    pub(crate) meets: F::Mask,
}

impl Circle {
    /// The circle with the table inside (`inside`) or outside.
    ///
    /// # Errors
    /// [`Error::Radius`] unless the radius is positive and finite, [`Error::Parameter`] for a centre that is not finite.
    pub fn new(center: Vector2<f64>, radius: f64, inside: bool) -> Result<Circle, Error> {
        finite("center", &center)?;
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(Error::Radius { radius });
        }
        let square = radius * radius;
        let to_normal = if inside { -1.0 / radius } else { 1.0 / radius };
        let circle = Circle {
            center: center.into(),
            radius,
            inside,
            square,
            half: 0.5 * (to_normal * to_normal),
            to_normal,
            slack: 0.0,
            off: 0.0,
        };
        Ok(circle.with_slack(slack([center.x, center.y, radius])))
    }

    /// The quadratic of the meeting times.
    #[inline(always)]
    pub(crate) fn roots<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> Roots<F> {
        let [y0, y1] = from(x, self.center);
        let y = [-y0, -y1];
        let (a, b) = (dot(&v, &v), dot(&y, &v));
        let c = dot(&y, &y) - self.square;
        // b² − a c = |v|² r² − (y × v)², in which the distance of a far start does not cancel
        let moment = cross(y, v);
        let discriminant = a * self.square - moment * moment;
        let zero = a.same(0.0);
        Roots { a, b, c, discriminant, root: discriminant.max(zero).sqrt(), meets: zero.lt(discriminant) }
    }

    /// The outward crossing among the roots, wherever on the circle it lies. The arc in question is certainly crossed where the path
    /// passes `between` its ends; where the arc goes `around`, it is crossed if the path meets the circle in two points, or starts
    /// inside along its edge. A path that starts outside a disk can leave it only after entering it.
    #[inline(always)]
    pub(crate) fn outward<F: Lane>(&self, roots: &Roots<F>, between: F::Mask, around: F::Mask) -> Candidate<F> {
        let Roots { a, b, c, discriminant, root, meets } = *roots;
        let zero = a.same(0.0);
        let q = b.abs() + root;
        let off = zero.same(self.off);
        if self.inside {
            // leaving the disk: the later root, in the form without cancellation, except where `b` and the square root are so small
            // that rounding spoils `c` as a product of the roots; a tangent start crosses at once
            let (coming, starts) = (!zero.lt(b), c.lt(off));
            let really = (between | (around & (meets | starts))) & (coming | starts);
            let as_sum = coming | discriminant.lt(-(a * c));
            Candidate { really, num: as_sum.select(root - b, -c), den: as_sum.select(a, q) }
        } else {
            // entering the disk: the earlier root
            let really = (between | (around & meets)) & b.lt(zero) & (-off).lt(c);
            Candidate { really, num: c, den: q }
        }
    }

    /// When the path from `x` with velocity `v` crosses outwards; see [`Piece::crossing`].
    #[inline(always)]
    pub fn cross<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> Crossing<F> {
        self.meet(x, v).into()
    }

    /// The same, before anything is selected.
    #[inline(always)]
    pub(crate) fn meet<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> Candidate<F> {
        let mut roots = self.roots(x, v);
        if self.inside {
            let Roots { a, b, c, root, .. } = roots;
            roots.root = is_chord([a, b, c], self.square).select(-b, root);
        }
        let never = x[0].never();
        self.outward(&roots, never, !never)
    }

    /// The landing point and the normal; see [`Piece::landing`].
    #[inline(always)]
    pub fn land<F: Lane>(&self, x: [F; 2], v: [F; 2], time: F) -> ([F; 2], [F; 2]) {
        self.land_where(!time.never(), x, v, time)
    }

    /// The same for the lanes whose paths land `here`; other lanes, which may be nowhere near, cause no extra work.
    #[inline(always)]
    pub(crate) fn land_where<F: Lane>(&self, here: F::Mask, x: [F; 2], v: [F; 2], time: F) -> ([F; 2], [F; 2]) {
        let p = along(x, v, time);
        let y = [p[0] - self.center[0], p[1] - self.center[1]];
        // one Newton step towards |y| = r. The deficit of |y|² is not computed from a sum near r², since round-to-even would favour
        // one side: along an ellipse that bias adds up
        let change = ((y[0].same(self.square) - y[0] * y[0]) - y[1] * y[1]) * self.half;
        let z = [y[0] + y[0] * change, y[1] + y[1] * change];
        let (point, normal) =
            ([z[0] + self.center[0], z[1] + self.center[1]], [z[0] * self.to_normal, z[1] * self.to_normal]);
        let afar = here & change.same(NEWTON).lt(change.abs());
        if !afar.any() {
            return (point, normal);
        }
        let (p, n) = on_circle(
            &y,
            &v,
            self.center.map(|c| change.same(c)),
            [self.to_normal, self.square].map(|k| change.same(k)),
        );
        ([0, 1].map(|i| afar.select(p[i], point[i])), [0, 1].map(|i| afar.select(n[i], normal[i])))
    }

    pub(crate) fn translated(self, by: [f64; 2]) -> Circle {
        let center = moved(self.center, by);
        Circle { center, ..self }.with_slack(slack([center[0], center[1], self.radius]))
    }
    /// The same with another rounding of coordinates.
    pub(crate) fn with_slack(self, slack: f64) -> Circle {
        let moved = Circle { slack, off: 2.0 * self.radius * slack, ..self };
        if self.is_two_sided() { moved.two_sided() } else { moved }
    }
    /// The same as one side of a wall with the table on both sides: a start on it, within rounding, may be on either side.
    pub(crate) fn two_sided(self) -> Circle {
        Circle { off: -0.5 * self.off.abs(), ..self }
    }
    /// The same as a wall with the table on one side only.
    pub(crate) fn one_sided(self) -> Circle {
        Circle { off: self.off.abs(), ..self }.with_slack(self.slack)
    }
    pub(crate) fn is_two_sided(&self) -> bool {
        self.off < 0.0
    }
    pub(crate) fn ground(&self) -> Ground {
        Ground::Round { center: self.center, to_normal: self.to_normal, square: self.square }
    }

    /// Polar angle of a point as seen from the centre, in (−π, π].
    pub(crate) fn angle(&self, point: &Vector2<f64>) -> f64 {
        libm::atan2(point.y - self.center[1], point.x - self.center[0])
    }
    pub(crate) fn at_angle(&self, angle: f64) -> Vector2<f64> {
        Vector2::from(self.center) + Vector2::new(libm::cos(angle), libm::sin(angle)) * self.radius
    }
    /// +1 where the table lies inside, and the circle is traversed counter-clockwise; −1 outside.
    pub(crate) fn turn(&self) -> f64 {
        if self.inside { 1.0 } else { -1.0 }
    }
    pub(crate) fn normal_at(&self, point: &Vector2<f64>) -> Vector2<f64> {
        (point - Vector2::from(self.center)) * self.to_normal
    }
    /// The point of the circle closest to `point`; for the centre itself, the one at angle 0.
    pub(crate) fn project(&self, point: &Vector2<f64>) -> Vector2<f64> {
        let y = point - Vector2::from(self.center);
        let d = libm::hypot(y.x, y.y);
        if d > 0.0 { Vector2::from(self.center) + y * (self.radius / d) } else { self.at_angle(0.0) }
    }
}

impl Piece for Circle {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        self.cross(path.point.into(), path.velocity.into())
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        let (point, normal) = self.land(path.point.into(), path.velocity.into(), time);
        Landing { point: point.into(), normal: normal.into() }
    }
    fn curvature(&self, _: &Vector2<f64>) -> f64 {
        self.turn() / self.radius
    }
    fn length(&self) -> f64 {
        2.0 * PI * self.radius
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        self.at_angle(self.turn() * s / self.radius)
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        let angle = self.turn() * self.angle(point);
        (if angle < 0.0 { angle + 2.0 * PI } else { angle }) * self.radius
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        let p = self.project(point);
        Landing { point: p, normal: self.normal_at(&p) }
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        None
    }
    fn extent(&self) -> Extent {
        let (c, r) = (Vector2::from(self.center), Vector2::repeat(self.radius));
        Extent { min: c - r, max: c + r }
    }
    fn area(&self) -> f64 {
        self.turn() * PI * self.radius * self.radius
    }
    fn shape(&self) -> Option<Shape> {
        Some(Shape::Circle(*self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(x: f64, y: f64, vx: f64, vy: f64) -> Line<2> {
        Line { point: Vector2::new(x, y), velocity: Vector2::new(vx, vy) }
    }

    #[test]
    fn chords_of_the_unit_circle_end_on_it() {
        let circle = Circle::new(Vector2::zeros(), 1.0, true).unwrap();
        let p = path(1.0, 0.0, -0.6, 0.8);
        let t = circle.crossing(&p).time();
        assert!((t - 1.2).abs() < 4.0 * f64::EPSILON); // −2 x·v / |v|²
        let at = circle.landing(&p, t);
        assert!((at.point.norm() - 1.0).abs() < 2.0 * f64::EPSILON);
        assert!((at.normal + at.point).norm() == 0.0);
    }

    #[test]
    fn a_path_from_outside_leaves_a_disk_only_where_it_has_entered_it() {
        let room = Circle::new(Vector2::new(3.0, 0.0), 1.0, true).unwrap();
        assert_eq!(room.crossing(&path(0.0, -0.5, 0.1, 1.0)).num, f64::INFINITY); // comes closer, and passes it
        assert_eq!(room.crossing(&path(0.0, 0.0, -1.0, 0.0)).num, f64::INFINITY);
        assert_eq!(room.crossing(&path(0.0, 0.0, 1.0, 0.0)).time(), 4.0);
    }

    #[test]
    fn a_tangent_start_on_the_inside_crosses_at_once() {
        let circle = Circle::new(Vector2::zeros(), 1.0, true).unwrap();
        assert_eq!(circle.crossing(&path(1.0, 0.0, 0.0, 1.0)).time(), 0.0);
    }

    #[test]
    fn a_scatterer_is_met_from_outside_only() {
        let disk = Circle::new(Vector2::new(2.0, 0.0), 1.0, false).unwrap();
        assert_eq!(disk.crossing(&path(0.0, 0.0, 1.0, 0.0)).time(), 1.0);
        assert_eq!(disk.crossing(&path(1.0, 0.0, -1.0, 0.0)).num, f64::INFINITY);
        assert_eq!(disk.crossing(&path(0.0, 1.5, 1.0, 0.0)).num, f64::INFINITY);
        assert_eq!(disk.crossing(&path(4.0, 0.0, 1.0, 0.0)).num, f64::INFINITY);
    }
}

//! An arc of a circle between two vertices.
use crate::{
    Error,
    crossing::{Candidate, Crossing},
    path::Line,
    piece::{Extent, Landing, Piece},
    plane::{cross, direction, finite, from, moved, slack},
    shapes::{Circle, Shape},
};
use core::f64::consts::{FRAC_PI_2, PI};
use lanes::{Lane, dot};
use nalgebra::Vector2;

/// The arc from `a` to `b`: counter-clockwise with the table inside the circle, or clockwise with the table outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    circle: Circle,
    a: [f64; 2],
    b: [f64; 2],
    /// Polar angle of `a`, and the positive angle from there to `b` in the sense of traversal.
    start: f64,
    sweep: f64,
    bulge: Bulge,
}

/// Decides whether an arc whose ends are both on one side of a path reaches over to the other side.
///
/// Where a line meets the circle and both ends lie on its left, all of the circle on its right belongs to one of the two arcs, including
/// the point farthest right, `c + r n`. That point is on the arc from `a` to `b`, which lies on the right of its chord, if
/// `r v·(b−a) > |v| (b−a)×(c−a)`: a condition on directions only, so rounding cannot open a gap at a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bulge {
    /// From `a` to `b`, times the sense of traversal.
    chord: [f64; 2],
    /// The square of `(b−a)×(c−a) / r`, with its sign, times the sense of traversal.
    square: f64,
}

impl Bulge {
    /// For the arc from `a` to `b` on a circle; `turn` is the sense of traversal, +1 for counter-clockwise.
    pub(crate) fn new(center: [f64; 2], radius: f64, a: [f64; 2], b: [f64; 2], turn: f64) -> Bulge {
        let chord = [0, 1].map(|i| turn * (b[i] - a[i]));
        let height = cross(chord, [center[0] - a[0], center[1] - a[1]]) / radius;
        Bulge { chord, square: height * height.abs() }
    }

    /// Whether the arc meets a path along `v` that meets the circle with both ends on its left, or both on its right.
    #[inline(always)]
    pub(crate) fn meets<F: Lane>(&self, v: [F; 2], a_left: F::Mask, b_left: F::Mask) -> F::Mask {
        let forward = v[0] * self.chord[0] + v[1] * self.chord[1];
        let (forward, least) = (forward * forward.abs(), dot(&v, &v) * self.square);
        (a_left & b_left & least.lt(forward)) | (!a_left & !b_left & forward.lt(-least))
    }
}

impl Arc {
    /// The arc from `a` to `b` about `center`; focusing (`inside`, counter-clockwise) or dispersing (clockwise).
    ///
    /// The vertices are kept as they are, since neighbours share them; the radius is their mean distance from the
    /// centre. Where their distances differ by more than rounding, the centre is moved to make them equal, so that the circle passes
    /// through the vertices.
    ///
    /// # Errors
    /// [`Error::ZeroLength`] if `a = b` (use [`Circle`]), [`Error::Radius`] for a vertex at the centre, [`Error::Parameter`] for a point
    /// that is not finite, and
    /// [`Error::OffCircle`] if the distances differ by more than 10⁻⁹ of the radius, or the centre would have to move by more than
    /// 10⁻⁶ of it: such data are taken for a mistake.
    pub fn new(center: Vector2<f64>, a: Vector2<f64>, b: Vector2<f64>, inside: bool) -> Result<Arc, Error> {
        finite("center", &center)?;
        finite("from", &a)?;
        finite("to", &b)?;
        let (ra, rb) = (libm::hypot(a.x - center.x, a.y - center.y), libm::hypot(b.x - center.x, b.y - center.y));
        let radius = 0.5 * (ra + rb);
        if (ra - rb).abs() > 1e-9 * radius + slack([center.x, center.y]) {
            return Err(Error::OffCircle { start: ra, end: rb });
        }
        if (ra - rb).abs() <= slack([center.x, center.y, radius]) || a == b {
            return Arc::with_radius(center, radius, a, b, inside);
        }
        let (chord, _) = direction(a.into(), b.into()).ok_or(Error::ZeroLength)?;
        let chord = Vector2::from(chord);
        let off = chord * (center - 0.5 * (a + b)).dot(&chord);
        if !(off.amax() <= 1e-6 * radius) {
            return Err(Error::OffCircle { start: ra, end: rb });
        }
        let center = center - off;
        Arc::with_radius(center, libm::hypot(a.x - center.x, a.y - center.y), a, b, inside)
    }

    /// The same with the radius given, for vertices that were computed from it.
    ///
    /// # Errors
    /// As [`Arc::new`], but [`Error::OffRadius`] for a vertex whose distance from the centre differs from the radius by more than 10⁻⁹ of
    /// it.
    pub fn with_radius(
        center: Vector2<f64>,
        radius: f64,
        a: Vector2<f64>,
        b: Vector2<f64>,
        inside: bool,
    ) -> Result<Arc, Error> {
        if a == b {
            return Err(Error::ZeroLength);
        }
        let circle = Circle::new(center, radius, inside)?;
        for vertex in [a, b] {
            let distance = libm::hypot(vertex.x - center.x, vertex.y - center.y);
            // a circle far from the origin for its size has vertices with the rounding of its position
            if (distance - radius).abs() > 1e-9 * radius + circle.slack {
                return Err(Error::OffRadius { distance, radius });
            }
        }
        let (start, end) = (circle.angle(&a), circle.angle(&b));
        let sweep = circle.turn() * (end - start);
        let sweep = if sweep <= 0.0 { sweep + 2.0 * PI } else { sweep };
        let bulge = Bulge::new(center.into(), radius, a.into(), b.into(), circle.turn());
        Ok(Arc { circle, a: a.into(), b: b.into(), start, sweep, bulge })
    }

    /// When the path from `x` with velocity `v` crosses outwards; see [`Piece::crossing`].
    ///
    /// Seen along the path, the circle is crossed outwards at its far end if the table is inside and at its near end
    /// if it is outside. That point lies on the arc if `a` is on the right and `b` on the left; or if both are on one
    /// side and the arc goes round the other way.
    #[inline(always)]
    pub fn cross<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> Crossing<F> {
        let zero = x[0].same(0.0);
        let (to_a, to_b) = (from(x, self.a), from(x, self.b));
        self.meet(x, v, [zero.lt(cross(v, to_a)), zero.lt(cross(v, to_b))]).into()
    }

    /// The same, given for each vertex whether it lies on the left of the path.
    #[inline(always)]
    pub(crate) fn meet<F: Lane>(&self, x: [F; 2], v: [F; 2], [a_left, b_left]: [F::Mask; 2]) -> Candidate<F> {
        let between = !a_left & b_left;
        let around = self.bulge.meets(v, a_left, b_left);
        let roots = self.circle.roots(x, v);
        self.circle.outward(&roots, between, around)
    }

    /// The landing point and the normal; see [`Piece::landing`].
    #[inline(always)]
    pub fn land<F: Lane>(&self, x: [F; 2], v: [F; 2], time: F) -> ([F; 2], [F; 2]) {
        self.circle.land(x, v, time)
    }

    pub(crate) fn circle(&self) -> &Circle {
        &self.circle
    }
    /// The vertices, in the order of traversal.
    pub(crate) fn vertices(&self) -> [&[f64; 2]; 2] {
        [&self.a, &self.b]
    }
    pub(crate) fn translated(self, by: [f64; 2]) -> Arc {
        Arc { circle: self.circle.translated(by), a: moved(self.a, by), b: moved(self.b, by), ..self }
    }

    /// The same as one side of a wall with the table on both sides.
    pub(crate) fn two_sided(self) -> Arc {
        Arc { circle: self.circle.two_sided(), ..self }
    }

    /// The angle from the start to `point`, in the sense of traversal, in [0, 2π).
    fn angle_along(&self, point: &Vector2<f64>) -> f64 {
        let angle = self.circle.turn() * (self.circle.angle(point) - self.start);
        if angle < 0.0 { angle + 2.0 * PI } else { angle }
    }
}

impl Piece for Arc {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        self.cross(path.point.into(), path.velocity.into())
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        self.circle.landing(path, time)
    }
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        self.circle.curvature(point)
    }
    fn length(&self) -> f64 {
        self.sweep * self.circle.radius
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        self.circle.at_angle(self.start + self.circle.turn() * s / self.circle.radius)
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        let angle = self.angle_along(point);
        let nearest = if angle <= self.sweep {
            angle
        } else if angle - self.sweep < 2.0 * PI - angle {
            self.sweep
        } else {
            0.0
        };
        nearest * self.circle.radius
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        if self.angle_along(point) <= self.sweep {
            return self.circle.closest(point);
        }
        let [a, b] = [Vector2::from(self.a), Vector2::from(self.b)];
        let end = if (point - a).norm_squared() <= (point - b).norm_squared() { a } else { b };
        Landing { point: end, normal: self.circle.normal_at(&end) }
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        Some([self.a.into(), self.b.into()])
    }
    fn extent(&self) -> Extent {
        let extremes = [0.0, FRAC_PI_2, PI, -FRAC_PI_2].map(|angle| self.circle.at_angle(angle));
        let on_arc = extremes.into_iter().filter(|p| self.angle_along(p) <= self.sweep);
        Extent::of(on_arc.chain([self.a.into(), self.b.into()]))
    }
    fn area(&self) -> f64 {
        0.5 * self.circle.radius * self.circle.radius * (self.sweep - libm::sin(self.sweep)) * self.circle.turn()
    }
    fn shape(&self) -> Option<Shape> {
        Some(Shape::Arc(*self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn v(x: f64, y: f64) -> Vector2<f64> {
        Vector2::new(x, y)
    }
    fn time(arc: &Arc, x: Vector2<f64>, velocity: Vector2<f64>) -> f64 {
        arc.crossing(&Line { point: x, velocity }).time()
    }

    #[test]
    fn two_arcs_of_a_circle_share_every_path_between_them() {
        // minor + major, every direction from several points, the two vertices included
        let (a, b) = (v(0.6, 0.8), v(-1.0, 0.0));
        let minor = Arc::new(Vector2::zeros(), a, b, true).unwrap();
        let major = Arc::new(Vector2::zeros(), b, a, true).unwrap();
        for x in [v(0.0, 0.0), v(0.3, 0.2), v(-0.5, 0.4), v(0.1, -0.9)] {
            let aimed = [a - x, b - x];
            let fan = (0..360).map(|d| Vector2::new(libm::cos(f64::from(d)), libm::sin(f64::from(d))));
            for direction in fan.chain(aimed) {
                let hits = [&minor, &major].map(|arc| time(arc, x, direction) < f64::INFINITY);
                assert!(hits[0] != hits[1], "from {x} along {direction}: {hits:?}");
            }
        }
    }

    #[test]
    fn a_path_that_starts_along_its_arc_does_not_leave_the_disk() {
        // at an angle of less than √ε to the arc the line misses the circle because of rounding
        let (a, b) = (v(1.0, 0.0), v(-1.0, 0.0));
        let arcs = [Arc::new(Vector2::zeros(), a, b, true).unwrap(), Arc::new(Vector2::zeros(), b, a, true).unwrap()];
        for slope in [1e-8, 1e-9, 1e-12, 0.0] {
            let (start, velocity) = (v(0.0, 1.0), v(1.0, -slope));
            assert!(time(&arcs[0], start, velocity) <= 2.0 * slope, "{slope:e}");
            assert_eq!(time(&arcs[1], start, velocity), f64::INFINITY, "{slope:e}");
        }
    }

    #[test]
    fn what_is_met_lies_on_the_arc() {
        // arcs of every length, both senses; paths from inside, in every direction
        let at = |degrees: f64| v(libm::cos(degrees.to_radians()), libm::sin(degrees.to_radians()));
        for (end, inside) in (1..36).flat_map(|k| [(10.0 * f64::from(k), true), (10.0 * f64::from(k), false)]) {
            let (a, b) = if inside { (at(0.0), at(end)) } else { (at(end), at(0.0)) };
            let arc = Arc::new(Vector2::zeros(), a, b, inside).unwrap();
            let circle = Circle::new(Vector2::zeros(), 1.0, inside).unwrap();
            for k in 0..5000 {
                let direction = at(37.1 * f64::from(k));
                // inside: any point of the disk; outside: a point from which the path heads for the disk
                let offset = -1.0 + f64::from(2 * (k % 83) + 1) / 83.0;
                let along = if inside { offset * (1.0 - offset * offset).sqrt() } else { -2.0 };
                let x = direction * along + v(-direction.y, direction.x) * offset;
                let path = Line { point: x, velocity: direction };
                let t = circle.crossing(&path).time();
                let angle = libm::atan2(path.at(t).y, path.at(t).x).to_degrees();
                let angle = if angle < 0.0 { angle + 360.0 } else { angle };
                let on_arc = angle < end;
                assert_eq!(time(&arc, x, direction), if on_arc { t } else { f64::INFINITY }, "{end} {inside} {angle}");
            }
        }
    }

    #[test]
    fn a_dispersing_arc_is_met_on_its_near_side() {
        // the lower half of the unit circle, table outside: clockwise from (1, 0) to (−1, 0)
        let bump = Arc::new(Vector2::zeros(), v(1.0, 0.0), v(-1.0, 0.0), false).unwrap();
        assert_eq!(time(&bump, v(0.0, -3.0), v(0.0, 1.0)), 2.0);
        assert_eq!(time(&bump, v(0.0, 3.0), v(0.0, -1.0)), f64::INFINITY);
        assert_eq!(time(&bump, v(0.0, -3.0), v(0.0, -1.0)), f64::INFINITY);
        assert!((bump.length() - PI).abs() < 4.0 * f64::EPSILON);
    }

    #[test]
    fn a_major_arc_is_met_on_both_sides_of_its_opening() {
        // a pocket, open at the top, traversed counter-clockwise from the left lip
        let (left, right) = (v(-0.75, 1.0), v(0.75, 1.0));
        let pocket = Arc::new(Vector2::zeros(), left, right, true).unwrap();
        assert_eq!(time(&pocket, v(0.0, 2.0), v(0.0, -1.0)), 3.25);
        assert_eq!(time(&pocket, v(0.0, 0.0), v(0.0, 1.0)), f64::INFINITY);
        assert_eq!(time(&pocket, v(0.0, 0.0), v(1.0, 0.0)), 1.25);
    }

    #[test]
    fn a_circle_given_to_ten_digits_passes_through_its_vertices() {
        let (a, b) = (v(1.0, 0.0), v(-0.999_999_999_1, 0.0));
        let arc = Arc::new(Vector2::zeros(), a, b, true).unwrap();
        for vertex in [a, b] {
            assert!(
                ((vertex - Vector2::from(arc.circle.center)).norm() - arc.circle.radius).abs() < 4.0 * f64::EPSILON
            );
        }
        // and a centre that is right up to rounding is kept
        assert_eq!(Arc::new(v(0.1, 0.2), v(1.1, 0.2), v(0.1, 1.2), true).unwrap().circle.center, [0.1, 0.2]);
        // almost a whole circle between vertices off by 10⁻¹⁰ may be anywhere
        let slit = Arc::new(Vector2::zeros(), a, v(1.0 + 1e-10, -1e-6), true);
        assert!(matches!(slit, Err(Error::OffCircle { .. })));
    }

    #[test]
    fn an_end_off_the_given_circle_is_told_from_ends_at_different_distances() {
        let (origin, a) = (Vector2::zeros(), v(1.0, 0.0));
        let error = |arc: Result<Arc, Error>| arc.unwrap_err().to_string();
        assert_eq!(
            error(Arc::new(origin, a, v(0.0, 2.0), true)),
            "the ends of the arc lie 1 and 2 from its centre; they must be equally far"
        );
        // both are equally far
        assert_eq!(
            error(Arc::with_radius(origin, 3.0, a, v(0.0, 1.0), true)),
            "an end of the arc lies 1 from its centre; its radius is 3"
        );
    }

    #[test]
    fn a_path_along_the_tangent_of_a_vertex_does_not_leak() {
        // the cap of a stadium, from the end of the straight wall on which the path runs
        let cap = Arc::new(v(1.0, 1.0), v(1.0, 0.0), v(1.0, 2.0), true).unwrap();
        assert_eq!(time(&cap, v(0.0, 0.0), v(1.0, 1e-17)), 1.0);
    }

    #[test]
    fn arcs_know_their_area() {
        let upper = Arc::new(Vector2::zeros(), v(1.0, 0.0), v(-1.0, 0.0), true).unwrap();
        let lower = Arc::new(Vector2::zeros(), v(-1.0, 0.0), v(1.0, 0.0), true).unwrap();
        assert!((upper.area() + lower.area() - PI).abs() < 4.0 * f64::EPSILON);
    }
}

//! An arc of an ellipse between two vertices.
use crate::{
    Error,
    crossing::{Candidate, Crossing},
    path::Line,
    piece::{Extent, Landing, Piece},
    plane::{cross, from, moved},
    shapes::{
        Ellipse, Shape,
        arc::Bulge,
        curve::{Blocks, Parametric},
    },
};
use core::f64::consts::PI;
use lanes::Lane;
use nalgebra::Vector2;

/// The arc from `a` to `b`: counter-clockwise with the table inside the ellipse, or clockwise with the table outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipticArc {
    ellipse: Ellipse,
    a: [f64; 2],
    b: [f64; 2],
    /// In the picture where the ellipse is the unit circle.
    bulge: Bulge,
    /// Arc length of `a` from the end of the first semi-axis, and from `a` to `b`, in the sense of traversal.
    start: f64,
    length: f64,
    /// Eccentric angle of `a`, and the positive angle from there to `b` in the sense of traversal.
    angle: f64,
    sweep: f64,
}

impl EllipticArc {
    /// The arc of `ellipse` from `a` to `b`, in the sense in which the ellipse is traversed.
    ///
    /// The vertices are kept as they are, since neighbours share them.
    ///
    /// # Errors
    /// [`Error::ZeroLength`] if `a = b` (use [`Ellipse`]), and [`Error::OffEllipse`] for a vertex that is off the
    /// ellipse by more than 10⁻⁹ of its size: such data are taken for a mistake.
    pub fn new(ellipse: Ellipse, a: Vector2<f64>, b: Vector2<f64>) -> Result<EllipticArc, Error> {
        if a == b {
            return Err(Error::ZeroLength);
        }
        let ends = [a, b].map(|vertex| ellipse.eccentric(&vertex));
        let [ra, rb] = ends.map(|y| libm::hypot(y[0], y[1]));
        for ratio in [ra, rb] {
            // in units of the semi-axes; far from the origin, the rounding of coordinates there
            let tolerance = 1e-9_f64.max(ellipse.unit().slack);
            if (ratio - 1.0).abs() > tolerance || ratio.is_nan() {
                return Err(Error::OffEllipse { ratio });
            }
        }
        let turn = ellipse.unit().turn();
        let [start, end] = ends.map(|y| turn * ellipse.arc_length_of(y));
        let [angle, far] = ends.map(|y| libm::atan2(y[1], y[0]));
        let along = |difference: f64, whole: f64| if difference <= 0.0 { difference + whole } else { difference };
        Ok(EllipticArc {
            ellipse,
            a: a.into(),
            b: b.into(),
            bulge: Bulge::new([0.0; 2], 1.0, ends[0], ends[1], turn),
            start,
            length: along(end - start, ellipse.length()),
            angle,
            sweep: along(turn * (far - angle), 2.0 * PI),
        })
    }

    /// When the path from `x` with velocity `v` crosses outwards; see [`Piece::crossing`].
    ///
    /// Seen along the path, the ellipse is crossed outwards at its far end if the table is inside and at its near end
    /// if it is outside. That point lies on the arc if `a` is on the right of the path and `b` on the left; or if both
    /// are on one side and the arc goes round the other way, as in the picture of the unit circle.
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
        let (y, w) = self.ellipse.affine(x, v);
        let around = self.bulge.meets(w, a_left, b_left);
        let roots = self.ellipse.unit().roots(y, w);
        self.ellipse.unit().outward(&roots, between, around)
    }

    /// The landing point and the normal; see [`Piece::landing`].
    #[inline(always)]
    pub fn land<F: Lane>(&self, x: [F; 2], v: [F; 2], time: F) -> ([F; 2], [F; 2]) {
        self.ellipse.land(x, v, time)
    }

    pub(crate) fn ellipse(&self) -> &Ellipse {
        &self.ellipse
    }
    /// The vertices, in the order of traversal.
    pub(crate) fn vertices(&self) -> [&[f64; 2]; 2] {
        [&self.a, &self.b]
    }
    pub(crate) fn translated(self, by: [f64; 2]) -> EllipticArc {
        EllipticArc { ellipse: self.ellipse.translated(by), a: moved(self.a, by), b: moved(self.b, by), ..self }
    }

    /// The same as one side of a wall with the table on both sides.
    pub(crate) fn two_sided(self) -> EllipticArc {
        EllipticArc { ellipse: self.ellipse.two_sided(), ..self }
    }

    /// The eccentric angle from the start to `point`, in the sense of traversal, in [0, 2π).
    fn angle_along(&self, point: &Vector2<f64>) -> f64 {
        let angle = self.ellipse.unit().turn() * (self.ellipse.eccentric_angle(point) - self.angle);
        if angle < 0.0 { angle + 2.0 * PI } else { angle }
    }

    /// The point of the unit circle that corresponds to the point of the arc closest to `point`.
    fn foot(&self, point: &Vector2<f64>) -> [f64; 2] {
        let y = self.ellipse.closest_eccentric(point);
        if self.angle_along(&self.ellipse.at(y).point) <= self.sweep {
            return y;
        }
        // the closest point of the whole ellipse is elsewhere: another foot of a perpendicular, or an end
        let node = |k: usize| {
            let u = self.sweep * (k as f64 / 32.0);
            (u, self.at(u))
        };
        let angle = Blocks::one(33).closest(self, node, point);
        self.unit_point(angle)
    }

    /// The point of the unit circle at the angle `u` from the start.
    fn unit_point(&self, u: f64) -> [f64; 2] {
        let angle = self.angle + self.ellipse.unit().turn() * u;
        [libm::cos(angle), libm::sin(angle)]
    }

    /// Arc length from the start, for a point of the arc.
    fn along(&self, y: [f64; 2]) -> f64 {
        let s = self.ellipse.unit().turn() * self.ellipse.arc_length_of(y) - self.start;
        let whole = self.ellipse.length();
        let s = if s < 0.0 { s + whole } else { s };
        // rounding may put the start itself a whole turn away
        if s <= self.length {
            s
        } else if s - self.length < whole - s {
            self.length
        } else {
            0.0
        }
    }
}

impl Parametric for EllipticArc {
    fn at(&self, u: f64) -> [Vector2<f64>; 2] {
        let y = self.unit_point(u);
        let turn = self.ellipse.unit().turn();
        [self.ellipse.at(y).point, self.ellipse.tangent(y) * turn]
    }
}

impl Piece for EllipticArc {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        self.cross(path.point.into(), path.velocity.into())
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        self.ellipse.landing(path, time)
    }
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        self.ellipse.curvature(point)
    }
    fn length(&self) -> f64 {
        self.length
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        self.ellipse.point_at(self.start + s)
    }
    fn landing_at(&self, s: f64) -> Landing {
        self.ellipse.landing_at(self.start + s)
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        self.along(self.foot(point))
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        self.ellipse.at(self.foot(point))
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        Some([self.a.into(), self.b.into()])
    }
    fn extent(&self) -> Extent {
        let on_arc = self.ellipse.extremes().into_iter().filter(|p| self.angle_along(p) <= self.sweep);
        Extent::of(on_arc.chain([self.a.into(), self.b.into()]))
    }
    fn shape(&self) -> Option<Shape> {
        Some(Shape::EllipticArc(*self))
    }
    fn area(&self) -> f64 {
        // the affine image of a circular one
        let [a, b] = self.ellipse.semi_axes();
        0.5 * a * b * (self.sweep - libm::sin(self.sweep)) * self.ellipse.unit().turn()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tilted(inside: bool) -> Ellipse {
        Ellipse::new(Vector2::new(0.25, -0.5), [2.0, 0.75], 0.6, inside).unwrap()
    }
    fn quarters(inside: bool) -> [EllipticArc; 2] {
        let e = tilted(inside);
        let (a, b) = (e.point_at(1.0), e.point_at(3.5));
        [EllipticArc::new(e, a, b).unwrap(), EllipticArc::new(e, b, a).unwrap()]
    }

    #[test]
    fn two_arcs_of_an_ellipse_share_every_path_between_them() {
        for inside in [true, false] {
            let arcs = quarters(inside);
            let ends = arcs[0].ends().unwrap();
            for x in [Vector2::new(0.25, -0.5), Vector2::new(1.0, 0.1), Vector2::new(-0.3, -0.9)] {
                // inside, starts at the point; outside, starts far off and heads towards it
                let fan = (0..360).map(|d| Vector2::new(libm::cos(f64::from(d)), libm::sin(f64::from(d))));
                for v in fan.chain(ends.map(|end| end - x)) {
                    let path = Line { point: if inside { x } else { x - v * 8.0 }, velocity: v };
                    let times = [&arcs[0], &arcs[1]].map(|arc| arc.crossing(&path).time());
                    assert!(times[0].is_finite() != times[1].is_finite(), "from {x} along {v}: {times:?}");
                    let whole = tilted(inside).crossing(&path).time();
                    assert_eq!(times[0].min(times[1]), whole);
                }
            }
        }
    }

    #[test]
    fn the_parts_add_up_to_the_whole() {
        for inside in [true, false] {
            let (arcs, e) = (quarters(inside), tilted(inside));
            let sum = |f: fn(&EllipticArc) -> f64| f(&arcs[0]) + f(&arcs[1]);
            assert!((sum(EllipticArc::length) - e.length()).abs() < 4.0 * f64::EPSILON * e.length());
            assert!((sum(Piece::area) - e.area()).abs() < 8.0 * f64::EPSILON * e.area().abs());
            assert!((arcs[0].length() - 2.5).abs() < 1e-14);
        }
    }

    #[test]
    fn vertices_must_lie_on_the_ellipse() {
        let ellipse = Ellipse::new(Vector2::new(5.0, 0.0), [4.0, 2.0], 0.0, true).unwrap();
        // the ends are equally far from the centre
        let off = EllipticArc::new(ellipse, Vector2::new(9.0, 0.0), Vector2::new(5.0, 4.0)).unwrap_err();
        assert_eq!(off.to_string(), "an end of the arc does not lie on its ellipse, but on one 2 times as large");
    }
}

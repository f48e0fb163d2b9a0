//! A half-infinite straight wall.
use crate::{
    Error,
    crossing::{Candidate, Crossing},
    path::Line,
    piece::{Extent, Landing, Piece},
    plane::{self, Behind, along, cross, from, moved, slack},
    shapes::Shape,
};
use lanes::{Lane, dot};
use nalgebra::Vector2;

/// The ray from `a` along a unit vector `d`, table on its left or on its right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    from: [f64; 2],
    direction: [f64; 2],
    /// +1 where the table lies on the left of `direction`, −1 on the right.
    side: f64,
    behind: Behind,
}

impl Ray {
    /// The ray from a point along `direction`, which need not have length 1; `left`: the table lies on its left.
    ///
    /// # Errors
    /// [`Error::ZeroLength`] if `direction` is zero, [`Error::Parameter`] for a point that is not finite.
    pub fn new(from: Vector2<f64>, direction: Vector2<f64>, left: bool) -> Result<Ray, Error> {
        plane::finite("from", &from)?;
        plane::finite("direction", &direction)?;
        let (direction, _) = plane::direction([0.0; 2], direction.into()).ok_or(Error::ZeroLength)?;
        Ok(Ray {
            from: from.into(),
            direction,
            side: if left { 1.0 } else { -1.0 },
            behind: Behind::of(slack([from.x, from.y])),
        })
    }

    /// Its end.
    pub(crate) fn start(&self) -> [f64; 2] {
        self.from
    }
    /// Unit vector away from its end.
    pub(crate) fn direction(&self) -> [f64; 2] {
        self.direction
    }
    /// Whether the table lies on the left of that.
    pub(crate) fn is_left(&self) -> bool {
        self.side > 0.0
    }
    pub(crate) fn translated(self, by: [f64; 2]) -> Ray {
        let from = moved(self.from, by);
        let moved = Ray { from, behind: Behind::of(slack(from)), ..self };
        if self.is_two_sided() { moved.two_sided() } else { moved }
    }
    /// The same as one side of a wall with the table on both sides: a start on it, within rounding, may be on either side.
    pub(crate) fn two_sided(self) -> Ray {
        Ray { behind: self.behind.two_sided(), ..self }
    }
    pub(crate) fn is_two_sided(&self) -> bool {
        self.behind.is_two_sided()
    }
    /// Unit normal into the table.
    pub(crate) fn inward_normal(&self) -> [f64; 2] {
        [-self.side * self.direction[1], self.side * self.direction[0]]
    }

    /// When the path from `x` with velocity `v` crosses outwards; see [`Piece::crossing`].
    #[inline(always)]
    pub fn cross<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> Crossing<F> {
        let zero = x[0].same(0.0);
        let to_end = from(x, self.from);
        self.meet(x, v, to_end, zero.lt(cross(v, to_end))).into()
    }

    /// The same, given whether the ray's end lies on the left of the path, and the vector from the start of the path to
    /// that end.
    #[inline(always)]
    pub(crate) fn meet<F: Lane>(&self, x: [F; 2], v: [F; 2], to_end: [F; 2], end_left: F::Mask) -> Candidate<F> {
        let n = self.inward_normal();
        let distance = -(to_end[0] * n[0] + to_end[1] * n[1]);
        let speed = -(v[0] * n[0] + v[1] * n[1]);
        // a ray with the table on its left goes from its end to infinity: its end must not be on the left of the path
        let passes = if self.side > 0.0 { !end_left } else { end_left };
        Candidate { really: passes & self.behind.at(x).lt(distance), num: distance, den: speed }
    }

    /// The landing point and the normal; see [`Piece::landing`].
    #[inline(always)]
    pub fn land<F: Lane>(&self, x: [F; 2], v: [F; 2], time: F) -> ([F; 2], [F; 2]) {
        let p = along(x, v, time);
        let n = self.inward_normal().map(|n| time.same(n));
        let off = dot(&from(p, self.from), &n);
        (along(p, n, off), n)
    }

    /// Arc length grows in the sense of traversal, towards the end of the ray if the table is on the right.
    fn toward(&self) -> Vector2<f64> {
        Vector2::from(self.direction) * self.side
    }
}

impl Piece for Ray {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        self.cross(path.point.into(), path.velocity.into())
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        let (point, normal) = self.land(path.point.into(), path.velocity.into(), time);
        Landing { point: point.into(), normal: normal.into() }
    }
    fn curvature(&self, _: &Vector2<f64>) -> f64 {
        0.0
    }
    fn length(&self) -> f64 {
        f64::INFINITY
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        Vector2::from(self.from) + self.toward() * s
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        let s = (point - Vector2::from(self.from)).dot(&self.toward());
        if self.side * s < 0.0 { 0.0 } else { s }
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        Landing { point: self.point_at(self.arc_length_at(point)), normal: self.inward_normal().into() }
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        let far = Vector2::from(self.direction).map(|d| if d == 0.0 { 0.0 } else { d * f64::INFINITY });
        Some(if self.side > 0.0 { [self.from.into(), far] } else { [far, self.from.into()] })
    }
    fn extent(&self) -> Extent {
        let far = |i: usize| if self.direction[i] == 0.0 { self.from[i] } else { self.direction[i] * f64::INFINITY };
        Extent::of([self.from.into(), Vector2::new(far(0), far(1))])
    }
    fn area(&self) -> f64 {
        f64::NAN
    }
    fn shape(&self) -> Option<Shape> {
        Some(Shape::Ray(*self))
    }
}

//! A straight segment between two vertices.
use crate::{
    Error,
    crossing::{Candidate, Crossing},
    path::Line,
    piece::{Extent, Landing, Piece},
    plane::{along, cross, direction, finite, from, moved, slack},
    shapes::Shape,
};
use lanes::{Lane, dot};
use nalgebra::Vector2;

/// Whether a path's line crosses the segment from `a` to `b` (outwards, if ahead): `a` is not on its left and `b` is.
#[inline(always)]
pub(crate) fn passes<F: Lane>(to_a: [F; 2], to_b: [F; 2], v: [F; 2]) -> F::Mask {
    let zero = v[0].same(0.0);
    !zero.lt(cross(v, to_a)) & zero.lt(cross(v, to_b))
}

/// The crossing of a path that passes between the ends of a segment; `behind` is minus the distance by which its start may lie outside.
#[inline(always)]
pub(crate) fn meet<F: Lane>(between: F::Mask, to_a: [F; 2], v: [F; 2], normal: [f64; 2], behind: f64) -> Candidate<F> {
    // both are outward; for a single path, testing for a wall along an axis takes longer than it saves
    let [n0, n1] = normal.map(|n| -n);
    let [distance, speed] = if F::LANES > 1 && n0 == 0.0 {
        [to_a[1] * n1, v[1] * n1]
    } else if F::LANES > 1 && n1 == 0.0 {
        [to_a[0] * n0, v[0] * n0]
    } else {
        [to_a[0] * n0 + to_a[1] * n1, v[0] * n0 + v[1] * n1]
    };
    Candidate { really: between & speed.same(behind).lt(distance), num: distance, den: speed }
}

/// The point of a path at `time`, projected onto the line through `a` with a unit normal.
#[inline(always)]
pub(crate) fn landing<F: Lane>(x: [F; 2], v: [F; 2], time: F, a: [f64; 2], normal: [f64; 2]) -> [F; 2] {
    let p = along(x, v, time);
    let n = normal.map(|n| time.same(n));
    along(p, n, dot(&from(p, a), &n))
}

/// The segment from `a` to `b`, table on its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    a: [f64; 2],
    b: [f64; 2],
    /// Unit normal into the table.
    normal: [f64; 2],
    length: f64,
    /// Minus the distance by which a start may lie outside through rounding. For one side of a two-sided wall, the distance by which it
    /// must lie inside.
    behind: f64,
}

impl Segment {
    /// The segment from `a` to `b` \[L\].
    ///
    /// # Errors
    /// [`Error::ZeroLength`] if the ends coincide, [`Error::Parameter`] if they are not finite.
    pub fn new(a: Vector2<f64>, b: Vector2<f64>) -> Result<Segment, Error> {
        finite("from", &a)?;
        finite("to", &b)?;
        let ([along_x, along_y], length) = direction(a.into(), b.into()).ok_or(Error::ZeroLength)?;
        let normal = [-along_y, along_x];
        let behind = -slack([a.x, a.y, b.x, b.y]);
        Ok(Segment { a: a.into(), b: b.into(), normal, length, behind })
    }

    /// The segment from `a` to `b` \[L\] of a line whose unit normal is known up to sign.
    ///
    /// Computed ends are off by rounding, and the shorter the segment, the more the direction from one to the other differs from that of
    /// the line.
    pub(crate) fn of_line(a: Vector2<f64>, b: Vector2<f64>, normal: [f64; 2]) -> Result<Segment, Error> {
        let segment = Segment::new(a, b)?;
        let same = dot(&segment.normal, &normal);
        let sign = 1.0_f64.copysign(same);
        Ok(if same == 0.0 { segment } else { Segment { normal: normal.map(|n| n * sign), ..segment } })
    }

    /// The same as one side of a wall with the table on both sides: a path that starts on the wall, within rounding, may be on either
    /// side and does not cross it.
    pub(crate) fn two_sided(self) -> Segment {
        Segment { behind: 0.5 * self.behind.abs(), ..self }
    }
    pub(crate) fn is_two_sided(&self) -> bool {
        self.behind > 0.0
    }

    /// When the path from `x` with velocity `v` crosses outwards; see [`Piece::crossing`].
    #[inline(always)]
    pub fn cross<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> Crossing<F> {
        let (to_a, to_b) = (from(x, self.a), from(x, self.b));
        // outwards exactly where `a` is not on the left of the path and `b` is
        self.meet(v, to_a, passes(to_a, to_b, v)).into()
    }

    /// The same, given whether the path passes between the vertices, and the vector from its start to `a`.
    #[inline(always)]
    pub(crate) fn meet<F: Lane>(&self, v: [F; 2], to_a: [F; 2], between: F::Mask) -> Candidate<F> {
        meet(between, to_a, v, self.normal, self.behind)
    }

    /// When a path that runs along the segment, to the last bit, comes to it: at the nearer end.
    ///
    /// There no side of a two-sided wall is crossed; at a one-sided wall the path crosses another wall that shares this end.
    pub(crate) fn edge_on(&self, x: [f64; 2], v: [f64; 2]) -> Option<Crossing> {
        let to = self.vertices().map(|end| from(x, *end));
        let ahead = to.map(|to| dot(&to, &v));
        let along = to.iter().all(|to| cross(v, *to) == 0.0) && ahead.iter().all(|ahead| *ahead > 0.0);
        along.then(|| Crossing { num: ahead[0].min(ahead[1]), den: dot(&v, &v) })
    }

    /// The landing point and the normal; see [`Piece::landing`].
    #[inline(always)]
    pub fn land<F: Lane>(&self, x: [F; 2], v: [F; 2], time: F) -> ([F; 2], [F; 2]) {
        (landing(x, v, time, self.a, self.normal), self.normal.map(|n| time.same(n)))
    }

    /// The first vertex.
    pub(crate) fn start(&self) -> [f64; 2] {
        self.a
    }
    /// The second vertex.
    pub(crate) fn end(&self) -> [f64; 2] {
        self.b
    }
    pub(crate) fn vertices(&self) -> [&[f64; 2]; 2] {
        [&self.a, &self.b]
    }
    /// Unit normal into the table.
    pub(crate) fn inward_normal(&self) -> [f64; 2] {
        self.normal
    }

    pub(crate) fn translated(self, by: [f64; 2]) -> Segment {
        let (a, b) = (moved(self.a, by), moved(self.b, by));
        let moved = Segment { a, b, behind: -slack(a.into_iter().chain(b)), ..self };
        if self.is_two_sided() { moved.two_sided() } else { moved }
    }

    fn direction(&self) -> Vector2<f64> {
        Vector2::new(self.normal[1], -self.normal[0])
    }
}

impl Piece for Segment {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        let (x, v) = (path.point.into(), path.velocity.into());
        let edge_on = if self.is_two_sided() { self.edge_on(x, v) } else { None };
        edge_on.unwrap_or_else(|| self.cross(x, v))
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        let (point, normal) = self.land(path.point.into(), path.velocity.into(), time);
        Landing { point: point.into(), normal: normal.into() }
    }
    fn curvature(&self, _: &Vector2<f64>) -> f64 {
        0.0
    }
    fn length(&self) -> f64 {
        self.length
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        Vector2::from(self.a) + self.direction() * s
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        (point - Vector2::from(self.a)).dot(&self.direction()).clamp(0.0, self.length)
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        let [a, b] = [Vector2::from(self.a), Vector2::from(self.b)];
        let s = (point - a).dot(&self.direction());
        // the vertices themselves, which neighbours share
        let at = if s <= 0.0 {
            a
        } else if s >= self.length {
            b
        } else {
            self.point_at(s)
        };
        Landing { point: at, normal: self.normal.into() }
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        Some([self.a.into(), self.b.into()])
    }
    fn extent(&self) -> Extent {
        Extent::of([self.a.into(), self.b.into()])
    }
    fn area(&self) -> f64 {
        0.0
    }
    fn shape(&self) -> Option<Shape> {
        Some(Shape::Segment(*self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn floor() -> Segment {
        Segment::new(Vector2::new(0.0, 0.0), Vector2::new(1.0, 0.0)).unwrap()
    }
    fn path(x: f64, y: f64, vx: f64, vy: f64) -> Line<2> {
        Line { point: Vector2::new(x, y), velocity: Vector2::new(vx, vy) }
    }

    #[test]
    fn a_segment_is_crossed_outwards_only() {
        assert_eq!(floor().crossing(&path(0.25, 1.0, 0.5, -1.0)).time(), 1.0);
        assert_eq!(floor().crossing(&path(0.25, -1.0, 0.0, 1.0)).num, f64::INFINITY);
        assert_eq!(floor().crossing(&path(0.25, 0.0, 0.0, 1.0)).num, f64::INFINITY);
        assert_eq!(floor().crossing(&path(0.25, -1.0, 0.0, -1.0)).num, f64::INFINITY);
    }

    #[test]
    fn a_shared_vertex_belongs_to_exactly_one_neighbour() {
        let wall = Segment::new(Vector2::new(1.0, 0.0), Vector2::new(2.0, 0.0)).unwrap();
        let at_vertex = path(1.0, 1.0, 0.0, -1.0);
        let hits = [floor(), wall].iter().filter(|s| s.crossing(&at_vertex).num < f64::INFINITY).count();
        assert_eq!(hits, 1);
    }

    #[test]
    fn a_segment_needs_length() {
        assert_eq!(Segment::new(Vector2::zeros(), Vector2::zeros()), Err(Error::ZeroLength));
    }
}

//! An infinite straight wall.
use crate::{
    Error,
    crossing::{Candidate, Crossing},
    path::Line,
    piece::{Extent, Landing, Piece},
    plane::{self, Behind, along, from, moved, slack},
    shapes::Shape,
};
use lanes::{Lane, dot};
use nalgebra::Vector2;

/// The straight line through `p` along a unit vector, table on its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FullLine {
    through: [f64; 2],
    normal: [f64; 2],
    behind: Behind,
}

impl FullLine {
    /// The line through a point along `direction`, which need not have length 1.
    ///
    /// # Errors
    /// [`Error::ZeroLength`] if `direction` is zero, [`Error::Parameter`] for a point that is not finite.
    pub fn new(through: Vector2<f64>, direction: Vector2<f64>) -> Result<FullLine, Error> {
        plane::finite("through", &through)?;
        plane::finite("direction", &direction)?;
        let ([along_x, along_y], _) = plane::direction([0.0; 2], direction.into()).ok_or(Error::ZeroLength)?;
        let normal = [-along_y, along_x];
        Ok(FullLine { through: through.into(), normal, behind: Behind::of(slack([through.x, through.y])) })
    }

    /// When the path from `x` with velocity `v` crosses outwards; see [`Piece::crossing`].
    #[inline(always)]
    pub fn cross<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> Crossing<F> {
        self.meet(x, v).into()
    }

    /// The same, before anything is selected.
    #[inline(always)]
    pub(crate) fn meet<F: Lane>(&self, x: [F; 2], v: [F; 2]) -> Candidate<F> {
        let zero = x[0].same(0.0);
        let to_line = from(x, self.through);
        let distance = -(to_line[0] * self.normal[0] + to_line[1] * self.normal[1]);
        let speed = -(v[0] * self.normal[0] + v[1] * self.normal[1]);
        Candidate { really: zero.lt(speed) & self.behind.at(x).lt(distance), num: distance, den: speed }
    }

    /// The landing point and the normal; see [`Piece::landing`].
    #[inline(always)]
    pub fn land<F: Lane>(&self, x: [F; 2], v: [F; 2], time: F) -> ([F; 2], [F; 2]) {
        let p = along(x, v, time);
        let n = self.normal.map(|n| time.same(n));
        let off = dot(&from(p, self.through), &n);
        (along(p, n, off), n)
    }

    /// A point of it.
    pub(crate) fn through(&self) -> [f64; 2] {
        self.through
    }
    /// Unit normal into the table.
    pub(crate) fn inward_normal(&self) -> [f64; 2] {
        self.normal
    }
    pub(crate) fn translated(self, by: [f64; 2]) -> FullLine {
        let through = moved(self.through, by);
        let moved = FullLine { through, behind: Behind::of(slack(through)), ..self };
        if self.is_two_sided() { moved.two_sided() } else { moved }
    }
    /// The same as one side of a wall with the table on both sides: a start on it, within rounding, may be on either side.
    pub(crate) fn two_sided(self) -> FullLine {
        FullLine { behind: self.behind.two_sided(), ..self }
    }
    pub(crate) fn is_two_sided(&self) -> bool {
        self.behind.is_two_sided()
    }

    /// Unit vector in the sense of traversal.
    pub(crate) fn direction(&self) -> Vector2<f64> {
        Vector2::new(self.normal[1], -self.normal[0])
    }
}

impl Piece for FullLine {
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
        Vector2::from(self.through) + self.direction() * s
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        (point - Vector2::from(self.through)).dot(&self.direction())
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        Landing { point: self.point_at(self.arc_length_at(point)), normal: self.normal.into() }
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        let far = |sign: f64| self.direction().map(|d| if d == 0.0 { 0.0 } else { sign * d * f64::INFINITY });
        Some([far(-1.0), far(1.0)])
    }
    fn extent(&self) -> Extent {
        let d = self.direction();
        let side = |i: usize, sign: f64| if d[i] == 0.0 { self.through[i] } else { sign * f64::INFINITY };
        Extent { min: Vector2::new(side(0, -1.0), side(1, -1.0)), max: Vector2::new(side(0, 1.0), side(1, 1.0)) }
    }
    fn area(&self) -> f64 {
        f64::NAN
    }
    fn shape(&self) -> Option<Shape> {
        Some(Shape::Line(*self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_that_starts_beyond_a_line_does_not_cross_it() {
        let floor = FullLine::new(Vector2::zeros(), Vector2::new(1.0, 0.0)).unwrap();
        let time =
            |y: f64| floor.crossing(&Line { point: Vector2::new(0.5, y), velocity: Vector2::new(0.3, -1.0) }).time();
        assert_eq!([time(1.0), time(-1e-16), time(-7.0)], [1.0, 0.0, f64::INFINITY]);
    }
}

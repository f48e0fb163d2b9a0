//! A wall without thickness.
use super::{Segment, Shape};
use crate::{
    Crossing, Error, Extent, Landing, Line, Piece,
    crossing::Candidate,
    plane::{cross, from},
};
use lanes::{Lane, dot};
use nalgebra::Vector2;

/// A straight segment that is a wall on both of its sides.
///
/// It is never crossed by a path that starts on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// The segment from `a` to `b` with the table on its left, and the same back again: the sides of a two-sided wall.
    faces: [Segment; 2],
}

impl Screen {
    /// The screen from `a` to `b` \[L\].
    ///
    /// # Errors
    /// [`Error::ZeroLength`] if the ends coincide.
    pub fn new(a: Vector2<f64>, b: Vector2<f64>) -> Result<Screen, Error> {
        Ok(Screen { faces: [Segment::new(a, b)?, Segment::new(b, a)?].map(Segment::two_sided) })
    }

    pub(crate) fn translated(self, by: [f64; 2]) -> Screen {
        Screen { faces: self.faces.map(|face| face.translated(by)) }
    }

    pub(crate) fn two_sided(self) -> Screen {
        self
    }
    pub(crate) fn is_two_sided(&self) -> bool {
        self.faces[0].is_two_sided()
    }

    /// The segment from `a` to `b`, and back again.
    pub(crate) fn faces(&self) -> &[Segment; 2] {
        &self.faces
    }

    /// How a path with velocity `v` crosses either face, with the vectors from its start to `a` and `b`, and `v ×` these.
    ///
    /// Both tips belong to both faces, so nothing slips through at a tip.
    #[inline(always)]
    pub(crate) fn meet<F: Lane>(&self, v: [F; 2], [to_a, to_b]: [[F; 2]; 2], [a, b]: [F; 2]) -> [Candidate<F>; 2] {
        let zero = a.same(0.0);
        let there = !zero.lt(a) & !b.lt(zero) & a.lt(b);
        let back = !zero.lt(b) & !a.lt(zero) & b.lt(a);
        [self.faces[0].meet(v, to_a, there), self.faces[1].meet(v, to_b, back)]
    }

    /// The tips `a` and `b`.
    fn vertices(&self) -> [Vector2<f64>; 2] {
        self.faces[0].vertices().map(|tip| Vector2::from(*tip))
    }

    /// The face that a path with this velocity can hit.
    fn facing(&self, velocity: &Vector2<f64>) -> &Segment {
        let [a, b] = self.vertices();
        let leftwards = cross((b - a).into(), (*velocity).into()) > 0.0;
        &self.faces[usize::from(leftwards)]
    }

    /// The number of the face on whose side a point lies; for points on the screen itself the left one.
    fn side_of(&self, point: &Vector2<f64>) -> usize {
        let [a, b] = self.vertices();
        usize::from(cross((b - a).into(), (point - a).into()) < 0.0)
    }

    /// The face at an arc length, and the arc length along it.
    fn face_at(&self, s: f64) -> (&Segment, f64) {
        let length = self.faces[0].length();
        if s <= length { (&self.faces[0], s) } else { (&self.faces[1], s - length) }
    }

    /// The arc length of the point of a face closest to `point`.
    fn arc_length_along(&self, face: usize, point: &Vector2<f64>) -> f64 {
        let along = self.faces[face].arc_length_at(point);
        if face == 0 { along } else { self.faces[0].length() + along }
    }
}

impl Piece for Screen {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        let v = path.velocity.into();
        if let Some(crossing) = self.faces[0].edge_on(path.point.into(), v) {
            return crossing;
        }
        let to = self.faces[0].vertices().map(|tip| from(path.point.into(), *tip));
        let [there, back] = self.meet(v, to, to.map(|to| cross(v, to)));
        if there.really { there.into() } else { back.into() }
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        self.facing(&path.velocity).landing(path, time)
    }
    fn curvature(&self, _: &Vector2<f64>) -> f64 {
        0.0
    }
    /// The length of both faces: `s` runs along the left one from `a` to `b` and back along the right one.
    fn length(&self) -> f64 {
        2.0 * self.faces[0].length()
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        let (face, s) = self.face_at(s);
        face.point_at(s)
    }
    /// On the face that `s` runs along, which cannot be recognised from the point.
    fn landing_at(&self, s: f64) -> Landing {
        let (face, s) = self.face_at(s);
        face.landing_at(s)
    }
    /// On the left face for points on the screen itself.
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        self.arc_length_along(self.side_of(point), point)
    }
    /// On the face with that normal.
    fn arc_length_of(&self, landing: &Landing) -> f64 {
        let right = dot(&self.faces[0].inward_normal(), &landing.normal.into()) < 0.0;
        self.arc_length_along(usize::from(right), &landing.point)
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        self.faces[self.side_of(point)].closest(point)
    }
    /// None: the boundary closes around both faces.
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        None
    }
    fn extent(&self) -> Extent {
        self.faces[0].extent()
    }
    fn area(&self) -> f64 {
        0.0
    }
    fn shape(&self) -> Option<Shape> {
        Some(Shape::Screen(*self))
    }
    fn tips(&self) -> Option<[Vector2<f64>; 2]> {
        Some(self.vertices())
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp, clippy::unwrap_used, reason = "tests claim exact values")]
mod tests {
    use super::*;

    #[test]
    fn a_screen_is_hit_from_both_sides_and_never_from_itself() {
        let screen = Screen::new(Vector2::new(0.1, 0.3), Vector2::new(0.9, 0.7)).unwrap();
        for side in [1.0, -1.0] {
            let velocity = Vector2::new(0.1, -1.0) * side;
            let start = Vector2::new(0.5, 0.5) - velocity;
            let path = Line { point: start, velocity };
            let time = screen.crossing(&path).time();
            assert!((time - 1.0).abs() < 8.0 * f64::EPSILON); // lengths of order 1
            let landing = screen.landing(&path, time);
            assert!(landing.normal.dot(&velocity) < 0.0);
            for k in 0..100 {
                let angle = 0.0628 * f64::from(k);
                let velocity = Vector2::new(libm::cos(angle), libm::sin(angle));
                assert_eq!(screen.crossing(&Line { point: landing.point, velocity }).num, f64::INFINITY);
            }
        }
    }
}

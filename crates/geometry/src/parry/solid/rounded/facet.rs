//! A triangle, seen from its front or from either side.
use super::View;
use crate::Extent;
use nalgebra::Vector3;

/// A triangle, counter-clockwise as seen from its front.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    corners: [Vector3<f64>; 3],
    /// Unit normal, towards the front.
    normal: Vector3<f64>,
    /// Per side, from corner `k` to the next.
    sides: [Edge; 3],
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    /// Unit vectors along it, and across it into the triangle.
    along: Vector3<f64>,
    inward: Vector3<f64>,
    length: f64,
}

impl Facet {
    pub(super) fn new(corners: [Vector3<f64>; 3], normal: Vector3<f64>) -> Facet {
        let sides = core::array::from_fn(|k| {
            let along = corners[(k + 1) % 3] - corners[k];
            let length = along.norm();
            let along = if length > 0.0 { along / length } else { along };
            Edge { along, inward: normal.cross(&along), length }
        });
        Facet { corners, normal, sides }
    }

    pub(super) fn corners(&self) -> [Vector3<f64>; 3] {
        self.corners
    }
    pub(super) fn normal(&self) -> Vector3<f64> {
        self.normal
    }
    pub(super) fn extent(&self) -> Extent<3> {
        Extent::of(self.corners)
    }

    /// How far a point lies above its plane.
    pub(super) fn above(&self, x: &Vector3<f64>) -> f64 {
        self.normal.dot(&(x - self.corners[0]))
    }

    /// The view from its front: its plane if the triangle is straight below, otherwise an edge or a corner.
    pub(super) fn front(&self, x: &Vector3<f64>) -> View {
        let flat = View { height: self.above(x), normal: self.normal };
        if flat.height < 0.0 {
            return self.rim(x, [true; 3]).unwrap_or(flat);
        }
        self.rim(x, self.passed(x)).unwrap_or(flat)
    }

    /// The view from either side.
    pub(super) fn either(&self, x: &Vector3<f64>) -> View {
        let height = self.above(x);
        let flat = View { height: height.abs(), normal: self.normal * 1.0_f64.copysign(height) };
        self.rim(x, self.passed(x)).unwrap_or(flat)
    }

    /// Beyond which edges the point of its plane nearest to `x` lies: none where that point is in the triangle.
    fn passed(&self, x: &Vector3<f64>) -> [bool; 3] {
        core::array::from_fn(|k| self.sides[k].inward.dot(&(x - self.corners[k])) < 0.0)
    }

    /// The nearest of some edges and their corners; `None` where there are none, or `x` lies on one of them.
    fn rim(&self, x: &Vector3<f64>, of: [bool; 3]) -> Option<View> {
        let away = (0..3).filter(|k| of[*k]).map(|k| {
            let Edge { along, length, .. } = &self.sides[k];
            let from_start = x - self.corners[k];
            let s = along.dot(&from_start);
            if s <= 0.0 {
                from_start
            } else if s >= *length {
                x - self.corners[(k + 1) % 3]
            } else {
                from_start - along * s
            }
        });
        away.min_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared())).and_then(View::around)
    }
}

//! A triangle, seen from in front or from anywhere.
use super::View;
use crate::Extent;
use nalgebra::Vector3;

/// A triangle, counter-clockwise as seen from in front.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    corners: [Vector3<f64>; 3],
    /// Unit normal, towards the front.
    normal: Vector3<f64>,
    /// Per side, from corner `k` to the next: unit vector along it, and its length.
    sides: [(Vector3<f64>, f64); 3],
}

impl Facet {
    pub(super) fn new(corners: [Vector3<f64>; 3], normal: Vector3<f64>) -> Facet {
        let sides = core::array::from_fn(|k| {
            let along = corners[(k + 1) % 3] - corners[k];
            let length = along.norm();
            (if length > 0.0 { along / length } else { along }, length)
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

    /// Seen from in front: its plane where that is straight below, otherwise an edge or a corner.
    pub(super) fn front(&self, x: &Vector3<f64>) -> View {
        let flat = View { height: self.above(x), normal: self.normal };
        if flat.height >= 0.0 && self.is_straight_below(x) {
            return flat;
        }
        self.rim(x).unwrap_or(flat)
    }

    /// Seen from either side.
    pub(super) fn either(&self, x: &Vector3<f64>) -> View {
        let height = self.above(x);
        let flat = View { height: height.abs(), normal: self.normal * 1.0_f64.copysign(height) };
        if self.is_straight_below(x) {
            return flat;
        }
        self.rim(x).unwrap_or(flat)
    }

    /// Whether the point of its plane nearest to `x` is one of the triangle.
    fn is_straight_below(&self, x: &Vector3<f64>) -> bool {
        (0..3).all(|k| self.normal.cross(&self.sides[k].0).dot(&(x - self.corners[k])) >= 0.0)
    }

    /// Its edges and corners; nothing from one of their points.
    fn rim(&self, x: &Vector3<f64>) -> Option<View> {
        let w = self.corners.map(|corner| x - corner);
        let away = (0..3).map(|k| {
            let (along, length) = &self.sides[k];
            let s = along.dot(&w[k]);
            if s <= 0.0 {
                w[k]
            } else if s >= *length {
                w[(k + 1) % 3]
            } else {
                w[k] - along * s
            }
        });
        away.min_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared())).and_then(View::around)
    }
}

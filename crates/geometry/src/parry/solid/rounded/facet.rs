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

/// What of a triangle is nearest to a point. Of several that are equally near but for rounding it is the first: a corner is farther away
/// than its edge next to it, and that than its face, by less than rounding, but their normals differ in half of the digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::parry::solid) enum Foot {
    Face,
    Edge,
    Corner,
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
    pub(super) fn front(&self, x: &Vector3<f64>) -> (View, Foot) {
        let flat = View { height: self.above(x), normal: self.normal };
        let of = if flat.height < 0.0 { [true; 3] } else { self.passed(x) };
        self.rim(x, of).unwrap_or((flat, Foot::Face))
    }

    /// The view from either side.
    pub(super) fn either(&self, x: &Vector3<f64>) -> (View, Foot) {
        let height = self.above(x);
        let flat = View { height: height.abs(), normal: self.normal * 1.0_f64.copysign(height) };
        self.rim(x, self.passed(x)).unwrap_or((flat, Foot::Face))
    }

    /// Beyond which edges the point of its plane nearest to `x` lies: none where that point is in the triangle.
    fn passed(&self, x: &Vector3<f64>) -> [bool; 3] {
        core::array::from_fn(|k| self.sides[k].inward.dot(&(x - self.corners[k])) < 0.0)
    }

    /// The nearest of some edges and their corners; `None` where there are none, or `x` lies on one of them.
    fn rim(&self, x: &Vector3<f64>, of: [bool; 3]) -> Option<(View, Foot)> {
        // per edge the way from what is nearest, and its corner if that is one
        let seen = |k: usize| {
            let Edge { along, length, .. } = &self.sides[k];
            let from_start = x - self.corners[k];
            let s = along.dot(&from_start);
            if s <= 0.0 {
                (from_start, Some(k))
            } else if s >= *length {
                (x - self.corners[(k + 1) % 3], Some((k + 1) % 3))
            } else {
                (from_start - along * s, None)
            }
        };
        let seen: [_; 3] = core::array::from_fn(|k| of[k].then(|| seen(k)));
        let is_edge = |k: usize| matches!(seen[k], Some((_, None)));
        // of an edge, another point is nearer
        let is_passed = |corner: usize| is_edge(corner) || is_edge((corner + 2) % 3);
        let nearest = seen.iter().flatten().filter(|(_, corner)| !corner.is_some_and(is_passed));
        let (away, corner) = nearest.min_by(|a, b| a.0.norm_squared().total_cmp(&b.0.norm_squared()))?;
        Some((View::around(*away)?, if corner.is_some() { Foot::Corner } else { Foot::Edge }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beyond_two_edges_of_an_obtuse_angle_the_one_with_a_foot_on_it_is_nearer_than_the_corner() {
        let corners = [[-1.0, 1.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]].map(Vector3::from);
        for corners in [corners, [corners[1], corners[2], corners[0]], [corners[2], corners[0], corners[1]]] {
            let facet = Facet::new(corners, Vector3::z());
            for exponent in 1..60 {
                let x = Vector3::new(libm::ldexp(1.0, -exponent), -0.6, 0.8);
                let (View { normal, .. }, foot) = facet.front(&x);
                assert_eq!((normal.x, foot), (0.0, Foot::Edge), "{x:?}");
            }
        }
    }
}

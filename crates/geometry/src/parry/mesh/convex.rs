//! Meshes that bound a convex body.
use super::Mesh;
use crate::walls::ConvexBody;
use nalgebra::Vector3;

impl Mesh {
    /// The convex body that it bounds, if it bounds one with few triangles; shrunk by a margin \[L\] where the table is
    /// inside.
    pub(crate) fn body(&self, margin: f64) -> Option<ConvexBody> {
        /// Meshes with more triangles are searched through the tree.
        const MANY: usize = 256;
        if self.triangles.len() > MANY || !self.closed || (self.outside && margin > 0.0) {
            return None;
        }
        let sign = if self.outside { 1.0 } else { -1.0 };
        let mut planes: Vec<[Vector3<f64>; 2]> = vec![];
        for (triangle, normal) in self.triangles.iter().zip(&self.normals) {
            let (corner, outward) = (self.vertices[triangle[0]], normal * sign);
            let is_behind = |vertex: &usize| outward.dot(&(self.vertices[*vertex] - corner)) <= self.slack;
            if !self.triangles.iter().flatten().all(is_behind) {
                return None;
            }
            let through = corner - outward * margin;
            // triangles that belong to one face
            let is_same = |[other, n]: &[Vector3<f64>; 2]| {
                (n - outward).amax() <= 4.0 * f64::EPSILON && n.dot(&(through - other)).abs() <= 0.25 * self.slack
            };
            if !planes.iter().any(is_same) {
                planes.push([through, outward]);
            }
        }
        Some(ConvexBody::Intersection { planes, round: None })
    }
}

//! Where convex solids stand on other walls, with their edges there.
use super::{Convex, Kind};
use crate::parry::first::continue_smoothly;
use nalgebra::Vector3;

impl Convex {
    /// Whether it has edges: several faces that are not tangent to each other.
    pub(in crate::parry::solid) fn has_edges(&self) -> bool {
        matches!(&self.kind, Kind::Intersection(faces) if faces.len() > 1)
    }

    /// Whether it stands at a point of another wall with this outward normal, to within `near`. It does not where a face of its continues
    /// that wall: then it lies behind it.
    ///
    /// Where faces meet at a small angle, they pass by points far beyond their edge within rounding.
    pub(in crate::parry::solid) fn stands_at(&self, x: &Vector3<f64>, normal: &Vector3<f64>, near: f64) -> bool {
        let Kind::Intersection(faces) = &self.kind else { return false };
        if self.off(x) > near {
            return false;
        }
        let (mut count, mut at_edge) = (0, false);
        for (i, face) in faces.iter().enumerate().filter(|(_, face)| face.off(x).abs() <= near) {
            if continue_smoothly(&face.project(x).1, normal) {
                return false;
            }
            count += 1;
            at_edge |= self.edges.get(i).is_none_or(|own| own.iter().any(|edge| edge.distance(x) <= near));
        }
        count == 1 || at_edge
    }
}

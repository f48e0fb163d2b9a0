//! On which side of a mesh a point lies.
use super::{Mesh, two_sided::SAME, winding::Surface};
use crate::plane::slack;
use nalgebra::Vector3;

/// A foot found by parry lies on its triangle to within this fraction of the size.
pub(super) const FOUND: f64 = 1e-12;

impl Mesh {
    pub(super) fn surface(&self) -> Surface<'_> {
        let Mesh { vertices, triangles, normals, tree, .. } = self;
        Surface { vertices, triangles, normals, tree }
    }

    /// Corrects foot, unit normal there and distance of a point, as determined from the triangles through the foot: where
    /// one of these has the table on both sides, the point belongs to the triangle that faces it. A point on triangles between which
    /// there is no table has the normal 0.
    ///
    /// For a closed surface the winding number around the point decides whether it lies in the table at all: two solid
    /// bodies may touch, and a triangle as narrow as rounding, whose normal is arbitrary, may otherwise spoil the side of
    /// all points nearest to its edges.
    pub(crate) fn beside(
        &self,
        point: &Vector3<f64>,
        (foot, normal, distance): (Vector3<f64>, Vector3<f64>, f64),
    ) -> (Vector3<f64>, Vector3<f64>, f64) {
        let away = point - foot;
        let size = away.norm();
        let rounding = slack([self.size, point.amax()]);
        let is_on_it = size <= rounding;
        let (mut nearest, mut height, mut hidden) = (None, f64::NEG_INFINITY, false);
        self.on_sheets(&foot, FOUND * self.size, |k| {
            let this = self.normals[k].dot(&away);
            if is_on_it && !self.is_exposed(k, &foot) {
                hidden = true;
            } else if this > height {
                (nearest, height) = (Some(k), this);
            }
        });
        let (normal, distance) = match nearest {
            None if hidden => return (foot, Vector3::zeros(), -size),
            None => {
                if !self.closed || size == 0.0 || self.is_in_table(point, &normal) == (distance > 0.0) {
                    (normal, distance)
                } else {
                    (if is_on_it { normal } else { away / size.copysign(-distance) }, -distance)
                }
            }
            Some(k) => {
                let in_table = if self.closed { self.is_in_table(point, &self.normals[k]) } else { height >= 0.0 };
                let distance = if in_table { size } else { -size };
                (if is_on_it { self.normals[k] } else { away / size.copysign(distance) }, distance)
            }
        };
        let of_face = self.normal_of_face(&foot, &away, rounding);
        (foot, of_face.map_or(normal, |face| face * 1.0_f64.copysign(face.dot(&normal))), distance)
    }

    /// The normal of the face straight above or below which a point lies, not beside an edge: exact, unlike the direction from the foot
    /// to the point.
    fn normal_of_face(&self, foot: &Vector3<f64>, away: &Vector3<f64>, rounding: f64) -> Option<Vector3<f64>> {
        let reach = FOUND * self.size;
        let (mut face, mut edge) = (None, false);
        self.tree.search(
            |e| e.distance(foot) <= 2.0 * reach,
            |k| {
                if !edge && self.has_on_it(k, foot, reach) {
                    let normal = *face.get_or_insert(self.normals[k]);
                    edge = normal.cross(&self.normals[k]).norm() > SAME;
                }
            },
        );
        face.filter(|normal| !edge && (away - normal * normal.dot(away)).norm() <= rounding)
    }

    /// Whether a point off a closed surface lies on the side away from the table.
    pub(crate) fn is_behind(&self, point: &Vector3<f64>) -> bool {
        self.closed && (self.surface().winding(point, 0, |_| true) == 0) != self.outside
    }

    /// Whether a point beside a triangle with this normal lies in the table of a closed surface.
    fn is_in_table(&self, point: &Vector3<f64>, normal: &Vector3<f64>) -> bool {
        // the axis along which the triangle appears largest
        (self.surface().winding(point, normal.iamax(), |_| true) == 0) == self.outside
    }
}

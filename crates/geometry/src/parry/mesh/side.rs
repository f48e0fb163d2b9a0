//! On which side of a mesh a point lies.
use super::{Mesh, winding::Surface};
use crate::plane::slack;
use nalgebra::Vector3;

/// A foot found by parry lies on its triangle to within this fraction of the size.
pub(super) const FOUND: f64 = 1e-12;

/// Closer to the boundary than this fraction of the size, the difference of a point and its foot has lost more than three
/// digits.
const CLEAR: f64 = 1e-3;

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
        let Some(k) = nearest else {
            if hidden {
                return (foot, Vector3::zeros(), -size);
            }
            if !self.closed || size == 0.0 || self.is_in_table(point, &normal) == (distance > 0.0) {
                return (foot, normal, distance);
            }
            return (foot, if is_on_it { normal } else { away / size.copysign(-distance) }, -distance);
        };
        let in_table = if self.closed { self.is_in_table(point, &self.normals[k]) } else { height >= 0.0 };
        let distance = if in_table { size } else { -size };
        let on_face = in_table && size <= CLEAR * self.size && height >= size - rounding;
        let normal = if on_face || is_on_it { self.normals[k] } else { away / size.copysign(distance) };
        (foot, normal, distance)
    }

    /// Whether a point beside a triangle with this normal lies in the table of a closed surface.
    fn is_in_table(&self, point: &Vector3<f64>, normal: &Vector3<f64>) -> bool {
        // the axis along which the triangle appears largest
        (self.surface().winding(point, normal.iamax(), |_| true) == 0) == self.outside
    }
}

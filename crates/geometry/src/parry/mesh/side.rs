//! On which side of a mesh a point lies.
use super::{Mesh, winding::Surface};
use crate::plane::slack;
use nalgebra::Vector3;

/// What parry finds lies on the triangle on which it should, within this part of the size.
const FOUND: f64 = 1e-12;

/// Closer to the boundary than this part of the size, the difference of a point and its foot has lost more than three
/// digits.
const CLEAR: f64 = 1e-3;

impl Mesh {
    pub(super) fn surface(&self) -> Surface<'_> {
        let Mesh { vertices, triangles, normals, tree, .. } = self;
        Surface { vertices, triangles, normals, tree }
    }

    /// Foot, unit normal there and distance of a point, as found by somebody who asks the triangles through the foot for the
    /// side: where the table is on both sides of one of these, the point lies beside the one that looks at it.
    ///
    /// Around a closed surface its winding number tells whether the table is there at all: two solid bodies may touch, and a
    /// triangle as narrow as rounding, which looks anywhere, may have a say in the side of all that is nearest to its edges.
    pub(crate) fn beside(
        &self,
        point: &Vector3<f64>,
        (foot, normal, distance): (Vector3<f64>, Vector3<f64>, f64),
    ) -> (Vector3<f64>, Vector3<f64>, f64) {
        let away = point - foot;
        let (mut nearest, mut height) = (None, f64::NEG_INFINITY);
        let reach = FOUND * self.size;
        self.on_sheets(&foot, reach, |k| {
            let this = self.normals[k].dot(&away);
            if this > height {
                (nearest, height) = (Some(k), this);
            }
        });
        let size = away.norm();
        let rounding = slack([self.size, point.amax()]);
        let Some(k) = nearest else {
            if !self.closed || size == 0.0 || self.is_in_table(point, &normal) == (distance > 0.0) {
                return (foot, normal, distance);
            }
            return (foot, if size <= rounding { normal } else { away / size.copysign(-distance) }, -distance);
        };
        let in_table = if self.closed { self.is_in_table(point, &self.normals[k]) } else { height >= 0.0 };
        let distance = if in_table { size } else { -size };
        let on_face = in_table && size <= CLEAR * self.size && height >= size - rounding;
        let normal = if on_face || size <= rounding { self.normals[k] } else { away / size.copysign(distance) };
        (foot, normal, distance)
    }

    /// Whether the table of a closed surface is at a point beside a triangle with this normal.
    fn is_in_table(&self, point: &Vector3<f64>, normal: &Vector3<f64>) -> bool {
        // the axis along which the triangle is seen best
        (self.surface().winding(point, normal.iamax(), |_| true) == 0) == self.outside
    }
}

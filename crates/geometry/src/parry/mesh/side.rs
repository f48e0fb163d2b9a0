//! On which side of a mesh a point lies beside triangles with two sides.
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

    /// Foot, unit normal there and distance of a point, as found by somebody who asks just one of several triangles
    /// through the foot for the side: where the table is on both sides of one of these, the point lies beside the one
    /// that looks at it.
    ///
    /// Around a closed surface its winding number tells whether the table is there at all: two solid bodies may touch.
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
        let Some(k) = nearest else { return (foot, normal, distance) };
        let size = away.norm();
        let in_table = if self.closed {
            // the axis along which the triangle is seen best
            let around = self.surface().winding(point, self.normals[k].iamax(), |_| true);
            (around == 0) == self.outside
        } else {
            height >= 0.0
        };
        let distance = if in_table { size } else { -size };
        let rounding = slack([self.size, point.amax()]);
        let on_face = in_table && size <= CLEAR * self.size && height >= size - rounding;
        let normal = if on_face || size <= rounding { self.normals[k] } else { away / size.copysign(distance) };
        (foot, normal, distance)
    }
}

//! On which side of a mesh a point lies.
use super::{Mesh, two_sided::SAME, winding::Surface};
use crate::plane::slack;
use nalgebra::Vector3;

/// The nearest point of a triangle lies on it to within this fraction of the size.
pub(super) const FOUND: f64 = 1e-12;

/// The triangle nearest to a point: the nearest point of it, the unit vector from there to the point, or the normal of the side on which
/// the point lies, and the distance.
pub(crate) struct Nearest {
    pub(crate) triangle: usize,
    pub(crate) foot: Vector3<f64>,
    pub(crate) towards: Vector3<f64>,
    pub(crate) height: f64,
}

impl Mesh {
    pub(super) fn surface(&self) -> Surface<'_> {
        let Mesh { vertices, triangles, normals, tree, .. } = self;
        Surface { vertices, triangles, normals, tree }
    }

    /// The closest point, unit normal there and distance of a point, given the view of the nearest triangle: where several pass through
    /// the foot, and one of these has the table on both sides, the point belongs to the triangle that faces it. A point on triangles
    /// between which there is no table has the normal 0.
    ///
    /// For a closed surface the winding number around the point decides whether it lies in the table at all: two solid
    /// bodies may touch, and a triangle as narrow as rounding, whose normal is arbitrary, may otherwise spoil the side of
    /// all points nearest to its edges. For an open one, `is_in_front` says whether the point is in front of it.
    pub(crate) fn beside(
        &self,
        point: &Vector3<f64>,
        Nearest { triangle, foot, towards, height }: Nearest,
        is_in_front: bool,
    ) -> (Vector3<f64>, Vector3<f64>, f64) {
        let away = towards * height;
        let rounding = slack([self.size, point.amax()]);
        let is_on_it = height <= rounding;
        let (mut facing, mut highest, mut hidden) = (None, f64::NEG_INFINITY, false);
        self.on_sheets(&foot, FOUND * self.size, |k| {
            let this = self.normals[k].dot(&away);
            if is_on_it && !self.is_exposed(k, &foot) {
                hidden = true;
            } else if this > highest {
                (facing, highest) = (Some(k), this);
            }
        });
        if facing.is_none() && hidden {
            return (foot, Vector3::zeros(), -height);
        }
        let wall = &self.normals[facing.unwrap_or(triangle)];
        let is_in_table = if self.closed {
            self.is_in_table(point, wall)
        } else if facing.is_some() {
            highest >= 0.0
        } else {
            is_in_front
        };
        let distance = if is_in_table { height } else { -height };
        let normal = if is_on_it { *wall } else { towards * 1.0_f64.copysign(distance) };
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

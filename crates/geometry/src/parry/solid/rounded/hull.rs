//! Convex polyhedra, and flat triangles.
use super::{Core, View};
use crate::{
    BoxTree, Error, Extent,
    parry::{
        convert::{Frame, from_glam3},
        mesh::across,
        solid::{polyhedron::faces, unsupported},
    },
};
use nalgebra::Vector3;
use parry3d_f64::shape::{ConvexPolyhedron, Triangle};

/// A convex polyhedron as its faces in triangles.
#[derive(Debug)]
pub(super) struct Hull {
    triangles: Vec<Facet>,
    tree: BoxTree<3>,
}

/// A triangle, counter-clockwise as seen from outside.
#[derive(Clone, Copy, Debug)]
struct Facet {
    corners: [Vector3<f64>; 3],
    /// Outward unit normal.
    normal: Vector3<f64>,
    /// Per side, from corner `k` to the next: unit vector along it, and its length.
    sides: [(Vector3<f64>, f64); 3],
}

impl Facet {
    fn new(corners: [Vector3<f64>; 3], normal: Vector3<f64>) -> Facet {
        let sides = core::array::from_fn(|k| {
            let along = corners[(k + 1) % 3] - corners[k];
            let length = along.norm();
            (if length > 0.0 { along / length } else { along }, length)
        });
        Facet { corners, normal, sides }
    }

    fn extent(&self) -> Extent<3> {
        Extent::of(self.corners)
    }

    /// How far a point lies above its plane.
    fn above(&self, x: &Vector3<f64>) -> f64 {
        self.normal.dot(&(x - self.corners[0]))
    }

    /// Seen from in front: its plane where that is straight below, otherwise an edge or a corner.
    fn view(&self, x: &Vector3<f64>) -> View {
        let w = self.corners.map(|corner| x - corner);
        let height = self.normal.dot(&w[0]);
        let flat = View { height, normal: self.normal };
        if height >= 0.0 && (0..3).all(|k| self.normal.cross(&self.sides[k].0).dot(&w[k]) >= 0.0) {
            return flat;
        }
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
        let nearest = away.min_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
        nearest.and_then(View::around).unwrap_or(flat)
    }
}

impl Hull {
    fn new(triangles: Vec<Facet>) -> Hull {
        let tree = BoxTree::new(triangles.iter().map(Facet::extent));
        Hull { triangles, tree }
    }

    pub(super) fn polyhedron(hull: &ConvexPolyhedron, frame: &Frame<3>) -> Hull {
        let fan = |(ring, normal): (Vec<Vector3<f64>>, Vector3<f64>)| {
            let corners = (1..ring.len().saturating_sub(1)).map(|k| [ring[0], ring[k], ring[k + 1]]);
            corners.map(|corners| Facet::new(corners, normal)).collect::<Vec<_>>()
        };
        Hull::new(faces(hull, frame).flat_map(fan).collect())
    }

    /// A triangle as its two sides.
    pub(super) fn triangle(triangle: &Triangle, frame: &Frame<3>) -> Result<Hull, Error> {
        let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(|p| frame.point(&from_glam3(p)));
        let (normal, _) = across([a, b, c]);
        let length = normal.norm();
        if !(length > 0.0 && length.is_finite()) {
            return Err(unsupported("round triangle", "its corners lie on a line: use a capsule"));
        }
        let normal = normal / length;
        Ok(Hull::new(vec![Facet::new([a, b, c], normal), Facet::new([a, c, b], -normal)]))
    }
}

impl Core for Hull {
    fn outer(&self, x: &Vector3<f64>) -> View {
        let nearest = self.tree.nearest(x, f64::INFINITY, |k| self.triangles[k].view(x).height);
        nearest.map_or(View { height: f64::NAN, normal: Vector3::zeros() }, |(_, k)| self.triangles[k].view(x))
    }

    fn inner(&self, x: &Vector3<f64>) -> Option<View> {
        let outmost = self.triangles.iter().max_by(|a, b| a.above(x).total_cmp(&b.above(x)))?;
        let height = outmost.above(x);
        (height <= 0.0).then_some(View { height, normal: outmost.normal })
    }

    fn extent(&self) -> [Vector3<f64>; 2] {
        let Extent { min, max } = Extent::of(self.triangles.iter().flat_map(|t| t.corners));
        [min, max]
    }
}

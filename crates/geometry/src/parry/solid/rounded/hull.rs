//! Convex polyhedra.
use super::{Core, View, facet::Facet};
use crate::{
    BoxTree, Extent,
    parry::{convert::Frame, solid::polyhedron::faces},
};
use nalgebra::Vector3;
use parry3d_f64::shape::ConvexPolyhedron;

/// A convex polyhedron as its faces in triangles.
#[derive(Debug)]
pub(super) struct Hull {
    triangles: Vec<Facet>,
    tree: BoxTree<3>,
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
}

impl Core for Hull {
    fn outer(&self, x: &Vector3<f64>) -> View {
        let nearest = self.tree.nearest(x, f64::INFINITY, |k| self.triangles[k].front(x).height);
        nearest.map_or(View { height: f64::NAN, normal: Vector3::zeros() }, |(_, k)| self.triangles[k].front(x))
    }

    fn inner(&self, x: &Vector3<f64>) -> Option<View> {
        let outmost = self.triangles.iter().max_by(|a, b| a.above(x).total_cmp(&b.above(x)))?;
        let height = outmost.above(x);
        (height <= 0.0).then_some(View { height, normal: outmost.normal() })
    }

    fn extent(&self) -> [Vector3<f64>; 2] {
        let Extent { min, max } = Extent::of(self.triangles.iter().flat_map(Facet::corners));
        [min, max]
    }
}

//! Convex polyhedra.
use super::{
    Core, View,
    facet::{Facet, Foot},
};
use crate::{
    BoxTree, Extent,
    parry::{
        convert::Frame,
        polytope::{Face, Polytope},
    },
};
use nalgebra::Vector3;

/// A convex polyhedron, given by its faces cut into triangles.
#[derive(Debug)]
pub(super) struct Hull {
    triangles: Vec<Facet>,
    tree: BoxTree<3>,
    /// The largest coordinate.
    size: f64,
}

impl Hull {
    pub(super) fn new(polytope: &Polytope, frame: &Frame<3>) -> Hull {
        let fan = |face: &Face| {
            let normal = frame.direction(&face.normal);
            let corners = face.fan().map(|t| t.map(|k| frame.point(&polytope.corners[k])));
            corners.map(|corners| Facet::new(corners, normal)).collect::<Vec<_>>()
        };
        let triangles: Vec<Facet> = polytope.faces.iter().flat_map(fan).collect();
        let tree = BoxTree::new(triangles.iter().map(Facet::extent));
        let size = triangles.iter().flat_map(Facet::corners).map(|corner| corner.amax()).fold(0.0, f64::max);
        Hull { triangles, tree, size }
    }
}

impl Core for Hull {
    fn outer(&self, x: &Vector3<f64>) -> View {
        // a face before its edges, and these before their corners
        let rounding = 8.0 * f64::EPSILON * self.size.max(x.amax());
        let height = |k: usize| {
            let (View { height, .. }, foot) = self.triangles[k].front(x);
            match foot {
                Foot::Face => height,
                Foot::Edge => height + rounding,
                Foot::Corner => height + 2.0 * rounding,
            }
        };
        let nearest = self.tree.nearest(x, f64::INFINITY, height);
        nearest.map_or(View { height: f64::NAN, normal: Vector3::zeros() }, |(_, k)| self.triangles[k].front(x).0)
    }

    fn inner(&self, x: &Vector3<f64>) -> Option<View> {
        let outmost = self.triangles.iter().max_by(|a, b| a.above(x).total_cmp(&b.above(x)))?;
        let height = outmost.above(x);
        (height <= 0.0).then_some(View { height, normal: outmost.normal() })
    }

    fn extent(&self) -> Extent<3> {
        Extent::of(self.triangles.iter().flat_map(Facet::corners))
    }
}

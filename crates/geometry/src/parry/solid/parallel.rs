//! The surface parallel to a mesh: where the centre of a ball is that touches triangles.
use super::{
    super::{distance::Distance, mesh::Mesh},
    Closest,
    rounded::{Plate, Rounded},
};
use crate::{BoxTree, Crossing, Error, Extent, Line, plane::slack, walls::CORNER};
use core::cell::Cell;
use nalgebra::Vector3;

/// What lies on the table's side of a mesh, farther from all triangles than a margin.
#[derive(Debug)]
pub(in crate::parry) struct Parallel {
    /// All that is within the margin of each triangle.
    plates: Vec<Rounded<Plate>>,
    /// Boxes around the plates, and around their triangles.
    tree: BoxTree<3>,
    cores: BoxTree<3>,
    /// The distance from the mesh.
    distance: Distance<3>,
    margin: f64,
    /// How far inside a point may lie and still count as on the surface.
    slack: f64,
    /// Within this distance of a second plate a point lies on an edge.
    near: f64,
}

impl Parallel {
    /// # Errors
    /// [`Error::Parameter`] unless the margin is positive and finite.
    pub(super) fn new(mesh: &Mesh, distance: Distance<3>, margin: f64) -> Result<Parallel, Error> {
        let plate =
            |(t, normal): (&[usize; 3], &Vector3<f64>)| Rounded::plate(t.map(|v| mesh.vertices[v]), *normal, margin);
        let plates = mesh.triangles.iter().zip(&mesh.normals).map(plate).collect::<Result<Vec<_>, _>>()?;
        let tree = BoxTree::new(plates.iter().map(|plate| {
            let [min, max] = plate.extent();
            Extent { min, max }
        }));
        let cores = BoxTree::new(mesh.triangles.iter().map(|t| Extent::of(t.map(|v| mesh.vertices[v]))));
        let size = mesh.vertices.iter().map(Vector3::amax).fold(0.0, f64::max) + margin;
        Ok(Parallel { plates, tree, cores, distance, margin, slack: slack([size]), near: CORNER * size })
    }

    pub(in crate::parry) fn plates(&self) -> &[Rounded<Plate>] {
        &self.plates
    }

    /// The first plate that the path comes to, and when.
    ///
    /// Around small triangles a path is in the boxes of many plates: each is asked only as far as the first hit so far.
    pub(super) fn first(&self, path: &Line<3>) -> Option<(usize, f64)> {
        let limit = Cell::new(f64::INFINITY);
        self.tree.first(path, |k| match self.plates[k].enters(path, limit.get()) {
            Some(time) => {
                limit.set(time.min(limit.get()));
                Crossing { num: time, den: 1.0 }
            }
            None => Crossing::NEVER,
        })
    }

    /// The plates within rounding of a point that lies on one: their numbers and unit normals there.
    fn touched(&self, point: &Vector3<f64>, mut visit: impl FnMut(usize, Vector3<f64>)) {
        let near = |triangle: &Extent<3>| triangle.distance(point) <= self.margin + 2.0 * self.near;
        self.cores.search(near, |k| {
            let (foot, normal) = self.plates[k].land(point);
            if (point - foot).dot(&normal) <= self.near {
                visit(k, normal);
            }
        });
    }

    /// A point brought onto a plate, the unit normal there, and whether the ball touches another triangle there as well.
    ///
    /// Where the normals of two plates through a point form a small angle φ, either φ is that of an edge in which the surface is bent
    /// inwards, or the foot on one triangle is an edge to which the other foot is near: then that plate is `m φ²/2` off, with the
    /// margin `m`. What is so within rounding counts as no corner, with a factor of four.
    pub(super) fn land(&self, k: usize, x: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>, bool) {
        let (point, normal) = self.plates[k].land(x);
        let mut corner = false;
        self.touched(&point, |_, its| corner |= (its - normal).norm_squared() * self.margin > 8.0 * self.near);
        (point, normal, corner)
    }

    /// Whether a point of a plate is one of the surface: nearer to no other triangle, nor behind the mesh. What lies around an edge or
    /// a corner is that of the first of its plates.
    pub(in crate::parry) fn exposes(&self, k: usize, point: &Vector3<f64>) -> bool {
        if self.closest(point).distance < -self.slack {
            return false;
        }
        let mut first = k;
        self.touched(point, |other, _| first = first.min(other));
        first == k
    }

    pub(super) fn closest(&self, point: &Vector3<f64>) -> Closest {
        let (foot, normal, distance) = self.distance.closest(point);
        Closest { distance: distance - self.margin, point: foot + normal * self.margin, normal }
    }

    /// A box around it.
    pub(super) fn extent(&self) -> [Vector3<f64>; 2] {
        let [low, high] = self.distance.extent();
        [low.add_scalar(-self.margin), high.add_scalar(self.margin)]
    }
}

//! The surface parallel to a mesh: the positions of the centre of a ball that touches triangles.
use super::{
    super::{distance::Distance, mesh::Mesh},
    Closest,
    bound::{Aim, Bound},
    nearest::{closest, nearest},
    rounded::{Foot, Plate, Rounded},
    strata::{Stratum, strata},
};
use crate::{
    BoxTree, Crossing, Error, Extent, Line,
    plane::slack,
    walls::{CORNER, ConvexBody},
};
use core::cell::Cell;
use nalgebra::Vector3;

/// What lies on the table's side of a mesh, farther from all triangles than a margin.
#[derive(Debug)]
pub(super) struct Parallel {
    mesh: Mesh,
    /// For each triangle, all points within the margin of it.
    plates: Vec<Rounded<Plate>>,
    /// Balls around the plates, and a tree of boxes.
    balls: Vec<Bound>,
    tree: BoxTree<3>,
    /// The distance from the mesh.
    distance: Distance<3>,
    margin: f64,
    /// How far inside a point may lie and still count as on the surface.
    slack: f64,
    size: f64,
    /// A point within this distance of a second plate lies on an edge.
    near: f64,
}

impl Parallel {
    /// # Errors
    /// [`Error::Length`] unless the margin is positive and at most 10¹⁵⁰.
    pub(super) fn new(mesh: Mesh, distance: Distance<3>, margin: f64) -> Result<Parallel, Error> {
        let plate =
            |(t, normal): (&[usize; 3], &Vector3<f64>)| Rounded::plate(t.map(|v| mesh.vertices[v]), *normal, margin);
        let plates = mesh.triangles.iter().zip(&mesh.normals).map(plate).collect::<Result<Vec<_>, _>>()?;
        let tree = BoxTree::new(plates.iter().map(Rounded::extent));
        let balls = mesh.triangles.iter().map(|t| Bound::around(t.map(|v| mesh.vertices[v]), margin)).collect();
        let size = mesh.vertices.iter().map(Vector3::amax).fold(0.0, f64::max) + margin;
        Ok(Parallel { mesh, plates, balls, tree, distance, margin, slack: slack([size]), size, near: CORNER * size })
    }

    /// The first plate that the path comes to, and when.
    ///
    /// Around small triangles a path is in the boxes of many plates: each is tested only up to the first hit so far, and only if the
    /// ball around it is entered before that.
    pub(super) fn first(&self, path: &Line<3>) -> Option<(usize, f64)> {
        let limit = Cell::new(f64::INFINITY);
        let aim = Aim::new(path, self.size);
        self.tree.first(path, |k| {
            let until = limit.get();
            if aim.misses(&self.balls[k], until) {
                return Crossing::NEVER;
            }
            let Some(time) = self.plates[k].enters(path, until) else { return Crossing::NEVER };
            limit.set(time.min(until));
            Crossing { num: time, den: 1.0 }
        })
    }

    /// The plates within rounding of a point that lies on one: their numbers and unit normals there.
    fn touched(&self, point: &Vector3<f64>, mut visit: impl FnMut(usize, Vector3<f64>)) {
        let near = |triangle: &Extent<3>| triangle.distance(point) <= self.margin + 2.0 * self.near;
        self.mesh.tree().search(near, |k| {
            let (foot, normal) = self.plates[k].land(point);
            if (point - foot).dot(&normal) <= self.near {
                visit(k, normal);
            }
        });
    }

    /// A point projected onto a plate, the unit normal there, and whether the ball touches another triangle there as well.
    ///
    /// Where the normals of two plates through a point form a small angle φ, either φ is the angle of an edge at which the surface is
    /// bent inwards, or the foot on one triangle is on an edge near the other foot: then that plate is off by `m φ²/2`, with the
    /// margin `m`. If that is within rounding (with a factor of four), it does not count as a corner.
    pub(super) fn land(&self, k: usize, x: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>, bool) {
        let (point, normal) = self.plates[k].land(x);
        let (mut corner, mut flat, mut edge) = (false, None, None);
        self.touched(&point, |other, its| {
            corner |= (its - normal).norm_squared() * self.margin > 8.0 * self.near;
            if its == self.mesh.normals[other] {
                flat = Some(other);
            } else if self.plates[other].foot(&point) == Foot::Edge {
                edge = Some(other);
            }
        });
        let edge = edge.filter(|_| self.plates[k].foot(&point) == Foot::Corner);
        let nearer = flat.or(edge).filter(|_| !corner);
        let (point, normal) = nearer.map_or((point, normal), |other| self.plates[other].land(&point));
        (point, normal, corner)
    }

    /// The convex body with the table inside that it bounds, if it does and has few faces.
    pub(super) fn body(&self) -> Option<ConvexBody> {
        self.mesh.body(self.margin)
    }

    /// The parts of the surface.
    pub(super) fn strata(&self) -> Vec<Stratum> {
        strata(&self.mesh)
    }

    /// The area of a part with its surroundings, where `unit` is the inverse of the unit of length.
    pub(super) fn area(&self, stratum: &Stratum, unit: f64) -> f64 {
        stratum.area(&self.mesh, self.margin, unit)
    }

    /// A random point of a part and the unit normal there, if the point is on the surface: nearer to no other triangle, and not
    /// behind the mesh. A point that belongs to several triangles counts for the first of them. A triangle seen from behind is not one:
    /// it only coincides with the one in front.
    pub(super) fn draw(
        &self,
        stratum: &Stratum,
        uniform: &mut dyn FnMut() -> f64,
    ) -> Option<(Vector3<f64>, Vector3<f64>)> {
        let (point, normal) = self.plates[stratum.triangle].land(&stratum.draw(&self.mesh, self.margin, uniform)?);
        // the first answer comes a hundred times as fast, and where the ball reaches little of the surface, nearly all points get it
        if self.is_clearly_hidden(&point) || self.closest(&point).distance < -self.slack {
            return None;
        }
        let mut first = stratum.triangle;
        self.touched(&point, |other, its| {
            if its != -self.mesh.normals[other] {
                first = first.min(other);
            }
        });
        (first == stratum.triangle).then_some((point, normal))
    }

    /// Whether a point is nearer to a triangle than the margin, by more than any rounding of distances, or lies behind a closed mesh.
    fn is_clearly_hidden(&self, point: &Vector3<f64>) -> bool {
        let deep = self.margin - 4.0 * self.slack;
        let is_deep = self.mesh.tree().nearest(point, deep, |k| self.plates[k].core_distance(point)).is_some();
        is_deep || self.mesh.is_behind(point)
    }

    pub(super) fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    pub(super) fn margin(&self) -> f64 {
        self.margin
    }

    /// Whether a point lies no nearer to any triangle than the margin, on whichever side.
    pub(super) fn is_clear(&self, point: &Vector3<f64>) -> bool {
        let guess = self.distance.probe(point).distance;
        nearest(&self.mesh, guess, point).height >= self.margin - self.slack
    }

    pub(super) fn closest(&self, point: &Vector3<f64>) -> Closest {
        let Closest { distance, point, normal } = closest(&self.mesh, &self.distance, point);
        Closest { distance: distance - self.margin, point: point + normal * self.margin, normal }
    }

    /// A box around it.
    pub(super) fn extent(&self) -> Extent<3> {
        let Extent { min, max } = self.distance.extent();
        Extent { min: min.add_scalar(-self.margin), max: max.add_scalar(self.margin) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{super::SolidSpec, Body};
    use crate::{parry::Side, random};

    /// Of points drawn on the parts of the parallel surface of a pyramid, with one corner of its base at a height: how many are nearer
    /// to the mesh than the margin or behind it, and how many of these are told at once.
    fn hidden_and_told(height: f64, margin: f64, side: Side) -> [usize; 2] {
        let vertices = vec![[0.0; 3], [2.0, 0.0, height], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0], [1.0, 1.0, 1.0]];
        let triangles = vec![[3, 2, 1], [3, 1, 0], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
        let solid = SolidSpec::TriMesh { vertices, triangles, margin }.solid([0.0; 3], side).unwrap();
        let [Body::Parallel(parallel)] = &solid.members[..] else { panic!() };
        let mut uniform = random::uniform(1);
        let [mut hidden, mut told] = [0, 0];
        for stratum in parallel.strata() {
            for _ in 0..500 {
                let Some(drawn) = stratum.draw(parallel.mesh(), margin, &mut uniform) else { continue };
                let (point, _) = parallel.plates[stratum.triangle].land(&drawn);
                let (is_hidden, is_told) =
                    (parallel.closest(&point).distance < -parallel.slack, parallel.is_clearly_hidden(&point));
                assert!(is_hidden || !is_told, "{point:?}");
                hidden += usize::from(is_hidden);
                told += usize::from(is_told);
            }
        }
        [hidden, told]
    }

    #[test]
    fn a_point_out_of_reach_of_the_ball_is_told_without_the_exact_distance_unless_rounding_decides() {
        for side in [Side::Inside, Side::Outside] {
            for height in [0.0, 1.0, 100.0, 1e4] {
                let [hidden, told] = hidden_and_told(height, 0.05, side);
                assert!(hidden > 100, "{side:?}, {height}: {hidden}");
                assert_eq!(hidden, told, "{side:?}, {height}");
            }
        }
    }
}

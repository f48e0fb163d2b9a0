//! What of a mesh is nearest to a point.
use super::{
    super::{
        distance::{Distance, to_unit},
        mesh::{Mesh, Nearest},
    },
    Closest,
    rounded::{Core, Plate, View},
};
use nalgebra::Vector3;

/// A fraction of the distance and of the size by which parry's distances are off at most, but for needles: beside these the search may
/// take a second turn.
const OFF: f64 = 1e-9;

/// The closest point of a mesh; `distance` is parry's.
///
/// Distances from triangles that are known by their planes and sides are correct to rounding however narrow these are; parry's lose the
/// digits by which a triangle is longer than wide. So parry tells where to look, and on which side of an open mesh the point lies.
pub(super) fn closest(mesh: &Mesh, distance: &Distance<3>, point: &Vector3<f64>) -> Closest {
    let guess = distance.probe(point).distance;
    let (point, normal, distance) = mesh.beside(point, nearest(mesh, guess, point), guess >= 0.0);
    Closest { distance, point, normal }
}

/// The triangle nearest to a point, given about its distance.
pub(super) fn nearest(mesh: &Mesh, guess: f64, point: &Vector3<f64>) -> Nearest {
    // powers of two, so that no square over- or underflows
    let unit = to_unit(mesh.tree().size());
    let view = |k: usize| {
        let corners = mesh.triangles[k].map(|v| mesh.vertices[v] * unit);
        Plate::new(corners, mesh.normals[k]).outer(&(point * unit))
    };
    let within = |bound: f64| mesh.tree().nearest(point, bound, |k| view(k).height / unit);
    let bound = guess.abs() + OFF * (guess.abs() + mesh.tree().size());
    let triangle = within(bound).or_else(|| within(f64::INFINITY)).map_or(0, |(_, triangle)| triangle);
    let View { height, normal } = view(triangle);
    let height = height / unit;
    Nearest { triangle, foot: point - normal * height, towards: normal, height }
}

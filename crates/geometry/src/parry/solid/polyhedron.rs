//! The faces of a convex polyhedron in its place.
use super::super::{
    convert::{Frame, from_glam3},
    distance::to_unit,
};
use nalgebra::Vector3;
use parry3d_f64::{math::Vector as Glam, shape::ConvexPolyhedron};

/// The corners of each face, counter-clockwise as seen from outside, and its outward unit normal.
pub(in crate::parry) fn faces(
    hull: &ConvexPolyhedron,
    frame: &Frame<3>,
) -> impl Iterator<Item = (Vec<Vector3<f64>>, Vector3<f64>)> {
    let points: Vec<Vector3<f64>> = hull.points().iter().map(|&p| frame.point(&from_glam3(p))).collect();
    hull.faces().iter().map(move |face| {
        let first = face.first_vertex_or_edge as usize;
        let count = face.num_vertices_or_edges as usize;
        let mut ring: Vec<Vector3<f64>> =
            hull.vertices_adj_to_face()[first..first + count].iter().map(|&v| points[v as usize]).collect();
        // Newell: the mean over the corners, accurate for slender faces too
        let origin = ring[0];
        let unit = to_unit(ring.iter().map(|p| (p - origin).amax()).fold(0.0, f64::max));
        let from = |k: usize| (ring[k] - origin) * unit;
        let area = (1..count.saturating_sub(1)).map(|k| from(k).cross(&from(k + 1))).sum::<Vector3<f64>>();
        let known: Glam = face.normal;
        let outward = frame.direction(&from_glam3(known));
        let inwards = area.dot(&outward) < 0.0;
        let normal = if inwards { -area } else { area };
        if inwards {
            ring.reverse();
        }
        let length = normal.norm();
        (ring, if length > 0.0 { normal / length } else { outward })
    })
}

//! The way round the rim of an open surface.
use super::{Body, Solid};
use crate::parry::mesh::OnRim;
use nalgebra::Vector3;

impl Solid {
    /// Three positions, for each place on the rims of open surfaces of triangles, through which the centre of the ball (or the point)
    /// comes round from the front to the back: in front of the place, beyond the rim, and behind. Left out are places where the surface
    /// itself blocks the way.
    pub(in crate::parry) fn ways_round(&self) -> impl Iterator<Item = [Vector3<f64>; 3]> {
        let meshes = self.members.iter().filter_map(|body| match body {
            Body::Mesh(mesh, _) => Some((mesh, 0.0, None)),
            Body::Parallel(parallel) => Some((parallel.mesh(), parallel.margin(), Some(parallel))),
            _ => None,
        });
        meshes.flat_map(|(mesh, margin, parallel)| {
            let round = move |OnRim { point, normal, outward }| [normal, outward, -normal].map(|u| point + u * margin);
            let is_free = move |way: &[Vector3<f64>; 3]| parallel.is_none_or(|it| way.iter().all(|x| it.is_clear(x)));
            mesh.rim().map(round).filter(is_free)
        })
    }
}

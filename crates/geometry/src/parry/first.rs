//! The first of several walls, and the edges between them.
use crate::{Hit, Line, walls::CORNER};

/// The first of the hits of a path with several walls: a corner where within rounding another one with another normal is hit as well.
pub(super) fn first_of(path: &Line<3>, hits: impl Iterator<Item = Hit<3>>) -> Option<Hit<3>> {
    /// Normals that differ by less belong to walls that continue one another. Next to where one is tangent to another, with a radius of
    /// `r`, both are hit within rounding as long as their normals differ by less than `4 √(ε size/r)`: radii from 10⁻⁵ of the size on.
    const SMOOTH: f64 = 1e-5;
    hits.reduce(|a, b| {
        let [first, second] = if b.time < a.time { [b, a] } else { [a, b] };
        // how far in front of the second wall the path meets the first
        let apart = (first.time - second.time) * path.velocity.dot(&second.normal);
        let size = path.point.amax().max(first.point.amax());
        let edge = apart.abs() <= CORNER * size && (first.normal - second.normal).norm() > SMOOTH;
        Hit { corner: first.corner || edge, ..first }
    })
}

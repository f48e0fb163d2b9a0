//! The first of several walls, and the edges between them.
use super::Solid;
use crate::{Boundary, BoxTree, Crossing, Hit, Line, plane::slack, walls::CORNER};
use core::cell::Cell;
use nalgebra::Vector3;

/// The first of the hits of a path with several walls; a corner if another wall with another normal is hit within rounding as well.
pub(super) fn first_of(path: &Line<3>, hits: impl Iterator<Item = Hit<3>>) -> Option<Hit<3>> {
    hits.reduce(|a, b| sooner(path, a, b))
}

/// Whether walls with these unit normals continue one another.
pub(super) fn continue_smoothly(a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    /// Where a wall with the radius `r` is tangent to another, both are hit within rounding as long as their normals differ by less than
    /// `4 √(ε size/r)`: the bound covers radii from 10⁻⁵ of the size on.
    const SMOOTH: f64 = 1e-5;
    (a - b).norm() <= SMOOTH
}

/// The sooner of two hits; for equal times the one with the lower number.
pub(super) fn sooner(path: &Line<3>, a: Hit<3>, b: Hit<3>) -> Hit<3> {
    let b_is_first = b.time < a.time || (b.time == a.time && b.piece < a.piece);
    let [first, second] = if b_is_first { [b, a] } else { [a, b] };
    // how far in front of the second wall the path meets the first
    let apart = (first.time - second.time) * path.velocity.dot(&second.normal);
    let size = path.point.amax().max(first.point.amax());
    let near = CORNER * size;
    let edge = apart.abs() <= near && !continue_smoothly(&first.normal, &second.normal);
    let same_place = || (first.point - second.point).amax() <= near;
    Hit { corner: first.corner || edge || (second.corner && same_place()), ..first }
}

/// The first of the hits of a path with numbered solids, whose boxes are those of the tree.
///
/// Walls that meet within rounding of the hit are among those whose boxes the path enters until then. Two-sided triangles (`sheets`)
/// are an exception: where one meets the wall that is hit, there is a corner whichever way the path goes.
pub(super) fn first_in<'a>(
    tree: &BoxTree<3>,
    sheets: bool,
    path: &Line<3>,
    solid: impl Fn(usize) -> (usize, &'a Solid),
) -> Option<Hit<3>> {
    let first = Cell::new(None);
    tree.first(path, |place| {
        let (piece, solid) = solid(place);
        let Some(hit) = solid.first_hit(path) else { return Crossing::NEVER };
        let hit = Hit { piece, ..hit };
        first.set(Some(first.get().map_or(hit, |so_far| sooner(path, so_far, hit))));
        Crossing { num: hit.time, den: 1.0 }
    });
    let hit = first.get().filter(|_| sheets).filter(|hit: &Hit<3>| !hit.corner);
    let Some(hit) = hit else { return first.get() };
    let mut corner = false;
    let reach = slack([tree.size(), hit.point.amax()]);
    tree.search(
        |e| e.distance(&hit.point) <= 4.0 * reach,
        |k| corner |= solid(k).1.meets_a_sheet(&hit.point, &hit.normal),
    );
    Some(Hit { corner, ..hit })
}

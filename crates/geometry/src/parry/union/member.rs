//! What a member of a union hides of the others.
use super::Part;
use crate::{BoxTree, Extent, Landing, plane::key};
use nalgebra::Vector2;
use std::collections::HashMap;

/// The interior of a member, whose boundary is searched by boxes.
pub(super) struct Member<'a> {
    number: usize,
    /// The parts that bound it.
    boundary: &'a [Part],
    /// The boxes around them.
    tree: BoxTree,
    /// Everything farther from this than rounding is outside the member.
    pub(super) reach: Extent,
}

impl Member<'_> {
    /// The member of that number, of the parts that bound it.
    pub(super) fn new(number: usize, boundary: &[Part]) -> Member<'_> {
        let extents = boundary.iter().map(|p| p.extent);
        let around = extents.clone().fold(Extent::EMPTY, Extent::union);
        let reach = if is_bounded(boundary) { around } else { Extent::WHOLE };
        Member { number, boundary, tree: BoxTree::new(extents), reach }
    }

    /// Whether a part of another member, with this point in its middle, is inside, or lies on its boundary and is not the one of both that
    /// bounds the union.
    pub(super) fn hides(&self, part: &Part, middle: &Vector2<f64>, near: f64) -> bool {
        let feet = self.nearest(middle, near);
        if feet.iter().all(|(distance, _)| *distance > near) {
            // of several equally near pieces, as at a vertex, the one seen least obliquely determines the side
            let heights = feet.iter().map(|(_, foot)| (middle - foot.point).dot(&foot.normal));
            return heights.reduce(|a, b| if b.abs() > a.abs() { b } else { a }).is_some_and(|height| height >= 0.0);
        }
        let normal = feet.iter().fold(Vector2::zeros(), |sum, (_, foot)| sum + foot.normal);
        let is_alike = part.solid && part.piece.closest(middle).normal.dot(&normal) > 0.0;
        !(is_alike && part.member < self.number)
    }

    /// The feet on the boundary that are nearest to a point within rounding, each with its distance, in the order of the parts.
    fn nearest(&self, point: &Vector2<f64>, near: f64) -> Vec<(f64, Landing)> {
        let foot = |k: usize| {
            let landing = self.boundary[k].piece.closest(point);
            ((landing.point - point).norm(), landing)
        };
        let Some((distance, _)) = self.tree.nearest(point, f64::INFINITY, |k| foot(k).0) else { return vec![] };
        // the distance from a box is rounded, too
        let mut numbers = vec![];
        self.tree.search(|e| e.distance(point) <= distance + 2.0 * near, |k| numbers.push(k));
        numbers.sort_unstable();
        let mut feet: Vec<_> = numbers.into_iter().map(foot).collect();
        let least = feet.iter().map(|(d, _)| *d).fold(f64::INFINITY, f64::min);
        feet.retain(|(d, _)| *d <= least + near);
        feet
    }
}

/// Whether a boundary consists of closed loops. (A half-space or a height field reaches beyond the box around its boundary.)
fn is_bounded(parts: &[Part]) -> bool {
    let mut balance: HashMap<[u64; 2], i32> = HashMap::new();
    for [start, end] in parts.iter().filter_map(|p| p.piece.ends()) {
        *balance.entry(key(start)).or_default() += 1;
        *balance.entry(key(end)).or_default() -= 1;
    }
    parts.iter().all(|p| p.extent.is_finite()) && balance.values().all(|&b| b == 0)
}

//! Straight walls that coincide, one with the table on this side and one with it on the other.
use crate::plane::{dot, slack};
use nalgebra::Vector2;

/// Directions that differ by less than this (radians) may be one: rounding of vertices turns short pieces by more than an ulp.
const SAME_DIRECTION: f64 = 1e-9;

/// A straight piece on its line, which is told by the normal in the upper half plane.
#[derive(Clone, Copy, Debug)]
struct Side {
    number: usize,
    normal: [f64; 2],
    /// Whether the table is on the side of that normal.
    upward: bool,
    /// The line's distance from the origin along the normal, and where on it the piece begins and ends.
    height: f64,
    from: f64,
    to: f64,
    rounding: f64,
}

impl Side {
    fn of(number: usize, [a, b]: [Vector2<f64>; 2]) -> Option<Side> {
        let ([x, y], _) = crate::plane::direction(a.into(), b.into())?;
        let upward = x > 0.0 || (x == 0.0 && y < 0.0);
        let normal = if upward { [-y, x] } else { [y, -x] };
        let along = [normal[1], -normal[0]];
        let [p, q] = [a, b].map(|end| dot(end.into(), along));
        let rounding = slack([a.x, a.y, b.x, b.y]);
        Some(Side { number, normal, upward, height: dot(a.into(), normal), from: p.min(q), to: p.max(q), rounding })
    }

    /// Whether this side and another one of the same line have a stretch in common.
    fn overlaps(&self, other: &Side) -> bool {
        self.to.min(other.to) - self.from.max(other.from) > self.rounding.max(other.rounding)
    }
}

/// The numbers of those straight pieces that coincide with another one, or in part, which has the table on the other side.
///
/// `n log n` operations for pieces in general position.
pub(super) fn two_sided(segments: impl Iterator<Item = (usize, [Vector2<f64>; 2])>) -> Vec<usize> {
    let mut sides: Vec<Side> = segments.filter_map(|(number, ends)| Side::of(number, ends)).collect();
    sides.sort_by(|a, b| a.normal[0].total_cmp(&b.normal[0]));
    let mut found = vec![];
    for parallel in sides.chunk_by_mut(|a, b| b.normal[0] - a.normal[0] <= SAME_DIRECTION) {
        if parallel.len() < 2 {
            continue;
        }
        parallel.sort_by(|a, b| a.height.total_cmp(&b.height));
        for line in parallel.chunk_by_mut(|a, b| b.height - a.height <= a.rounding.max(b.rounding)) {
            line.sort_by(|a, b| a.from.total_cmp(&b.from));
            // those that reach so far
            let mut open: Vec<Side> = vec![];
            for side in line.iter() {
                open.retain(|other| other.to > side.from);
                for other in open.iter().filter(|other| other.upward != side.upward && other.overlaps(side)) {
                    found.extend([other.number, side.number]);
                }
                open.push(*side);
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

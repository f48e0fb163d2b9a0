//! Triangles without area, whose long side adjoins other triangles than the two short ones do.
use super::across;
use crate::{Error, edges::sides};
use core::cmp::Reverse;
use nalgebra::Vector3;
use std::collections::{BinaryHeap, HashMap};

/// Most splits per triangle: where several triangles without area lie on one another, each may be split a few times.
const SPLITS: usize = 16;

/// Whether a triangle has no area, or none but for what rounding makes of its sides.
pub(super) fn is_flat(corners: [Vector3<f64>; 3]) -> bool {
    let (area, unit) = across(corners);
    let [a, b, c] = corners;
    let rounded = ((b - a) / unit).cross(&((c - a) / unit));
    !(area.norm_squared() > 0.0 && rounded.norm_squared() > 0.0)
}

/// The triangles of positive area of a surface, split so that each side is shared with what lies beyond it, and for each the given
/// triangle that it is part of.
///
/// A triangle without area, with a corner `c` on its long side from `a` to `b`, is removed, and the triangle `b a s` beyond that side is
/// split at `c`: into `b c s`, which keeps its place, and `c a s`, at the end. Otherwise rounding would leave a gap between `a b` and
/// `a c b`. The longest is removed first: then what lies beyond the long side of the next has an area, unless the two share their long
/// side. So `n` of them take `n log n` steps, wherever they lie.
///
/// # Errors
/// [`Error::Triangle`] where this does not terminate.
pub(super) fn split(
    vertices: &[Vector3<f64>],
    mut triangles: Vec<[usize; 3]>,
) -> Result<(Vec<[usize; 3]>, Vec<usize>), Error> {
    let is_flat = |t: &[usize; 3]| is_flat(t.map(|v| vertices[v]));
    let is_point = |[a, b, c]: &[usize; 3]| a == b || b == c || c == a;
    let lengths = |t: &[usize; 3]| {
        sides(*t).map(|[a, b]| {
            let [x, y, z] = (vertices[b] - vertices[a]).into();
            libm::hypot(libm::hypot(x, y), z)
        })
    };
    // ordered by length (the bits of positive numbers), then by index
    let size = |t: &[usize; 3]| lengths(t).into_iter().fold(0.0, f64::max).to_bits();
    let entry = |k: usize, t: &[usize; 3]| (size(t), Reverse(k));
    let mut flat: BinaryHeap<_> =
        triangles.iter().enumerate().filter(|(_, t)| is_flat(t)).map(|(k, t)| entry(k, t)).collect();
    let mut origin: Vec<usize> = (0..triangles.len()).collect();
    if flat.is_empty() {
        return Ok((triangles, origin));
    }
    let mut at: HashMap<[usize; 2], usize> = HashMap::new();
    for (k, t) in triangles.iter().enumerate().filter(|(_, t)| !is_point(t)) {
        at.extend(sides(*t).map(|side| (side, k)));
    }
    let mut gone = vec![false; triangles.len()];
    let mut left = SPLITS * flat.len();
    while let Some((longest, Reverse(k))) = flat.pop() {
        let t = triangles[k];
        // a triangle split since then is in the queue again, if need be
        if gone[k] || !is_flat(&t) || size(&t) != longest {
            continue;
        }
        let lengths = lengths(&t);
        let long = (0..3).fold(0, |best, i| if lengths[i] > lengths[best] { i } else { best });
        let [a, b, c] = [0, 1, 2].map(|i| t[(long + i) % 3]);
        let beyond = at.get(&[b, a]).copied().filter(|&other| !is_point(&t) && !gone[other]);
        gone[k] = true;
        let Some(beyond) = beyond else { continue };
        if left == 0 {
            return Err(Error::Triangle {
                triangle: origin[k],
                problem: "has no area, and neither do others around it: remove them",
            });
        }
        left -= 1;
        let s = triangles[beyond].into_iter().find(|v| *v != a && *v != b).unwrap_or(c);
        for side in [[a, b], [b, a]] {
            at.remove(&side);
        }
        // one is the other reversed: nothing lies between
        if s == c {
            gone[beyond] = true;
            continue;
        }
        let parts = [[b, c, s], [c, a, s]];
        triangles[beyond] = parts[0];
        triangles.push(parts[1]);
        gone.push(false);
        origin.push(origin[beyond]);
        for (part, number) in parts.iter().zip([beyond, triangles.len() - 1]) {
            at.extend(sides(*part).map(|side| (side, number)));
            if is_flat(part) {
                flat.push(entry(number, part));
            }
        }
    }
    let is_left = |k: &usize| !gone[*k];
    let left: Vec<usize> = (0..triangles.len()).filter(is_left).collect();
    Ok(left.iter().map(|&k| (triangles[k], origin[k])).unzip())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_triangle_at_fault_is_one_of_those_given() {
        // all on one line, with two vertices at either end: the parts of the last triangle are as long as itself
        let vertices = [2.0, 2.0, 8.0, 8.0].map(|x| Vector3::new(x, 0.0, 0.0));
        let triangles = vec![[0, 1, 2], [2, 0, 3], [2, 3, 1], [0, 3, 1], [3, 2, 1]];
        let error = split(&vertices, triangles).unwrap_err();
        assert!(matches!(error, Error::Triangle { triangle: 4, .. }), "{error}");
    }
}

//! How often triangles wind around a point.
use crate::{BoxTree, Extent};
use nalgebra::Vector3;

/// Triangles in space, counter-clockwise on one side.
#[derive(Clone, Copy)]
pub(super) struct Surface<'a> {
    pub(super) vertices: &'a [Vector3<f64>],
    pub(super) triangles: &'a [[usize; 3]],
    pub(super) normals: &'a [Vector3<f64>],
    pub(super) tree: &'a BoxTree<3>,
}

impl Surface<'_> {
    /// How often the triangles selected by `asked`, which must form a closed surface, wind around a point: the number of them that a
    /// ray along the axis crosses to their counter-clockwise side, less the number crossed to the other side.
    ///
    /// Neighbours agree on which side of the ray the edge between them passes, so nothing leaks.
    pub(super) fn winding(&self, point: &Vector3<f64>, axis: usize, asked: impl Fn(usize) -> bool) -> i32 {
        let axes = [axis, (axis + 1) % 3, (axis + 2) % 3];
        let [_, i, j] = axes;
        let ahead = |e: &Extent<3>| {
            let within = |i: usize| e.min[i] <= point[i] && point[i] <= e.max[i];
            within(i) && within(j) && e.max[axis] >= point[axis]
        };
        let mut winding = 0;
        self.tree.search(ahead, |k| {
            if !asked(k) {
                return;
            }
            let corners = self.triangles[k].map(|v| self.vertices[v]);
            let levels = [0, 1, 2].map(|s| Level::of(axes, point, &corners[s], &corners[(s + 1) % 3]));
            let levels = || levels.iter().flatten();
            let around: i32 = levels().map(|level| level.passes(point[i])).sum();
            if around != 0 && self.is_ahead(k, point, axis, levels().map(|level| level.along)) {
                winding += around;
            }
        });
        winding
    }

    /// Whether the line through a point along an axis meets a triangle ahead of the point, given the positions along the line of the
    /// two sides of the triangle between which it passes.
    fn is_ahead(&self, k: usize, point: &Vector3<f64>, axis: usize, mut sides: impl Iterator<Item = f64>) -> bool {
        // a plane parallel to the axis may be met anywhere, within rounding, but not outside the triangle
        let (Some(a), Some(b)) = (sides.next(), sides.next()) else { return false };
        if a > point[axis] && b > point[axis] {
            return true;
        }
        if a < point[axis] && b < point[axis] {
            return false;
        }
        let corner = self.vertices[self.triangles[k][0]];
        let normal = &self.normals[k];
        (normal.dot(&(point - corner)) < 0.0) == (normal[axis] > 0.0)
    }
}

/// Where the side of a triangle, seen along an axis, is at the height of a point.
struct Level {
    upwards: bool,
    at: f64,
    /// Position along the axis.
    along: f64,
}

impl Level {
    /// The place on the side from `a` to `b`, if there is one.
    fn of([axis, i, j]: [usize; 3], point: &Vector3<f64>, a: &Vector3<f64>, b: &Vector3<f64>) -> Option<Level> {
        let upwards = a[j] <= point[j] && point[j] < b[j];
        let downwards = b[j] <= point[j] && point[j] < a[j];
        if !(upwards || downwards) {
            return None;
        }
        // computed from the lower end, whatever the direction, so it is the same for both neighbours
        let (low, high) = if upwards { (a, b) } else { (b, a) };
        let place = |i: usize| low[i] + (point[j] - low[j]) * ((high[i] - low[i]) / (high[j] - low[j]));
        Some(Level { upwards, at: place(i), along: place(axis) })
    }

    /// +1 where the side passes upwards on the right of a point, −1 downwards.
    fn passes(&self, point: f64) -> i32 {
        if self.at <= point {
            0
        } else if self.upwards {
            1
        } else {
            -1
        }
    }
}

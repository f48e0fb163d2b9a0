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
    /// How often those triangles that are `asked` for, which must be a closed surface, wind around a point: so many
    /// more of them does a ray along the axis cross to their counter-clockwise side than to the other one.
    ///
    /// Neighbours agree on which side of the ray the edge between them passes: nothing leaks.
    pub(super) fn winding(&self, point: &Vector3<f64>, axis: usize, asked: impl Fn(usize) -> bool) -> i32 {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
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
            let around: i32 = (0..3).map(|s| passes([i, j], point, &corners[s], &corners[(s + 1) % 3])).sum();
            if around != 0 && self.is_ahead(k, point, axis) {
                winding += around;
            }
        });
        winding
    }

    /// Whether the line through a point along an axis meets the plane of a triangle ahead of the point.
    fn is_ahead(&self, k: usize, point: &Vector3<f64>, axis: usize) -> bool {
        let [a, b, c] = self.triangles[k].map(|v| self.vertices[v]);
        if point[axis] < a[axis].min(b[axis]).min(c[axis]) {
            return true;
        }
        let normal = &self.normals[k];
        (normal.dot(&(point - a)) < 0.0) == (normal[axis] > 0.0)
    }
}

/// Seen along an axis: +1 where the side from `a` to `b` passes the point on its right upwards, −1 downwards.
fn passes([i, j]: [usize; 2], point: &Vector3<f64>, a: &Vector3<f64>, b: &Vector3<f64>) -> i32 {
    let upwards = a[j] <= point[j] && point[j] < b[j];
    let downwards = b[j] <= point[j] && point[j] < a[j];
    if !(upwards || downwards) {
        return 0;
    }
    // from the lower end, whichever way it is passed: the same for both neighbours
    let (low, high) = if upwards { (a, b) } else { (b, a) };
    let at = low[i] + (point[j] - low[j]) * ((high[i] - low[i]) / (high[j] - low[j]));
    if at <= point[i] {
        0
    } else if upwards {
        1
    } else {
        -1
    }
}

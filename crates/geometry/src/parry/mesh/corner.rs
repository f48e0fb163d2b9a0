//! Which points of a surface of triangles are corners.
use super::{Mesh, two_sided::SAME};
use crate::Extent;
use nalgebra::Vector3;

/// Where a triangle may meet edges of the surface that are not its own sides.
#[derive(Clone, Copy)]
pub(super) struct Meetings {
    /// Whether an edge of the surface ends at this corner.
    corners: [bool; 3],
    /// Whether another triangle may touch this one elsewhere.
    elsewhere: bool,
}

impl Mesh {
    /// Finds where triangles may meet edges of others. `n log n` operations for triangles in general position.
    pub(super) fn mark_meetings(&mut self) {
        let mut has_edge = vec![false; self.vertices.len()];
        for (t, edges) in self.triangles.iter().zip(&self.edges) {
            for i in (0..3).filter(|&i| edges[i]) {
                has_edge[t[i]] = true;
                has_edge[t[(i + 1) % 3]] = true;
            }
        }
        let of = |k: usize| {
            let (extent, mut elsewhere) = (Extent::of(self.corners(k)), false);
            self.tree.search(
                |e| e.meets(&extent, 2.0 * self.near),
                |other| elsewhere = elsewhere || self.may_touch_elsewhere(k, other),
            );
            Meetings { corners: self.triangles[k].map(|v| has_edge[v]), elsewhere }
        };
        self.meetings = (0..self.triangles.len()).map(of).collect();
    }

    /// Whether two triangles may touch in other points than their common vertices and sides. Those of one face do not.
    fn may_touch_elsewhere(&self, k: usize, other: usize) -> bool {
        (self.normals[k] - self.normals[other]).norm() > SAME && !self.is_apart(k, other) && !self.is_apart(other, k)
    }

    /// Whether the vertices of another triangle, except common ones, lie on one side of the plane of a triangle, off it.
    fn is_apart(&self, k: usize, other: usize) -> bool {
        let (normal, own) = (&self.normals[k], &self.triangles[k]);
        let (mut is_in_front, mut is_behind) = (true, true);
        for v in self.triangles[other].iter().filter(|v| !own.contains(v)) {
            let height = normal.dot(&(self.vertices[*v] - self.vertices[own[0]]));
            is_in_front &= height > self.near;
            is_behind &= height < -self.near;
        }
        is_in_front || is_behind
    }

    /// Whether a point of a triangle lies on an edge of the surface, within rounding: its own, that of another triangle that has only a
    /// vertex there, or that of another part which stands on this one. An open surface may also cross itself.
    pub(super) fn is_corner(&self, k: usize, point: &Vector3<f64>) -> bool {
        let Meetings { corners, elsewhere } = self.meetings[k];
        let is_at = |i: usize| corners[i] && (point - self.vertices[self.triangles[k][i]]).amax() <= self.near;
        if self.is_on_edge(k, point) || (0..3).any(is_at) {
            return true;
        }
        elsewhere && self.is_on_edge_of_others(k, point)
    }

    fn is_on_edge_of_others(&self, k: usize, point: &Vector3<f64>) -> bool {
        let crosses = |other: usize| {
            let (normal, its) = (&self.normals[k], &self.normals[other]);
            !self.closed && normal.cross(its).norm() > SAME && self.has_on_it(other, point, self.near)
        };
        let (here, mut found) = (Extent::of([*point]), false);
        self.tree.search(
            |e| e.meets(&here, 2.0 * self.near),
            |other| found = found || (other != k && (self.is_on_edge(other, point) || crosses(other))),
        );
        found
    }

    /// Whether a point lies on a side of a triangle that is an edge of the surface, within rounding.
    fn is_on_edge(&self, k: usize, point: &Vector3<f64>) -> bool {
        let corners = self.corners(k);
        (0..3).any(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            let (length, from_start) = ((b - a).norm(), point - a);
            let along = (b - a) / length;
            let is_between = |s: f64| s >= -self.near && s <= length + self.near;
            self.edges[k][i] && along.cross(&from_start).norm() <= self.near && is_between(along.dot(&from_start))
        })
    }
}

//! Closed surfaces that run through themselves.
use super::Mesh;
use crate::{Error, Extent, edges::sides};
use nalgebra::Vector3;

impl Mesh {
    /// Refuses a surface one triangle of which is run through by a side of another one: between the two there is no telling where the
    /// table is. Through walls with the table on both sides, and by them, that is no contradiction.
    ///
    /// `n log n` operations for triangles in general position.
    ///
    /// # Errors
    /// [`Error::Triangle`] with one of these `numbers`.
    pub(super) fn check_crossings(&self, numbers: &[usize]) -> Result<(), Error> {
        for k in 0..self.triangles.len() {
            let (extent, mut found) = (Extent::of(self.corners(k)), false);
            self.tree.search(|e| e.meets(&extent, 0.0), |other| found = found || self.is_run_through(k, other));
            if found {
                return Err(Error::Triangle {
                    triangle: numbers[k],
                    problem: "is run through by another one: unite the parts of the surface that overlap there",
                });
            }
        }
        Ok(())
    }

    /// Whether a side of another triangle leads through a triangle.
    fn is_run_through(&self, k: usize, other: usize) -> bool {
        let (normal, corner) = (&self.normals[k], self.vertices[self.triangles[k][0]]);
        let (mut is_in_front, mut is_behind) = (false, false);
        for &v in &self.triangles[other] {
            let height = normal.dot(&(self.vertices[v] - corner));
            is_in_front |= height > self.slack;
            is_behind |= height < -self.slack;
        }
        if !(is_in_front && is_behind) {
            return false;
        }
        sides(self.triangles[other]).into_iter().any(|side| {
            let through = self.passage(k, side.map(|v| self.vertices[v]));
            through.is_some_and(|point| ![k, other].into_iter().any(|wall| self.has_back_at(wall, &point)))
        })
    }

    /// Where the way from one point to another leads through a triangle: from farther in front of it than rounding to farther behind
    /// it, or back, all the while over its inside. A way that only touches the triangle, or runs along it, does not.
    fn passage(&self, k: usize, [p, q]: [Vector3<f64>; 2]) -> Option<Vector3<f64>> {
        let (corners, normal) = (self.corners(k), &self.normals[k]);
        // the part of the way over the inside, as fractions of its length
        let [mut start, mut end] = [0.0_f64, 1.0_f64];
        for i in 0..3 {
            let along = corners[(i + 1) % 3] - corners[i];
            let inwards = normal.cross(&(along / along.norm()));
            let [from, to] = [p, q].map(|x| inwards.dot(&(x - corners[i])) - self.slack);
            let place = from / (from - to);
            match (from > 0.0, to > 0.0) {
                (true, true) => {}
                (false, false) => return None,
                (false, true) => start = start.max(place),
                (true, false) => end = end.min(place),
            }
        }
        let [high, low] = [p, q].map(|x| normal.dot(&(x - corners[0])));
        let [first, last] = [start, end].map(|s| high + (low - high) * s);
        let is_through = start < end && first.abs().min(last.abs()) > self.slack && (first > 0.0) != (last > 0.0);
        is_through.then(|| p + (q - p) * (high / (high - low)))
    }

    /// Whether a triangle has the table on both sides at a point of it.
    fn has_back_at(&self, k: usize, point: &Vector3<f64>) -> bool {
        let mut found = false;
        self.on_sheets(point, 2.0 * self.slack, |other| found = found || self.are_back_to_back(k, other));
        found
    }
}

//! Triangles with the table on both sides: those that coincide with others whose normals are opposite.
use super::Mesh;
use crate::{BoxTree, Extent, plane::slack};
use nalgebra::Vector3;

/// A point of another wall may count as on a two-sided triangle within this many times its [`slack`]: one slack for
/// the triangle, one for the point, and a half for the rounding of a start there.
const BAND: f64 = 2.5;

/// Two triangles are one wall where they are no farther apart than this many times the surface's [`slack`]: a path that starts on one may
/// do so a slack behind the other and still hit it, and the start is rounded by up to a half.
const THICKNESS: f64 = 1.5;

/// Unit normals that differ by less than this, or are opposite to within this, belong to one wall.
pub(super) const SAME: f64 = 1e-9;

/// The two-sided triangles and a tree of their boxes.
#[derive(Clone)]
pub(super) struct Sheets {
    pub(super) numbers: Vec<usize>,
    pub(super) tree: BoxTree<3>,
}

/// Whether two triangles lie in one plane, up to rounding of vertices and of starts, and share more than an edge.
///
/// Two triangles in a plane are disjoint if a line along one of their six sides separates them.
fn overlap(a: &[Vector3<f64>; 3], b: &[Vector3<f64>; 3], normals: [&Vector3<f64>; 2], slack: f64) -> bool {
    let rounding = THICKNESS * slack;
    let flat = |of: &[Vector3<f64>; 3], n: &Vector3<f64>, on: &[Vector3<f64>; 3]| {
        of.iter().all(|p| n.dot(&(p - on[0])).abs() <= rounding)
    };
    // the normal of a narrow triangle is rounded more than that of another
    if !flat(b, normals[0], a) && !flat(a, normals[1], b) {
        return false;
    }
    let meets = |of: &[Vector3<f64>; 3], n: &Vector3<f64>, other: &[Vector3<f64>; 3]| {
        (0..3).all(|i| {
            let along = of[(i + 1) % 3] - of[i];
            let inwards = n.cross(&(along / along.norm()));
            other.iter().any(|p| inwards.dot(&(p - of[i])) > slack)
        })
    };
    meets(a, normals[0], b) && meets(b, normals[1], a)
}

impl Mesh {
    pub(super) fn corners(&self, k: usize) -> [Vector3<f64>; 3] {
        self.triangles[k].map(|v| self.vertices[v])
    }

    /// Whether two triangles coincide, at least in part, and have the table on opposite sides.
    pub(super) fn are_back_to_back(&self, k: usize, j: usize) -> bool {
        let normals = [&self.normals[k], &self.normals[j]];
        normals[0].dot(normals[1]) < 0.0 && overlap(&self.corners(k), &self.corners(j), normals, self.slack)
    }

    /// The triangles that coincide, at least in part, with another one that has the table on the other side.
    ///
    /// `n log n` operations for triangles in general position.
    fn doubles(&self) -> Vec<usize> {
        let is_double = |&k: &usize| {
            let (extent, mut found) = (Extent::of(self.corners(k)), false);
            self.tree.search(|e| e.meets(&extent, self.slack), |j| found = found || self.are_back_to_back(k, j));
            found
        };
        (0..self.triangles.len()).filter(is_double).collect()
    }

    /// Finds the two-sided triangles: a path that starts on them, within rounding, may be on either side and does
    /// not cross them.
    pub(super) fn mark_two_sided(&mut self) {
        let numbers = self.doubles();
        for &k in &numbers {
            self.behind[k] = 0.5 * self.slack;
        }
        let tree = BoxTree::new(numbers.iter().map(|&k| Extent::of(self.corners(k))));
        self.sheets = if numbers.is_empty() { None } else { Some(Sheets { numbers, tree }) };
    }

    /// Whether there are two-sided triangles.
    pub(crate) fn has_two_sides(&self) -> bool {
        self.sheets.is_some()
    }

    /// Whether a point lies on a triangle, to within `reach`.
    pub(super) fn has_on_it(&self, k: usize, point: &Vector3<f64>, reach: f64) -> bool {
        let (corners, n) = (self.corners(k), &self.normals[k]);
        let inside = |i: usize| {
            let along = corners[(i + 1) % 3] - corners[i];
            n.cross(&(along / along.norm())).dot(&(point - corners[i])) >= -reach
        };
        n.dot(&(point - corners[0])).abs() <= reach && (0..3).all(inside)
    }

    /// Visits the two-sided triangles on which a point lies, to within `reach`.
    pub(super) fn on_sheets(&self, point: &Vector3<f64>, reach: f64, mut visit: impl FnMut(usize)) {
        let Some(sheets) = &self.sheets else { return };
        sheets.tree.search(
            |e| e.distance(point) <= 2.0 * reach,
            |place| {
                let k = sheets.numbers[place];
                if self.has_on_it(k, point, reach) {
                    visit(k);
                }
            },
        );
    }

    /// Whether a point of a wall with this normal lies where a two-sided triangle meets that wall.
    ///
    /// A path that starts on such a triangle, within rounding, does not cross it. So a path that has just left
    /// another wall next to it could slip through; therefore orbits end there, as in a corner.
    pub(crate) fn meets_a_sheet(&self, point: &Vector3<f64>, normal: &Vector3<f64>) -> bool {
        let mut found = false;
        let reach = BAND * self.slack.max(slack([point.amax()]));
        self.on_sheets(point, reach, |k| found = found || normal.cross(&self.normals[k]).norm() > SAME);
        found
    }
}

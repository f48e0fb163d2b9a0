//! Polygons in space, cut into triangles.
use crate::plane::slack;
use nalgebra::{Vector2, Vector3};

/// Most corners of polygons that are not convex: looking for crossings takes the square of their number of steps.
const CORNERS: usize = 10_000;

/// Triangles that fill a polygon with the same orientation, as numbers of its corners; `None` where the polygon is not simple.
///
/// The polygon is projected along the coordinate axis along which it appears largest, so its corners need only lie near a plane. A convex
/// one becomes a fan around its first corner; from any other, ears are cut off.
pub(super) fn triangles(corners: &[Vector3<f64>]) -> Option<Vec<[usize; 3]>> {
    if corners.len() == 3 {
        return Some(vec![[0, 1, 2]]);
    }
    let polygon = Polygon::seen(corners)?;
    if polygon.is_convex() {
        return Some((1..corners.len() - 1).map(|k| [0, k, k + 1]).collect());
    }
    if corners.len() > CORNERS || polygon.crosses_itself() {
        return None;
    }
    polygon.ears()
}

/// A polygon in the plane, counter-clockwise and of size one.
struct Polygon {
    corners: Vec<Vector2<f64>>,
    rounding: f64,
}

impl Polygon {
    fn seen(corners: &[Vector3<f64>]) -> Option<Polygon> {
        let size = corners.iter().map(|c| (c - corners[0]).amax()).fold(0.0, f64::max);
        let rounding = slack(corners.iter().flatten().copied()) / size;
        let corners: Vec<_> = corners.iter().map(|c| (c - corners[0]) / size).collect();
        let area: Vector3<f64> = corners.windows(2).map(|pair| pair[0].cross(&pair[1])).sum();
        let axis = area.iamax();
        let (i, j) = if area[axis] > 0.0 { (axis + 1, axis + 2) } else { (axis + 2, axis + 1) };
        let corners = corners.iter().map(|c| Vector2::new(c[i % 3], c[j % 3])).collect();
        (area[axis].abs() > rounding).then_some(Polygon { corners, rounding })
    }

    /// Twice the area of the triangle of three corners, counter-clockwise positive; 0 within rounding.
    fn turn(&self, [a, b, c]: [usize; 3]) -> f64 {
        let [a, b, c] = [a, b, c].map(|k| self.corners[k % self.corners.len()]);
        let (ab, ac) = (b - a, c - a);
        let area = ab.perp(&ac);
        if area.abs() <= self.rounding * ab.amax().max(ac.amax()) { 0.0 } else { area }
    }

    /// Whether all turns are to the left, and add up to one whole turn.
    fn is_convex(&self) -> bool {
        let n = self.corners.len();
        let rises = |k: usize| self.corners[(k + 1) % n].y >= self.corners[k % n].y;
        (0..n).all(|k| self.turn([k, k + 1, k + 2]) > 0.0) && (0..n).filter(|&k| !rises(k) && rises(k + 1)).count() == 1
    }

    fn crosses_itself(&self) -> bool {
        let n = self.corners.len();
        let parts = |i: usize, j: usize| self.turn([i, i + 1, j]) * self.turn([i, i + 1, j + 1]) < 0.0;
        (0..n).any(|i| (i + 2..n).any(|j| parts(i, j) && parts(j, i)))
    }

    /// Triangles cut off at corners one after another.
    fn ears(&self) -> Option<Vec<[usize; 3]>> {
        let n = self.corners.len();
        let mut before: Vec<usize> = (0..n).map(|k| (k + n - 1) % n).collect();
        let mut after: Vec<usize> = (0..n).map(|k| (k + 1) % n).collect();
        let is_blunt = |corner: [usize; 3]| self.turn(corner) <= 0.0;
        let mut blunt: Vec<bool> = (0..n).map(|k| is_blunt([before[k], k, after[k]])).collect();
        // a corner that was not an ear stays so until a neighbour is cut off, unless another corner only touched it
        let mut refused = vec![false; n];
        let mut cut = vec![];
        let (mut at, mut left, mut passed, mut since) = (0, n, 0, 0);
        while left > 3 {
            let ear = [before[at], at, after[at]];
            if !refused[at] && self.is_ear(ear, &blunt) {
                cut.push(ear);
                let [a, _, c] = ear;
                (after[a], before[c]) = (c, a);
                for k in [a, c] {
                    blunt[k] = is_blunt([before[k], k, after[k]]);
                    refused[k] = false;
                }
                (at, left, passed, since) = (c, left - 1, 0, since + 1);
            } else if passed < left {
                refused[at] = true;
                (at, passed) = (after[at], passed + 1);
            } else if since > 0 {
                refused.fill(false);
                (passed, since) = (0, 0);
            } else {
                return None;
            }
        }
        cut.push([before[at], at, after[at]]);
        Some(cut)
    }

    /// Whether a triangle is a left turn with no other corner inside it or on its edges. If there are other corners in it, one of them is
    /// reflex, namely the one farthest in, so only `blunt` corners need testing.
    fn is_ear(&self, [a, b, c]: [usize; 3], blunt: &[bool]) -> bool {
        let own = [a, b, c].map(|k| self.corners[k]);
        let is_in = |k: usize| [[a, b, k], [b, c, k], [c, a, k]].into_iter().all(|edge| self.turn(edge) >= 0.0);
        let mut others = (0..blunt.len()).filter(|&k| blunt[k] && !own.contains(&self.corners[k]));
        self.turn([a, b, c]) > 0.0 && !others.any(is_in)
    }
}

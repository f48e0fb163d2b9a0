//! The triangles of a convex hull, by quickhull with exact predicates.
//!
//! A point outside the hull of the points before it strictly sees a disk of triangles, even if points are coplanar or collinear,
//! as long as visibility is decided exactly; so the rim of that disk is one closed chain, and no tolerance is needed. References:
//! [Barber, Dobkin, Huhdanpaa 1996], [Shewchuk 1997].
use nalgebra::Vector3;
use robust::{Coord3D, orient3d};
use std::collections::HashMap;

/// A triangle of the hull so far.
struct Triangle {
    /// Counter-clockwise as seen from outside.
    corners: [usize; 3],
    /// The triangles beyond each side, from corner `k` to the next.
    beyond: [usize; 3],
    /// Points that see this triangle and are assigned to it, with values proportional to their heights.
    seen_by: Vec<(usize, f64)>,
    is_alive: bool,
}

struct Hull<'a> {
    points: &'a [Vector3<f64>],
    triangles: Vec<Triangle>,
}

/// A value proportional to the height of a point above the plane of a triangle; its sign is exact.
fn above(points: &[Vector3<f64>], corners: [usize; 3], point: usize) -> f64 {
    let at = |k: usize| Coord3D { x: points[k].x, y: points[k].y, z: points[k].z };
    -orient3d(at(corners[0]), at(corners[1]), at(corners[2]), at(point))
}

/// The index of the greatest value, the first of equal ones; `None` unless that value is positive.
fn greatest(values: impl Iterator<Item = f64>) -> Option<usize> {
    let best = values.enumerate().fold((0, 0.0), |best, (k, value)| if value > best.1 { (k, value) } else { best });
    (best.1 > 0.0).then_some(best.0)
}

/// The triangles of the hull of points of size 1, counter-clockwise as seen from outside; None where all lie in one plane.
pub(super) fn triangles(points: &[Vector3<f64>]) -> Option<Vec<[usize; 3]>> {
    let origin = points.first()?;
    let a = greatest(points.iter().map(|p| (p - origin).norm()))?;
    let b = greatest(points.iter().map(|p| (p - points[a]).norm()))?;
    let c = greatest(points.iter().map(|p| (points[b] - points[a]).cross(&(p - points[a])).norm()))?;
    let d = greatest((0..points.len()).map(|k| above(points, [a, b, c], k).abs()))?;
    let [b, c] = if above(points, [a, b, c], d) > 0.0 { [c, b] } else { [b, c] };
    let mut hull = Hull { points, triangles: vec![] };
    for (corners, beyond) in
        [([a, b, c], [1, 2, 3]), ([b, a, d], [0, 3, 2]), ([c, b, d], [0, 1, 3]), ([a, c, d], [0, 2, 1])]
    {
        hull.triangles.push(Triangle { corners, beyond, seen_by: vec![], is_alive: true });
    }
    let others = (0..points.len()).filter(|k| ![a, b, c, d].contains(k));
    hull.assign(0, others.collect());
    // new triangles come last, and no old one is seen by more points than before
    let mut k = 0;
    while k < hull.triangles.len() {
        if hull.triangles[k].is_alive
            && let Some(farthest) = greatest(hull.triangles[k].seen_by.iter().map(|(_, height)| *height))
        {
            let point = hull.triangles[k].seen_by[farthest].0;
            hull.add(point, k);
        }
        k += 1;
    }
    Some(hull.triangles.iter().filter(|t| t.is_alive).map(|t| t.corners).collect())
}

impl Hull<'_> {
    /// Assigns each point to the first triangle from this number on that it sees; points that see none lie inside.
    fn assign(&mut self, from: usize, points: Vec<usize>) {
        for point in points {
            for triangle in &mut self.triangles[from..] {
                let height = above(self.points, triangle.corners, point);
                if height > 0.0 {
                    triangle.seen_by.push((point, height));
                    break;
                }
            }
        }
    }

    /// Adds a point that sees a triangle.
    fn add(&mut self, point: usize, triangle: usize) {
        let first = self.triangles.len();
        let mut sees = HashMap::from([(triangle, true)]);
        let (mut visible, mut next) = (vec![triangle], 0);
        // the new triangle at each side of the rim, by the start of that side
        let mut rim = HashMap::new();
        while let Some(&seen) = visible.get(next) {
            next += 1;
            for side in 0..3 {
                let neighbour = self.triangles[seen].beyond[side];
                let corners = self.triangles[neighbour].corners;
                let is_seen = *sees.entry(neighbour).or_insert_with(|| {
                    let is_seen = above(self.points, corners, point) > 0.0;
                    if is_seen {
                        visible.push(neighbour);
                    }
                    is_seen
                });
                if is_seen {
                    continue;
                }
                let own = self.triangles[seen].corners;
                let [a, b] = [own[side], own[(side + 1) % 3]];
                let number = self.triangles.len();
                rim.insert(a, number);
                let back = &mut self.triangles[neighbour];
                for side in (0..3).filter(|side| corners[*side] == b) {
                    back.beyond[side] = number;
                }
                let beyond = [neighbour, 0, 0];
                self.triangles.push(Triangle { corners: [a, b, point], beyond, seen_by: vec![], is_alive: true });
            }
        }
        for number in first..self.triangles.len() {
            let next = rim[&self.triangles[number].corners[1]];
            self.triangles[number].beyond[1] = next;
            self.triangles[next].beyond[2] = number;
        }
        let mut homeless = vec![];
        for seen in visible {
            let seen = &mut self.triangles[seen];
            seen.is_alive = false;
            homeless.extend(seen.seen_by.drain(..).map(|(k, _)| k).filter(|k| *k != point));
        }
        self.assign(first, homeless);
    }
}

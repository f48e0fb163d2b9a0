//! Triangles of one plane joined into faces.
use super::Face;
use crate::{edges::sides, parry::mesh::cross};
use nalgebra::Vector3;
use std::collections::{BTreeMap, HashMap};

/// A triangle narrower than this fraction of its length has a normal dominated by rounding (4 ulp).
const THIN: f64 = 16.0 * f64::EPSILON;

/// Triangles that lie in one plane.
struct Plane {
    members: Vec<usize>,
    /// Sums over the triangles: normals times twice the areas, middles times twice the areas, and twice the areas.
    normal: Vector3<f64>,
    middle: Vector3<f64>,
    area: f64,
}

/// Faces of a closed convex surface of triangles: neighbours within the `tolerance` of one plane form one face.
pub(super) fn joined(points: &[Vector3<f64>], triangles: &[[usize; 3]], tolerance: f64) -> Vec<Face> {
    let by_side: HashMap<[usize; 2], usize> =
        triangles.iter().enumerate().flat_map(|(k, t)| sides(*t).map(|side| (side, k))).collect();
    let beyond = |k: usize| sides(triangles[k]).map(|[a, b]| by_side[&[b, a]]);
    let normals: Vec<Vector3<f64>> = triangles.iter().map(|t| cross(t.map(|k| points[k]))).collect();
    let length = |[a, b]: [usize; 2]| (points[a] - points[b]).norm();
    let is_thin: Vec<bool> = triangles
        .iter()
        .zip(&normals)
        .map(|(t, normal)| {
            let longest = sides(*t).map(length).into_iter().fold(0.0, f64::max);
            normal.norm() <= THIN * longest * longest
        })
        .collect();
    // starting with the largest, whose directions are most accurate
    let mut seeds: Vec<usize> = (0..triangles.len()).filter(|k| !is_thin[*k]).collect();
    seeds.sort_by(|i, j| normals[*j].norm().total_cmp(&normals[*i].norm()));
    let mut planes: Vec<Plane> = vec![];
    let mut plane_of = vec![None; triangles.len()];
    for seed in seeds {
        if plane_of[seed].is_some() {
            continue;
        }
        let number = planes.len();
        plane_of[seed] = Some(number);
        let mut plane = Plane { members: vec![], normal: Vector3::zeros(), middle: Vector3::zeros(), area: 0.0 };
        plane.add(seed, triangles, points, &normals);
        let mut next = 0;
        while let Some(&k) = plane.members.get(next) {
            next += 1;
            for neighbour in beyond(k) {
                // only a narrow triangle can lie within the tolerance at nearly a right angle, and its continuation
                // might not
                let agrees = is_thin[neighbour]
                    || normals[neighbour].dot(&plane.normal) > 0.5 * normals[neighbour].norm() * plane.normal.norm();
                let is_near = || triangles[neighbour].iter().all(|&v| plane.height(&points[v]).abs() <= tolerance);
                if plane_of[neighbour].is_none() && agrees && is_near() {
                    plane_of[neighbour] = Some(number);
                    plane.add(neighbour, triangles, points, &normals);
                }
            }
        }
        planes.push(plane);
    }
    // a thin triangle that is left over joins the face beyond its longest side
    while let Some((k, plane)) = (0..triangles.len()).filter(|k| plane_of[*k].is_none()).find_map(|k| {
        let known = sides(triangles[k]).into_iter().filter_map(|[a, b]| Some(([a, b], plane_of[by_side[&[b, a]]]?)));
        known.max_by(|a, b| length(a.0).total_cmp(&length(b.0))).map(|(_, plane)| (k, plane))
    }) {
        plane_of[k] = Some(plane);
        planes[plane].members.push(k);
    }
    let mut rings: Vec<Vec<usize>> = vec![];
    for (number, plane) in planes.iter().enumerate() {
        let mut rim = BTreeMap::new();
        for &k in &plane.members {
            let outer = sides(triangles[k]).into_iter().filter(|[a, b]| plane_of[by_side[&[*b, *a]]] != Some(number));
            rim.extend(outer.map(|[a, b]| (a, b)));
        }
        rings.push(longest_chain(rim));
    }
    straightened(&mut rings, points.len());
    let face = |(mut ring, plane): (Vec<usize>, &Plane)| {
        let least = (0..ring.len()).min_by_key(|k| ring[*k])?;
        ring.rotate_left(least);
        let heights =
            ring.iter().map(|&k| (k, plane.height(&points[k]))).filter(|(_, height)| *height <= 2.0 * tolerance);
        let top = heights.max_by(|a, b| a.1.total_cmp(&b.1))?.0;
        Some(Face { ring, normal: plane.normal / plane.normal.norm(), top })
    };
    let mut faces: Vec<Face> = rings.into_iter().zip(&planes).filter_map(face).collect();
    faces.sort_by(|a, b| a.ring.cmp(&b.ring));
    faces
}

impl Plane {
    fn add(&mut self, k: usize, triangles: &[[usize; 3]], points: &[Vector3<f64>], normals: &[Vector3<f64>]) {
        let area = normals[k].norm();
        self.members.push(k);
        self.normal += normals[k];
        self.middle += triangles[k].iter().map(|&v| points[v]).sum::<Vector3<f64>>() * (area / 3.0);
        self.area += area;
    }

    /// How far a point lies above it.
    fn height(&self, point: &Vector3<f64>) -> f64 {
        self.normal.dot(&(point - self.middle / self.area)) / self.normal.norm()
    }
}

/// The longest closed chain of sides, given by their ends, starting from its least number.
fn longest_chain(mut sides: BTreeMap<usize, usize>) -> Vec<usize> {
    let mut longest = vec![];
    while let Some((start, mut next)) = sides.pop_first() {
        let mut chain = vec![start];
        while next != start
            && let Some(after) = sides.remove(&next)
        {
            chain.push(next);
            next = after;
        }
        if chain.len() > longest.len() {
            longest = chain;
        }
    }
    longest
}

/// Removes from all rings points that are not corners, since fewer than three faces meet there; faces without area
/// have no corners.
fn straightened(rings: &mut [Vec<usize>], points: usize) {
    loop {
        let mut faces = vec![0; points];
        for &k in rings.iter().flatten() {
            faces[k] += 1;
        }
        let before: usize = rings.iter().map(Vec::len).sum();
        for ring in rings.iter_mut() {
            ring.retain(|k| faces[*k] >= 3);
            if ring.len() < 3 {
                ring.clear();
            }
        }
        if rings.iter().map(Vec::len).sum::<usize>() == before {
            return;
        }
    }
}

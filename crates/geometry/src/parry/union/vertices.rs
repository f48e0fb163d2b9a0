//! Where the parts of a union end, and where they meet.
//!
//! Where three parts meet in one point, rounding makes three points of it, up to as far apart as rounding divided by the sine of the angle
//! at which two of the parts cross. They are one vertex, the most accurate one of them.
use super::Part;
use crate::{BoxTree, Extent, Meeting, MeetingKind, intersect::direction_at, meetings, plane::is_finite};
use nalgebra::Vector2;

/// A point at which a part ends, or is cut by another one.
struct Vertex {
    point: Vector2<f64>,
    /// The parts that meet there; twice the same one where it ends.
    parts: [usize; 2],
    /// How far along the parts it may be off: rounding, divided by the sine of the angle at which they cross.
    tolerance: f64,
}

/// All vertices, and which of them are the same.
pub(super) struct Vertices<'a> {
    parts: &'a [Part],
    all: Vec<Vertex>,
    /// For each the number of the one that stands for it.
    same: Vec<usize>,
    /// Rounding of coordinates.
    near: f64,
}

impl Vertices<'_> {
    /// The ends of all parts, and the points where parts of different members meet.
    pub(super) fn new(parts: &[Part], near: f64) -> Vertices<'_> {
        let ends = |(k, part): (usize, &Part)| part.piece.ends().into_iter().flatten().map(move |end| (k, end));
        let ends = parts.iter().enumerate().flat_map(ends).filter(|(_, end)| is_finite(end));
        let mut all: Vec<Vertex> = ends.map(|(k, point)| Vertex { point, parts: [k; 2], tolerance: near }).collect();
        // the ends are exact, and of crossings those at the greatest angles are the most accurate
        let mut crossings = crossings(parts, near);
        crossings.sort_by(|a, b| a.tolerance.total_cmp(&b.tolerance));
        all.extend(crossings);
        let mut vertices = Vertices { parts, same: (0..all.len()).collect(), all, near };
        vertices.unite();
        vertices
    }

    /// Lets the nearest earlier vertex that is the same stand for each.
    fn unite(&mut self) {
        let tree = BoxTree::new(self.all.iter().map(|v| Extent { min: v.point, max: v.point }));
        for (i, vertex) in self.all.iter().enumerate() {
            let here = Extent { min: vertex.point, max: vertex.point };
            let mut nearest: Option<(f64, usize)> = None;
            let visit = |j: usize| {
                let apart = (self.all[j].point - vertex.point).amax();
                if j < i
                    && self.same[j] == j
                    && nearest.is_none_or(|known| (apart, j) < known)
                    && self.are_one(vertex, &self.all[j])
                {
                    nearest = Some((apart, j));
                }
            };
            tree.search(|e| e.meets(&here, vertex.tolerance), visit);
            if let Some((_, j)) = nearest {
                self.same[i] = j;
            }
        }
    }

    /// Whether an earlier vertex, within the tolerance of another one, is the same.
    fn are_one(&self, vertex: &Vertex, earlier: &Vertex) -> bool {
        let [a, b] = vertex.parts;
        if a == b {
            // however short a side of a member is, its ends are two
            return vertex.point == earlier.point || self.parts[a].member != self.parts[earlier.parts[0]].member;
        }
        // an earlier one, at a greater angle, is as good a crossing if it is on both parts
        let at = earlier.point;
        [a, b].iter().all(|k| (self.parts[*k].piece.closest(&at).point - at).amax() <= self.near)
    }

    /// For each part its finite ends, and then the points at which other members cut it.
    pub(super) fn of_parts(&self) -> Vec<Vec<Vector2<f64>>> {
        let mut of_parts = vec![vec![]; self.parts.len()];
        for (vertex, same) in self.all.iter().zip(&self.same) {
            let [a, b] = vertex.parts;
            let point = self.all[*same].point;
            of_parts[a].push(point);
            if a != b {
                of_parts[b].push(point);
            }
        }
        of_parts
    }
}

/// Where parts of different members meet.
fn crossings(parts: &[Part], near: f64) -> Vec<Vertex> {
    let tree = BoxTree::new(parts.iter().map(|p| p.extent));
    let mut crossings = vec![];
    for (k, part) in parts.iter().enumerate() {
        let mut others = vec![];
        tree.search(|e| e.meets(&part.extent, near), |j| others.push(j));
        others.sort_unstable();
        for j in others.into_iter().filter(|&j| j > k && parts[j].member != part.member) {
            let pieces = [k, j].map(|k| &*parts[k].piece);
            for Meeting { point, kind, .. } in meetings(pieces[0], pieces[1]) {
                let [t, u] = pieces.map(|piece| direction_at(piece, &point));
                let tolerance = if kind == MeetingKind::Crossing { near / t.perp(&u).abs() } else { near };
                crossings.push(Vertex { point, parts: [k, j], tolerance });
            }
        }
    }
    crossings
}

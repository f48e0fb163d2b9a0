//! The outline of a planar shape of which only the distance is known, traced and measured.
//!
//! Smooth stretches are accurate to 10⁻¹². At a corner a stretch is accepted as straight when its end lies 10⁻⁸ of
//! the shape's size beyond the corner, so each corner adds an error of that size.
use super::distance::Distance;
use crate::{Extent, Landing, plane::cross};
use nalgebra::Vector2;
use std::collections::HashMap;

/// Nodes along the outline, so dense that circular arcs between them give its length to 10⁻¹².
#[derive(Debug)]
pub(crate) struct Traced {
    /// Loops one after another; each ends with its first node again.
    nodes: Vec<Node>,
    area: f64,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    at: Landing,
    /// Arc length.
    s: f64,
    /// The first node of a loop: nothing joins it to the one before.
    starts: bool,
}

/// Cells across the box, as a power of two.
const DEPTH: u32 = 8;
/// Change that halving a stretch may still make, in units of the shape's size.
const FINE: f64 = 1e-14;
/// Most halvings of a stretch: at a corner the last has 10⁻¹³ of the size.
const DEEPEST: u32 = 36;

type Vertex = (i64, i64);
/// A side of a grid cell, from a vertex to its right (`false`) or upper (`true`) neighbour.
type Side = (Vertex, bool);

/// Arc length, and the area between chord and arc, of the circular arc with these ends and normals.
fn arc(a: &Landing, b: &Landing) -> (f64, f64) {
    let chord = (b.point - a.point).norm();
    let turn = cross(a.normal.into(), b.normal.into()).clamp(-1.0, 1.0);
    let t2 = turn * turn; // sin²φ, and φ = turn (1 + sin²φ/6 + …)
    let angle = turn * (1.0 + t2 * (1.0 / 6.0 + t2 * 3.0 / 40.0));
    let p2 = angle * angle;
    // (φ/2)/sin(φ/2) and (φ − sin φ)/(8 sin²(φ/2)) as series
    (chord * (1.0 + p2 * (1.0 / 24.0 + p2 * 7.0 / 5760.0)), chord * chord * angle / 12.0 * (1.0 + p2 / 30.0))
}

impl Traced {
    pub(crate) fn new(distance: &Distance<2>) -> Traced {
        let landing = |x: &Vector2<f64>| {
            let (point, normal, _) = distance.closest(x);
            Landing { point, normal }
        };
        let size = {
            let Extent { min, max } = distance.extent();
            (max - min).norm()
        };
        let mut traced = Traced { nodes: vec![], area: 0.0 };
        for start in loops(distance) {
            let mut corners: Vec<Landing> = start.iter().map(landing).collect();
            corners.dedup_by(|a, b| (a.point - b.point).norm() <= FINE * size);
            let Some(&first) = corners.first() else { continue };
            corners.push(first);
            let s = traced.nodes.last().map_or(0.0, |n| n.s);
            traced.nodes.push(Node { at: first, s, starts: true });
            for pair in corners.windows(2) {
                traced.refine(&landing, &pair[0], &pair[1], size, 0);
            }
        }
        traced
    }

    /// Adds the stretch up to `b`, halved until halving no longer matters.
    fn refine(&mut self, landing: &impl Fn(&Vector2<f64>) -> Landing, a: &Landing, b: &Landing, size: f64, depth: u32) {
        let middle = landing(&((a.point + b.point) * 0.5));
        let [whole, left, right] = [arc(a, b), arc(a, &middle), arc(&middle, b)];
        let triangle = 0.5 * cross((middle.point - a.point).into(), (b.point - a.point).into());
        let gain = [left.0 + right.0 - whole.0, left.1 + right.1 + triangle - whole.1];
        if depth < DEEPEST && (gain[0].abs() > FINE * size || gain[1].abs() > FINE * size * size) {
            self.refine(landing, a, &middle, size, depth + 1);
            self.refine(landing, &middle, b, size, depth + 1);
            return;
        }
        // the error of a stretch of length h is c h⁵: halving removes 15/16 of it, and a fifteenth of the change is
        // left
        let s = self.nodes.last().map_or(0.0, |n| n.s);
        let half = s + left.0 + gain[0] / 30.0;
        self.nodes.push(Node { at: middle, s: half, starts: false });
        self.nodes.push(Node { at: *b, s: half + right.0 + gain[0] / 30.0, starts: false });
        // about a point of the boundary: about a distant point the areas of triangles would lose all digits
        let corner = self.nodes[0].at.point;
        let triangle = 0.5 * cross((a.point - corner).into(), (b.point - corner).into());
        self.area += triangle + whole.1 + gain[1] * (16.0 / 15.0);
    }

    pub(crate) fn length(&self) -> f64 {
        self.nodes.last().map_or(f64::NAN, |n| n.s)
    }
    pub(crate) fn area(&self) -> f64 {
        if self.nodes.is_empty() { f64::NAN } else { self.area }
    }

    pub(crate) fn arc_length_at(&self, at: &Landing) -> f64 {
        let mut best = (f64::INFINITY, f64::NAN);
        for pair in self.nodes.windows(2).filter(|p| !p[1].starts) {
            let (a, b) = (pair[0].at.point, pair[1].at.point);
            let chord = b - a;
            let u = ((at.point - a).dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
            let away = (a + chord * u - at.point).norm_squared();
            if away < best.0 {
                let s = if u == 1.0 { pair[1].s } else { (pair[0].s + arc(&pair[0].at, at).0).min(pair[1].s) };
                best = (away, s);
            }
        }
        best.1
    }

    pub(crate) fn point_at(&self, distance: &Distance<2>, s: f64) -> Vector2<f64> {
        let k = self.nodes.partition_point(|n| n.s <= s).clamp(1, self.nodes.len().max(2) - 1);
        let (Some(a), Some(b)) = (self.nodes.get(k - 1), self.nodes.get(k)) else {
            return Vector2::repeat(f64::NAN);
        };
        let u = if b.s > a.s { (s - a.s) / (b.s - a.s) } else { 0.0 };
        if u <= 0.0 || u >= 1.0 {
            return if u <= 0.0 { a.at.point } else { b.at.point };
        }
        let (mut point, mut normal, _) = distance.closest(&(a.at.point + (b.at.point - a.at.point) * u));
        for _ in 0..4 {
            let ahead = s - (a.s + arc(&a.at, &Landing { point, normal }).0);
            (point, normal, _) = distance.closest(&(point + Vector2::new(normal.y, -normal.x) * ahead));
        }
        point
    }
}

/// Rough points along each loop, in the order of traversal with the table on the left.
fn loops(distance: &Distance<2>) -> Vec<Vec<Vector2<f64>>> {
    let Extent { min, max } = distance.extent();
    let width = (max - min).amax();
    if !(width > 0.0 && width < 1e100) {
        return vec![];
    }
    // a little larger than the shape, and off its symmetry axes
    let origin = (min + max) * 0.5 - Vector2::new(0.5137, 0.5191) * (width * 1.07);
    let unit = width * 1.11 / libm::ldexp(1.0, DEPTH.cast_signed());
    let at = |x: f64, y: f64| origin + Vector2::new(x, y) * unit;
    let height = |x: f64, y: f64| distance.probe(&at(x, y)).distance;
    // cells that the outline can pass through
    let mut cells: Vec<Vertex> = vec![(0, 0)];
    for level in (0..DEPTH).rev() {
        let side = 1_i64 << level;
        let half = side as f64 * 0.5;
        let children = cells.iter().flat_map(|&(i, j)| [(i, j), (i + side, j), (i, j + side), (i + side, j + side)]);
        cells =
            children.filter(|&(i, j)| height(i as f64 + half, j as f64 + half).abs() <= 1.5 * half * unit).collect();
    }
    let mut known: HashMap<Vertex, f64> = HashMap::new();
    let mut next: HashMap<Side, Side> = HashMap::new();
    for &(i, j) in &cells {
        let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        let heights = corners.map(|v| *known.entry(v).or_insert_with(|| height(v.0 as f64, v.1 as f64)));
        let inside = heights.map(|h| h > 0.0);
        // counter-clockwise around the cell: bottom, right, top, left
        let sides = [((i, j), false), ((i + 1, j), true), ((i, j + 1), false), ((i, j), true)];
        // the outline enters where the table gives way to the wall counter-clockwise, and leaves where it returns
        let entries = (0..4).filter(|&k| inside[k] && !inside[(k + 1) % 4]);
        let center_inside = || height(i as f64 + 0.5, j as f64 + 0.5) > 0.0;
        let saddle = inside[0] == inside[2] && inside[1] == inside[3] && inside[0] != inside[1];
        for k in entries {
            let exits = |m: usize| !inside[m % 4] && inside[(m + 1) % 4];
            // at a saddle: around the single wall corner if the table is connected there, else around the single
            // table corner
            let exit = if saddle {
                if center_inside() { k + 1 } else { k + 3 }
            } else {
                match (k + 1..k + 4).find(|&m| exits(m)) {
                    Some(m) => m,
                    None => continue,
                }
            };
            next.insert(sides[k], sides[exit % 4]);
        }
    }
    let point = |&((i, j), up): &Side| {
        let (a, b) = ((i, j), if up { (i, j + 1) } else { (i + 1, j) });
        let value = |v: &Vertex| known.get(v).copied().unwrap_or(0.0);
        let (ha, hb) = (value(&a), value(&b));
        let u = if ha == hb { 0.5 } else { ha / (ha - hb) };
        at(a.0 as f64 + u * (b.0 - a.0) as f64, a.1 as f64 + u * (b.1 - a.1) as f64)
    };
    let mut starts: Vec<Side> = next.keys().copied().collect();
    starts.sort_unstable();
    let mut out = vec![];
    for start in starts {
        let mut points = vec![];
        let mut at = Some(start);
        while let Some(to) = at.and_then(|side| next.remove(&side)) {
            points.push(point(&to));
            at = Some(to);
        }
        if points.len() > 2 {
            out.push(points);
        }
    }
    out
}

//! The table as a polyline, found through the tree of boxes, with the normals of its edges or of the curve.

use billiards::Billiard;
use billiards::geometry::shapes::Segment;
use billiards::geometry::walls::ByLane;
use billiards::geometry::{Boundary, BoxTree, Hit, Line, Piece, Table, Vector2};

use super::super::Effort;
use super::super::case::{Case, Space};
use super::super::chart::Mark;
use super::super::law::Law;
use super::super::state::State;
use super::exact::{bulk, trace};
use super::{Built, End, Entry, Method};
use crate::simulation::{Engine, PlanarLaw, PlanarTrail};

pub(super) const FLAT: Entry = Entry {
    name: "polyline, flat normals",
    summary: "straight pieces between points of the boundary, each with its own normal",
    mark: Mark::Ring,
    sizes,
    build: |case, law, pieces| Polyline::build(case, law, pieces, false),
};

pub(super) const INTERPOLATED: Entry = Entry {
    name: "polyline, interpolated normals",
    summary: "the same pieces with the boundary's normals at their ends, interpolated between them",
    mark: Mark::Box,
    sizes,
    build: |case, law, pieces| Polyline::build(case, law, pieces, true),
};

/// 10² … 10⁶ pieces, for tables that are not polygons themselves.
fn sizes(case: &Case, effort: Effort) -> Vec<Option<usize>> {
    let curved = |table: &Table| {
        let bent = |piece: &dyn Piece| piece.curvature(&piece.point_at(0.5 * piece.length())) != 0.0;
        table.perimeter().is_finite() && table.pieces().iter().any(|piece| bent(&**piece))
    };
    match &case.space {
        Space::Plane(table) if curved(table) => {
            let most = if effort == Effort::Quick { 4 } else { 6 };
            (2..=most).map(|k| Some(10_usize.pow(k))).collect()
        }
        _ => vec![],
    }
}

/// A table as straight pieces.
#[derive(Debug)]
struct Polyline {
    walls: ByLane<Chain>,
    law: PlanarLaw,
}

#[derive(Debug)]
struct Chain {
    tree: BoxTree,
    edges: Vec<Segment>,
    /// Normals of the boundary at both ends of each edge; empty where the edges' own are used.
    normals: Vec<[Vector2<f64>; 2]>,
}

impl Polyline {
    fn build(case: &Case, law: Law, pieces: Option<usize>, interpolated: bool) -> Built {
        let (Space::Plane(table), Some(pieces)) = (&case.space, pieces) else {
            return Err("a polyline needs a planar table and a number of pieces".into());
        };
        let step = table.perimeter() / pieces as f64;
        let (mut edges, mut normals) = (Vec::with_capacity(pieces), vec![]);
        for piece in table.pieces() {
            let [start, end] = piece.ends().unwrap_or([piece.point_at(0.0); 2]);
            let parts = libm::round(piece.length() / step).max(1.0);
            let mut from = start;
            let mut k = 1.0;
            while k <= parts {
                let to = if k < parts { piece.point_at(piece.length() * (k / parts)) } else { end };
                edges.push(Segment::new(from, to)?);
                if interpolated {
                    normals.push([from, to].map(|point| piece.closest(&point).normal));
                }
                from = to;
                k += 1.0;
            }
        }
        let tree = BoxTree::new(edges.iter().map(Piece::extent));
        Ok(Box::new(Polyline { walls: ByLane(Chain { tree, edges, normals }), law: law.planar() }))
    }
}

impl Boundary<2> for Chain {
    fn first_hit(&self, path: &Line<2>) -> Option<Hit<2>> {
        let (piece, time) = self.tree.first(path, |i| self.edges[i].crossing(path))?;
        let edge = &self.edges[piece];
        let landing = edge.landing(path, time);
        let normal = match self.normals.get(piece) {
            Some([a, b]) => {
                let share = edge.arc_length_at(&landing.point) / edge.length();
                (a * (1.0 - share) + b * share).normalize()
            }
            None => landing.normal,
        };
        Some(Hit { time, point: landing.point, normal, piece, corner: false })
    }
}

impl Method for Polyline {
    fn trace(&self, start: &State<f64>, stops: &[u64], look: &mut dyn FnMut(usize, &State<f64>)) -> End {
        let engine: &dyn Engine<2, 1, PlanarTrail> = &Billiard { walls: &self.walls, law: &self.law };
        trace(engine, start, stops, look)
    }
    fn bulk(&self, starts: &[State<f64>], collisions: u64) -> u64 {
        let engine: &dyn Engine<2, 1, PlanarTrail> = &Billiard { walls: &self.walls, law: &self.law };
        bulk(engine, starts, collisions)
    }
}

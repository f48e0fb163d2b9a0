//! A list of pieces of any kind.
use super::{ByLane, CORNER, WallHit, Walls};
use crate::{Boundary, Crossing, Hit, Line, Piece, parry::Index};
use lanes::Lane;
use nalgebra::Vector2;
use std::collections::HashSet;
use std::sync::Arc;

/// Pieces of any kind: a few are asked one after another, many through a tree of boxes.
#[derive(Clone, Debug)]
pub struct List(ByLane<Pieces>);

/// How the first piece is found.
#[derive(Clone, Debug)]
enum Search {
    /// By asking each.
    Each,
    /// By asking those whose boxes the path enters.
    Tree(Index),
}

#[derive(Clone, Debug)]
struct Pieces {
    numbered: Vec<(usize, Arc<dyn Piece>)>,
    search: Search,
    /// Vertices at which the boundary has a corner, per piece.
    corners: Vec<Vec<Vector2<f64>>>,
    /// Size of their coordinates, of which rounding is a fraction.
    size: f64,
}

impl List {
    /// From so many pieces on, a tree of boxes is faster than asking each: measured on polygons inscribed in a circle, where
    /// the two take as long at about seventy.
    pub(crate) const MANY: usize = 72;

    /// The pieces with their numbers, and the corners of the boundary.
    pub fn new(pieces: Vec<(usize, Arc<dyn Piece>)>, corners: &[Vector2<f64>]) -> List {
        // −0 is 0
        let bits = |p: &Vector2<f64>| [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()];
        let known: HashSet<[u64; 2]> = corners.iter().map(bits).collect();
        let size = corners.iter().flat_map(|c| c.iter()).fold(0.0, |m: f64, c| m.max(c.abs()));
        let own = |p: &Arc<dyn Piece>| -> Vec<Vector2<f64>> {
            let ends = p.ends().map_or(vec![], Vec::from);
            ends.into_iter().filter(|e| known.contains(&bits(e))).collect()
        };
        let corners = pieces.iter().map(|(_, p)| own(p)).collect();
        let tree = || Search::Tree(Index::new(pieces.iter().map(|(_, piece)| piece.extent())));
        let search = if pieces.len() < List::MANY { Search::Each } else { tree() };
        List(ByLane(Pieces { numbered: pieces, search, corners, size }))
    }
}

impl Pieces {
    /// The piece that a path crosses first, and when; of equal times the first in the list.
    fn first(&self, path: &Line<2>) -> Option<(usize, Crossing)> {
        match &self.search {
            Search::Each => {
                let mut first = None;
                let mut soonest = Crossing::NEVER;
                for (k, (_, piece)) in self.numbered.iter().enumerate() {
                    let crossing = piece.crossing(path);
                    if crossing.before(&soonest) {
                        (first, soonest) = (Some(k), crossing);
                    }
                }
                first.map(|k| (k, soonest))
            }
            Search::Tree(index) => index.first(path, |k| self.numbered[k].1.crossing(path)),
        }
    }
}

impl Boundary<2> for Pieces {
    fn first_hit(&self, path: &Line<2>) -> Option<Hit<2>> {
        let (k, crossing) = self.first(path)?;
        let time = crossing.time();
        let landing = self.numbered[k].1.landing(path, time);
        // a path may come from far beyond the vertices
        let near = CORNER * self.size.max(path.point.amax());
        Some(Hit {
            time,
            point: landing.point,
            normal: landing.normal,
            piece: self.numbered[k].0,
            corner: self.corners[k].iter().any(|c| (landing.point - c).amax() <= near),
        })
    }
}

impl Walls<2> for List {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        self.0.first_hit(x, v)
    }
}

//! A list of pieces of any kind.
use super::{ByLane, CORNER, WallHit, Walls, corners::Corners};
use crate::{Boundary, BoxTree, Crossing, Hit, Line, Piece};
use lanes::Lane;
use nalgebra::Vector2;
use std::sync::Arc;

/// Pieces of any kind: a few are tested one after another, many through a tree of boxes.
#[derive(Clone, Debug)]
pub struct List(ByLane<Pieces>);

/// How the first piece is found.
#[derive(Clone, Debug)]
enum Search {
    /// By testing each.
    Each,
    /// By testing those whose boxes the path enters.
    Tree(BoxTree),
}

#[derive(Clone, Debug)]
struct Pieces {
    numbered: Vec<(usize, Arc<dyn Piece>)>,
    search: Search,
    /// Whether there are corners at the start and at the end of each piece.
    corners: Vec<[bool; 2]>,
    /// Size of the coordinates of corners, to which rounding is relative.
    size: f64,
}

impl List {
    /// From this many pieces on, a tree of boxes is faster than testing each. Orbits in polygons inscribed in a flower take
    /// equally long either way at 19 sides (8: 54 and 71 ns, 16: 92 and 102, 24: 126 and 104, 32: 159 and 106). The first
    /// hits alone: `cargo bench -p geometry -- "each or tree"`.
    pub(crate) const MANY: usize = 20;

    /// The pieces with their numbers, and the corners of the boundary.
    pub fn new(pieces: Vec<(usize, Arc<dyn Piece>)>, corners: &[Vector2<f64>]) -> List {
        let known = Corners::new(corners);
        let are_corners =
            |ends: Option<[Vector2<f64>; 2]>| ends.map_or([false; 2], |e| e.map(|end| known.contains(&end)));
        let corners = pieces.iter().map(|(_, piece)| are_corners(ends(&**piece))).collect();
        let tree = || Search::Tree(BoxTree::new(pieces.iter().map(|(_, piece)| piece.extent())));
        let search = if pieces.len() < List::MANY { Search::Each } else { tree() };
        List(ByLane(Pieces { numbered: pieces, search, corners, size: known.size() }))
    }
}

impl Pieces {
    /// The piece that a path crosses first, and when; for equal times the first in the list.
    fn first(&self, path: &Line<2>) -> Option<(usize, f64)> {
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
                first.map(|k| (k, soonest.time()))
            }
            Search::Tree(tree) => tree.first(path, |k| self.numbered[k].1.crossing(path)),
        }
    }
}

/// Where a piece ends: at its ends, or its tips.
fn ends(piece: &dyn Piece) -> Option<[Vector2<f64>; 2]> {
    piece.ends().or(piece.tips())
}

impl Boundary<2> for Pieces {
    fn first_hit(&self, path: &Line<2>) -> Option<Hit<2>> {
        let (k, time) = self.first(path)?;
        let (number, piece) = &self.numbered[k];
        let landing = piece.landing(path, time);
        // a path may come from far beyond the vertices
        let near = CORNER * self.size.max(path.point.amax());
        let is_corner = |(end, corner): (Vector2<f64>, bool)| corner && (landing.point - end).amax() <= near;
        let corner = self.corners[k] != [false; 2]
            && ends(&**piece).is_some_and(|ends| ends.into_iter().zip(self.corners[k]).any(is_corner));
        Some(Hit { time, point: landing.point, normal: landing.normal, piece: *number, corner })
    }
}

impl Walls<2> for List {
    fn rounds_normals(&self) -> bool {
        true
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        self.0.first_hit(x, v)
    }
}

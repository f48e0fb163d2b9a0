//! A list of pieces of any kind.
use super::{ByLane, CORNER, WallHit, Walls};
use crate::{Boundary, Crossing, Hit, Line, Piece};
use lanes::Lane;
use nalgebra::Vector2;
use std::collections::HashSet;
use std::sync::Arc;

/// Pieces asked one after another.
#[derive(Clone, Debug)]
pub struct List(ByLane<Pieces>);

#[derive(Clone, Debug)]
struct Pieces {
    numbered: Vec<(usize, Arc<dyn Piece>)>,
    /// Vertices at which the boundary has a corner, per piece.
    corners: Vec<Vec<Vector2<f64>>>,
    /// Size of their coordinates, of which rounding is a fraction.
    size: f64,
}

impl List {
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
        List(ByLane(Pieces { numbered: pieces, corners, size }))
    }
}

impl Boundary<2> for Pieces {
    fn first_hit(&self, path: &Line<2>) -> Option<Hit<2>> {
        let mut first = (Crossing::NEVER, None);
        for (k, (_, piece)) in self.numbered.iter().enumerate() {
            let crossing = piece.crossing(path);
            if crossing.before(&first.0) {
                first = (crossing, Some(k));
            }
        }
        let k = first.1?;
        let time = first.0.time();
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

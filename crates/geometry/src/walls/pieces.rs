//! Pieces of any kind: those that answer in lanes beside those that do not.
use super::{Few, List, WallHit, Walls};
use crate::{Piece, shapes::Shape};
use lanes::{Lane, MOST_LANES};
use nalgebra::Vector2;
use std::sync::Arc;

/// A list of pieces, each asked in the best way.
#[derive(Clone, Debug)]
pub struct Pieces {
    /// Those known in lanes.
    few: Few,
    /// The others, if any; or all, where they are many.
    list: Option<List>,
    /// Whether the list is of all.
    all: bool,
}

impl Pieces {
    /// The pieces with their numbers, and the corners of the boundary.
    pub fn new(pieces: Vec<(usize, Arc<dyn Piece>)>, corners: &[Vector2<f64>]) -> Pieces {
        let all = pieces.len() >= List::MANY;
        let in_lanes = pieces.len() < Few::PER_LANE * MOST_LANES;
        let known = pieces.iter().filter_map(|(number, piece)| Some((*number, piece.shape()?)));
        let mut shapes: Vec<(usize, Shape)> = if in_lanes { known.collect() } else { vec![] };
        if all && shapes.len() < pieces.len() {
            shapes.clear();
        }
        let others: Vec<_> = pieces.into_iter().filter(|(_, piece)| all || piece.shape().is_none()).collect();
        let list = (!others.is_empty()).then(|| List::new(others, corners));
        Pieces { few: Few::new(&shapes, corners), list, all }
    }
}

impl Walls<2> for Pieces {
    fn careful(&self) -> bool {
        self.list.is_some() || self.few.careful()
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let Some(list) = &self.list else { return self.few.first_hit(x, v) };
        let few = self.few.len();
        if few == 0 || self.all {
            let in_lanes = 0 < few && few < Few::PER_LANE * F::LANES;
            return if in_lanes { self.few.first_hit(x, v) } else { list.first_hit(x, v) };
        }
        let (hit, other) = (self.few.first_hit(x, v), list.first_hit(x, v));
        hit.or(other.time.lt(hit.time), &other)
    }
}

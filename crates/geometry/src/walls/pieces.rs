//! Pieces of any kind: those that answer in lanes beside those that do not.
use super::{Few, List, WallHit, Walls};
use crate::Piece;
use lanes::Lane;
use nalgebra::Vector2;
use std::sync::Arc;

/// A list of pieces, each asked in the best way.
#[derive(Clone, Debug)]
pub struct Pieces {
    /// Those known in lanes.
    few: Few,
    /// The others, if any.
    others: Option<List>,
}

impl Pieces {
    /// The pieces with their numbers, and the corners of the boundary.
    pub fn new(pieces: Vec<(usize, Arc<dyn Piece>)>, corners: &[Vector2<f64>]) -> Pieces {
        let many = pieces.len() >= List::MANY;
        let (mut shapes, mut others) = (vec![], vec![]);
        for (number, piece) in pieces {
            match piece.shape() {
                Some(shape) if !many => shapes.push((number, shape)),
                _ => others.push((number, piece)),
            }
        }
        let others = (!others.is_empty()).then(|| List::new(others, corners));
        Pieces { few: Few::new(&shapes, corners), others }
    }
}

impl Walls<2> for Pieces {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let Some(others) = &self.others else { return self.few.first_hit(x, v) };
        let other = others.first_hit(x, v);
        if self.few.is_empty() {
            return other;
        }
        let hit = self.few.first_hit(x, v);
        hit.or(other.time.lt(hit.time), &other)
    }
}

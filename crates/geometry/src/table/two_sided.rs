//! Walls that coincide, one with the table on this side and one with it on the other.
mod formula;
mod oval;
mod straight;
mod stretch;

use super::Translate;
use crate::{
    Figure, Piece,
    shapes::{OneSide, Shape},
};
use oval::Oval;
use std::sync::Arc;
use straight::Side;

/// The numbers of the pieces that coincide, at least in part, with another one that has the table on the other
/// side.
///
/// Takes `n log n` operations for pieces in general position.
pub(super) fn two_sided(pieces: &[Translate]) -> Vec<usize> {
    let side = |copy: &Translate| match copy.piece.figure() {
        Figure::Segment { ends } => Side::segment(copy.number, ends),
        Figure::Ray { from, direction, left: true } => {
            Some(Side::infinite(copy.number, from, direction, [true, false]))
        }
        Figure::Ray { from, direction, left: false } => {
            Some(Side::infinite(copy.number, from, -direction, [false, true]))
        }
        Figure::Line { through, direction } => Some(Side::infinite(copy.number, through, direction, [false, false])),
        _ => None,
    };
    let mut found = straight::doubles(pieces.iter().filter_map(side).collect());
    found.extend(oval::doubles(pieces.iter().filter_map(|copy| Oval::of(copy.number, &copy.piece.shape()?)).collect()));
    let others = pieces.iter().filter(|copy| copy.piece.shape().is_none() && copy.piece.figure() == Figure::Other);
    found.extend(formula::doubles(others.map(|copy| (copy.number, &*copy.piece))));
    found.sort_unstable();
    found.dedup();
    found
}

/// The piece as one side of a wall with the table on both sides.
pub(super) fn one_side(piece: &Arc<dyn Piece>) -> Arc<dyn Piece> {
    match piece.shape().map(Shape::two_sided) {
        Some(shape) => shape.into_piece(),
        None => Arc::new(OneSide::new(piece.clone())),
    }
}

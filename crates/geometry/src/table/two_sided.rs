//! Walls that coincide, one with the table on this side and one with it on the other.
mod curves;
mod oval;
mod straight;
mod stretch;

use super::Translate;
use crate::{
    Figure, Meeting, MeetingKind, Piece,
    intersect::direction_at,
    shapes::{OneSide, Shape},
};
use nalgebra::Vector2;
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
    found.extend(curves::doubles(pieces));
    found.sort_unstable();
    found.dedup();
    found
}

/// Where two pieces with these meetings run along each other, at least in part, with the table on different sides, if they do.
///
/// Takes pieces together that differ by more than [`two_sided`] does.
pub(crate) fn side_by_side(pieces: [&dyn Piece; 2], meetings: &[Meeting]) -> Option<Vector2<f64>> {
    let [a, b] = pieces;
    match pieces.map(|piece| piece.figure() == Figure::Other) {
        [true, _] if a.length().is_finite() => curves::coincide(a, b),
        [_, true] => curves::coincide(b, a),
        _ => {
            let against = |m: &&Meeting| direction_at(a, &m.point).dot(&direction_at(b, &m.point)) < 0.0;
            meetings.iter().filter(|m| m.kind == MeetingKind::Overlap).find(against).map(|m| m.point)
        }
    }
}

/// The piece as one side of a wall with the table on both sides.
pub(super) fn one_side(piece: &Arc<dyn Piece>) -> Arc<dyn Piece> {
    match piece.shape().map(Shape::two_sided) {
        Some(shape) => shape.into_piece(),
        None => Arc::new(OneSide::new(piece.clone())),
    }
}

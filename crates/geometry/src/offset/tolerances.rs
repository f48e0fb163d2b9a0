//! How much points of moved pieces that are computed twice may differ.
use super::{moved::Moved, vertices::Vertices};
use crate::{Piece, Table, piece::rounding, plane::slack};
use std::sync::Arc;

/// The points of a flat arc are known only as well as its centre: such pieces, and those that end on them, get a larger tolerance
/// than all others.
pub(super) struct Tolerances {
    /// The tolerance of most pieces.
    pub(super) general: f64,
    /// The largest tolerance of any piece.
    pub(super) widest: f64,
    pub(super) of_raw: Vec<f64>,
    pub(super) of_drawn: Vec<f64>,
    pub(super) of_vertices: Vec<f64>,
    /// For each moved piece, the largest of its own tolerance and those of the vertices at its ends.
    pub(super) of_ended: Vec<f64>,
}

impl Tolerances {
    pub(super) fn new(table: &Table, radius: f64, raw: &[Moved], vertices: &Vertices) -> Tolerances {
        let general = general(table, radius);
        let of = |piece: &dyn Piece| general.max(4.0 * rounding(piece));
        let of_raw: Vec<f64> = raw.iter().map(|r| of(&*r.piece)).collect();
        let mut of_vertices = vec![general; vertices.len()];
        for (r, &own) in raw.iter().zip(&of_raw) {
            r.ends.iter().flatten().for_each(|site| of_vertices[site.vertex] = own.max(of_vertices[site.vertex]));
        }
        let ended = |r: &Moved| r.ends.iter().flatten().map(|site| of_vertices[site.vertex]).fold(general, f64::max);
        let of_ended = raw.iter().zip(&of_raw).map(|(r, own)| own.max(ended(r))).collect();
        let of_drawn: Vec<f64> = table.pieces().iter().map(|p| of(&**p)).collect();
        let widest = of_raw.iter().chain(&of_drawn).copied().fold(general, f64::max);
        Tolerances { general, widest, of_raw, of_drawn, of_vertices, of_ended }
    }
}

/// A vertex computed twice agrees to a few times the rounding of its coordinates, and of what they are computed from.
pub(super) fn general(table: &Table, radius: f64) -> f64 {
    // the extent of a line at an angle is infinite in all directions
    let size = |piece: &Arc<dyn Piece>| piece.extent().size().max(piece.point_at(0.0).amax());
    4.0 * slack([table.pieces().iter().map(size).fold(radius, f64::max)])
}

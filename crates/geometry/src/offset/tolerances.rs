//! How much places on moved pieces may differ that are computed twice.
use super::{moved::Moved, vertices::Vertices};
use crate::{Piece, Table, piece::rounding, plane::slack};

/// The points of a flat arc are known as well as its centre only: such a piece, and what ends on it, is allowed more, and no other.
pub(super) struct Tolerances {
    /// On most pieces.
    pub(super) general: f64,
    /// On the one where it is most.
    pub(super) widest: f64,
    pub(super) of_raw: Vec<f64>,
    pub(super) of_drawn: Vec<f64>,
    pub(super) of_vertices: Vec<f64>,
    /// Of each moved piece with those that it goes on as, which end it.
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
    4.0 * slack([table.pieces().iter().map(|p| p.extent().size()).fold(radius, f64::max)])
}

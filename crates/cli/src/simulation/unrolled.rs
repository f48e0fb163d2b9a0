//! The boundary of a planar table, unrolled: where on it a collision is.

use billiards::geometry::{Table, Vector2, WallHit};
use lanes::Lane;

use super::start;
use crate::picture::REDUCED_WIDTH;

/// The arc length of all pieces laid end to end, in the unit of the picture.
#[derive(Clone, Debug)]
pub(crate) struct Unrolled {
    table: Table,
    /// Arc length at the start of each piece.
    offsets: Vec<f64>,
    /// To the copies of a piece on a lattice next to it.
    shifts: Vec<Vector2<f64>>,
    /// Width of the picture per length.
    unit: f64,
}

impl Unrolled {
    /// The boundary of a table, of finite length.
    pub(crate) fn of(table: &Table) -> Self {
        let offsets = table.arc_length_offsets();
        Unrolled {
            shifts: start::neighbours(table),
            unit: REDUCED_WIDTH / table.perimeter(),
            offsets,
            table: table.clone(),
        }
    }

    /// Where hits are, between 0 and the width of the picture.
    #[inline(always)]
    pub(crate) fn arc_length<F: Lane>(&self, hit: &WallHit<F, 2>) -> F {
        let [x, y] = hit.point;
        x.each(|k| self.of_one(hit.piece.lane(k), Vector2::new(x.lane(k), y.lane(k))))
    }

    fn of_one(&self, piece: f64, at: Vector2<f64>) -> f64 {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a piece number is a small integer")]
        let number = (piece as usize).min(self.offsets.len() - 1);
        let piece = &self.table.pieces()[number];
        // on a lattice, the copy of the piece that was hit
        let off = |point: &Vector2<f64>| (piece.closest(point).point - point).norm_squared();
        let at = match &self.shifts[..] {
            [] | [_] => at,
            shifts => shifts.iter().map(|shift| at - shift).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(at),
        };
        (self.offsets[number] + piece.arc_length_at(&at)) * self.unit
    }
}

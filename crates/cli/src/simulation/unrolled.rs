//! The boundary of a planar table, unrolled: gives the arc length of a collision.

use billiards::geometry::{Landing, Piece, Table, Vector2, walls};
use lanes::Lane;

use super::bearings::Bearings;
use super::stretches::Stretches;
use crate::picture::REDUCED_WIDTH;

/// The arc length of all pieces laid end to end, in the unit of the picture.
#[derive(Clone, Debug)]
pub(crate) struct Unrolled {
    table: Table,
    /// Arc length at the start of each piece.
    offsets: Vec<f64>,
    /// Width of the picture per length.
    unit: f64,
    /// All pieces, where they are few segments and arcs.
    stretches: Option<Stretches>,
    /// For each piece that would have to search and can be looked up instead, its bearings; `None` where there are
    /// `stretches`, or few points.
    bearings: Vec<Option<Bearings>>,
    /// And the translations of its translates on a lattice.
    shifts: Vec<Vec<Vector2<f64>>>,
    /// Whether there are walls without thickness.
    thin: bool,
}

/// Number of points from which looking them up pays.
const MANY: f64 = 50_000.0;

/// How far arc lengths may be off, of the whole: half a thousandth of a pixel.
const EXACT: f64 = 5e-7;

/// Most arcs of pieces that are looked up: each takes 48 KiB and some milliseconds.
const MOST_LOOKED_UP: usize = 64;

impl Unrolled {
    /// The boundary of a table, of finite length, on which at most `points` points will be located.
    pub(crate) fn of(table: &Table, points: f64) -> Self {
        let (offsets, unit) = (table.arc_length_offsets(), REDUCED_WIDTH / table.perimeter());
        let alone = table.lattice().is_none();
        let stretches = Stretches::of(table, &offsets, unit);
        let looked_up = stretches.is_none() && points >= MANY && table.pieces().len() <= MOST_LOOKED_UP;
        let pieces = if looked_up { table.pieces() } else { &[] };
        // a segment or an arc gives the arc length of a point directly, but does not know which of its copies is hit
        let searches = |piece: &&std::sync::Arc<dyn Piece>| !alone || !Stretches::knows(&***piece);
        let (most, arcs) = (EXACT * table.perimeter(), MOST_LOOKED_UP / pieces.len().max(1));
        let bearings = pieces
            .iter()
            .map(|piece| Some(piece).filter(searches).and_then(|piece| Bearings::of(&**piece, most, arcs)));
        let bearings: Vec<_> = bearings.collect();
        let shifts = (0..bearings.len()).map(|piece| table.translations(piece).collect()).collect();
        let thin = table.pieces().iter().any(|piece| piece.tips().is_some());
        Unrolled { unit, offsets, table: table.clone(), stretches, bearings, shifts, thin }
    }

    /// Whether unit normals are needed: they determine the place of a hit on an arc, or the face of a thin wall.
    #[inline(always)]
    pub(super) fn wants_normals(&self) -> bool {
        self.stretches.as_ref().map_or(self.thin, Stretches::want_normals)
    }

    /// The positions of hits, between 0 and the width of the picture.
    #[inline(always)]
    pub(crate) fn arc_length<F: Lane>(&self, [x, y]: [F; 2], normal: impl FnOnce() -> [F; 2], piece: F) -> F {
        if let Some(stretches) = &self.stretches {
            return stretches.at([x, y], normal, piece);
        }
        let [n1, n2] = normal();
        let landing =
            |k| Landing { point: Vector2::new(x.lane(k), y.lane(k)), normal: Vector2::new(n1.lane(k), n2.lane(k)) };
        x.each(|k| self.of_one(piece.lane(k), &landing(k)))
    }

    /// The same for a piece of any kind.
    #[inline(never)]
    fn of_one(&self, piece: f64, at: &Landing) -> f64 {
        let number = walls::number(piece).min(self.offsets.len() - 1);
        if let Some(Some(bearings)) = self.bearings.get(number) {
            return (self.offsets[number] + bearings.arc_length(at.point, &self.shifts[number])) * self.unit;
        }
        (self.offsets[number] + self.table.arc_length(number, at)) * self.unit
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::PI;

    use super::*;
    use billiards::geometry::shapes::{Circle, Screen};

    #[test]
    fn the_faces_of_a_thin_wall_lie_beside_each_other() {
        let circle = Circle::new(Vector2::zeros(), 2.0, true).unwrap();
        let screen = Screen::new(Vector2::new(0.02, 0.9), Vector2::new(-0.1, 0.16)).unwrap();
        let table = Table::new(vec![Box::new(circle) as Box<dyn Piece>, Box::new(screen)]).unwrap();
        let unrolled = Unrolled::of(&table, 1e9);
        assert!(unrolled.wants_normals());
        for k in 0..100 {
            let s = screen.length() * (f64::from(k) + 0.5) * 0.01;
            let at = screen.landing_at(s);
            let place = unrolled.arc_length(at.point.into(), || at.normal.into(), 1.0);
            assert!((place - (4.0 * PI + s) * unrolled.unit).abs() < 1e-12 * REDUCED_WIDTH, "{k}");
        }
    }
}

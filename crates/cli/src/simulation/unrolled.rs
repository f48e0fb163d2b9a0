//! The boundary of a planar table, unrolled: where on it a collision is.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use billiards::geometry::{Figure, Landing, Piece, Table, Vector2, walls};
use lanes::{Lane, Mask};

use super::bearings::Bearings;
use crate::picture::REDUCED_WIDTH;

/// The arc length of all pieces laid end to end, in the unit of the picture.
#[derive(Clone, Debug)]
pub(crate) struct Unrolled {
    table: Table,
    /// Arc length at the start of each piece.
    offsets: Vec<f64>,
    /// Width of the picture per length.
    unit: f64,
    /// All pieces, where they are few segments and arcs; else nothing.
    stretches: Vec<Stretch>,
    /// Whether there are arcs among them.
    arcs: bool,
    /// Of each piece that can be looked up and would have to search; nothing where there are `stretches`, or few points.
    bearings: Vec<Option<Bearings>>,
    /// And by what it is moved in its translates on a lattice.
    shifts: Vec<Vec<Vector2<f64>>>,
    /// Whether there are walls without thickness.
    thin: bool,
}

/// From so many points on it is worth while to look them up.
const MANY: f64 = 50_000.0;

/// Most pieces that are looked up: each takes 48 KiB and some milliseconds.
const MOST_LOOKED_UP: usize = 64;

/// Most pieces that are told apart one after another.
const MOST_STRETCHES: usize = 16;

/// A segment or an arc on the unrolled boundary.
///
/// With `d` from `origin` to a point of it, a segment is at `start + d·axis`, and an arc at `start + radius θ`, where `θ` is
/// the angle from `axis` to `d` in the sense of `turn`.
#[derive(Clone, Copy, Debug)]
struct Stretch<F = f64> {
    origin: [F; 2],
    axis: [F; 2],
    turn: F,
    /// 0 of a segment.
    radius: F,
    /// The angle of an arc.
    sweep: F,
    start: F,
}

impl Stretch {
    /// A piece that begins at `start`, in a picture with so much width per length.
    fn of(piece: &dyn Piece, start: f64, unit: f64) -> Option<Self> {
        let turn = |inside| if inside { 1.0 } else { -1.0 };
        let arc = |center: Vector2<f64>, radius: f64, inside| {
            let axis = (piece.point_at(0.0) - center) / radius;
            let (sweep, radius) = (piece.length() / radius, radius * unit);
            Stretch { origin: center.into(), axis: axis.into(), turn: turn(inside), radius, sweep, start }
        };
        match piece.figure() {
            Figure::Segment { ends: [a, b] } => {
                let axis = (b - a).normalize() * unit;
                Some(Stretch { origin: a.into(), axis: axis.into(), turn: 1.0, radius: 0.0, sweep: 0.0, start })
            }
            Figure::Arc { center, radius, inside, .. } | Figure::Circle { center, radius, inside } => {
                Some(arc(center, radius, inside))
            }
            _ => None,
        }
    }

    /// The same in as many lanes as `zero` has.
    #[inline(always)]
    fn all<F: Lane>(&self, zero: F) -> Stretch<F> {
        let [o1, o2] = self.origin;
        let [a1, a2] = self.axis;
        Stretch {
            origin: [zero.same(o1), zero.same(o2)],
            axis: [zero.same(a1), zero.same(a2)],
            turn: zero.same(self.turn),
            radius: zero.same(self.radius),
            sweep: zero.same(self.sweep),
            start: zero.same(self.start),
        }
    }
}

impl<F: Lane> Stretch<F> {
    /// This one, or `other` where `second`.
    #[inline(always)]
    fn or(self, second: F::Mask, other: &Self) -> Self {
        let ([o1, o2], [p1, p2]) = (self.origin, other.origin);
        let ([a1, a2], [b1, b2]) = (self.axis, other.axis);
        Stretch {
            origin: [second.select(p1, o1), second.select(p2, o2)],
            axis: [second.select(b1, a1), second.select(b2, a2)],
            turn: second.select(other.turn, self.turn),
            radius: second.select(other.radius, self.radius),
            sweep: second.select(other.sweep, self.sweep),
            start: second.select(other.start, self.start),
        }
    }

    /// Where a point of it is, on a boundary with or without arcs.
    #[inline(always)]
    fn at(&self, [x, y]: [F; 2], arcs: bool) -> F {
        let (d1, d2) = (x - self.origin[0], y - self.origin[1]);
        let [a1, a2] = self.axis;
        let along = d1 * a1 + d2 * a2;
        if !arcs {
            return self.start + along;
        }
        let angle = angle(along, self.turn * (a1 * d2 - a2 * d1));
        // rounding may take a point beyond the ends
        let beyond = (self.sweep * 0.5 + PI).lt(angle);
        let angle = beyond.select(angle.same(0.0), angle.min(self.sweep));
        let zero = angle.same(0.0);
        self.start + zero.lt(self.radius).select(self.radius * angle, along)
    }
}

/// The angle of a vector in [0, 2π], to 2·10⁻⁸: a hundred thousandth of a pixel.
///
/// The quotient of its components, or of their difference and sum beyond π/8, goes into the series of the arc tangent.
#[inline(always)]
fn angle<F: Lane>(x: F, y: F) -> F {
    let zero = x.same(0.0);
    let (a, b) = (x.abs(), y.abs());
    let (small, large) = (a.min(b), a.max(b));
    let steep = (large * 0.414_213_562_373_095_03).lt(small); // tan(π/8)
    let t = steep.select(small - large, small) / steep.select(small + large, large);
    let t2 = t * t;
    let mut series = t2.same(1.0 / 15.0);
    for k in [13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0] {
        series = t2.same(1.0 / k) - series * t2;
    }
    let mut angle = t * series + steep.select(zero.same(FRAC_PI_4), zero);
    angle = a.lt(b).select(-angle + FRAC_PI_2, angle);
    angle = x.lt(zero).select(-angle + PI, angle);
    y.lt(zero).select(-angle + TAU, angle)
}

impl Unrolled {
    /// The boundary of a table, of finite length, on which at most so many points will be found.
    pub(crate) fn of(table: &Table, points: f64) -> Self {
        let (offsets, unit) = (table.arc_length_offsets(), REDUCED_WIDTH / table.perimeter());
        let alone = table.lattice().is_none();
        let few = alone && table.pieces().len() <= MOST_STRETCHES;
        let stretch = |(piece, start): (&std::sync::Arc<dyn Piece>, &f64)| Stretch::of(&**piece, start * unit, unit);
        let stretches: Option<Vec<Stretch>> = table.pieces().iter().zip(&offsets).map(stretch).collect();
        let stretches = stretches.filter(|_| few).unwrap_or_default();
        let arcs = stretches.iter().any(|stretch| stretch.radius > 0.0);
        let looked_up = stretches.is_empty() && points >= MANY && table.pieces().len() <= MOST_LOOKED_UP;
        let pieces = if looked_up { table.pieces() } else { &[] };
        // a segment or an arc knows where a point of it is, but not which of its copies is hit
        let searches = |piece: &&std::sync::Arc<dyn Piece>| !alone || Stretch::of(&***piece, 0.0, unit).is_none();
        let bearings = pieces.iter().map(|piece| Some(piece).filter(searches).and_then(|piece| Bearings::of(&**piece)));
        let bearings: Vec<_> = bearings.collect();
        let shifts = (0..bearings.len()).map(|piece| table.translations(piece).collect()).collect();
        let thin = table.pieces().iter().any(|piece| piece.tips().is_some());
        Unrolled { unit, offsets, table: table.clone(), stretches, arcs, bearings, shifts, thin }
    }

    /// Whether the point of a hit does not tell where it is, since a wall has two faces there: unit normals are asked for.
    #[inline(always)]
    pub(super) fn is_thin(&self) -> bool {
        self.thin
    }

    /// Where hits are, between 0 and the width of the picture.
    #[inline(always)]
    pub(crate) fn arc_length<F: Lane>(&self, [x, y]: [F; 2], normal: impl FnOnce() -> [F; 2], piece: F) -> F {
        let Some((first, others)) = self.stretches.split_first() else {
            let [n1, n2] = normal();
            let landing =
                |k| Landing { point: Vector2::new(x.lane(k), y.lane(k)), normal: Vector2::new(n1.lane(k), n2.lane(k)) };
            return x.each(|k| self.of_one(piece.lane(k), &landing(k)));
        };
        let mut stretch = first.all(x);
        let mut before = 0.5;
        for other in others {
            stretch = stretch.or(x.same(before).lt(piece), &other.all(x));
            before += 1.0;
        }
        stretch.at([x, y], self.arcs)
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
    use super::*;
    use billiards::geometry::{parry::Screen, shapes::Circle, tables};

    #[test]
    fn angles_are_right_to_a_hundred_thousandth_of_a_pixel() {
        for k in 0..10_000 {
            let turn = f64::from(k) * 6.283e-4;
            let (sin, cos) = libm::sincos(turn);
            for size in [1e-3, 1.0, 1e5] {
                assert!((angle(size * cos, size * sin) - turn).abs() < 2e-8, "{turn}");
            }
        }
    }

    #[test]
    fn the_faces_of_a_thin_wall_lie_beside_each_other() {
        let circle = Circle::new(Vector2::zeros(), 2.0, true).unwrap();
        let screen = Screen::new(Vector2::new(0.02, 0.9), Vector2::new(-0.1, 0.16)).unwrap();
        let table = Table::new(vec![Box::new(circle) as Box<dyn Piece>, Box::new(screen)]).unwrap();
        let unrolled = Unrolled::of(&table, 1e9);
        assert!(unrolled.is_thin());
        for k in 0..100 {
            let s = screen.length() * (f64::from(k) + 0.5) * 0.01;
            let at = screen.landing_at(s);
            let place = unrolled.arc_length(at.point.into(), || at.normal.into(), 1.0);
            assert!((place - (4.0 * PI + s) * unrolled.unit).abs() < 1e-12 * REDUCED_WIDTH, "{k}");
        }
    }

    #[test]
    fn points_of_segments_and_arcs_are_where_their_pieces_say() {
        let tables = [
            tables::stadium(1.0, 1.0),
            tables::mushroom(1.0, 0.5, 0.75),
            tables::moon(1.0, 0.75, 1.0),
            tables::sinai(1.0, 0.25),
            tables::circle(0.5),
            tables::hexagon(1.0),
        ];
        for table in tables.map(Result::unwrap) {
            let unrolled = Unrolled::of(&table, 1e9);
            assert_eq!(unrolled.stretches.len(), table.pieces().len());
            for (number, piece) in table.pieces().iter().enumerate() {
                for k in 0..=100 {
                    let landing = piece.landing_at(piece.length() * f64::from(k) * 0.01);
                    let fast = unrolled.arc_length(landing.point.into(), || landing.normal.into(), number as f64);
                    let exact = unrolled.of_one(number as f64, &landing);
                    // a closed curve ends where it begins
                    let off = (fast - exact).abs();
                    let round = piece.ends().is_none() && (off - piece.length() * unrolled.unit).abs() < 1e-7;
                    assert!(off < 1e-7 || round, "{table:?} {number} {k}: {fast} {exact}");
                }
            }
        }
    }
}

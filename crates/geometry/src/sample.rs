//! Random points of a table and of its boundary: where ensembles start.
//!
//! Random numbers come from the caller, uniform in [0, 1).
use crate::{Error, Landing, Table, table::piece_at};
use nalgebra::Vector2;

/// The uniform distribution on a bounded table, or on a [cell](Table::cell) of one on a lattice.
///
/// ```
/// use geometry::{Interior, tables};
/// let stadium = tables::stadium(1.0, 1.0)?;
/// let mut state = 1_u64;
/// let mut uniform = || {
///     state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
///     (state >> 11) as f64 / (1_u64 << 53) as f64
/// };
/// let interior = Interior::of(&stadium)?;
/// let point = interior.point(&mut uniform).expect("the stadium fills most of its extent");
/// assert!(stadium.contains(&point));
/// # Ok::<(), geometry::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Interior<'a> {
    table: &'a Table,
    /// A parallelogram around the table: a corner, and the edges from there.
    corner: Vector2<f64>,
    edges: [Vector2<f64>; 2],
}

/// After this many trial points in a row outside the table, the search for a point is given up.
const MOST_TRIALS: u32 = 1_000_000;

impl<'a> Interior<'a> {
    /// The uniform distribution on a table.
    ///
    /// # Errors
    /// [`Error::Unbounded`] for a table of infinite area.
    pub fn of(table: &'a Table) -> Result<Interior<'a>, Error> {
        let area = table.area();
        if !(area > 0.0 && area.is_finite()) {
            return Err(Error::Unbounded { what: "the area of the table" });
        }
        let extent = table.extent();
        let size = extent.max - extent.min;
        let begin = table.cell().map_or_else(Vector2::zeros, |cell| cell.lattice().translation(cell.corner()));
        let (corner, edges) = match table.shortest().map_or(&[][..], |lattice| lattice.vectors()) {
            [a, b] => (begin, [*a, *b]),
            [a] => {
                // a cell of a channel: as high as the extent, seen along the channel
                let across = Vector2::new(-a.y, a.x) / libm::hypot(a.x, a.y);
                let middle = (extent.min + extent.max) * 0.5;
                let reach = 0.5 * (size.x * across.x.abs() + size.y * across.y.abs());
                let low = across * (across.dot(&middle) - reach);
                (begin + low, [*a, across * (2.0 * reach)])
            }
            _ => (extent.min, [Vector2::new(size.x, 0.0), Vector2::new(0.0, size.y)]),
        };
        Ok(Interior { table, corner, edges })
    }

    /// A random point of the table: trial points of a parallelogram around it, until one lies inside. `None` after a
    /// million trials, in a table that fills next to nothing of its extent.
    pub fn point(&self, uniform: &mut impl FnMut() -> f64) -> Option<Vector2<f64>> {
        let [a, b] = self.edges;
        (0..MOST_TRIALS).map(|_| self.corner + a * uniform() + b * uniform()).find(|point| self.table.contains(point))
    }
}

/// The uniform distribution, by arc length, on the boundary of a table.
#[derive(Clone, Debug)]
pub struct Perimeter<'a> {
    table: &'a Table,
    /// Arc length up to the start of each piece, and the total length.
    offsets: Vec<f64>,
    length: f64,
}

/// A point of the boundary of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundaryPoint {
    /// The number of its piece.
    pub piece: usize,
    /// Arc length from the start of the piece \[L\].
    pub arc_length: f64,
    /// The point \[L\], on a lattice in its [cell](Table::cell).
    pub point: Vector2<f64>,
    /// Unit normal there, into the table.
    pub normal: Vector2<f64>,
}

impl<'a> Perimeter<'a> {
    /// The uniform distribution on the boundary of a table.
    ///
    /// # Errors
    /// [`Error::Unbounded`] for a boundary of infinite length.
    pub fn of(table: &'a Table) -> Result<Perimeter<'a>, Error> {
        let length = table.perimeter();
        if !length.is_finite() {
            return Err(Error::Unbounded { what: "the length of the walls" });
        }
        Ok(Perimeter { table, offsets: table.arc_length_offsets(), length })
    }

    /// The point at the fraction `u` of the boundary, 0 ≤ u < 1, all pieces laid end to end in the order of their
    /// numbers. Uniform for uniform `u`.
    pub fn point(&self, u: f64) -> BoundaryPoint {
        let (piece, s) = piece_at(&self.offsets, u * self.length);
        let on = &*self.table.pieces()[piece];
        let arc_length = s.clamp(0.0, on.length());
        let Landing { point, normal } = self.table.landing_on(on, arc_length);
        BoundaryPoint { piece, arc_length, point, normal }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Lattice, Piece, shapes::Segment, tables};

    /// The additive recurrence of the plastic number: points that fill the square evenly.
    fn even() -> impl FnMut() -> f64 {
        let mut k = 0.0;
        move || {
            k += 1.0;
            let step = if k % 2.0 == 1.0 { 0.754_877_666_246_692_7 } else { 0.569_840_290_998_053_3 };
            let x = step * (0.5 * k + 0.5_f64).floor();
            x - x.floor()
        }
    }

    #[test]
    fn points_of_a_table_are_spread_evenly() {
        // such points measure areas to about (log n)²/n: 2e-3 for n = 20 000
        let table = tables::mushroom(1.0, 0.5, 0.75).unwrap();
        let interior = Interior::of(&table).unwrap();
        let mut uniform = even();
        let n = 20_000;
        let points: Vec<_> = (0..n).map(|_| interior.point(&mut uniform).unwrap()).collect();
        assert!(points.iter().all(|p| table.contains(p)));
        let in_stem = points.iter().filter(|p| p.y < 0.0).count() as f64 / f64::from(n);
        assert!((in_stem - 0.375 / table.area()).abs() < 4e-3, "{in_stem}");
    }

    #[test]
    fn points_of_a_channel_askew_are_spread_evenly_over_a_cell() {
        let v = Vector2::new;
        for (along, far) in [(v(2.0, 1.0), v(3.0, 7.0)), (v(0.5, -3.0), v(-20.0, 4.0)), (v(1.0, 0.0), v(0.0, 0.0))] {
            let across = v(-along.y, along.x) * 0.75;
            let wall = |a: Vector2<f64>, b: Vector2<f64>| Box::new(Segment::new(a, b).unwrap()) as Box<dyn Piece>;
            let walls = vec![wall(far, far + along), wall(far + along + across, far + across)];
            let table = Table::periodic(walls, Some(Lattice::new(&[along]).unwrap())).unwrap();
            let interior = Interior::of(&table).unwrap();
            let (n, mut uniform, mut shares) = (4000, even(), [[0; 4]; 4]);
            for _ in 0..n {
                let off = interior.point(&mut uniform).unwrap() - far;
                let [a, b] = [along, across].map(|edge| off.dot(&edge) / edge.norm_squared());
                let share = |x: f64| [0.25, 0.5, 0.75].iter().filter(|&&bound| x >= bound).count();
                shares[share(a - a.floor())][share(b)] += 1;
            }
            let even = shares.as_flattened().iter().all(|share| (share * 16_i32 - n).abs() < n / 10);
            assert!(even, "{along}: {shares:?}");
        }
    }

    #[test]
    fn points_of_lattice_tables_lie_in_a_cell() {
        for table in [tables::lorentz(0.4, 1.0).unwrap(), tables::channel(1.0, 1.0, 0.2).unwrap()] {
            let interior = Interior::of(&table).unwrap();
            let mut uniform = even();
            for _ in 0..1000 {
                let p = interior.point(&mut uniform).unwrap();
                let home = table.home(&p);
                assert!((home - p).norm() < 4.0 * f64::EPSILON && table.contains(&p));
            }
        }
    }

    #[test]
    fn boundary_points_lie_on_their_pieces() {
        for entry in tables::all().iter().filter(|e| e.dimension() == 2) {
            let table = entry.planar(&entry.typical()).unwrap();
            let Ok(perimeter) = Perimeter::of(&table) else { continue };
            for k in 0..500 {
                let at = perimeter.point(f64::from(k) / 500.0);
                // a few ulp of the largest coordinate, 2
                assert!(table.signed_distance(&at.point).abs() < 8.0 * f64::EPSILON, "{}: {at:?}", entry.name);
                let piece = &table.pieces()[at.piece];
                assert!((0.0..=piece.length()).contains(&at.arc_length));
                assert!((at.normal.norm() - 1.0).abs() < 4.0 * f64::EPSILON);
            }
        }
    }

    #[test]
    fn infinite_tables_have_no_uniform_distribution() {
        for table in [tables::strip(1.0).unwrap(), tables::wedge(1.0).unwrap()] {
            assert_eq!(Interior::of(&table).unwrap_err(), Error::Unbounded { what: "the area of the table" });
            assert_eq!(Perimeter::of(&table).unwrap_err(), Error::Unbounded { what: "the length of the walls" });
        }
    }
}

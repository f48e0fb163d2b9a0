//! Starts in equal cells of the phase space of a planar table.
use super::{Start, Starts, checked, leaving};
use crate::Error;
use geometry::{BoundaryPoint, GOLDEN_RATIO, Perimeter, Table};

/// A regular grid over the reduced phase space of a planar table: one start in each cell, all cells of equal canonical measure.
///
/// `(s, v₀, vₜ)` are taken in arc length and polar coordinates `(v₀, vₜ) = speed · r (cos φ, sin φ)`, with `r²` and `φ` in equal steps.
/// Starts lie in the middle of `r²` and `φ`, and at the golden section of `s`: the middle of an arc would often be a vertex where sides
/// have lengths in simple ratios. From number [`Grid::count`] on the starts repeat. For points, which have no spin, the grid is one in
/// `(s, vₜ)`.
///
/// ```
/// use billiards::{Grid, Starts, geometry::tables};
///
/// let square = tables::square(1.0)?;
/// let grid = Grid::new(&square, 1.0, [4, 2, 8])?;
/// let starts: Vec<_> = (0..grid.count()).map(|i| grid.start(i)).collect();
/// assert_eq!(starts.len(), 4 * 2 * 8);
/// let on_the_floor = starts.iter().filter(|start| start.position[1] == 0.0);
/// assert_eq!(on_the_floor.count(), 2 * 8); // one of the four sides
/// assert_eq!(grid.start(grid.count() + 3), starts[3]);
/// # Ok::<(), billiards::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Grid<'a, const S: usize = 1> {
    perimeter: Perimeter<'a>,
    speed: f64,
    /// Cells in arc length, `r²` and `φ`; for points in arc length and `vₜ`, and one.
    cells: [u64; 3],
    /// Starts.
    count: u64,
}

impl<'a> Grid<'a> {
    /// A grid of this many positions, radii and angles.
    ///
    /// # Errors
    /// Those of [`Canonical::new`](crate::Canonical::new), and [`Error::Grid`] without cells or with too many to count.
    pub fn new(table: &'a Table, speed: f64, cells: [u64; 3]) -> Result<Self, Error> {
        Grid::of_cells(table, speed, cells)
    }

    /// `count` starts in a grid with at least as many cells, about as many each way; the cells that have none are far apart.
    ///
    /// # Errors
    /// Those of [`Grid::new`].
    pub fn with_count(table: &'a Table, speed: f64, count: u64) -> Result<Self, Error> {
        let [a, b, c] = about_as_many(count, libm::cbrt(count as f64));
        Ok(Grid { count, ..Grid::new(table, speed, [a, b, c])? })
    }
}

impl<'a> Grid<'a, 0> {
    /// `count` starts of points in a grid with at least as many cells of `(s, vₜ)`, about as many each way.
    ///
    /// # Errors
    /// Those of [`Grid::new`].
    pub fn of_points(table: &'a Table, speed: f64, count: u64) -> Result<Self, Error> {
        let [a, b] = about_as_many(count, (count as f64).sqrt());
        Ok(Grid { count, ..Grid::of_cells(table, speed, [a, b, 1])? })
    }
}

/// Numbers whose product is at least `count`: the whole part of its root, and some of them one more.
fn about_as_many<const D: usize>(count: u64, root: f64) -> [u64; D] {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 2³²")]
    let mut cells = [root as u64; D];
    for i in 0..D {
        if cells.iter().map(|n| u128::from(*n)).product::<u128>() < u128::from(count) {
            cells[i] += 1;
        }
    }
    cells
}

impl<'a, const S: usize> Grid<'a, S> {
    fn of_cells(table: &'a Table, speed: f64, cells: [u64; 3]) -> Result<Self, Error> {
        let [a, b, c] = cells;
        let count = a.checked_mul(b).and_then(|ab| ab.checked_mul(c));
        if count.is_none_or(|count| count == 0 || count >= 1 << 63) {
            return Err(Error::Grid);
        }
        Ok(Grid { perimeter: Perimeter::of(table)?, speed: checked(speed)?, cells, count: a * b * c })
    }

    /// The number of starts.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The cell of a start: the point on the boundary, and the middle in the other coordinates, of [0, 1] each.
    fn cell(&self, i: u64) -> (BoundaryPoint, [f64; 2]) {
        let [a, b, c] = self.cells;
        #[allow(clippy::cast_possible_truncation, reason = "less than the number of cells")]
        let i = (u128::from(i % self.count) * u128::from(a * b * c) / u128::from(self.count)) as u64;
        let middle = |k: u64, of: u64| (k as f64 + 0.5) / of as f64;
        let at = self.perimeter.point(((i / (b * c)) as f64 + GOLDEN_RATIO) / a as f64);
        (at, [middle(i / c % b, b), middle(i % c, c)])
    }
}

impl Starts<2, 1> for Grid<'_> {
    fn start(&self, i: u64) -> Start<2, 1> {
        let (at, [square, turn]) = self.cell(i);
        let r = square.sqrt();
        let (sin, cos) = libm::sincos(core::f64::consts::TAU * turn);
        leaving(at.point, at.normal, [r * cos], r * sin, self.speed)
    }
}

impl Starts<2, 0> for Grid<'_, 0> {
    fn start(&self, i: u64) -> Start<2, 0> {
        let (at, [part, _]) = self.cell(i);
        leaving(at.point, at.normal, [], 2.0 * part - 1.0, self.speed)
    }
}

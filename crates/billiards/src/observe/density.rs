//! Counts of very many points on a grid.
use crate::merge::Merge;
use lanes::{Lane, MOST_LANES, Mask, WHOLE};

/// How many of the points fell into each cell of a grid over a window of the plane, in one layer or several.
///
/// Memory does not grow with the points, and counts merge exactly, in any order. Counting a point takes a few multiplications and an
/// addition to a byte: the low eight bits of all counts lie close together, so that the cells in use fit into the cache of a core, and
/// only every 256th point of a cell goes beyond.
#[derive(Clone, Debug)]
pub struct Density {
    low: [f64; 2],
    high: [f64; 2],
    size: [usize; 2],
    layers: usize,
    /// The middle of the first cell, and cells per length.
    first: [f64; 2],
    scale: [f64; 2],
    /// The number of cells from one row to the next.
    stride: f64,
    /// The cell for lanes without a point, in the form that [`count`](Self::count) takes.
    nobody: f64,
    /// Counts modulo 256, layer by layer, each with a border of cells around the window for the points outside; at the end those of lanes
    /// without a point.
    few: Vec<u8>,
    /// What is missing in these counts: multiples of 256.
    many: Vec<u64>,
}

/// The last bits of `x + WHOLE`: the whole number nearest to `x`, for `0 ≤ x < 2⁵¹`.
const LAST_BITS: u64 = (1 << 51) - 1;
/// Cells are counted this many points later: a few vectors of any width.
const MOST_NOTED: usize = 256;
/// This many cells are carried over together.
const MOST_FULL: usize = 256;

impl Density {
    /// A grid of `size[0]` × `size[1]` empty cells (at least one each way) over the window between two corners; cells are
    /// counted from `low` towards `high`, wherever that lies. A point on the edge between two cells belongs to one of them,
    /// on the edge of the window to the outside perhaps. In a window without width or height, all points are outside.
    ///
    /// # Panics
    /// As `Vec` does, where memory does not hold nine bytes for each cell.
    pub fn new(low: [f64; 2], high: [f64; 2], size: [usize; 2]) -> Self {
        let size = size.map(|n| n.max(1));
        let scale = [0, 1].map(|i| size[i] as f64 / (high[i] - low[i]));
        let first = [0, 1].map(|i| low[i] + 0.5 / scale[i]);
        let (stride, nobody) = ((size[0] + 2) as f64, 0.0);
        Density { low, high, size, layers: 0, first, scale, stride, nobody, few: vec![], many: vec![] }.in_layers(1)
    }

    /// A square grid over the unit disk, the window of velocity portraits.
    pub fn disk(size: usize) -> Self {
        Density::new([-1.0; 2], [1.0; 2], [size; 2])
    }

    /// This many empty grids over the same window, at least one.
    ///
    /// # Panics
    /// As [`Density::new`].
    #[must_use]
    pub fn in_layers(self, layers: usize) -> Self {
        let layers = layers.max(1);
        let cells = layers * self.cells_of_layer() + 1;
        let nobody = WHOLE + (cells - 1) as f64;
        Density { layers, nobody, few: vec![0; cells], many: vec![0; cells], ..self }
    }

    /// The corners of the window.
    pub fn window(&self) -> [[f64; 2]; 2] {
        [self.low, self.high]
    }

    /// Number of cells each way.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The counts of a layer, row by row from `low` on, first coordinate first; none if there is no such layer.
    pub fn counts(&self, layer: usize) -> Vec<u64> {
        let [width, height] = self.size;
        let mut counts = Vec::with_capacity(width * height);
        (0..height).for_each(|row| counts.extend(self.row(layer, row)));
        counts
    }

    /// The counts of a row of a layer; none if there is no such row or layer.
    pub fn row(&self, layer: usize, row: usize) -> impl Iterator<Item = u64> {
        let [width, height] = self.size;
        let first = self.first(layer) + row.min(height) * (width + 2);
        let cells = first..first + if row < height && layer < self.layers { width } else { 0 };
        self.few[cells.clone()].iter().zip(&self.many[cells]).map(|(few, many)| many + u64::from(*few))
    }

    /// Number of layers.
    pub fn layers(&self) -> usize {
        self.layers
    }

    /// Points inside the window.
    pub fn inside(&self) -> u64 {
        (0..self.layers).flat_map(|layer| self.counts(layer)).sum()
    }

    /// Points outside the window.
    pub fn outside(&self) -> u64 {
        self.total() - self.inside()
    }

    /// All points, inside and outside.
    pub fn total(&self) -> u64 {
        (0..self.few.len() - 1).map(|cell| self.at(cell)).sum()
    }

    fn at(&self, cell: usize) -> u64 {
        self.many[cell] + u64::from(self.few[cell])
    }

    fn cells_of_layer(&self) -> usize {
        (self.size[0] + 2) * (self.size[1] + 2)
    }

    /// The first cell of a layer that is not in its border.
    fn first(&self, layer: usize) -> usize {
        layer.min(self.layers - 1) * self.cells_of_layer() + self.size[0] + 3
    }

    /// Counts a point in the first layer.
    #[inline(always)]
    pub fn add(&mut self, point: [f64; 2]) {
        self.add_to(point, self.layer(0));
    }

    /// The layer of this number, or the last one if there are fewer, in the form that [`add_to`](Self::add_to) takes.
    pub fn layer(&self, layer: usize) -> f64 {
        self.first(layer) as f64
    }

    /// Counts a point in the layer given by [`layer`](Self::layer).
    #[inline(always)]
    pub fn add_to(&mut self, point: [f64; 2], layer: f64) {
        self.count(&[self.cells(self.near(point), layer, true)]);
    }

    /// Points, those far outside the window (or nowhere) replaced by some close to it.
    #[inline(always)]
    pub fn near<F: Lane>(&self, point: [F; 2]) -> [F; 2] {
        let bounds = |i: usize| {
            let (low, high) = (self.low[i].min(self.high[i]), self.low[i].max(self.high[i]));
            let beside = (0.5 / self.scale[i]).abs();
            (low - beside, high + beside)
        };
        let [(left, right), (below, above)] = [bounds(0), bounds(1)];
        let [x, y] = point;
        [x.max(x.same(left)).min(x.same(right)), y.max(y.same(below)).min(y.same(above))]
    }

    /// Number of the cell along an axis, added to [`WHOLE`].
    #[inline(always)]
    fn along<F: Lane>(&self, x: F, axis: usize) -> F {
        (x - self.first[axis]) * self.scale[axis] + WHOLE
    }

    /// The cells of a point in each lane that is `here`, in the layers given by [`layer`](Self::layer), for
    /// [`count`](Self::count): of points in the window or [`near`](Self::near) it.
    #[inline(always)]
    pub fn cells<F: Lane>(&self, point: [F; 2], layer: F, here: F::Mask) -> F {
        let (column, row) = (self.along(point[0], 0), self.along(point[1], 1) - WHOLE);
        let cell = column + (row * self.stride + layer);
        here.select(cell, layer.same(self.nobody))
    }

    /// Counts a point in each of some [`cells`](Self::cells).
    #[inline(always)]
    pub fn count(&mut self, cells: &[f64]) {
        for cell in cells {
            let cell = number(*cell);
            if adds_to(&mut self.few, cell) {
                self.many[cell] += 256;
            }
        }
    }
}

/// Counts a point; returns whether that makes another 256 of them. A point far outside, which has no cell, is not counted.
#[inline(always)]
fn adds_to(few: &mut [u8], cell: usize) -> bool {
    let Some(few) = few.get_mut(cell) else { return false };
    *few = few.wrapping_add(1);
    *few == 0
}

/// The number of a cell.
#[inline(always)]
fn number(cell: f64) -> usize {
    #[allow(clippy::cast_possible_truncation, reason = "the number of something in memory")]
    let number = (cell.to_bits() & LAST_BITS) as usize;
    number
}

/// The cells of the latest points, which are not counted yet: so a count need not wait for the search for its cell, and the search for
/// the next cells need not wait for the count.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Noted {
    cells: [f64; MOST_NOTED],
    /// Where the oldest of them are.
    oldest: usize,
    /// Cells with another 256 points, which lie far apart: many of them are fetched at the same time.
    full: [usize; MOST_FULL],
    /// How many there are.
    filled: usize,
}

impl Noted {
    /// No cells of this density yet.
    pub fn new(density: &Density) -> Self {
        Noted { cells: [density.nobody; MOST_NOTED], oldest: 0, full: [0; MOST_FULL], filled: 0 }
    }

    /// Notes the [`cells`](Density::cells) of points of this density, and counts as many others.
    #[inline(always)]
    pub fn note<F: Lane>(&mut self, density: &mut Density, cells: F) {
        let oldest = if self.oldest + F::LANES > MOST_NOTED { 0 } else { self.oldest };
        let old = &mut self.cells[oldest..oldest + F::LANES];
        // where the counts begin is read once for all of them
        let Density { few, many, .. } = density;
        let few = few.as_mut_slice();
        let (full, mut filled) = (&mut self.full, self.filled);
        for cell in &*old {
            let cell = number(*cell);
            // rare, and never predicted: no call is made here, for which all vectors would have to leave their registers
            if adds_to(few, cell) {
                full[filled % MOST_FULL] = cell;
                filled += 1;
            }
        }
        cells.store(old);
        (self.oldest, self.filled) = (oldest + F::LANES, filled);
        if filled > MOST_FULL - MOST_LANES {
            self.carry(many);
        }
    }

    /// Counts what is noted.
    pub fn count(&mut self, density: &mut Density) {
        density.count(&self.cells);
        self.carry(&mut density.many);
        self.cells = [density.nobody; MOST_NOTED];
    }

    /// Carries the full cells over.
    #[cold]
    #[inline(never)]
    fn carry(&mut self, many: &mut [u64]) {
        self.full[..self.filled].iter().for_each(|cell| many[*cell] += 256);
        self.filled = 0;
    }
}

impl Density {
    /// Adds the points of another grid; if that has another window, size or number of layers, they count as points outside.
    pub fn merge_in(&mut self, other: &Self) {
        let same = (self.low, self.high, self.size, self.layers) == (other.low, other.high, other.size, other.layers);
        if !same {
            let total = other.total() + u64::from(self.few[0]);
            #[allow(clippy::cast_possible_truncation, reason = "the last eight bits")]
            let few = total as u8;
            self.few[0] = few;
            self.many[0] += total - u64::from(few);
            return;
        }
        let cells = self.few.iter_mut().zip(&mut self.many);
        for ((few, many), (other_few, other_many)) in cells.zip(other.few.iter().zip(&other.many)) {
            let (sum, carry) = few.overflowing_add(*other_few);
            *few = sum;
            // memory that was never written need not be allocated
            let more = other_many + if carry { 256 } else { 0 };
            if more > 0 {
                *many += more;
            }
        }
    }
}

/// The same window, size and layers, and as many points in each cell, inside and outside.
impl PartialEq for Density {
    fn eq(&self, other: &Self) -> bool {
        // lanes without a point say how many lanes there were
        let points = |of: &Density| (of.few.len() - 1, of.low, of.high, of.size, of.layers);
        let cells = self.few.len() - 1;
        points(self) == points(other)
            && self.few[..cells] == other.few[..cells]
            && self.many[..cells] == other.many[..cells]
    }
}

impl Extend<[f64; 2]> for Density {
    #[inline(always)]
    fn extend<I: IntoIterator<Item = [f64; 2]>>(&mut self, points: I) {
        for point in points {
            self.add(point);
        }
    }
}

/// See [`Density::merge_in`].
impl Merge for Density {
    fn merge(mut self, other: Self) -> Self {
        self.merge_in(&other);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_falls_into_the_cell_around_it() {
        let mut grid = Density::new([0.0, 0.0], [4.0, 2.0], [4, 2]);
        grid.extend([[1e-9, 1e-9], [3.5, 1.5], [3.999, 1.001], [1.5, 0.5]]);
        assert_eq!(grid.counts(0), [1, 1, 0, 0, 0, 0, 0, 2]);
        assert_eq!([0, 1, 2].map(|row| grid.row(0, row).sum::<u64>()), [2, 2, 0]);
        let far = [[4.001, 0.5], [1.0, -1e-9], [f64::NAN, 0.5], [0.5, 1e300], [f64::NEG_INFINITY, 0.5], [-1e-9, 0.5]];
        grid.extend(far);
        assert_eq!((grid.outside(), grid.total()), (6, 10));
    }

    #[test]
    fn lanes_without_a_point_do_not_make_two_counts_differ() {
        let mut grid = Density::disk(4);
        grid.add([0.5, 0.5]);
        for here in [true, false] {
            let mut other = grid.clone();
            other.count(&[grid.cells([0.25, 0.75], grid.layer(0), here)]);
            assert_eq!(other != grid, here);
        }
        assert_ne!(Density::disk(4), Density::disk(5));
    }

    #[test]
    fn a_layer_that_is_not_there_has_no_counts() {
        let grid = Density::disk(2).in_layers(2);
        assert_eq!([0, 1, 2].map(|layer| grid.counts(layer).len()), [4, 4, 0]);
    }

    #[test]
    fn a_point_on_an_edge_belongs_to_one_of_both_cells() {
        let mut grid = Density::new([0.0, 3.0], [8.0, 0.0], [8, 3]);
        grid.extend((1..8).map(|x| [f64::from(x), 2.5]));
        assert_eq!((grid.counts(0)[..8].iter().sum::<u64>(), grid.total()), (7, 7));
        // the next numbers to both sides belong to both
        let mut grid = Density::new([0.0, 3.0], [8.0, 0.0], [8, 3]);
        for x in (1..8).map(f64::from) {
            grid.extend([[x * (1.0 - 1e-14), 2.5], [x * (1.0 + 1e-14), 2.5]]);
        }
        assert_eq!(grid.counts(0)[..8], [1, 2, 2, 2, 2, 2, 2, 1]);
    }

    #[test]
    fn a_window_far_from_the_origin_has_cells_as_any_other() {
        // three numbers to a cell, of which the middle one is counted
        let (low, cell) = (6e15, 3.0);
        let mut grid = Density::new([low, 0.0], [low + 1000.0 * cell, 1.0], [1000, 1]);
        grid.extend((0..1000).map(|k| [low + f64::from(k) * cell + 1.0, 0.5]));
        assert_eq!(grid.counts(0), [1; 1000]);
        grid.extend([[low - 3.0, 0.5], [-low, 0.5], [low + 1001.0 * cell, 0.5], [2.0 * low, 0.5]]);
        assert_eq!((grid.inside(), grid.outside()), (1000, 4));
    }

    #[test]
    fn in_a_window_without_width_all_points_are_outside() {
        for high in [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [f64::NAN, 1.0], [f64::INFINITY, 1.0]] {
            let mut grid = Density::new([0.0; 2], high, [4, 4]);
            grid.extend([[0.0, 0.0], [0.5, 0.0], [0.0, 0.5], [0.5, 0.5], [f64::NAN, 0.5]]);
            assert_eq!((grid.inside(), grid.outside()), (0, 5), "{high:?}");
        }
    }

    #[test]
    fn far_points_are_brought_near_and_near_ones_stay() {
        let grid = Density::new([0.0, 1.0], [2.0, -1.0], [20, 20]);
        assert_eq!(grid.near([0.3, -0.7]), [0.3, -0.7]);
        for (far, near) in [(-5.0, -0.05), (5.0, 2.05), (f64::NAN, -0.05)] {
            assert_eq!(grid.near([far, 0.0])[0], near);
        }
        assert_eq!([grid.near([0.0, -9.0])[1], grid.near([0.0, 9.0])[1]], [-1.05, 1.05]);
    }

    #[test]
    fn counts_beyond_a_byte_are_whole() {
        let mut grid = Density::new([0.0; 2], [1.0; 2], [2, 2]).in_layers(3);
        let layer = grid.layer(1);
        for _ in 0..1000 {
            grid.add_to([0.7, 0.2], layer);
            grid.count(&[grid.cells([0.7, 0.2], layer, false)]);
        }
        let grid = grid.clone().merge(grid);
        assert_eq!([0, 1, 2].map(|layer| grid.counts(layer)), [[0; 4], [0, 2000, 0, 0], [0; 4]]);
        assert_eq!((grid.total(), grid.outside()), (2000, 0));
    }

    #[test]
    fn noted_points_are_counted_all() {
        let mut grid = Density::new([0.0; 2], [1.0; 2], [50, 40]).in_layers(2);
        let mut same = grid.clone();
        let (mut noted, layer) = (Noted::new(&grid), grid.layer(1));
        for i in 0..200_000 {
            let point = [f64::from(i * 7 % 1001) / 1000.0, f64::from(i * 13 % 1003) / 500.0];
            let cells = grid.cells(grid.near(point), layer, i % 5 > 0);
            noted.note(&mut grid, cells);
            if i % 5 > 0 {
                same.add_to(point, layer);
            }
        }
        noted.count(&mut grid);
        assert_eq!(
            (0..2).map(|k| grid.counts(k)).collect::<Vec<_>>(),
            (0..2).map(|k| same.counts(k)).collect::<Vec<_>>()
        );
        assert_eq!((grid.total(), grid.outside()), (160_000, same.outside()));
    }

    #[test]
    fn points_noted_one_by_one_and_side_by_side_are_counted_all() {
        struct Both<'a>(&'a mut Density, &'a mut Noted);
        impl lanes::Kernel for Both<'_> {
            type Output = u64;
            fn run<F: Lane>(self, zero: F) -> u64 {
                let Both(grid, noted) = self;
                let layer = grid.layer(0);
                for k in 0..1000 {
                    let cells = grid.cells([zero, zero], zero.same(layer), !zero.never());
                    noted.note(grid, cells);
                    for _ in 0..k % 7 {
                        let cells = grid.cells([0.0, 0.0], layer, true);
                        noted.note(grid, cells);
                    }
                }
                noted.count(grid);
                1000 * F::LANES as u64 + (0..1000).map(|k| k % 7).sum::<u64>()
            }
        }
        let mut grid = Density::disk(10);
        let mut noted = Noted::new(&grid);
        let points = lanes::dispatch(Both(&mut grid, &mut noted));
        assert_eq!((grid.total(), grid.inside()), (points, points));
    }

    #[test]
    fn merged_counts_are_the_counts_of_all_points() {
        let points = |from: u32| (from..from + 50).map(|i| [f64::from(i * i % 37) / 37.0, f64::from(i % 11) / 10.0]);
        let count = |points: &mut dyn Iterator<Item = [f64; 2]>| {
            let mut grid = Density::new([0.0; 2], [1.0; 2], [8, 8]);
            grid.extend(points);
            grid
        };
        let together = count(&mut points(0).chain(points(50)));
        let [first, second] = [count(&mut points(0)), count(&mut points(50))];
        assert_eq!(first.clone().merge(second.clone()), together);
        assert_eq!(second.merge(first), together);
    }
}

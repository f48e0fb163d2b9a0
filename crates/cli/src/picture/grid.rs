//! Counts of very many points on a grid, and their shading.

use billiards::observe::Density;

use super::ink::Colour;
use super::png::Raster;
use super::view::Window;

/// Points counted per cell of a grid over a window, with the colours they came in. Adding and merging in any order gives
/// the same grid.
#[derive(Clone, Debug)]
pub struct Grid {
    colours: Vec<Colour>,
    /// A layer for each colour, rows from the top.
    density: Density,
}

/// The counts of all colours together.
#[derive(Clone, Debug)]
struct Tally {
    width: usize,
    height: usize,
    counts: Vec<u64>,
    /// The mean colour of the points of each cell.
    tints: Vec<Colour>,
}

/// How counts are mapped to depth of colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shading {
    /// By the logarithm of the count, up to the count that 1 in 200 cells exceeds: true to orders of magnitude.
    Log,
    /// By the logarithm, in the colours themselves and never near black: thin curves keep their colour, and single points
    /// are visible.
    Tinted,
}

/// Depth of the faintest cell that is not empty.
const FAINTEST: f64 = 0.22;
/// The same where points are few.
const SPARSE: f64 = 0.6;
/// Depth of the full colour; from here on it darkens towards black.
const FULL: f64 = 0.7;
/// So much deeper it would be black; the greatest depth is 1, so that colours can be told apart to the end.
const TO_BLACK: f64 = 0.45;
/// Shares of filled cells above which points are drawn as single cells, and as dots of five cells; below, of thirteen.
const DENSE: f64 = 0.25;
const SCATTERED: f64 = 0.02;
/// Most cells in a row or column.
const MOST_CELLS: usize = 16_384;

impl Grid {
    /// An empty grid over a window, this many cells wide, for points of these colours; cells are square.
    pub fn new(window: Window, width: usize, colours: &[Colour]) -> Self {
        let [w, h] = window.size();
        let width = width.clamp(1, MOST_CELLS);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to a few thousand")]
        let height = ((width as f64 * h / w + 0.5).clamp(1.0, MOST_CELLS as f64)) as usize;
        let Window { low, high } = window;
        let density = Density::new([low[0], high[1]], [high[0], low[1]], [width, height]).in_layers(colours.len());
        Self { colours: colours.into(), density }
    }

    /// Width and height in cells.
    pub fn size(&self) -> [usize; 2] {
        self.density.size()
    }

    /// Counts a point; one outside the window is left out.
    #[inline]
    pub fn add(&mut self, point: [f64; 2], colour: Colour) {
        // points of an unexpected colour are drawn in the last one
        let layer = self.colours.iter().position(|of| *of == colour).unwrap_or(self.colours.len());
        self.density.add_to(point, self.density.layer(layer));
    }

    /// Its counts, a layer for each colour.
    pub fn into_density(self) -> Density {
        self.density
    }

    /// Adds counts of the same shape.
    pub fn merge(&mut self, counts: &Density) {
        self.density.merge_in(counts);
    }

    /// The counts of all colours together, row by row from the top.
    pub fn counts(&self) -> Vec<u64> {
        let [width, height] = self.size();
        let mut counts = vec![0; width * height];
        for (row, counts) in counts.chunks_exact_mut(width).enumerate() {
            for layer in 0..self.density.layers() {
                counts.iter_mut().zip(self.density.row(layer, row)).for_each(|(total, count)| *total += count);
            }
        }
        counts
    }

    fn tally(&self) -> Tally {
        let [width, height] = self.size();
        let mut tally = Tally { width, height, counts: self.counts(), tints: vec![Colour::WHITE; width * height] };
        let rows = tally.counts.chunks_exact(width).zip(tally.tints.chunks_exact_mut(width));
        for (row, (counts, tints)) in rows.enumerate() {
            let mut sums = vec![[0; 3]; width];
            for (layer, colour) in self.colours.iter().enumerate() {
                let parts = [colour.0, colour.1, colour.2].map(u64::from);
                for (sum, count) in sums.iter_mut().zip(self.density.row(layer, row)).filter(|of| of.1 > 0) {
                    for (sum, part) in sum.iter_mut().zip(parts) {
                        *sum += count * part;
                    }
                }
            }
            for ((tint, sum), &count) in tints.iter_mut().zip(sums).zip(counts).filter(|of| *of.1 > 0) {
                #[allow(clippy::cast_possible_truncation, reason = "a mean of bytes")]
                let [r, g, b] = sum.map(|sum| ((sum + count / 2) / count) as u8);
                *tint = Colour(r, g, b);
            }
        }
        tally
    }

    /// The picture of the counts: empty cells white, full ones in the mean colour of their points.
    ///
    /// Where few cells are filled, points are drawn as dots of several cells, and darker, since otherwise nothing would
    /// be visible.
    pub fn shade(&self, shading: Shading) -> Raster {
        self.tally().shade(shading)
    }
}

impl Tally {
    fn shade(&self, shading: Shading) -> Raster {
        let filled = self.counts.iter().filter(|count| **count > 0).count() as f64 / self.counts.len() as f64;
        match filled {
            DENSE.. => self.shaded(shading, FAINTEST),
            SCATTERED.. => self.spread(1).shaded(shading, SPARSE),
            _ => self.spread(2).shaded(shading, SPARSE),
        }
    }

    /// The same with every count spread over a disk of cells around its own; each cell takes the greatest.
    fn spread(&self, radius: usize) -> Self {
        let mut wide = self.clone();
        for (cell, (&count, &tint)) in self.counts.iter().zip(&self.tints).enumerate().filter(|(_, of)| *of.0 > 0) {
            let (row, column) = (cell / self.width, cell % self.width);
            for y in row.saturating_sub(radius)..=(row + radius).min(self.height - 1) {
                for x in column.saturating_sub(radius)..=(column + radius).min(self.width - 1) {
                    let near = y * self.width + x;
                    let (dy, dx) = (y.abs_diff(row), x.abs_diff(column));
                    if dx * dx + dy * dy <= radius * radius && wide.counts[near] < count {
                        (wide.counts[near], wide.tints[near]) = (count, tint);
                    }
                }
            }
        }
        wide
    }

    fn shaded(&self, shading: Shading, faintest: f64) -> Raster {
        let depth = self.depths(shading, faintest);
        let colour = |(&count, &full): (&u64, &Colour)| {
            if count == 0 {
                return Colour::WHITE;
            }
            let depth = depth(count);
            // From a pale tint through the full one towards black, so that more than one order of magnitude shows.
            if depth < FULL {
                Colour::WHITE.mix(full, depth / FULL)
            } else {
                full.mix(Colour::BLACK, (depth - FULL) / TO_BLACK)
            }
        };
        Raster::new(self.width, self.counts.iter().zip(&self.tints).map(colour))
    }

    /// The depth of colour, 0 … 1, of a count that is not zero.
    fn depths(&self, shading: Shading, faintest: f64) -> impl Fn(u64) -> f64 {
        let mut filled: Vec<u64> = self.counts.iter().copied().filter(|count| *count > 0).collect();
        // Leaves out the few cells of periodic orbits, beside which all else would be pale.
        let (few, last) = (filled.len() / 200, filled.len().saturating_sub(1));
        let mut ranked = |rank| if filled.is_empty() { 1 } else { *filled.select_nth_unstable(rank).1 };
        // black means that a count is an order of magnitude above others; where counts hardly differ the colour is full
        let (least, most) = (ranked(few), ranked(last.saturating_sub(few)));
        let darkest = FULL + (1.0 - FULL) * libm::log10(most as f64 / least as f64).min(1.0);
        move |count| {
            let share = match shading {
                Shading::Tinted => {
                    let share = libm::log(count as f64) / libm::log(most.max(2) as f64);
                    return 0.42 + 0.28 * share.min(1.0);
                }
                Shading::Log if most == 1 => 1.0,
                Shading::Log => (libm::log(count as f64) / libm::log(most as f64)).min(1.0),
            };
            faintest + (darkest - faintest) * share
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_counted_once_and_only_inside() {
        let mut grid = Grid::new(Window { low: [0.0, 0.0], high: [2.0, 1.0] }, 4, &[Colour::BLACK]);
        assert_eq!(grid.size(), [4, 2]);
        for point in [[0.0, 1.0], [1.99, 0.01], [2.0, 0.5], [-0.1, 0.5], [f64::NAN, 0.5]] {
            grid.add(point, Colour::BLACK);
        }
        assert_eq!(grid.tally().counts, [1, 0, 0, 0, 0, 0, 0, 1]);
        let mut doubled = grid.clone();
        doubled.merge(&grid.into_density());
        assert_eq!((doubled.density.inside(), doubled.tally().counts[7]), (4, 2));
    }

    #[test]
    fn a_cell_has_the_mean_colour_of_its_points() {
        let (blue, red) = (Colour(0, 40, 200), Colour(180, 40, 0));
        let mut grid = Grid::new(Window { low: [0.0, 0.0], high: [2.0, 1.0] }, 2, &[blue, red]);
        for colour in [blue, red, blue, blue] {
            grid.add([0.5, 0.5], colour);
        }
        let tally = grid.tally();
        assert_eq!((&tally.counts[..], &tally.tints[..]), (&[4, 0][..], &[Colour(45, 40, 150), Colour::WHITE][..]));
    }

    #[test]
    fn single_points_are_spread_to_be_seen() {
        let mut grid = Grid::new(Window { low: [0.0, 0.0], high: [100.0, 100.0] }, 100, &[Colour::BLACK]);
        grid.add([50.5, 50.5], Colour::BLACK);
        let wide = grid.tally().spread(2);
        assert_eq!(wide.counts.iter().filter(|count| **count > 0).count(), 13);
        assert_eq!(grid.tally().spread(1).counts.iter().filter(|count| **count > 0).count(), 5);
    }

    #[test]
    fn where_counts_hardly_differ_colours_are_not_near_black() {
        let colour = Colour(0, 0, 200);
        for (counts, darkest) in
            [([100, 101, 103, 102], 0.7..0.71), ([10, 30, 50, 100], 1.0..1.01), ([1; 4], 0.7..0.71)]
        {
            let mut grid = Grid::new(Window { low: [0.0, 0.0], high: [4.0, 1.0] }, 4, &[colour]);
            for (cell, count) in counts.into_iter().enumerate() {
                (0..count).for_each(|_| grid.add([cell as f64 + 0.5, 0.5], colour));
            }
            let depth = grid.tally().depths(Shading::Log, FAINTEST)(*counts.iter().max().unwrap());
            assert!(darkest.contains(&depth), "{counts:?}: {depth}");
        }
    }

    #[test]
    fn more_points_are_never_paler() {
        let mut grid = Grid::new(Window { low: [0.0, 0.0], high: [4.0, 1.0] }, 4, &[Colour(0, 0, 200)]);
        for (cell, count) in [(0.5, 1), (1.5, 10), (2.5, 100)] {
            for _ in 0..count {
                grid.add([cell, 0.5], Colour(0, 0, 200));
            }
        }
        let tally = grid.tally();
        let depth = tally.depths(Shading::Log, FAINTEST);
        assert!(depth(1) < depth(10) && depth(10) < depth(100) && depth(100) <= 1.0);
    }
}

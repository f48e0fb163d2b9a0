//! Counts of very many points on a grid.
use crate::merge::Merge;

/// How many of the points fell into each cell of a grid over a window of the plane.
///
/// Memory does not grow with the points, and counts merge exactly.
#[derive(Clone, Debug, PartialEq)]
pub struct Density {
    low: [f64; 2],
    high: [f64; 2],
    size: [usize; 2],
    counts: Vec<u64>,
    outside: u64,
}

impl Density {
    /// A grid of `size[0]` × `size[1]` empty cells (at least one each way) over `low ≤ x < high`.
    pub fn new(low: [f64; 2], high: [f64; 2], size: [usize; 2]) -> Self {
        let size = size.map(|n| n.max(1));
        Density { low, high, size, counts: vec![0; size[0] * size[1]], outside: 0 }
    }

    /// A square grid over the unit disk, the window of velocity portraits.
    pub fn disk(size: usize) -> Self {
        Density::new([-1.0; 2], [1.0; 2], [size; 2])
    }

    /// The corners of the window.
    pub fn window(&self) -> [[f64; 2]; 2] {
        [self.low, self.high]
    }

    /// Number of cells each way.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The counts, row by row from the lowest second coordinate up.
    pub fn counts(&self) -> &[u64] {
        &self.counts
    }

    /// Points outside the window.
    pub fn outside(&self) -> u64 {
        self.outside
    }

    /// All points, inside and outside.
    pub fn total(&self) -> u64 {
        self.counts.iter().sum::<u64>() + self.outside
    }

    /// Counts a point.
    #[inline]
    pub fn add(&mut self, point: [f64; 2]) {
        let mut cell = [0; 2];
        for i in 0..2 {
            let at = (point[i] - self.low[i]) / (self.high[i] - self.low[i]) * self.size[i] as f64;
            if !(at >= 0.0 && at < self.size[i] as f64) {
                self.outside += 1;
                return;
            }
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and the size")]
            let index = at as usize;
            cell[i] = index;
        }
        self.counts[cell[1] * self.size[0] + cell[0]] += 1;
    }
}

impl Extend<[f64; 2]> for Density {
    #[inline]
    fn extend<I: IntoIterator<Item = [f64; 2]>>(&mut self, points: I) {
        for point in points {
            self.add(point);
        }
    }
}

/// Of grids with different windows or sizes, the points of the second count as outside the first.
impl Merge for Density {
    fn merge(mut self, other: Self) -> Self {
        if (self.low, self.high, self.size) == (other.low, other.high, other.size) {
            for (a, b) in self.counts.iter_mut().zip(other.counts) {
                *a += b;
            }
            self.outside += other.outside;
        } else {
            self.outside += other.total();
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_falls_into_the_cell_around_it() {
        let mut grid = Density::new([0.0, 0.0], [4.0, 2.0], [4, 2]);
        grid.extend([[0.0, 0.0], [3.5, 1.5], [3.999, 1.0], [4.0, 0.5], [f64::NAN, 0.5], [1.5, 0.5]]);
        assert_eq!(grid.counts(), [1, 1, 0, 0, 0, 0, 0, 2]);
        assert_eq!((grid.outside(), grid.total()), (2, 6));
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

//! The map from the engine's coordinates to the user's.

use billiards::geometry::{FundamentalCell, Vector2};

/// The translation of the engine's positions, in its unit of length.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Frame<'a> {
    /// Position of the engine's origin.
    pub(crate) shift: [f64; 3],
    /// On a lattice the cell in which it follows paths, if that is not the unit cell: the user's places lie there.
    pub(crate) cell: Option<&'a FundamentalCell>,
}

impl Frame<'_> {
    /// The user's position, and by how many lattice vectors it has been moved, from those in the engine's cell.
    pub(crate) fn place<const N: usize>(&self, at: &[f64; N], cells: [f64; 2]) -> ([f64; 3], [f64; 2]) {
        let mut place = [0.0; 3];
        place[..N].copy_from_slice(at);
        let Some(cell) = self.cell else { return (self.shifted(place), cells) };
        let (home, by) = cell.in_unit_cell(&Vector2::new(place[0], place[1]));
        ([home.x, home.y, 0.0], [cells[0] + by[0], cells[1] + by[1]])
    }

    /// The end of a path, moved like the point from which it comes.
    pub(crate) fn beyond<const N: usize>(&self, from: &[f64; N], at: &[f64; N]) -> [f64; 3] {
        let mut place = [0.0; 3];
        place[..N].copy_from_slice(at);
        let Some(cell) = self.cell else { return self.shifted(place) };
        let (_, by) = cell.in_unit_cell(&Vector2::new(from[0], from[1]));
        let by = cell.given().translation(by);
        [place[0] - by.x, place[1] - by.y, 0.0]
    }

    fn shifted(&self, place: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|i| place[i] + self.shift[i])
    }
}

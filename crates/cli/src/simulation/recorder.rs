//! Collisions as rows of a record.

use super::event::Event;
use crate::record::{Columns, Format, Row};

/// Writes collisions in a format.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recorder<'a> {
    pub(crate) format: &'a dyn Format,
    pub(crate) columns: Columns,
}

impl Recorder<'_> {
    /// Appends the row of a collision.
    pub(crate) fn write(&self, event: &Event, to: &mut Vec<u8>) {
        let Event { orbit, n, time, piece, .. } = *event;
        let ([x1, x2, x3], [v1, v2, v3], [w1, w2, w3]) = (event.position, event.velocity, event.spin);
        #[allow(clippy::cast_possible_truncation, reason = "a number of cells")]
        let cell = event.cell.map(|c| c as i64);
        let cell = &cell[..self.columns.cells()];
        let (in_plane, in_space) = ([event.angle, x1, x2, w1, v1, v2], [x1, x2, x3, v1, v2, v3, w1, w2, w3]);
        let state = if self.columns.dimension == 2 { &in_plane[..] } else { &in_space[..] };
        self.format.row(&Row { orbit, n, time, piece, state, cell }, to);
    }
}

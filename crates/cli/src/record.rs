//! Collision records: one row per collision, in a format that other programs read.

mod csv;
mod jsonl;
mod npy;

use std::io;
use std::path::{Path, PathBuf};

use crate::scene::RecordFormat;
use crate::whole_file::WholeFile;

pub use csv::Csv;
pub use jsonl::JsonLines;
pub use npy::Npy;

/// What a record is about; it decides the columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Columns {
    /// Dimension of space, 2 or 3.
    pub dimension: usize,
    /// Whether the table is repeated on a lattice.
    pub lattice: bool,
}

impl Columns {
    /// The names of all columns, in order: whole numbers first and last, between them time, position and velocity.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        let (reals, cells): (&[_], &[_]) = if self.dimension == 2 {
            (&["x0", "x1", "x2", "v0", "v1", "v2"], &["cell1", "cell2"])
        } else {
            (&["x1", "x2", "x3", "v1", "v2", "v3", "w1", "w2", "w3"], &["cell1", "cell2", "cell3"])
        };
        let cells = if self.lattice { cells } else { &[] };
        ["orbit", "n", "t", "piece"].into_iter().chain(reals.iter().copied()).chain(cells.iter().copied())
    }

    /// Whether the column of this name holds whole numbers.
    pub fn is_whole(name: &str) -> bool {
        matches!(name, "orbit" | "n" | "piece") || name.starts_with("cell")
    }

    /// How many numbers [`Row::state`] holds.
    pub fn state(self) -> usize {
        if self.dimension == 2 { 6 } else { 9 }
    }

    /// How many numbers [`Row::cell`] holds.
    pub fn cells(self) -> usize {
        if self.lattice { self.dimension } else { 0 }
    }
}

/// One collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<'a> {
    /// Number of the orbit, from 0.
    pub orbit: u64,
    /// Number of the collision, from 1.
    pub n: u64,
    /// Absolute time since the start.
    pub time: f64,
    /// Number of the piece hit.
    pub piece: u64,
    /// Position at the collision and velocity after it: in the plane x0, x1, x2, v0, v1, v2; in space x1 … x3, v1 … v3,
    /// w1 … w3.
    pub state: &'a [f64],
    /// Accumulated translations on a lattice, one per dimension; else none.
    pub cell: &'a [i64],
}

/// Writes collision records. Rows must have the lengths that [`Columns`] says.
pub trait RecordWriter {
    /// Writes one collision.
    ///
    /// # Errors
    /// The file cannot be written.
    fn row(&mut self, row: &Row<'_>) -> io::Result<()>;

    /// Completes the file.
    ///
    /// # Errors
    /// The file cannot be written.
    fn finish(self: Box<Self>) -> io::Result<()>;
}

/// Where a record lies in a folder: `collisions.csv` or the like.
pub fn path(folder: &Path, format: RecordFormat) -> PathBuf {
    folder.join(match format {
        RecordFormat::Csv => "collisions.csv",
        RecordFormat::JsonLines => "collisions.jsonl",
        RecordFormat::Npy => "collisions.npy",
    })
}

/// Starts a record in a folder; it appears there when it is finished.
///
/// # Errors
/// The file cannot be made.
pub fn create(folder: &Path, format: RecordFormat, columns: Columns) -> io::Result<Box<dyn RecordWriter + Send>> {
    let file = WholeFile::create(&path(folder, format))?;
    Ok(match format {
        RecordFormat::Csv => Box::new(Csv::new(file, columns)?),
        RecordFormat::JsonLines => Box::new(JsonLines::new(file, columns)),
        RecordFormat::Npy => Box::new(Npy::new(file, columns)?),
    })
}

/// Something that can be told that all has been written.
pub trait Finish {
    /// Completes what has been written.
    ///
    /// # Errors
    /// It cannot be written.
    fn finish(self) -> io::Result<()>;
}

impl Finish for WholeFile {
    fn finish(self) -> io::Result<()> {
        WholeFile::finish(self)
    }
}

impl<T> Finish for &mut io::Cursor<T> {
    fn finish(self) -> io::Result<()> {
        Ok(())
    }
}

/// Appends the shortest decimal that reads back to the same double: `0.25`, `-3`, `1e-7`.
fn push_number(line: &mut String, x: f64) {
    use std::fmt::Write as _;
    let start = line.len();
    // Writing to a string cannot fail.
    let _ = write!(line, "{x:?}");
    if line[start..].ends_with(".0") {
        line.truncate(line.len() - 2);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn columns_are_those_of_the_interface() {
        let names = |dimension, lattice| Columns { dimension, lattice }.names().collect::<Vec<_>>().join(",");
        assert_eq!(names(2, false), "orbit,n,t,piece,x0,x1,x2,v0,v1,v2");
        assert_eq!(names(2, true), "orbit,n,t,piece,x0,x1,x2,v0,v1,v2,cell1,cell2");
        assert_eq!(names(3, false), "orbit,n,t,piece,x1,x2,x3,v1,v2,v3,w1,w2,w3");
        for (dimension, lattice) in [(2, false), (2, true), (3, false), (3, true)] {
            let columns = Columns { dimension, lattice };
            assert_eq!(columns.names().count(), 4 + columns.state() + columns.cells());
        }
    }

    proptest! {
        #[test]
        fn numbers_read_back_to_the_same_double(bits in any::<u64>()) {
            let x = f64::from_bits(bits);
            prop_assume!(x.is_finite());
            let mut text = String::new();
            push_number(&mut text, x);
            prop_assert_eq!(text.parse::<f64>().unwrap().to_bits(), bits);
            let plain = format!("{x:?}");
            prop_assert!(text.len() <= plain.len());
        }
    }
}

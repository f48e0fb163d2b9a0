//! Collision records: one row per collision, in a format that other programs read.

mod csv;
mod jsonl;
mod npy;

use std::fmt::Debug;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::whole_file::WholeFile;

/// A format that a scene can name.
#[derive(Clone, Copy, Debug)]
pub struct RecordFormat {
    /// Its name in a scene, and the extension of its file.
    pub name: &'static str,
    /// What writes it, for these columns.
    pub writer: fn(Columns) -> Box<dyn Format>,
}

/// Every format that a scene can name.
pub const FORMATS: &[RecordFormat] = &[csv::FORMAT, jsonl::FORMAT, npy::FORMAT];

impl RecordFormat {
    /// Where a record lies in a folder: `collisions.csv` or the like.
    pub fn path(&self, folder: &Path) -> PathBuf {
        folder.join(format!("collisions.{}", self.name))
    }
}

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

/// How collision records are written. Rows must have the lengths that [`Columns`] says.
///
/// Threads format their own rows; the results are written in order.
pub trait Format: Debug + Send + Sync {
    /// What comes before the rows, of the same length for any number of them.
    fn header(&self, columns: Columns, rows: u64) -> Vec<u8>;

    /// Appends a collision.
    fn row(&self, row: &Row<'_>, to: &mut Vec<u8>);
}

/// A record on its way to the disk.
#[derive(Debug)]
pub struct RecordFile<'a> {
    file: WholeFile,
    format: &'a dyn Format,
    columns: Columns,
    rows: u64,
}

impl<'a> RecordFile<'a> {
    /// Starts a record; it appears under its path when its file is finished.
    ///
    /// # Errors
    /// The file cannot be made.
    pub fn create(path: &Path, format: &'a dyn Format, columns: Columns) -> io::Result<Self> {
        let mut file = WholeFile::create(path)?;
        file.write_all(&format.header(columns, 0))?;
        Ok(Self { file, format, columns, rows: 0 })
    }

    /// Writes a number of formatted rows.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&mut self, rows: u64, formatted: &[u8]) -> io::Result<()> {
        self.rows += rows;
        self.file.write_all(formatted)
    }

    /// Completes the file, which is then finished together with others.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn complete(mut self) -> io::Result<WholeFile> {
        let header = self.format.header(self.columns, self.rows);
        if header != self.format.header(self.columns, 0) {
            self.file.seek(SeekFrom::Start(0))?;
            self.file.write_all(&header)?;
        }
        Ok(self.file)
    }
}

/// Appends the shortest decimal that reads back to the same double: `0.25`, `-3`, `1e-7`; of several, the nearest, and of two
/// equally near ones (which exist for some sums of a few powers of two) the even one.
fn push_number(to: &mut Vec<u8>, x: f64) {
    if (1e-4..1e16).contains(&x.abs()) {
        let mut digits = zmij::Buffer::new();
        let digits = digits.format_finite(x);
        return to.extend_from_slice(digits.strip_suffix(".0").unwrap_or(digits).as_bytes());
    }
    // very large or small numbers have an exponent
    let digits = format!("{x:?}");
    to.extend_from_slice(digits.strip_suffix(".0").unwrap_or(&digits).as_bytes());
}

/// Appends a whole number.
fn push_integer(to: &mut Vec<u8>, n: impl itoa::Integer) {
    to.extend_from_slice(itoa::Buffer::new().format(n).as_bytes());
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
            let mut text = vec![];
            push_number(&mut text, x);
            let text = String::from_utf8(text).unwrap();
            prop_assert_eq!(text.parse::<f64>().unwrap().to_bits(), bits);
            let plain = format!("{x:?}");
            prop_assert_eq!(text.len(), plain.strip_suffix(".0").unwrap_or(&plain).len());
        }

        #[test]
        fn numbers_of_any_size_are_as_short_as_those_of_the_standard_library(x in -20.0..20.0_f64, digits in 0..18_i32) {
            // all magnitudes alike, some with few digits
            let x = libm::copysign(libm::exp10(x.abs() - 5.0), x);
            let few = libm::round(x * libm::exp10(f64::from(digits))) / libm::exp10(f64::from(digits));
            for x in [x, few] {
                let mut text = vec![];
                push_number(&mut text, x);
                let (text, plain) = (String::from_utf8(text).unwrap(), format!("{x:?}"));
                prop_assert_eq!(text.parse::<f64>().unwrap(), x);
                prop_assert_eq!(text.len(), plain.strip_suffix(".0").unwrap_or(&plain).len());
                prop_assert_eq!(text.contains('e'), plain.contains('e'));
            }
        }
    }
}

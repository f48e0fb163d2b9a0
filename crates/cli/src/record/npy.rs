//! Records as `NumPy` arrays.
//!
//! The array has one dimension and a structured type: every column is a named field, whole numbers `<i8`, all others
//! `<f8`. So `a = numpy.load("collisions.npy")` gives `a["x1"]` by name, and counts and cells stay exact.

use super::{Columns, Format, RecordFormat, Row};
use crate::npy;

pub(super) const FORMAT: RecordFormat = RecordFormat { name: "npy", writer: |_| Box::new(Npy) };

/// Digits kept free for the number of rows, known only at the end.
const DIGITS: usize = 19;

/// A structured `NumPy` array.
#[derive(Clone, Copy, Debug)]
struct Npy;

/// The header of an array with this many rows; its length does not depend on them.
fn header(columns: Columns, rows: u64) -> Vec<u8> {
    let field = |name| format!("('{name}', '{}')", if Columns::is_whole(name) { "<i8" } else { "<f8" });
    let fields: Vec<_> = columns.names().map(field).collect();
    let shape = format!("({rows},)");
    npy::header(&format!("[{}]", fields.join(", ")), &format!("{shape:width$}", width = DIGITS + 3))
}

impl Format for Npy {
    fn header(&self, columns: Columns, rows: u64) -> Vec<u8> {
        header(columns, rows)
    }

    fn row(&self, row: &Row<'_>, to: &mut Vec<u8>) {
        for number in [row.orbit.to_le_bytes(), row.n.to_le_bytes(), row.time.to_le_bytes(), row.piece.to_le_bytes()] {
            to.extend_from_slice(&number);
        }
        row.state.iter().for_each(|x| to.extend_from_slice(&x.to_le_bytes()));
        row.cell.iter().for_each(|cell| to.extend_from_slice(&cell.to_le_bytes()));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_names_the_fields_and_counts_the_rows() {
        let mut bytes = Npy.header(Columns { dimension: 2, lattice: false }, 3);
        for n in 1..=3 {
            let state = [0.0, 1.0, 2.0, 3.0, 4.0, 5.5];
            Npy.row(&Row { orbit: 0, n, time: 0.5, piece: 2, state: &state, cell: &[] }, &mut bytes);
        }
        assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
        let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        assert_eq!((10 + length) % 64, 0);
        let text = std::str::from_utf8(&bytes[10..10 + length]).unwrap();
        assert!(
            text.starts_with(
                "{'descr': [('orbit', '<i8'), ('n', '<i8'), ('t', '<f8'), ('piece', '<i8'), ('x0', '<f8')"
            )
        );
        assert!(text.contains("'shape': (3,) "), "{text}");
        assert!(text.ends_with('\n'));
        let data = &bytes[10 + length..];
        assert_eq!(data.len(), 3 * 10 * 8);
        assert_eq!(data[80 + 8..80 + 16], 2u64.to_le_bytes());
        assert_eq!(data[72..80], 5.5f64.to_le_bytes());
    }

    #[test]
    fn the_length_of_the_header_does_not_depend_on_the_number_of_rows() {
        let columns = Columns { dimension: 3, lattice: true };
        assert_eq!(header(columns, 0).len(), header(columns, u64::MAX / 2).len());
    }
}

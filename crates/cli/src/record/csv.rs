//! Comma-separated values.

use super::{Columns, Format, RecordFormat, Row, push_integer, push_number};

pub(super) const FORMAT: RecordFormat = RecordFormat { name: "csv", writer: |_| Box::new(Csv) };

/// A header line, then one line per collision; numbers are the shortest decimals that read back to the same double.
#[derive(Clone, Copy, Debug)]
struct Csv;

impl Format for Csv {
    fn header(&self, columns: Columns, _: u64) -> Vec<u8> {
        let names: Vec<_> = columns.names().collect();
        (names.join(",") + "\n").into_bytes()
    }

    fn row(&self, row: &Row<'_>, to: &mut Vec<u8>) {
        push_integer(to, row.orbit);
        to.push(b',');
        push_integer(to, row.n);
        to.push(b',');
        push_number(to, row.time);
        to.push(b',');
        push_integer(to, row.piece);
        for &x in row.state {
            to.push(b',');
            push_number(to, x);
        }
        for &cell in row.cell {
            to.push(b',');
            push_integer(to, cell);
        }
        to.push(b'\n');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_is_a_header_and_a_line_per_collision() {
        let mut record = Csv.header(Columns { dimension: 2, lattice: true }, 1);
        let state = [0.0, 0.1, -2.0, 1e-7, 1.0 / 3.0, 1e300];
        Csv.row(&Row { orbit: 0, n: 1, time: 0.5, piece: 3, state: &state, cell: &[-1, 2] }, &mut record);
        assert_eq!(
            String::from_utf8(record).unwrap(),
            "orbit,n,t,piece,x0,x1,x2,v0,v1,v2,cell1,cell2\n0,1,0.5,3,0,0.1,-2,1e-7,0.3333333333333333,1e300,-1,2\n"
        );
    }
}

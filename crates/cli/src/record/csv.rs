//! Comma-separated values.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::{Columns, Finish, RecordWriter, Row, push_number};

/// A header line, then one line per collision; numbers are the shortest decimals that read back to the same double.
#[derive(Debug)]
pub struct Csv<W> {
    to: W,
    line: String,
}

impl<W: Write> Csv<W> {
    /// Starts a record.
    ///
    /// # Errors
    /// The header cannot be written.
    pub fn new(mut to: W, columns: Columns) -> io::Result<Self> {
        let names: Vec<_> = columns.names().collect();
        writeln!(to, "{}", names.join(","))?;
        Ok(Self { to, line: String::new() })
    }
}

impl<W: Write + Finish> RecordWriter for Csv<W> {
    fn row(&mut self, row: &Row<'_>) -> io::Result<()> {
        let line = &mut self.line;
        line.clear();
        // Writing to a string cannot fail.
        let _ = write!(line, "{},{},", row.orbit, row.n);
        push_number(line, row.time);
        let _ = write!(line, ",{}", row.piece);
        for &x in row.state {
            line.push(',');
            push_number(line, x);
        }
        for cell in row.cell {
            let _ = write!(line, ",{cell}");
        }
        line.push('\n');
        self.to.write_all(line.as_bytes())
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        self.to.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_is_a_header_and_a_line_per_collision() {
        let mut to = io::Cursor::new(Vec::new());
        let mut csv = Csv::new(&mut to, Columns { dimension: 2, lattice: true }).unwrap();
        let state = [0.0, 0.1, -2.0, 1e-7, 1.0 / 3.0, 1e300];
        csv.row(&Row { orbit: 0, n: 1, time: 0.5, piece: 3, state: &state, cell: &[-1, 2] }).unwrap();
        Box::new(csv).finish().unwrap();
        assert_eq!(
            String::from_utf8(to.into_inner()).unwrap(),
            "orbit,n,t,piece,x0,x1,x2,v0,v1,v2,cell1,cell2\n0,1,0.5,3,0,0.1,-2,1e-7,0.3333333333333333,1e300,-1,2\n"
        );
    }
}

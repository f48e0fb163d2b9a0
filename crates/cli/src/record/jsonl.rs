//! JSON Lines.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::{Columns, Finish, RecordWriter, Row, push_number};

/// One JSON object per line and collision, its keys the names of the columns.
#[derive(Debug)]
pub struct JsonLines<W> {
    to: W,
    names: Vec<&'static str>,
    line: String,
}

impl<W: Write> JsonLines<W> {
    /// Starts a record.
    pub fn new(to: W, columns: Columns) -> Self {
        Self { to, names: columns.names().collect(), line: String::new() }
    }
}

impl<W: Write + Finish> RecordWriter for JsonLines<W> {
    fn row(&mut self, row: &Row<'_>) -> io::Result<()> {
        let line = &mut self.line;
        line.clear();
        // Writing to a string cannot fail.
        let _ = write!(line, "{{\"orbit\":{},\"n\":{},\"t\":", row.orbit, row.n);
        push_number(line, row.time);
        let _ = write!(line, ",\"piece\":{}", row.piece);
        let mut names = self.names.iter().skip(4);
        for (&x, name) in row.state.iter().zip(names.by_ref()) {
            let _ = write!(line, ",\"{name}\":");
            push_number(line, x);
        }
        for (cell, name) in row.cell.iter().zip(names) {
            let _ = write!(line, ",\"{name}\":{cell}");
        }
        line.push_str("}\n");
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
    fn each_line_is_an_object_with_the_columns_as_keys() {
        let columns = Columns { dimension: 3, lattice: true };
        let mut to = io::Cursor::new(Vec::new());
        let mut json = JsonLines::new(&mut to, columns);
        let state = [0.5, -0.0, 1e-9, 2.0, 3.5, 1e22, 0.1, 0.2, 0.3];
        json.row(&Row { orbit: 4, n: 7, time: 2.5, piece: 1, state: &state, cell: &[1, -2, 3] }).unwrap();
        Box::new(json).finish().unwrap();
        let line = String::from_utf8(to.into_inner()).unwrap();
        let object: serde_json::Value = serde_json::from_str(&line).unwrap();
        let read: Vec<f64> = columns.names().map(|name| object[name].as_f64().unwrap()).collect();
        assert_eq!(read, [4.0, 7.0, 2.5, 1.0, 0.5, -0.0, 1e-9, 2.0, 3.5, 1e22, 0.1, 0.2, 0.3, 1.0, -2.0, 3.0]);
    }
}

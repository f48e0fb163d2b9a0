//! JSON Lines.

use super::{Columns, Format, Row, push_integer, push_number};

/// One JSON object per line and collision, its keys the names of the columns.
#[derive(Clone, Debug)]
pub struct JsonLines {
    /// What comes before each number, from `{"orbit":` on.
    keys: Vec<String>,
}

impl JsonLines {
    /// For these columns.
    pub fn new(columns: Columns) -> Self {
        let key = |(i, name)| format!("{}\"{name}\":", if i == 0 { '{' } else { ',' });
        Self { keys: columns.names().enumerate().map(key).collect() }
    }
}

impl Format for JsonLines {
    fn header(&self, _: Columns, _: u64) -> Vec<u8> {
        Vec::new()
    }

    fn row(&self, row: &Row<'_>, to: &mut Vec<u8>) {
        let mut keys = self.keys.iter().map(String::as_bytes);
        let mut next = |to: &mut Vec<u8>| to.extend_from_slice(keys.next().unwrap_or_default());
        next(to);
        push_integer(to, row.orbit);
        next(to);
        push_integer(to, row.n);
        next(to);
        push_number(to, row.time);
        next(to);
        push_integer(to, row.piece);
        for &x in row.state {
            next(to);
            push_number(to, x);
        }
        for &cell in row.cell {
            next(to);
            push_integer(to, cell);
        }
        to.extend_from_slice(b"}\n");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_line_is_an_object_with_the_columns_as_keys() {
        let columns = Columns { dimension: 3, lattice: true };
        let (json, mut line) = (JsonLines::new(columns), vec![]);
        let state = [0.5, -0.0, 1e-9, 2.0, 3.5, 1e22, 0.1, 0.2, 0.3];
        json.row(&Row { orbit: 4, n: 7, time: 2.5, piece: 1, state: &state, cell: &[1, -2, 3] }, &mut line);
        assert!(line.starts_with(b"{\"orbit\":4,\"n\":7,\"t\":2.5,") && line.ends_with(b"}\n"));
        let object: serde_json::Value = serde_json::from_slice(&line).unwrap();
        let read: Vec<f64> = columns.names().map(|name| object[name].as_f64().unwrap()).collect();
        assert_eq!(read, [4.0, 7.0, 2.5, 1.0, 0.5, -0.0, 1e-9, 2.0, 3.5, 1e22, 0.1, 0.2, 0.3, 1.0, -2.0, 3.0]);
    }
}

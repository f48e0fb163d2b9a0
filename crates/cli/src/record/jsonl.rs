//! JSON Lines.

use super::{Columns, Format, RecordFormat, Row, push_integer, push_number};

pub(super) const FORMAT: RecordFormat =
    RecordFormat { name: "jsonl", writer: |columns| Box::new(JsonLines::new(columns)) };

/// One JSON object per line and collision, its keys the names of the columns.
#[derive(Clone, Debug)]
struct JsonLines {
    /// What comes before each number, from `{"orbit":` on.
    keys: Vec<String>,
}

impl JsonLines {
    /// For these columns.
    fn new(columns: Columns) -> Self {
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
        push(to, row.time);
        next(to);
        push_integer(to, row.piece);
        for &x in row.state {
            next(to);
            push(to, x);
        }
        for &cell in row.cell {
            next(to);
            push_integer(to, cell);
        }
        to.extend_from_slice(b"}\n");
    }
}

/// Appends a number, or null for one that JSON does not have: an angle or a time may be infinite where lengths and speeds differ by
/// 10³⁰⁰. Readers that tell whole numbers from others would take `-0` for 0.
fn push(to: &mut Vec<u8>, x: f64) {
    match x {
        0.0 if x.is_sign_negative() => to.extend_from_slice(b"-0.0"),
        _ if x.is_finite() => push_number(to, x),
        _ => to.extend_from_slice(b"null"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_null() {
        let (json, mut line) = (JsonLines::new(Columns { dimension: 2, lattice: false }), vec![]);
        let state = [f64::INFINITY, 0.0, 0.0, 0.0, f64::NAN, 0.0];
        json.row(&Row { orbit: 0, n: 1, time: f64::INFINITY, piece: 0, state: &state, cell: &[] }, &mut line);
        let object: serde_json::Value = serde_json::from_slice(&line).unwrap();
        assert_eq!(object.as_object().unwrap().values().filter(|value| value.is_null()).count(), 3);
    }

    #[test]
    fn each_line_is_an_object_with_the_columns_as_keys() {
        let columns = Columns { dimension: 3, lattice: true };
        let (json, mut line) = (JsonLines::new(columns), vec![]);
        let state = [0.5, -0.0, 1e-9, 2.0, 3.5, 1e22, 0.1, 0.2, 0.3];
        json.row(&Row { orbit: 4, n: 7, time: 2.5, piece: 1, state: &state, cell: &[1, -2, 3] }, &mut line);
        assert!(line.starts_with(b"{\"orbit\":4,\"n\":7,\"t\":2.5,") && line.ends_with(b"}\n"));
        assert!(std::str::from_utf8(&line).unwrap().contains("\"x2\":-0.0,"));
        let object: serde_json::Value = serde_json::from_slice(&line).unwrap();
        let read: Vec<f64> = columns.names().map(|name| object[name].as_f64().unwrap()).collect();
        assert_eq!(read, [4.0, 7.0, 2.5, 1.0, 0.5, -0.0, 1e-9, 2.0, 3.5, 1e22, 0.1, 0.2, 0.3, 1.0, -2.0, 3.0]);
    }
}

//! The built-in tables, as scenes name them: those of the geometry crate.

use std::sync::LazyLock;

use billiards::geometry::tables::{self, Entry, Kind as Measure, Value};

use super::parameters::{Default, Kind, Model, Parameter};

/// Every built-in table.
pub static TABLES: LazyLock<Vec<Model>> = LazyLock::new(|| tables::all().iter().map(model).collect());

fn model(entry: &'static Entry) -> Model {
    let parameters: Vec<_> = entry.parameters.iter().map(parameter).collect();
    Model { name: entry.name, dimension: entry.dimension(), summary: entry.summary, parameters: parameters.into(), build: () }
}

fn parameter(of: &'static tables::Parameter) -> Parameter {
    let kind = match of.kind {
        Measure::Length => Kind::Length,
        Measure::Displacement | Measure::Angle | Measure::Number => Kind::Real,
        Measure::Count { least } => Kind::Count { least, most: tables::MOST_VERTICES as u64 },
        Measure::Lengths(n) => Kind::Lengths(n),
        Measure::Points(n) => Kind::Points { least: n, most: n },
    };
    let default = match &of.value {
        // for angles, no example: it would be written without pi
        Value::Number(x) if of.required && of.kind != Measure::Angle => Default::Required(core::slice::from_ref(x)),
        _ if of.required => Default::Required(&[]),
        Value::Number(x) => Default::Numbers(core::slice::from_ref(x)),
        Value::List(list) => Default::Numbers(list),
        // points are required by every table that has them
        Value::Points(_) => Default::Required(&[]),
    };
    Parameter { name: of.name, kind, default }
}

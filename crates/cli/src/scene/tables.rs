//! The built-in tables, as scenes name them: those of the geometry crate.

use std::sync::LazyLock;

use billiards::geometry::tables::{self, Entry, Kind as Measure, Value};

use super::parameters::{Constant, IfAbsent, Kind, Model, Parameter};

/// Every built-in table.
pub static TABLES: LazyLock<Vec<Model>> = LazyLock::new(|| tables::all().iter().map(model).collect());

fn model(entry: &'static Entry) -> Model {
    let parameters: Vec<_> = entry.parameters.iter().map(parameter).collect();
    Model {
        name: entry.name,
        dimension: entry.dimension(),
        summary: entry.summary,
        parameters: parameters.into(),
        build: (),
    }
}

fn parameter(of: &'static tables::Parameter) -> Parameter {
    let kind = match of.kind {
        Measure::Length => Kind::Length,
        Measure::Displacement | Measure::Angle | Measure::Number => Kind::Real,
        Measure::Count { least } => Kind::Count { least, most: tables::MOST_VERTICES as u64 },
        Measure::Lengths(n) => Kind::Lengths(n),
        Measure::Points(n) => Kind::Points { least: n, most: n },
    };
    let value = match &of.value {
        Value::Number(x) => Constant::Numbers(core::slice::from_ref(x)),
        Value::List(list) => Constant::Numbers(list),
        Value::Points(points) => Constant::Points(points),
    };
    let default = match (of.required, of.kind) {
        // for angles, no example: it would be written without pi
        (true, Measure::Angle) => IfAbsent::Required(None),
        (true, _) => IfAbsent::Required(Some(value)),
        (false, _) => IfAbsent::Value(value),
    };
    Parameter { name: of.name, kind, default }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_have_defaults_and_examples_like_numbers() {
        let four: &[[f64; 2]] = &[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.5]];
        let of = |required: bool| -> &'static tables::Parameter {
            let (kind, value) = (Measure::Points(4), Value::Points(four.into()));
            Box::leak(Box::new(tables::Parameter { name: "vertices", kind, value, required }))
        };
        let optional = parameter(of(false));
        assert_eq!(optional.default, IfAbsent::Value(Constant::Points(four)));
        assert_eq!(optional.signature(), "vertices = [[0, 0], [2, 0], [2, 1], [0, 1.5]]");
        let required = parameter(of(true));
        assert_eq!(required.default, IfAbsent::Required(Some(Constant::Points(four))));
        assert_eq!(required.signature(), "vertices");
    }
}

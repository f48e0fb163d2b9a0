//! `billiards tables`: the tables and shapes a scene can name.

use std::io::{self, Write};

use serde_json::{Value, json};

use crate::scene::{Constant, IfAbsent, Model, SHAPES, TABLES};

/// Lists tables and shapes.
///
/// # Errors
/// The output cannot be written.
pub fn run(json: bool, out: &mut impl Write) -> io::Result<()> {
    if json {
        let all = json!({
            "tables": TABLES.iter().map(as_json).collect::<Vec<_>>(),
            "shapes": SHAPES.iter().map(as_json).collect::<Vec<_>>(),
        });
        return writeln!(out, "{all:#}");
    }
    writeln!(out, "Tables, as [table] with name = \"...\" and the parameters as further keys:\n")?;
    for dimension in [2, 3] {
        if dimension == 3 {
            writeln!(out, "\nIn space, with dimension = 3 in [table]:\n")?;
        }
        list(TABLES.iter().filter(|model| model.dimension == dimension), out)?;
    }
    writeln!(
        out,
        "\nShapes, in a [[table.boundary]] entry as shape = {{ name = \"...\", ... }} (rounding adds to their size):\n"
    )?;
    for dimension in [2, 3] {
        if dimension == 3 {
            writeln!(out, "\nIn space:\n")?;
        }
        list(SHAPES.iter().filter(|model| model.dimension == dimension), out)?;
    }
    Ok(())
}

fn list<'a, B: 'a>(models: impl Iterator<Item = &'a Model<B>>, out: &mut impl Write) -> io::Result<()> {
    for model in models {
        writeln!(out, "  {:<18} {}", model.name, model.summary)?;
        let parameters: Vec<_> = model.parameters.iter().map(crate::scene::Parameter::signature).collect();
        if !parameters.is_empty() {
            writeln!(out, "  {:<18} {}", "", parameters.join(", "))?;
        }
    }
    Ok(())
}

fn as_json<B>(model: &Model<B>) -> Value {
    let parameter = |parameter: &crate::scene::Parameter| {
        let default = match parameter.default {
            IfAbsent::Required(_) => Value::Null,
            IfAbsent::Value(Constant::Numbers([x])) => json!(x),
            IfAbsent::Value(Constant::Numbers(xs)) => json!(xs),
            IfAbsent::Value(Constant::Points(points)) => json!(points),
        };
        json!({ "name": parameter.name, "default": default })
    };
    json!({
        "name": model.name,
        "dimension": model.dimension,
        "summary": model.summary,
        "parameters": model.parameters.iter().map(parameter).collect::<Vec<_>>(),
    })
}

//! `billiards laws`: the laws a scene can name.

use std::io::{self, Write};

use serde_json::{Value, json};

use crate::scene::LAWS;

/// Lists the laws.
///
/// # Errors
/// The output cannot be written.
pub fn run(json: bool, out: &mut impl Write) -> io::Result<()> {
    if json {
        let law =
            |law: &crate::scene::LawModel| json!({ "name": law.name, "example": law.example, "summary": law.summary });
        return writeln!(out, "{:#}", Value::Array(LAWS.iter().map(law).collect()));
    }
    for law in LAWS {
        writeln!(out, "{:<14}{}\n{:14}{}", law.name, law.summary, "", law.example)?;
    }
    Ok(())
}

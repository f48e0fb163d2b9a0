//! `billiards laws`: the laws a scene can name.

use std::io::{self, Write};

use crate::scene::LAWS;

/// Lists the laws.
///
/// # Errors
/// The output cannot be written.
pub fn run(out: &mut impl Write) -> io::Result<()> {
    for law in LAWS {
        writeln!(out, "{:<14}{}\n{:14}{}", law.name, law.summary, "", law.example)?;
    }
    Ok(())
}

//! `billiards guide`: how scene and contact files are written, and what output they produce.

use std::io::{self, Write};

/// The guide, in Markdown.
pub const GUIDE: &str = include_str!("../../SCENES.md");

/// Prints it.
///
/// # Errors
/// The output cannot be written.
pub fn run(out: &mut impl Write) -> io::Result<()> {
    out.write_all(GUIDE.as_bytes())
}

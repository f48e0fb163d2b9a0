//! What the command does, one file per subcommand.

pub mod bench;
pub mod check;
pub mod collide;
pub mod guide;
pub mod laws;
pub mod reproduce;
pub mod run;
pub mod tables;

use std::fmt;
use std::io;

use crate::document::Diagnostic;

/// Why a command failed.
#[derive(Debug)]
pub enum Failure {
    /// The input is wrong: everything that is wrong with it. Exit status 2.
    Input(Vec<Diagnostic>),
    /// The input is right, but the work could not be done. Exit status 1.
    Work(String),
    /// Whoever read the output has seen enough. Exit status 0.
    Closed,
}

impl Failure {
    /// The exit status.
    pub fn status(&self) -> u8 {
        match self {
            Self::Input(_) => 2,
            Self::Work(_) => 1,
            Self::Closed => 0,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Work(what) => write!(f, "error: {what}"),
            Self::Closed => f.write_str("the output was closed"),
            Self::Input(diagnostics) => {
                for (i, diagnostic) in diagnostics.iter().enumerate() {
                    if i > 0 {
                        f.write_str("\n\n")?;
                    }
                    write!(f, "{diagnostic}")?;
                }
                Ok(())
            }
        }
    }
}

impl std::error::Error for Failure {}

impl From<Vec<Diagnostic>> for Failure {
    fn from(diagnostics: Vec<Diagnostic>) -> Self {
        Self::Input(diagnostics)
    }
}

impl From<Box<Diagnostic>> for Failure {
    fn from(diagnostic: Box<Diagnostic>) -> Self {
        Self::Input(vec![*diagnostic])
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe { Self::Closed } else { Self::Work(error.to_string()) }
    }
}

/// The first Ctrl-C calls `interrupt`, which ends the work and tells whether it was called before; the second ends the program.
fn on_ctrl_c(interrupt: impl Fn() -> bool + Send + 'static) -> Result<(), Failure> {
    let handler = move || {
        if interrupt() {
            std::process::exit(130);
        }
    };
    ctrlc::set_handler(handler).map_err(|error| Failure::Work(format!("cannot listen to Ctrl-C: {error}")))
}

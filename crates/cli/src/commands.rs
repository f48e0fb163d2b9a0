//! What the command does, one file per subcommand.

pub mod bench;
pub mod check;
pub mod collide;
pub mod guide;
pub mod laws;
mod patience;
pub mod reproduce;
pub mod run;
pub mod tables;

use std::fmt;
use std::io;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::document::{Diagnostic, plain};
use crate::spelling;
use crate::whole_file;

/// Why a command failed.
#[derive(Debug)]
pub enum Failure {
    /// The input is wrong: everything that is wrong with it. Exit status 2.
    Input(Vec<Diagnostic>),
    /// The input is right, but the work could not be done. Exit status 1.
    Work(String),
    /// The reader of the output has closed it. Exit status 0.
    Closed,
}

/// Most errors in input that are shown: a mistake that a script makes thousands of times is seen in a few of them.
const MOST_SHOWN: usize = 20;

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
                for (i, diagnostic) in diagnostics.iter().take(MOST_SHOWN).enumerate() {
                    if i > 0 {
                        f.write_str("\n\n")?;
                    }
                    write!(f, "{diagnostic}")?;
                }
                match diagnostics.len().saturating_sub(MOST_SHOWN) {
                    0 => Ok(()),
                    more => write!(f, "\n\nand {more} more {}", if more == 1 { "error" } else { "errors" }),
                }
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

/// The failure of standard output: other files have failures of their own, with their paths.
impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe {
            Self::Closed
        } else {
            Self::Work(format!("standard output cannot be written: {error}"))
        }
    }
}

/// A path as it may be printed.
fn shown(path: &Path) -> String {
    plain(&path.display().to_string())
}

/// The failure of standard output after all files in a folder have been written.
fn untold(folder: &Path, error: io::Error) -> Failure {
    match Failure::from(error) {
        Failure::Work(what) => Failure::Work(format!("{what}\nhelp: the files in {} are complete", shown(folder))),
        other => other,
    }
}

/// The failure that a file cannot be written there, with advice.
fn unwritable(path: &Path, error: &io::Error) -> Failure {
    let what = format!("{}: {error}", shown(path));
    let help = match error.kind() {
        io::ErrorKind::AlreadyExists | io::ErrorKind::NotADirectory => {
            "there is a file, or a link that leads nowhere, where a folder should be: name another folder, --out DIR"
        }
        io::ErrorKind::IsADirectory => "move that folder away, or name another folder for the files: --out DIR",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "name a folder in which you may write and replace files: --out DIR"
        }
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "make room there, or name a folder elsewhere: --out DIR"
        }
        io::ErrorKind::FileTooLarge => {
            "files there may not be so long: raise the limit (ulimit -f), or name a folder on another file system: --out DIR"
        }
        io::ErrorKind::InvalidFilename => "name a folder with a shorter name: --out DIR",
        io::ErrorKind::NotFound => "no folder can be made there, or it is gone: name another one, --out DIR",
        _ => return Failure::Work(what),
    };
    Failure::Work(format!("{what}\nhelp: {help}"))
}

/// The failure that `--only` names nothing that there is; `known` tells what there is, for names that resemble none of it.
fn unknown<'a>(what: &str, only: &str, names: impl IntoIterator<Item = &'a str>, known: &str) -> Failure {
    let problem = Diagnostic::of_file("--only", format!("there is no {what} `{only}`"));
    Failure::Input(vec![match spelling::closest(only, names) {
        Some(near) => problem.with_help(format!("did you mean `{near}`?")),
        None => problem.with_help(known),
    }])
}

/// Signals within this time count as one request: launchers such as `timeout` send one to the program and another to its
/// group.
const ONE_REQUEST: Duration = Duration::from_millis(500);

/// The flag that Ctrl-C sets: what is being done then is the last that is done.
fn interruption() -> Result<Arc<AtomicBool>, Failure> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    on_ctrl_c(move || flag.store(true, Ordering::Relaxed))?;
    Ok(interrupted)
}

/// The first Ctrl-C calls `interrupt`, which ends the work; a later one that is not part of the same request ends the program
/// at once.
fn on_ctrl_c(interrupt: impl Fn() + Send + 'static) -> Result<(), Failure> {
    let mut first: Option<Instant> = None;
    let handler = move || match first {
        None => {
            first = Some(Instant::now());
            interrupt();
        }
        Some(first) if first.elapsed() < ONE_REQUEST => {}
        Some(_) => whole_file::exit(130),
    };
    ctrlc::set_handler(handler).map_err(|error| Failure::Work(format!("cannot listen to Ctrl-C: {error}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_printed_without_control_characters() {
        let folder = Path::new("out/red \u{1b}[31m\nor not");
        assert_eq!(shown(folder), "out/red  [31m or not");
        let full = || io::Error::from(io::ErrorKind::StorageFull);
        for failure in [unwritable(folder, &full()), untold(folder, full())] {
            assert!(failure.to_string().contains("out/red  [31m or not"), "{failure}");
        }
    }
}

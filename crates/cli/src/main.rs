//! The command `billiards`.

use std::io::{self, Write};
use std::process::ExitCode;

use billiards_cli::args::{Cli, Command};
use billiards_cli::commands::{Failure, bench, check, collide, guide, laws, reproduce, run, tables};
use billiards_cli::document::Source;

fn main() -> ExitCode {
    #[cfg(unix)]
    survive_long_files();
    let out = &mut io::stdout().lock();
    let done = Cli::read()
        .map_err(Failure::from)
        .and_then(|cli| cli.map_or(Ok(()), |cli| execute(cli.command, out)))
        .and_then(|()| Ok(out.flush()?));
    match done {
        Ok(()) | Err(Failure::Closed) => ExitCode::SUCCESS,
        Err(failure) => {
            // Nobody is left to hear that standard error cannot be written.
            let _ = writeln!(io::stderr(), "{failure}");
            ExitCode::from(failure.status())
        }
    }
}

/// Where a file grows beyond the limit on its size, writing fails as on a full disk and does not end the process.
#[cfg(unix)]
fn survive_long_files() {
    use nix::sys::signal::{SigSet, Signal};
    // threads begun from here on block it, too; a failure to block it prevents nothing
    let _ = SigSet::from(Signal::SIGXFSZ).thread_block();
}

fn execute(command: Command, out: &mut impl Write) -> Result<(), Failure> {
    match command {
        Command::Run(arguments) => run::run(&arguments, out),
        Command::Check(arguments) => check::run(&arguments, out),
        Command::Tables(arguments) => Ok(tables::run(arguments.json, out)?),
        Command::Guide => Ok(guide::run(out)?),
        Command::Laws(arguments) => Ok(laws::run(arguments.json, out)?),
        Command::Reproduce(arguments) => reproduce::run(&arguments, out),
        Command::Bench(arguments) => bench::run(&arguments, out),
        Command::Collide(arguments) => collide::run(&Source::read(&arguments.contact)?, arguments.json, out),
    }
}

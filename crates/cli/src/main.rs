//! The command `billiards`.

use std::io::{self, Write};
use std::process::ExitCode;

use billiards_cli::args::{Cli, Command};
use billiards_cli::commands::{Failure, bench, check, collide, guide, laws, reproduce, run, tables};
use billiards_cli::document::Source;
#[cfg(unix)]
use billiards_cli::signals;

fn main() -> ExitCode {
    #[cfg(unix)]
    {
        signals::survive_long_files();
        signals::leave_ignored_ones_alone();
    }
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

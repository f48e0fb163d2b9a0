//! `billiards bench`: what accuracy costs on this machine.

use std::error::Error;
use std::io::{self, IsTerminal, Write};

use indicatif::ProgressBar;

use super::Failure;
use crate::args;
use crate::bench::score::Score;
use crate::bench::{self, Effort, case, chart, report};
use crate::document::Diagnostic;
use crate::spelling;
use crate::whole_file::WholeFile;

/// Times every method on every table, and prints what came of it.
///
/// # Errors
/// There is no table of that name, a method fails, or something cannot be written.
pub fn run(arguments: &args::Bench, out: &mut impl Write) -> Result<(), Failure> {
    let effort = if arguments.quick { Effort::Quick } else { Effort::Full };
    let tables = bench::tables(arguments.only.as_deref());
    if let (true, Some(only)) = (tables.is_empty(), &arguments.only) {
        return Err(unknown(only));
    }
    if !arguments.json {
        report::preamble(arguments.law, effort, out)?;
    }
    let bar = progress();
    let mut scores: Vec<Score> = vec![];
    for table in tables {
        let measured = bench::measure(table, arguments.law, effort, &mut |what| {
            bar.set_message(what.to_string());
            bar.tick();
        });
        let measured = measured.map_err(|error| failed(table, &*error))?;
        if !arguments.json {
            bar.suspend(|| report::table(&measured, out))?;
        }
        scores.extend(measured);
    }
    bar.finish_and_clear();
    let all = report::json(&scores, arguments.law, effort);
    if let Some(folder) = &arguments.out {
        let write = |name: &str, content: String| {
            let path = folder.join(name);
            WholeFile::write(&path, content.as_bytes())
                .map_err(|error| Failure::Work(format!("{}: {error}", path.display())))
        };
        write("bench.json", format!("{all:#}\n"))?;
        write("work-precision.svg", chart::draw(&scores).to_string())?;
    }
    if arguments.json {
        writeln!(out, "{all:#}")?;
    }
    Ok(())
}

/// On a terminal, what is being done; elsewhere nothing.
fn progress() -> ProgressBar {
    if io::stderr().is_terminal() { ProgressBar::new_spinner() } else { ProgressBar::hidden() }
}

fn failed(table: &case::Entry, error: &dyn Error) -> Failure {
    Failure::Work(format!("{}: {error}", table.name))
}

fn unknown(name: &str) -> Failure {
    let problem = Diagnostic::of_file("--only", format!("there is no table `{name}` to be timed"));
    let names = || case::CASES.iter().map(|entry| entry.name);
    Failure::Input(vec![match spelling::closest(name, names()) {
        Some(near) => problem.with_help(format!("did you mean `{near}`?")),
        None => problem.with_help(format!("there are {}", names().collect::<Vec<_>>().join(", "))),
    }])
}

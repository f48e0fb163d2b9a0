//! `billiards bench`: what accuracy costs on this machine.

use std::io::{self, IsTerminal, Write};

use indicatif::ProgressBar;

use super::Failure;
use crate::args;
use crate::bench::score::Score;
use crate::bench::{self, Effort, case, chart, report, stress};
use crate::document::Diagnostic;
use crate::spelling;
use crate::whole_file::WholeFile;

/// Times every method on every table, or goes where programs break, and prints what came of it.
///
/// # Errors
/// There is no table or case of that name, a method fails, something is lost under stress, or something cannot be
/// written.
pub fn run(arguments: &args::Bench, out: &mut impl Write) -> Result<(), Failure> {
    if arguments.stress { under_stress(arguments, out) } else { against_error(arguments, out) }
}

fn effort(arguments: &args::Bench) -> Effort {
    if arguments.quick { Effort::Quick } else { Effort::Full }
}

fn against_error(arguments: &args::Bench, out: &mut impl Write) -> Result<(), Failure> {
    let effort = effort(arguments);
    let tables = bench::tables(arguments.only.as_deref());
    if let (true, Some(only)) = (tables.is_empty(), &arguments.only) {
        return Err(unknown(only, "table", case::CASES.iter().map(|entry| entry.name)));
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
        let measured = measured.map_err(|error| Failure::Work(format!("{}: {error}", table.name)))?;
        if !arguments.json {
            bar.suspend(|| report::table(&measured, out))?;
        }
        scores.extend(measured);
    }
    bar.finish_and_clear();
    let all = report::json(&scores, arguments.law, effort);
    keep(arguments, "bench.json", &format!("{all:#}\n"))?;
    keep(arguments, "work-precision.svg", &chart::draw(&scores).to_string())?;
    if arguments.json {
        writeln!(out, "{all:#}")?;
    }
    Ok(())
}

fn under_stress(arguments: &args::Bench, out: &mut impl Write) -> Result<(), Failure> {
    let effort = effort(arguments);
    let cases = stress::cases(arguments.only.as_deref());
    if let (true, Some(only)) = (cases.is_empty(), &arguments.only) {
        return Err(unknown(only, "case", stress::CASES.iter().map(|entry| entry.name)));
    }
    let bar = progress();
    let mut reports = vec![];
    for case in cases {
        bar.set_message(case.name);
        bar.tick();
        let report = case.run(effort);
        if !arguments.json {
            bar.suspend(|| report::stress(&report, out))?;
        }
        reports.push(report);
    }
    bar.finish_and_clear();
    let all = report::stress_json(&reports, effort);
    keep(arguments, "stress.json", &format!("{all:#}\n"))?;
    if arguments.json {
        writeln!(out, "{all:#}")?;
    }
    let bad = |report: &&stress::Report| report.result.as_ref().map_or(true, |tally| tally.lost > 0);
    match reports.iter().filter(bad).map(|report| report.name).collect::<Vec<_>>()[..] {
        [] => Ok(()),
        ref names => Err(Failure::Work(format!("something was lost: {}", names.join(", ")))),
    }
}

/// Writes a file where the user wants files.
fn keep(arguments: &args::Bench, name: &str, content: &str) -> Result<(), Failure> {
    let Some(folder) = &arguments.out else { return Ok(()) };
    let path = folder.join(name);
    WholeFile::write(&path, content.as_bytes()).map_err(|error| Failure::Work(format!("{}: {error}", path.display())))
}

/// On a terminal, what is being done; elsewhere nothing.
fn progress() -> ProgressBar {
    if io::stderr().is_terminal() { ProgressBar::new_spinner() } else { ProgressBar::hidden() }
}

fn unknown(name: &str, what: &str, names: impl Iterator<Item = &'static str> + Clone) -> Failure {
    let problem = Diagnostic::of_file("--only", format!("there is no {what} `{name}`"));
    Failure::Input(vec![match spelling::closest(name, names.clone()) {
        Some(near) => problem.with_help(format!("did you mean `{near}`?")),
        None => problem.with_help(format!("there are: {}", names.collect::<Vec<_>>().join(", "))),
    }])
}

//! `billiards bench`: what accuracy costs on this machine.

use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use indicatif::ProgressBar;

use super::{Failure, interruption, unwritable};
use crate::args;
use crate::bench::score::Score;
use crate::bench::{self, Effort, case, chart, report, stress};
use crate::document::Diagnostic;
use crate::whole_file::WholeFile;

/// Times every method on every table, or runs the stress cases, and prints the results.
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
        if stress::CASES.iter().any(|entry| entry.name == only) {
            let problem = Diagnostic::of_file("--only", format!("`{only}` is a stress case"));
            return Err(Failure::Input(vec![problem.with_help("add --stress")]));
        }
        return Err(unknown(only, "table", case::CASES.iter().map(|entry| entry.name)));
    }
    let keep = Keep::new(arguments, &["bench.json", "work-precision.svg"])?;
    let interrupted = interruption()?;
    let mut reader = Reader { json: arguments.json, heard: Ok(()) };
    reader.tell(|| report::preamble(arguments.law, effort, out));
    let bar = progress();
    let mut scores: Vec<Score> = vec![];
    let mut done = 0;
    for table in &tables {
        if interrupted.load(Ordering::Relaxed) {
            break;
        }
        let measured = bench::measure(table, arguments.law, effort, &mut |what| {
            bar.set_message(what.to_string());
            bar.tick();
        });
        let measured = measured.map_err(|error| Failure::Work(format!("{}: {error}", table.name)))?;
        reader.tell(|| bar.suspend(|| report::table(&measured, out)));
        scores.extend(measured);
        done += 1;
    }
    bar.finish_and_clear();
    let all = format!("{:#}\n", report::json(&scores, arguments.law, effort));
    reader.finish(&all, out);
    keep.write(&[all, chart::draw(&scores).to_string()])?;
    whole(done, tables.len(), "tables")?;
    Ok(reader.heard?)
}

fn under_stress(arguments: &args::Bench, out: &mut impl Write) -> Result<(), Failure> {
    let effort = effort(arguments);
    let cases = stress::cases(arguments.only.as_deref());
    if let (true, Some(only)) = (cases.is_empty(), &arguments.only) {
        return Err(unknown(only, "case", stress::CASES.iter().map(|entry| entry.name)));
    }
    let keep = Keep::new(arguments, &["stress.json"])?;
    let interrupted = interruption()?;
    let mut reader = Reader { json: arguments.json, heard: Ok(()) };
    let bar = progress();
    let mut reports = vec![];
    for case in &cases {
        if interrupted.load(Ordering::Relaxed) {
            break;
        }
        bar.set_message(case.name);
        bar.tick();
        let report = case.run(effort);
        reader.tell(|| bar.suspend(|| report::stress(&report, out)));
        reports.push(report);
    }
    bar.finish_and_clear();
    let all = format!("{:#}\n", report::stress_json(&reports, effort));
    reader.finish(&all, out);
    keep.write(&[all])?;
    whole(reports.len(), cases.len(), "cases")?;
    let bad = |report: &&stress::Report| report.result.as_ref().map_or(true, |tally| tally.lost > 0);
    match reports.iter().filter(bad).map(|report| report.name).collect::<Vec<_>>()[..] {
        [] => Ok(reader.heard?),
        ref names => Err(Failure::Work(format!("cases that failed or lost something: {}", names.join(", ")))),
    }
}

/// Fails where Ctrl-C has cut the work short: the results so far are kept, but they are incomplete.
fn whole(done: usize, of: usize, what: &str) -> Result<(), Failure> {
    if done == of { Ok(()) } else { Err(Failure::Work(format!("interrupted: {done} of {of} {what} are done"))) }
}

/// The reader of the results: gets tables as they come, or JSON at the end. The work goes on even if the output is closed.
struct Reader {
    json: bool,
    heard: io::Result<()>,
}

impl Reader {
    /// Prints the results so far, for people.
    fn tell(&mut self, what: impl FnOnce() -> io::Result<()>) {
        if !self.json && self.heard.is_ok() {
            self.heard = what();
        }
    }

    /// Prints everything, for programs.
    fn finish(&mut self, all: &str, out: &mut impl Write) {
        if self.json {
            self.heard = out.write_all(all.as_bytes());
        }
    }
}

/// The files that the user wants. Whether they can be written is checked before the work, which would be lost otherwise.
struct Keep {
    paths: Vec<PathBuf>,
}

impl Keep {
    fn new(arguments: &args::Bench, names: &[&str]) -> Result<Self, Failure> {
        let paths = arguments.out.iter().flat_map(|folder| names.iter().map(|name| folder.join(name)));
        let keep = Keep { paths: paths.collect() };
        for path in &keep.paths {
            WholeFile::probe(path).map_err(|error| unwritable(path, &error))?;
        }
        Ok(keep)
    }

    fn write(&self, contents: &[String]) -> Result<(), Failure> {
        let mut files = vec![];
        for (path, content) in self.paths.iter().zip(contents) {
            files.push(WholeFile::with(path, content.as_bytes()).map_err(|error| unwritable(path, &error))?);
        }
        let folder = self.paths.first().and_then(|path| path.parent()).unwrap_or(Path::new("."));
        WholeFile::finish(files).map_err(|error| unwritable(folder, &error))
    }
}

/// A progress message on a terminal; elsewhere nothing.
fn progress() -> ProgressBar {
    if io::stderr().is_terminal() { ProgressBar::new_spinner() } else { ProgressBar::hidden() }
}

fn unknown(name: &str, what: &str, names: impl Iterator<Item = &'static str> + Clone) -> Failure {
    let known = format!("known names: {}", names.clone().collect::<Vec<_>>().join(", "));
    super::unknown(what, name, names, &known)
}

//! `billiards bench`: what accuracy costs on this machine.

use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

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
    let keep = Keep::new(arguments, &["bench.json", "work-precision.svg"])?;
    let interrupted = interruption()?;
    let mut reader = Reader { json: arguments.json, heard: Ok(()) };
    reader.tell(|| report::preamble(arguments.law, effort, out));
    let bar = progress();
    let mut scores: Vec<Score> = vec![];
    for table in tables {
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
    }
    bar.finish_and_clear();
    let all = format!("{:#}\n", report::json(&scores, arguments.law, effort));
    reader.finish(&all, out);
    keep.write(&[all, chart::draw(&scores).to_string()])?;
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
    for case in cases {
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
    let bad = |report: &&stress::Report| report.result.as_ref().map_or(true, |tally| tally.lost > 0);
    match reports.iter().filter(bad).map(|report| report.name).collect::<Vec<_>>()[..] {
        [] => Ok(reader.heard?),
        ref names => Err(Failure::Work(format!("something was lost: {}", names.join(", ")))),
    }
}

/// Where Ctrl-C is noted: the table or case at work is the last one then.
fn interruption() -> Result<Arc<AtomicBool>, Failure> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    super::on_ctrl_c(move || flag.swap(true, Ordering::Relaxed))?;
    Ok(interrupted)
}

/// Whoever reads the results: tables as they come, or JSON at the end. The work goes on where nobody listens any more.
struct Reader {
    json: bool,
    heard: io::Result<()>,
}

impl Reader {
    /// Tells people what there is so far.
    fn tell(&mut self, what: impl FnOnce() -> io::Result<()>) {
        if !self.json && self.heard.is_ok() {
            self.heard = what();
        }
    }

    /// Tells programs everything.
    fn finish(&mut self, all: &str, out: &mut impl Write) {
        if self.json {
            self.heard = out.write_all(all.as_bytes());
        }
    }
}

/// The files that the user wants, begun before the work, which would be lost where they cannot be written.
struct Keep {
    files: Vec<(PathBuf, WholeFile)>,
}

impl Keep {
    fn new(arguments: &args::Bench, names: &[&str]) -> Result<Self, Failure> {
        let paths = arguments.out.iter().flat_map(|folder| names.iter().map(|name| folder.join(name)));
        let begin = |path: PathBuf| match WholeFile::create(&path) {
            Ok(file) => Ok((path, file)),
            Err(error) => Err(unwritable(&path, &error)),
        };
        Ok(Keep { files: paths.map(begin).collect::<Result<_, _>>()? })
    }

    fn write(self, contents: &[String]) -> Result<(), Failure> {
        for ((path, mut file), content) in self.files.into_iter().zip(contents) {
            let written = file.write_all(content.as_bytes()).and_then(|()| file.finish());
            written.map_err(|error| unwritable(&path, &error))?;
        }
        Ok(())
    }
}

fn unwritable(path: &Path, error: &io::Error) -> Failure {
    Failure::Work(format!("{}: {error}", path.display()))
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

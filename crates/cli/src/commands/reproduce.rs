//! `billiards reproduce`: the paper on one page.

use std::io::{self, IsTerminal, Write};
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;

use indicatif::{ProgressBar, ProgressStyle};
use paper::{Claim, Measurement, claims};

use super::Failure;
use crate::args;
use crate::document::Diagnostic;
use crate::reproduce::page::{self, Drawn, Measured};
use crate::reproduce::{Effort, Figure, figures};
use crate::spelling;
use crate::whole_file::WholeFile;

/// What there is to do.
#[derive(Clone, Copy, Debug)]
enum Job {
    Draw(&'static Figure),
    Measure(&'static Claim),
}

impl Job {
    fn name(self) -> &'static str {
        match self {
            Self::Draw(figure) => figure.name,
            Self::Measure(claim) => claim.name,
        }
    }
}

/// What came of it.
enum Done {
    Drawn(String, [f64; 2]),
    Measured(Measurement),
}

/// Recomputes figures and claims, and writes the page.
///
/// # Errors
/// There is no figure or claim of that name, one of them fails, or something cannot be written.
pub fn run(arguments: &args::Reproduce, out: &mut impl Write) -> Result<(), Failure> {
    let all = figures::all().iter().map(Job::Draw).chain(claims::all().iter().map(Job::Measure));
    if arguments.list {
        return list(out).map_err(Failure::from);
    }
    let jobs: Vec<Job> =
        all.clone().filter(|job| arguments.only.as_deref().is_none_or(|only| job.name() == only)).collect();
    if let (true, Some(only)) = (jobs.is_empty(), &arguments.only) {
        return Err(unknown(only, all.map(Job::name)));
    }
    let effort = if arguments.quick { Effort::Quick } else { Effort::Full };
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    super::on_ctrl_c(move || flag.swap(true, Ordering::Relaxed))?;
    let done = in_parallel(&jobs, effort, &interrupted)?;
    let (drawn, measured) = done.iter().fold((0, 0), |(d, m), (job, _)| match job {
        Job::Draw(_) => (d + 1, m),
        Job::Measure(_) => (d, m + 1),
    });
    let rest = jobs.len() - done.len();
    write(done, effort, &arguments.out)
        .map_err(|error| Failure::Work(format!("{}: {error}", arguments.out.display())))?;
    let page = arguments.out.join("index.html");
    let missing = if rest > 0 { format!("; interrupted, {rest} not done") } else { String::new() };
    Ok(writeln!(out, "{}: {drawn} figures, {measured} claims{missing}", page.display())?)
}

fn unknown(name: &str, names: impl Iterator<Item = &'static str>) -> Failure {
    let problem = Diagnostic::of_file("--only", format!("there is no figure or claim `{name}`"));
    Failure::Input(vec![match spelling::closest(name, names) {
        Some(near) => problem.with_help(format!("did you mean `{near}`?")),
        None => problem.with_help("`billiards reproduce --list` lists them"),
    }])
}

fn list(out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "Figures")?;
    for figure in figures::all() {
        writeln!(out, "  {:<22}{} ({})", figure.name, figure.title, figure.place)?;
    }
    writeln!(out, "Claims")?;
    for claim in claims::all() {
        writeln!(out, "  {:<22}{}", claim.name, claim.place)?;
    }
    Ok(())
}

/// Does the jobs on all processors, each on its own, and hands back those done in their order: all, unless interrupted.
fn in_parallel(jobs: &[Job], effort: Effort, interrupted: &AtomicBool) -> Result<Vec<(Job, Done)>, Failure> {
    let bar = progress_bar(jobs.len());
    let next = AtomicUsize::new(0);
    let results: Vec<Mutex<Option<Result<Done, String>>>> = jobs.iter().map(|_| Mutex::new(None)).collect();
    let threads = thread::available_parallelism().map_or(1, usize::from).min(jobs.len());
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while !interrupted.load(Ordering::Relaxed) {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some(job) = jobs.get(i) else { break };
                    bar.set_message(job.name());
                    let result = one(*job, effort);
                    if let Ok(mut slot) = results[i].lock() {
                        *slot = Some(result);
                    }
                    bar.inc(1);
                }
            });
        }
    });
    bar.finish_and_clear();
    let results = jobs.iter().zip(results).filter_map(|(job, slot)| {
        let result = slot.into_inner().ok()??;
        Some(result.map(|done| (*job, done)).map_err(|error| Failure::Work(format!("{}: {error}", job.name()))))
    });
    results.collect()
}

fn one(job: Job, effort: Effort) -> Result<Done, String> {
    match job {
        Job::Draw(figure) => {
            let svg = (figure.draw)(effort).map_err(|error| error.to_string())?;
            Ok(Done::Drawn(svg.to_string(), svg.size()))
        }
        // A claim whose set-up is impossible panics: an error of this program, told as one.
        Job::Measure(claim) => panic::catch_unwind(AssertUnwindSafe(|| claim.measure(effort)))
            .map(Done::Measured)
            .map_err(|_| "the measurement failed".to_string()),
    }
}

fn progress_bar(jobs: usize) -> ProgressBar {
    if !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style =
        ProgressStyle::with_template("{bar:40} {pos}/{len}  {elapsed} passed  {msg}; Ctrl-C keeps what is done");
    ProgressBar::new(jobs as u64).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// The pictures, then the claims, then the page that shows them.
fn write(results: Vec<(Job, Done)>, effort: Effort, folder: &Path) -> io::Result<()> {
    let (mut drawn, mut measured) = (Vec::new(), Vec::new());
    for (job, done) in results {
        match (job, done) {
            (Job::Draw(figure), Done::Drawn(svg, size)) => {
                WholeFile::write(&folder.join(format!("{}.svg", figure.name)), svg.as_bytes())?;
                drawn.push(Drawn { figure: *figure, svg, size });
            }
            (Job::Measure(claim), Done::Measured(measurement)) => measured.push(Measured { claim, measurement }),
            _ => {}
        }
    }
    let json = format!("{:#}\n", page::claims_json(&measured));
    WholeFile::write(&folder.join("claims.json"), json.as_bytes())?;
    WholeFile::write(&folder.join("index.html"), page::html(&drawn, &measured, effort).as_bytes())
}

//! `billiards reproduce`: the paper on one page.

use std::fmt;
use std::io::{self, IsTerminal, Write};
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;

use indicatif::{ProgressBar, ProgressState, ProgressStyle};
use paper::{Claim, Measurement, claims};

use super::{Failure, patience};
use crate::args;
use crate::reproduce::page::{self, Drawn, Measured};
use crate::reproduce::{Effort, Figure, figures};
use crate::simulation::plural;
use crate::whole_file::WholeFile;

/// One job: a figure or a claim.
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

/// The result of a job.
enum Done {
    Drawn(String, [f64; 2]),
    Measured(Measurement),
}

/// All results, each kind in the order of the paper.
#[derive(Default)]
struct Results {
    drawn: Vec<Drawn>,
    measured: Vec<Measured>,
    /// The figures and claims that could not be drawn or measured, by name and with the reason.
    failed: Vec<String>,
    /// Those that an interruption has left out.
    left_out: Vec<&'static str>,
}

/// Recomputes figures and claims, and writes the page.
///
/// # Errors
/// There is no figure or claim of that name; or (after all else is written) one of them fails or a measurement disagrees with its
/// verdict, or the user has interrupted the work; or something cannot be written.
pub fn run(arguments: &args::Reproduce, out: &mut impl Write) -> Result<(), Failure> {
    let all = figures::all().iter().map(Job::Draw).chain(claims::all().iter().map(Job::Measure));
    if arguments.list {
        return list(out).map_err(Failure::from);
    }
    let jobs: Vec<Job> =
        all.clone().filter(|job| arguments.only.as_deref().is_none_or(|only| job.name() == only)).collect();
    if let (true, Some(only)) = (jobs.is_empty(), &arguments.only) {
        let list = "`billiards reproduce --list` lists them";
        return Err(super::unknown("figure or claim", only, all.map(Job::name), list));
    }
    let files = match &arguments.only {
        Some(name) => {
            let measures = jobs.iter().any(|job| matches!(job, Job::Measure(_)));
            Files { page: format!("{name}.html"), claims: measures.then(|| format!("{name}.json")) }
        }
        None => Files { page: "index.html".into(), claims: Some("claims.json".into()) },
    };
    work(&jobs, &files, arguments, out)
}

/// Does the jobs and writes the files, once it is known that they can be written: the work would be lost otherwise.
fn work(jobs: &[Job], files: &Files, arguments: &args::Reproduce, out: &mut impl Write) -> Result<(), Failure> {
    let unwritable = |error| super::unwritable(&arguments.out, &error);
    files.probe(jobs, &arguments.out).map_err(unwritable)?;
    let effort = if arguments.quick { Effort::Quick } else { Effort::Full };
    let interrupted = super::interruption()?;
    let results = in_parallel(jobs, effort, &interrupted);
    let Results { drawn, measured, failed, left_out } = &results;
    let mut told = Ok(());
    if !(drawn.is_empty() && measured.is_empty()) {
        write(&results, effort, &arguments.out, files).map_err(unwritable)?;
        let page = arguments.out.join(&files.page);
        let figures = plural(drawn.len() as u64, "figure");
        let claims = plural(measured.len() as u64, "claim");
        told = writeln!(out, "{}: {figures}, {claims}", super::shown(&page));
    }
    let interrupted = (!left_out.is_empty())
        .then(|| format!("interrupted: {} of {} figures and claims are done", jobs.len() - left_out.len(), jobs.len()));
    let wrong = failed.iter().cloned().chain(measured.iter().filter_map(disagreement)).chain(interrupted);
    let wrong: Vec<String> = wrong.collect();
    if wrong.is_empty() {
        told.map_err(|error| super::untold(&arguments.out, error))
    } else {
        Err(Failure::Work(wrong.join("\nerror: ")))
    }
}

/// What disagrees with a claim's verdict, if anything does.
fn disagreement(Measured { claim, measurement }: &Measured) -> Option<String> {
    let off: Vec<String> = measurement.quantities.iter().filter(|q| !q.agrees()).map(ToString::to_string).collect();
    (!measurement.is_consistent())
        .then(|| format!("{}: the measurement disagrees with the verdict\n  {}", claim.name, off.join("\n  ")))
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

/// Does all jobs, one per processor at a time, unless interrupted.
fn in_parallel(jobs: &[Job], effort: Effort, interrupted: &Arc<AtomicBool>) -> Results {
    let bar = progress_bar(jobs.len(), Arc::clone(interrupted));
    let next = AtomicUsize::new(0);
    let slots: Vec<Mutex<Option<Result<Done, String>>>> = jobs.iter().map(|_| Mutex::new(None)).collect();
    let threads = thread::available_parallelism().map_or(1, usize::from).min(jobs.len());
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while !interrupted.load(Ordering::Relaxed) {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some(job) = jobs.get(i) else { break };
                    bar.set_message(job.name());
                    let result = one(*job, effort);
                    if let Ok(mut slot) = slots[i].lock() {
                        *slot = Some(result);
                    }
                    bar.inc(1);
                }
            });
        }
    });
    bar.finish_and_clear();
    let mut results = Results::default();
    for (job, slot) in jobs.iter().zip(slots) {
        match (job, slot.into_inner().ok().flatten()) {
            (Job::Draw(figure), Some(Ok(Done::Drawn(svg, size)))) => {
                results.drawn.push(Drawn { figure: **figure, svg, size });
            }
            (Job::Measure(claim), Some(Ok(Done::Measured(measurement)))) => {
                results.measured.push(Measured { claim, measurement });
            }
            (job, Some(Err(error))) => results.failed.push(format!("{}: {error}", job.name())),
            (job, _) => results.left_out.push(job.name()),
        }
    }
    results
}

/// Does one job. A figure or claim whose set-up is impossible panics: an error of this program, which does not affect other jobs.
fn one(job: Job, effort: Effort) -> Result<Done, String> {
    let work = || match job {
        Job::Draw(figure) => {
            let svg = (figure.draw)(effort).map_err(|error| error.to_string())?;
            Ok(Done::Drawn(svg.to_string(), svg.size()))
        }
        Job::Measure(claim) => Ok(Done::Measured(claim.measure(effort))),
    };
    panic::catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| Err("the computation failed".into()))
}

fn progress_bar(jobs: usize, interrupted: Arc<AtomicBool>) -> ProgressBar {
    if !io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let of_ctrl_c = move |_: &ProgressState, to: &mut dyn fmt::Write| {
        let _ = to.write_str(patience::of_ctrl_c(interrupted.load(Ordering::Relaxed)));
    };
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len}  {elapsed} elapsed  {msg}; {of_ctrl_c}");
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar()).with_key("of_ctrl_c", of_ctrl_c);
    let bar = ProgressBar::new(jobs as u64).with_style(style);
    bar.enable_steady_tick(patience::GLANCE);
    bar
}

/// The file names of the page and of the measurements. For a single figure or claim they are named after it, so that the whole
/// page is left alone.
struct Files {
    page: String,
    claims: Option<String>,
}

impl Files {
    /// Checks whether these files and the pictures can be written.
    fn probe(&self, jobs: &[Job], folder: &Path) -> io::Result<()> {
        let pictures = jobs.iter().filter_map(|job| match job {
            Job::Draw(figure) => Some(picture(figure)),
            Job::Measure(_) => None,
        });
        let names = pictures.chain(self.claims.clone()).chain([self.page.clone()]);
        names.map(|name| folder.join(name)).try_for_each(|path| WholeFile::probe(&path))
    }
}

/// The file name of a figure.
fn picture(figure: &Figure) -> String {
    format!("{}.svg", figure.name)
}

/// Writes the pictures, the claims, and the page that shows them: all or none.
fn write(results: &Results, effort: Effort, folder: &Path, files: &Files) -> io::Result<()> {
    let Results { drawn, measured, left_out, .. } = results;
    let mut whole = vec![];
    for Drawn { figure, svg, .. } in drawn {
        whole.push(WholeFile::with(&folder.join(picture(figure)), svg.as_bytes())?);
    }
    if let Some(claims) = &files.claims {
        let json = format!("{:#}\n", page::claims_json(measured, left_out));
        whole.push(WholeFile::with(&folder.join(claims), json.as_bytes())?);
    }
    whole.push(WholeFile::with(&folder.join(&files.page), page::html(drawn, measured, left_out, effort).as_bytes())?);
    WholeFile::finish(whole)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::BEYOND;

    #[test]
    fn nothing_is_drawn_where_a_file_cannot_be_written() {
        static DRAWN: AtomicBool = AtomicBool::new(false);
        static FIGURE: Figure = Figure {
            name: "figure",
            title: "A figure",
            place: BEYOND,
            caption: "",
            parameters: "",
            draw: |_| {
                DRAWN.store(true, Ordering::Relaxed);
                Err("drawn".into())
            },
        };
        let out = std::env::temp_dir().join(format!("billiards-probed-{}", std::process::id()));
        let files = || Files { page: "figure.html".into(), claims: Some("figure.json".into()) };
        for name in ["figure.svg", "figure.json", "figure.html"] {
            std::fs::create_dir_all(out.join(name)).unwrap();
            let arguments = args::Reproduce { quick: true, only: None, list: false, out: out.clone() };
            let failed = work(&[Job::Draw(&FIGURE)], &files(), &arguments, &mut io::sink()).unwrap_err().to_string();
            assert!(failed.contains(&format!("{name} is a folder, not a file")), "{failed}");
            assert!(!DRAWN.load(Ordering::Relaxed), "{name}");
            std::fs::remove_dir_all(&out).unwrap();
        }
    }
}

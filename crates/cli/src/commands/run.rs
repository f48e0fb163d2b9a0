//! `billiards run`: the main job.

use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread;
use std::time::Duration;

use indicatif::{HumanDuration, ProgressBar, ProgressStyle};

use super::{Failure, patience};
use crate::args;
use crate::document::{Diagnostic, Source, plain, spell};
use crate::scene::{Request, Scene};
use crate::simulation::{Control, Done, Simulation};

/// Runs a scene and prints a summary.
///
/// # Errors
/// The scene is wrong, or something cannot be written.
pub fn run(arguments: &args::Run, out: &mut impl Write) -> Result<(), Failure> {
    let request = Request { law: arguments.law.clone(), collisions: arguments.collisions, needs_limit: true };
    let source = Source::read(&arguments.scene)?;
    let folder = arguments.folder().ok_or_else(|| {
        let what = "the results would go to a folder in out/ named after the scene file, but no folder can be named after this";
        Box::new(Diagnostic::of_file(source.name(), what).with_help("name a folder: --out DIR"))
    })?;
    let simulation = patience::with_spinner("reading and checking the scene", || {
        Ok::<_, Failure>(Simulation::new(Scene::parse(&source, &request)?)?)
    })?;
    let overwritten = simulation.overwritten(&folder);
    if !overwritten.is_empty() {
        return Err(overwritten.into());
    }
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let control = Arc::new(Control::new(arguments.threads.map_or(cores, usize::from)));
    let flag = Arc::clone(&control);
    super::on_ctrl_c(move || flag.interrupted.store(true, Ordering::Relaxed))?;
    let steps = simulation.steps();
    let update = |bar: &ProgressBar| {
        let (done, interrupted) = (control.steps_done(), control.interrupted.load(Ordering::Relaxed));
        let outlook = if interrupted { String::new() } else { outlook(control.running(), done, steps) + "; " };
        bar.set_position(done);
        bar.set_message(outlook + patience::of_ctrl_c(interrupted));
    };
    let done = patience::with_bar(|| progress_bar(steps), update, || simulation.run(&folder, &control))
        .map_err(|error| super::unwritable(&folder, &error))?;
    report(&simulation, &done, &folder, out).map_err(|error| super::untold(&folder, error))
}

fn progress_bar(steps: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}");
    ProgressBar::new(steps).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// How long the rest of the orbits takes at the rate at which they have been running; before and after, what is being done.
fn outlook(running: Option<Duration>, done: u64, steps: u64) -> String {
    let Some(running) = running else { return "horizons".into() };
    if done == 0 {
        return "first orbits".into();
    }
    if done >= steps {
        return "pictures, files".into();
    }
    let seconds = running.as_secs_f64() * ((steps - done) as f64 / done as f64);
    // only in the largest unit, since the estimate is rough
    format!("{:#} to go", HumanDuration(Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX)))
}

/// A short summary, and what was written.
fn report(simulation: &Simulation, done: &Done, folder: &Path, out: &mut impl Write) -> io::Result<()> {
    let summary = &done.summary;
    if let Some(title) = &simulation.scene().title {
        writeln!(out, "{}", plain(title))?;
    }
    writeln!(out, "  table       {}", summary.setup.table)?;
    writeln!(out, "  law         {}, gamma^2 = {}", summary.setup.law, spell(summary.setup.gamma_squared))?;
    let stops: Vec<_> = summary.stops.iter().map(|(name, count)| format!("{count} {name}")).collect();
    writeln!(out, "  orbits      {}: {}", summary.orbits, stops.join(", "))?;
    let seconds = Duration::from_secs_f64(summary.seconds);
    writeln!(out, "  collisions  {} in {seconds:.3?}, {:.1} ns each", summary.collisions, summary.ns_per_collision)?;
    let drift = if summary.energy_drift == 0.0 { "0".into() } else { format!("{:.1e}", summary.energy_drift) };
    writeln!(out, "  energy      changes by at most {drift} (relative)")?;
    writeln!(out, "  digits      {}", summary.horizon.in_words(summary.orbits))?;
    let names = done.files.iter().filter_map(|file| file.file_name()).map(|name| name.to_string_lossy());
    writeln!(out, "  written     {}: {}", super::shown(folder), names.collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_takes_as_long_as_what_is_done_took() {
        let after = |seconds: u64, done, steps| outlook(Some(Duration::from_secs(seconds)), done, steps);
        assert_eq!(after(1, 1, 20), "19s to go");
        assert_eq!(after(2, 1 << 32, 1 << 33), "2s to go");
        assert_eq!(after(3600, 10, 20), "60m to go");
        assert_eq!(after(9, 20, 20), "pictures, files");
        // the amount of work is enormous
        assert!(after(1, 1, u64::MAX).ends_with("y to go"));
    }

    #[test]
    fn before_anything_is_done_nothing_is_said_of_the_rest() {
        assert_eq!(outlook(Some(Duration::from_secs(60)), 0, 20), "first orbits");
        assert_eq!(outlook(None, 0, 20), "horizons");
    }
}

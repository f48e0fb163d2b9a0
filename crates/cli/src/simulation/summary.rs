//! `summary.json`: what was run, and the results.

use std::collections::BTreeMap;
use std::io;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use serde::Serialize;

use super::harvest::Totals;
use super::horizon::Horizons;
use super::setup::Setup;
use crate::scene::{Limit, Scene, Starts};

/// A run on one page. Two runs of the same scene differ at most in the last six fields.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// The scene's title, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// SHA-256 of the scene file.
    pub scene: String,
    /// The same of the drawings and meshes beside it, by their names in the scene.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub inputs: BTreeMap<String, String>,
    /// Version of this program.
    pub version: &'static str,
    /// Seed of the starts, 0 where they are given one by one. (That of a random law stands with the law.)
    pub seed: u64,
    /// Table, law and particle.
    #[serde(flatten)]
    pub setup: Setup,
    /// Number of collisions after which an orbit ends, if that was requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub collisions_per_orbit: Option<u64>,
    /// Time after which an orbit ends, if that was requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_per_orbit: Option<f64>,
    /// Number of orbits.
    pub orbits: u64,
    /// Collisions of all orbits.
    pub collisions: u64,
    /// Simulated time of all orbits.
    pub time: f64,
    /// Largest relative deviation of an orbit's energy from that of its start, at the end and every 4096 collisions, for states as
    /// they are reported ([`billiards::Orbit::restored`]).
    pub energy_drift: f64,
    /// How long the digits of the orbits last.
    pub horizon: Horizons,
    /// How many orbits ended for which reason.
    pub stops: BTreeMap<&'static str, u64>,
    /// The other files that were written. Any further files in the folder are from an earlier run.
    pub files: Vec<String>,
    /// Time that the simulation itself took, in seconds.
    pub seconds: f64,
    /// The same per collision, in nanoseconds; 0 without collisions.
    pub ns_per_collision: f64,
    /// Number of threads.
    pub threads: usize,
    /// The machine.
    pub host: String,
    /// When the run ended, UTC.
    pub date: String,
    /// The command line, as a shell reads it.
    pub command: String,
}

/// The files of a run besides the scene and the summary.
#[derive(Debug)]
pub(crate) struct Files {
    /// What was read, and its SHA-256.
    pub(crate) read: BTreeMap<String, String>,
    /// What was written.
    pub(crate) written: Vec<String>,
}

impl Summary {
    /// Collects what is known of a run.
    pub(crate) fn new(
        scene: &Scene,
        orbits: u64,
        totals: &Totals,
        horizon: Horizons,
        files: Files,
        busy: Duration,
        threads: usize,
    ) -> Summary {
        let seconds = busy.as_secs_f64();
        let ns_per_collision = if totals.collisions == 0 { 0.0 } else { seconds * 1e9 / totals.collisions as f64 };
        let (collisions_per_orbit, time_per_orbit) = match scene.limit {
            Some(Limit::Collisions(n)) => (Some(n.value), None),
            Some(Limit::Time(time)) => (None, Some(time.value)),
            None => (None, None),
        };
        let mut stops = totals.stops.clone();
        let never_begun = orbits - totals.orbits;
        if never_begun > 0 {
            *stops.entry(super::harvest::INTERRUPTED).or_default() += never_begun;
        }
        Summary {
            title: scene.title.clone(),
            scene: crate::sha256::hex(scene.source.text().as_bytes()),
            inputs: files.read,
            version: env!("CARGO_PKG_VERSION"),
            seed: match &scene.starts {
                Starts::Ensemble(ensemble) => ensemble.seed,
                Starts::Orbits(_) => 0,
            },
            setup: Setup::of(scene),
            collisions_per_orbit,
            time_per_orbit,
            orbits,
            collisions: totals.collisions,
            time: totals.time.value(),
            energy_drift: totals.drift,
            horizon,
            stops,
            files: files.written,
            seconds,
            ns_per_collision,
            threads,
            host: host(),
            date: date(SystemTime::now()),
            command: std::env::args_os().map(|word| quoted(&word.to_string_lossy())).collect::<Vec<_>>().join(" "),
        }
    }

    /// The hashes of the drawings and meshes beside a scene.
    ///
    /// # Errors
    /// One cannot be read.
    pub(super) fn inputs(scene: &Scene) -> io::Result<BTreeMap<String, String>> {
        let hash = |name: &str| Ok((name.into(), crate::sha256::hex(&std::fs::read(scene.source.beside(name))?)));
        scene.table.files().map(|file| hash(&file.value)).collect()
    }

    /// The file's content.
    pub fn json(&self) -> String {
        // A summary contains nothing that JSON cannot represent.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}

/// A word quoted for a POSIX shell.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_@%+=:,./-".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.into()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// Operating system, processor and its capabilities.
pub(crate) fn host() -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let (os, arch) = (std::env::consts::OS, std::env::consts::ARCH);
    format!("{os} {arch}, {cores} cores, {}", lanes::instruction_set().0)
}

/// A moment as `2031-05-09T16:03:20Z`.
fn date(moment: SystemTime) -> String {
    let seconds = moment.duration_since(UNIX_EPOCH).map_or(0, |time| time.as_secs());
    let (days, seconds) = (seconds / 86_400, seconds % 86_400);
    // Civil date from days, in eras of 400 years that begin in March [Hinnant].
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, later) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    let year = era * 400 + year + later;
    let (hour, minute, second) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_quoted_where_a_shell_would_read_them_otherwise() {
        assert_eq!(["out/a-b_1.toml", "1e6", "--law=no-slip"].map(quoted), ["out/a-b_1.toml", "1e6", "--law=no-slip"]);
        assert_eq!(["", "a b", "$x", "~", "caf\u{e9}"].map(quoted), ["''", "'a b'", "'$x'", "'~'", "'caf\u{e9}'"]);
        assert_eq!(quoted("sp ace'q\".toml"), r#"'sp ace'\''q".toml'"#);
    }

    #[test]
    fn dates_are_civil() {
        let at = |seconds| date(UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(at(0), "1970-01-01T00:00:00Z");
        assert_eq!(at(951_827_696), "2000-02-29T12:34:56Z");
        assert_eq!(at(4_102_444_799), "2099-12-31T23:59:59Z");
    }
}

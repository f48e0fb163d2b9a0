//! Where billiard programs break: extreme tables, starts, bodies and units.
//!
//! Each case reports what happened: how the orbits ended, the worst error of something that is known exactly, and
//! whether anything was lost. An orbit is lost if it leaves a closed table, lies outside it by more than rounding, or
//! contains a NaN. A case ends after a number of collisions set beforehand, so that none can hang; one that panics is
//! reported like any other.

mod gamma;
mod mass;
mod nearby;
mod needle;
mod outline;
mod slender;
mod tangent;
mod units;
mod wedge;

use std::collections::BTreeMap;
use std::error::Error;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use billiards::geometry::{Table, Vector2};
use billiards::{Outcome, Start, Stop};

use super::Effort;
use super::method::exact::{orbit, with_engine};
use super::state::{State, worse};
use crate::simulation::{Engine, PlanarLaw, PlanarTrail, Until};

/// An entry of the registry.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// What is done, in one line.
    pub summary: &'static str,
    run: fn(Effort) -> Result<Tally, Box<dyn Error>>,
}

/// Every case.
pub const CASES: &[Entry] = &[
    wedge::SPECULAR,
    wedge::NO_SLIP,
    needle::ENTRY,
    tangent::GAPS,
    tangent::HORNS,
    tangent::CUSP,
    gamma::SMALL,
    gamma::LARGE,
    mass::ENTRY,
    slender::ENTRY,
    units::LENGTHS,
    units::SPEEDS,
    nearby::WALLS,
    nearby::VERTICES,
    outline::ENTRY,
];

/// What happened.
#[derive(Clone, Debug)]
pub struct Report {
    /// Name of the case.
    pub name: &'static str,
    /// What was done.
    pub summary: &'static str,
    /// Its result, or why there is none.
    pub result: Result<Tally, String>,
    /// Time that it took.
    pub time: Duration,
}

/// The result of a case.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Orbits, or single collisions.
    pub orbits: u64,
    /// Collisions of all of them.
    pub collisions: u64,
    /// How many ended in which way.
    pub stops: BTreeMap<&'static str, u64>,
    /// The quantity that is known exactly.
    pub known: &'static str,
    /// Its worst error.
    pub error: f64,
    /// How many were lost.
    pub lost: u64,
}

impl Tally {
    /// Counts a single collision with this error.
    fn collision(&mut self, error: f64) {
        self.error = worse(self.error, error);
        self.lost += u64::from(!error.is_finite());
        self.orbits += 1;
        self.collisions += 1;
        *self.stops.entry("finished").or_default() += 1;
    }

    /// Adds another part of the same case.
    fn join(&mut self, part: Tally) {
        self.orbits += part.orbits;
        self.collisions += part.collisions;
        for (stop, count) in part.stops {
            *self.stops.entry(stop).or_default() += count;
        }
        self.known = part.known;
        self.error = worse(self.error, part.error);
        self.lost += part.lost;
    }
}

impl Entry {
    /// Runs the case.
    pub fn run(&self, effort: Effort) -> Report {
        let begun = Instant::now();
        let result = match catch_unwind(AssertUnwindSafe(|| (self.run)(effort))) {
            Ok(result) => result.map_err(|error| error.to_string()),
            Err(_) => Err("it panicked".into()),
        };
        Report { name: self.name, summary: self.summary, result, time: begun.elapsed() }
    }
}

/// The cases of that name; all if there is none.
pub fn cases(only: Option<&str>) -> Vec<&'static Entry> {
    CASES.iter().filter(|entry| only.is_none_or(|only| entry.name == only)).collect()
}

/// A point off a wall by more than this fraction of the size of its coordinates is outside: 64 ulp, four times the
/// error (16) with which a point still counts as on a piece.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// Collisions between two looks at an orbit.
const BLOCK: u64 = 1000;

/// A planar table with a law, under stress.
struct Trial<'a> {
    table: &'a Table,
    law: PlanarLaw,
    /// Collisions per orbit.
    collisions: u64,
    /// Whether an orbit may leave.
    open: bool,
}

impl Trial<'_> {
    /// Runs orbits, and watches their energy and that they stay inside.
    fn run(&self, starts: &[Start<2, 1>]) -> Tally {
        Tally { known: "energy", ..self.watch(starts, &|first, now| now.energy_drift(first)) }
    }

    /// The same with another error, computed from the initial and the current state.
    fn watch(&self, starts: &[Start<2, 1>], error: &dyn Fn(&State<f64>, &State<f64>) -> f64) -> Tally {
        with_engine(self.table, &self.law, |engine| {
            let mut tally = Tally::default();
            for start in starts {
                self.follow(engine, start, error, &mut tally);
            }
            tally
        })
    }

    fn follow(
        &self,
        engine: &dyn Engine<2, 1, PlanarTrail>,
        start: &Start<2, 1>,
        error: &dyn Fn(&State<f64>, &State<f64>) -> f64,
        tally: &mut Tally,
    ) {
        let first = State::from_parts(&start.position, &start.velocity, &start.spin);
        let extent = self.table.extent();
        let reach = [extent.min.x, extent.min.y, extent.max.x, extent.max.y];
        let size = reach.into_iter().filter(|x| x.is_finite()).fold(0.0, |m: f64, x| m.max(x.abs()));
        let mut orbit = orbit::<2, 1>(&first);
        let mut done = 0;
        let mut inside = true;
        let stop = loop {
            let until = Until { collisions: BLOCK.min(self.collisions - done), time: f64::INFINITY };
            let Outcome { stop, collisions } = engine.bare(&mut orbit, until);
            done += collisions;
            let now = State::from_parts(&orbit.position, &orbit.velocity, &orbit.spin);
            if collisions > 0 {
                let [x, y] = orbit.position;
                let off = self.table.signed_distance(&Vector2::new(x, y));
                inside &= off >= -ROUNDING * size.max(x.abs()).max(y.abs());
                tally.error = worse(tally.error, error(&first, &now));
            }
            if stop != Stop::Finished || done == self.collisions {
                break stop;
            }
        };
        let gone = stop == Stop::Escaped && !self.open;
        tally.lost += u64::from(gone || !inside);
        tally.orbits += 1;
        tally.collisions += done;
        *tally.stops.entry(stop.name()).or_default() += 1;
    }
}

/// A start in the plane, with a spin as large as the transverse speed.
fn start(position: [f64; 2], angle: f64) -> Start<2, 1> {
    let (sin, cos) = libm::sincos(angle);
    Start { position, velocity: [cos, sin], spin: [0.5] }
}

/// Directions all around, none of them special.
fn directions(many: u32) -> impl Iterator<Item = f64> {
    (0..many).map(move |k| 0.1 + core::f64::consts::TAU * (f64::from(k) + 0.3) / f64::from(many))
}

//! The ways of computing an orbit that are compared, one per file.

mod distance;
pub(super) mod exact;
mod formula;
mod polyline;
mod side_by_side;
mod textbook;

use std::error::Error;

pub use billiards::Stop;

use super::Effort;
use super::case::Case;
use super::chart::Mark;
use super::law::Law;
use super::state::State;

/// A way of computing orbits, ready for one table and law.
pub trait Method {
    /// Runs one orbit and shows its state after each of the numbers of collisions in `stops`, in rising order.
    fn trace(&self, start: &State<f64>, stops: &[u64], look: &mut dyn FnMut(usize, &State<f64>)) -> End;

    /// Runs each start for a number of collisions, to measure the time. Returns the number of collisions made.
    fn bulk(&self, starts: &[State<f64>], collisions: u64) -> u64;
}

/// How an orbit ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// After the requested number of collisions.
    Whole,
    /// In a corner, as an orbit may.
    Corner,
    /// Too early, and why: the method has lost the particle.
    Lost(Stop),
}

/// Shows an orbit after these numbers of collisions; `step` makes a number of further collisions, and returns why it
/// stopped and where.
fn in_steps(
    stops: &[u64],
    look: &mut dyn FnMut(usize, &State<f64>),
    mut step: impl FnMut(u64) -> (Stop, State<f64>),
) -> End {
    let mut done = 0;
    for (k, &stop) in stops.iter().enumerate() {
        let (why, state) = step(stop - done);
        match why {
            Stop::Finished => {}
            Stop::Corner => return End::Corner,
            _ => return End::Lost(why),
        }
        done = stop;
        look(k, &state);
    }
    End::Whole
}

/// An entry of the registry.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// What it is, in one line.
    pub summary: &'static str,
    /// How its points in the chart are marked.
    pub mark: Mark,
    /// The numbers of pieces it is tried with, `None` where there is no such choice; nothing where it does not apply.
    pub sizes: fn(&Case, Effort) -> Vec<Option<usize>>,
    /// Prepares it.
    pub build: fn(&Case, Law, Option<usize>) -> Built,
}

/// A method that is ready, or why it is not.
pub type Built = Result<Box<dyn Method>, Box<dyn Error>>;

/// Every method, in the order of the report.
pub const METHODS: &[Entry] = &[
    exact::ENTRY,
    side_by_side::ENTRY,
    formula::IMPLICIT,
    formula::POLAR,
    distance::ENTRY,
    polyline::FLAT,
    polyline::INTERPOLATED,
    textbook::DOUBLE,
    textbook::SINGLE,
];

/// For methods without a number of pieces that apply everywhere.
fn always(_: &Case, _: Effort) -> Vec<Option<usize>> {
    vec![None]
}

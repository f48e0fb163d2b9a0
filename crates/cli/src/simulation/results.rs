//! Results of orbits, on their way from the threads that run them to the one that keeps them.

use billiards::Stop;

use super::event::Event;
use super::portraits::Point;

/// How an orbit ended, in the user's units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ended {
    /// Number of the orbit.
    pub(crate) orbit: u64,
    /// Why; `None` if the user interrupted it.
    pub(crate) stop: Option<Stop>,
    /// Collisions made.
    pub(crate) collisions: u64,
    /// Time passed.
    pub(crate) time: f64,
    /// Largest relative deviation of the energy, in reported states, from that of the start.
    pub(crate) drift: f64,
    /// Position at the end; for an orbit that ends in a corner, the corner.
    pub(crate) position: [f64; 3],
    /// Velocity at the end.
    pub(crate) velocity: [f64; 3],
    /// For how long it has been flying when its time is over, if it meets no wall any more and is drawn.
    pub(crate) adrift: Option<f64>,
}

/// Results of consecutive orbits, or of a part of one.
#[derive(Debug, Default)]
pub(crate) struct Results {
    /// Collisions, orbit after orbit, if they are drawn.
    pub(crate) events: Vec<Event>,
    /// The same, as rows of the record, and their number.
    pub(crate) rows: u64,
    pub(crate) formatted: Vec<u8>,
    /// The same as points of portraits, as long as they are few.
    pub(crate) points: Vec<Point>,
    /// Ends of orbits, and how many of the events come before each.
    pub(crate) ends: Vec<(usize, Ended)>,
}

//! Up to where the digits of the orbits last.

use billiards::geometry::{Lattice, Vector2};
use billiards::{Bend, Bounce, Horizon};
use serde::Serialize;

use super::start::Start;
use super::words::short;

/// Orbits that are looked at: the first so many.
const MOST_ORBITS: u64 = 16;
/// Collisions that are looked at, of all these orbits together: a twentieth of a second.
const MOST_COLLISIONS: u64 = 50_000;

/// How long the digits of orbits last: rounding grows along an orbit, and past its horizon it is one of many.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Horizons {
    /// Collisions after which the first of the orbits is lost; nothing if all are known as far as they were looked at.
    pub collisions: Option<u64>,
    /// When that is.
    pub time: Option<f64>,
    /// The first orbits, one by one.
    pub orbits: Vec<OfOrbit>,
}

/// The horizon of an orbit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct OfOrbit {
    /// Its number.
    pub orbit: u64,
    /// Collisions whose place is known.
    pub collisions: u64,
    /// When the last of them was.
    pub time: f64,
    /// A bound for the error there, in units of the table's size or of the speed.
    pub error: f64,
    /// Whether what follows is lost; if not, nothing more was looked at.
    pub lost: bool,
}

impl Horizons {
    /// Looks at the first orbits, on a table of some size, up to a number of collisions and a time of the user.
    pub(crate) fn of<const N: usize, const S: usize>(
        billiard: &dyn Bounce<N, S>,
        walls: &dyn Bend<N>,
        size: f64,
        orbits: u64,
        start: &dyn Fn(u64) -> Start<N, S>,
        [collisions, time]: [f64; 2],
    ) -> Horizons {
        let looked_at = orbits.min(MOST_ORBITS);
        let each = collisions.min((MOST_COLLISIONS / looked_at.max(1)) as f64);
        let horizon = |orbit| {
            let Start { position, velocity, spin, scale, .. } = start(orbit);
            let limit = [each, scale.time_in(time)];
            let found = Horizon::of(billiard, walls, billiards::Start { position, velocity, spin }, size, limit);
            let Horizon { collisions, time, error, lost } = found;
            OfOrbit { orbit, collisions, time: scale.time_out(time), error, lost }
        };
        let orbits: Vec<OfOrbit> = (0..looked_at).map(horizon).collect();
        let first = orbits.iter().filter(|orbit| orbit.lost).min_by_key(|orbit| orbit.collisions).copied();
        Horizons { collisions: first.map(|first| first.collisions), time: first.map(|first| first.time), orbits }
    }

    /// The number of the last collision of an orbit whose place is known, if the orbit goes on and was looked at.
    pub(crate) fn last_known(&self, orbit: u64) -> Option<u64> {
        let found = self.orbits.get(usize::try_from(orbit).ok()?)?;
        found.lost.then_some(found.collisions)
    }

    /// The same in words.
    pub fn in_words(&self) -> String {
        let lost = self.orbits.iter().filter(|orbit| orbit.lost);
        if let Some(first) = lost.min_by_key(|orbit| orbit.collisions) {
            let OfOrbit { orbit, collisions, time, .. } = first;
            return format!(
                "of orbit {orbit} last {collisions} collisions (t = {}); beyond, it is one of many",
                short(*time)
            );
        }
        let Some(least) = self.orbits.iter().map(|orbit| orbit.collisions).min() else { return "none".into() };
        let error = self.orbits.iter().fold(0.0, |m: f64, orbit| m.max(orbit.error));
        format!("right to {error:.0e} of the table's size after {least} collisions")
    }
}

/// The largest of the finite sides of a box; infinite if there is none.
pub(crate) fn size(low: &[f64], high: &[f64]) -> f64 {
    let sides = low.iter().zip(high).map(|(low, high)| high - low).filter(|side| side.is_finite() && *side > 0.0);
    sides.reduce(f64::max).unwrap_or(f64::INFINITY)
}

/// The longest side of the unit cell.
pub(crate) fn cell_size(lattice: &Lattice) -> f64 {
    lattice.vectors().iter().map(Vector2::norm).fold(0.0, f64::max)
}

//! How long the digits of the orbits last.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::{self, Builder};

use billiards::geometry::{FundamentalCell, Vector2, WallHit};
use billiards::{Bend, Bounce, Horizon, Stop, Timed};
use serde::Serialize;

use super::Control;
use super::engine::{Bare, Engine, Until, Watched};
use super::job::bare;
use super::start::Start;
use super::trail::Trail;
use super::words::{plural, short};
use super::work::BLOCK;

/// Most orbits that are examined: the first ones.
const MOST_ORBITS: u64 = 16;
/// Most collisions that are examined, for all these orbits together: a tenth of a second.
const MOST_COLLISIONS: u64 = 50_000;

/// How long the digits of orbits last: rounding errors grow along an orbit, and past its horizon the computed orbit is only one of many
/// possible ones.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Horizons {
    /// Number of collisions after which the first of the orbits is lost; `None` if all are known as far as they were examined.
    pub collisions: Option<u64>,
    /// The time at which that happens.
    pub time: Option<f64>,
    /// The first orbits, one by one; fewer if the user interrupted the run before all were examined.
    pub orbits: Vec<OfOrbit>,
    /// The unit of position errors, in words.
    #[serde(skip)]
    pub unit: &'static str,
}

/// Units of errors on a table that has a size, and on one that has none.
const UNITS: [&str; 2] = ["the table's size", "the distance from the walls"];

/// The horizon of an orbit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct OfOrbit {
    /// Its number.
    pub orbit: u64,
    /// Number of collisions whose position is known.
    pub collisions: u64,
    /// Time of the last of them.
    pub time: f64,
    /// A bound for the error there, in units of the table's size or of the speed. An oblique strip, a half-plane or a wedge has no size;
    /// there the unit is the greatest distance that the orbit has had from the wall that it hit next.
    pub error: f64,
    /// Whether what follows is lost; if not, nothing further was examined.
    pub lost: bool,
}

impl Horizons {
    /// Examines the first orbits, on a table of some size, up to a number of collisions and a time in the user's unit.
    pub(crate) fn of<const N: usize, const S: usize, T: Trail<N, S>>(
        engine: &dyn Engine<N, S, T>,
        walls: &(dyn Bend<N> + Sync),
        size: f64,
        orbits: u64,
        launch: &(dyn Fn(u64) -> (Start<N, S>, Watched<N, S, T>) + Sync),
        [collisions, time]: [f64; 2],
        control: &Control,
    ) -> Horizons {
        let billiard = &Interruptible { billiard: engine, interrupted: &control.interrupted };
        let looked_at = orbits.min(MOST_ORBITS);
        let each = collisions.min((MOST_COLLISIONS / looked_at.max(1)) as f64);
        let horizon = |orbit| {
            let (start, launched) = launch(orbit);
            let Start { position, velocity, spin, scale, .. } = start;
            let up_to = |collisions| {
                let from = billiards::Start { position, velocity, spin };
                Horizon::of(billiard, walls, from, size, [collisions, f64::INFINITY])
            };
            // knowledge of an orbit ends where the orbit does; the engine's own bits decide when each collision is, and which is the last
            let time = scale.time_in(time);
            let mut ran = bare(&launched);
            let mut found = up_to(each);
            let made = collisions_of(engine, &mut ran, Until { collisions: found.collisions, time });
            let known = ran.track.time();
            let mut goes_on = || collisions_of(engine, &mut ran, Until { collisions: 1, time }) == 1;
            if made < found.collisions || (found.lost && !goes_on()) {
                found = up_to(made as f64);
            }
            let Horizon { collisions, error, lost, .. } = found;
            let of_orbit = OfOrbit { orbit, collisions, time: scale.time_out(known), error, lost };
            // an interruption cuts the examination short
            (!control.interrupted.load(Ordering::Relaxed)).then_some(of_orbit)
        };
        let orbits = on_threads(control.threads, looked_at, &horizon);
        let first = first_lost(&orbits);
        let unit = UNITS[usize::from(size == f64::INFINITY)];
        Horizons { collisions: first.map(|first| first.collisions), time: first.map(|first| first.time), orbits, unit }
    }

    /// The number of the last collision of an orbit whose position is known, if the orbit goes on and was examined.
    pub(crate) fn last_known(&self, orbit: u64) -> Option<u64> {
        let found = self.orbits.get(usize::try_from(orbit).ok()?)?;
        found.lost.then_some(found.collisions)
    }

    /// The same in words, for this many orbits.
    pub fn in_words(&self, orbits: u64) -> String {
        let looked_at = self.orbits.len() as u64;
        let among = match looked_at {
            0 => return "not examined".into(),
            1 if orbits == 1 => String::new(),
            _ if looked_at == orbits => format!(" of {orbits} orbits"),
            1 => format!(" of the first of {orbits} orbits"),
            _ => format!(" of the first {looked_at} of {orbits} orbits"),
        };
        if let Some(OfOrbit { orbit, collisions, time, .. }) = first_lost(&self.orbits) {
            let first = if among.is_empty() { String::new() } else { format!(", the first{among} to be lost") };
            let collisions = plural(collisions, "collision");
            return format!(
                "of orbit {orbit} last for {collisions} (t = {}){first}; what follows is one of many possible orbits",
                short(time)
            );
        }
        let worst = self.orbits.iter().reduce(|a, b| if b.error > a.error { b } else { a });
        let Some(OfOrbit { orbit, collisions, error, .. }) = worst else { return "none".into() };
        let after = format!("after {}", plural(*collisions, "collision"));
        let of = if among.is_empty() { String::new() } else { format!(" (orbit {orbit}, the worst{among})") };
        if *error > A_DIGIT {
            return format!("all but gone {after}{of}");
        }
        let error = if *error == 0.0 { "0".into() } else { format!("{error:.0e}") };
        format!("accurate to {error} of {} {after}{of}", self.unit)
    }
}

/// The orbit that is lost after the fewest collisions.
fn first_lost(orbits: &[OfOrbit]) -> Option<OfOrbit> {
    orbits.iter().filter(|orbit| orbit.lost).min_by_key(|orbit| orbit.collisions).copied()
}

/// A billiard in which nothing is hit any more once the user has interrupted the run.
struct Interruptible<'a, const N: usize, const S: usize> {
    billiard: &'a dyn Bounce<N, S>,
    interrupted: &'a AtomicBool,
}

impl<const N: usize, const S: usize> Bounce<N, S> for Interruptible<'_, N, S> {
    fn first_hit(&self, position: &[f64; N], velocity: &[f64; N]) -> WallHit<f64, N> {
        if self.interrupted.load(Ordering::Relaxed) {
            return WallHit::never(*position);
        }
        self.billiard.first_hit(position, velocity)
    }
    fn collide(&self, hit: &WallHit<f64, N>, velocity: &mut [f64; N], spin: &mut [f64; S]) {
        self.billiard.collide(hit, velocity, spin);
    }
}

/// What becomes of the numbers from 0, on so many threads, in their order, up to the first one of which nothing becomes.
fn on_threads<R: Send>(threads: usize, count: u64, what: &(dyn Fn(u64) -> Option<R> + Sync)) -> Vec<R> {
    let next = AtomicU64::new(0);
    let one = || {
        let mut done = vec![];
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            let Some(result) = (k < count).then(|| what(k)).flatten() else { return done };
            done.push((k, result));
        }
    };
    let mut done = thread::scope(|scope| {
        // if the system cannot start so many threads, fewer do the same work
        let spawn = |_| Builder::new().spawn_scoped(scope, one).ok();
        let others: Vec<_> = (1..count.min(threads as u64)).map_while(spawn).collect();
        let mut done = one();
        for other in others {
            done.extend(other.join().unwrap_or_else(|panic| resume_unwind(panic)));
        }
        done
    });
    done.sort_by_key(|(k, _)| *k);
    done.into_iter().zip(0..).take_while(|((k, _), place)| k == place).map(|((_, result), _)| result).collect()
}

/// How many collisions an orbit makes until then, run in blocks as always: where a particle slowed down by a law creeps along a wall,
/// only the engine's own bits determine which collision is the last one.
fn collisions_of<const N: usize, const S: usize, T: Trail<N, S>>(
    engine: &dyn Engine<N, S, T>,
    orbit: &mut Bare<N, S>,
    until: Until,
) -> u64 {
    let mut made = 0;
    while made < until.collisions {
        let block = Until { collisions: BLOCK.min(until.collisions - made), ..until };
        let outcome = engine.bare(orbit, block);
        made += outcome.collisions;
        if outcome.stop != Stop::Finished || outcome.collisions < block.collisions {
            break;
        }
    }
    made
}

/// A relative error of more than this leaves less than a digit.
const A_DIGIT: f64 = 0.05;

/// The largest of the finite sides of a box; infinite if there is none.
pub(crate) fn size(low: &[f64], high: &[f64]) -> f64 {
    let sides = low.iter().zip(high).map(|(low, high)| high - low).filter(|side| side.is_finite() && *side > 0.0);
    sides.reduce(f64::max).unwrap_or(f64::INFINITY)
}

/// The longest side of the cell in which paths are followed.
pub(crate) fn cell_size(cell: &FundamentalCell) -> f64 {
    cell.lattice().vectors().iter().map(Vector2::norm).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(orbits: &[(u64, f64, bool)]) -> Horizons {
        let of = |(orbit, &(collisions, error, lost)): (usize, &(u64, f64, bool))| OfOrbit {
            orbit: orbit as u64,
            collisions,
            time: 2.5,
            error,
            lost,
        };
        let orbits = orbits.iter().enumerate().map(of).collect();
        Horizons { collisions: None, time: None, orbits, unit: UNITS[0] }
    }

    #[test]
    fn what_is_said_of_digits_is_said_of_one_orbit() {
        let wedge = of(&[(7, 6e-14, false), (0, 0.0, false)]);
        assert_eq!(
            wedge.in_words(2),
            "accurate to 6e-14 of the table's size after 7 collisions (orbit 0, the worst of 2 orbits)"
        );
        assert!(wedge.in_words(5000).ends_with("(orbit 0, the worst of the first 2 of 5000 orbits)"));
        assert_eq!(of(&[(1, 0.0, false)]).in_words(1), "accurate to 0 of the table's size after 1 collision");
        assert_eq!(of(&[(40, 0.4, false)]).in_words(1), "all but gone after 40 collisions");
        let lost = of(&[(9, 0.1, false), (30, 0.1, true), (1, 0.2, true)]);
        assert_eq!(
            lost.in_words(3),
            "of orbit 2 last for 1 collision (t = 2.5), the first of 3 orbits to be lost; what follows is one of many possible orbits"
        );
        assert_eq!(
            of(&[(9, 0.1, true)]).in_words(1),
            "of orbit 0 last for 9 collisions (t = 2.5); what follows is one of many possible orbits"
        );
    }
}

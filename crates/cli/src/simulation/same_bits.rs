//! Whether orbits are the same side by side and one by one, to the last bit.

use std::sync::atomic::AtomicBool;

use billiards::{Outcome, Timed};
use serde::Serialize;

use super::engine::{Bare, Engine, Until, Watched};
use super::job::bare;
use super::start::Start;
use super::trail::Trail;
use super::{Body, Simulation};

/// Number of orbits that are compared, and of collisions of each.
const ORBITS: u64 = 40;
const COLLISIONS: u64 = 200;

/// How many orbits and collisions were the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct SameBits {
    /// Orbits.
    pub orbits: u64,
    /// How many collisions each should make.
    pub each: u64,
    /// Collisions of all of them.
    pub collisions: u64,
}

/// An orbit that ends differently side by side than alone.
#[derive(Clone, Debug, thiserror::Error)]
#[error("orbit {orbit} run side by side differs from the same orbit run alone: {side_by_side} instead of {alone}")]
pub struct OtherBits {
    orbit: u64,
    side_by_side: String,
    alone: String,
}

impl Simulation {
    /// Runs some orbits side by side and one by one, in directions of their own from the starts of the scene, and compares all
    /// bits of their last states, how they ended and after how many collisions.
    ///
    /// # Errors
    /// They differ, or there is no start.
    pub fn same_bits(&self) -> Result<SameBits, Box<dyn std::error::Error>> {
        match &self.body {
            Body::Plane(planar) => {
                let starts = planar.starts()?;
                Ok(planar.with_engine(|engine| {
                    compare(engine, &|i| starts(i % planar.orbits()), &|start| planar.launch(start), planar.orbits())
                })?)
            }
            Body::Space(spatial) => {
                let starts = spatial.starts()?;
                Ok(spatial.with_engine(|engine| {
                    compare(engine, &|i| starts(i % spatial.orbits()), &|start| spatial.launch(start), spatial.orbits())
                })?)
            }
        }
    }
}

fn compare<const N: usize, const S: usize, T: Trail<N, S>>(
    engine: &dyn Engine<N, S, T>,
    start: &dyn Fn(u64) -> Start<N, S>,
    launch: &dyn Fn(&Start<N, S>) -> Watched<N, S, T>,
    count: u64,
) -> Result<SameBits, OtherBits> {
    let orbit = |i: u64| -> Bare<N, S> {
        let mut start = start(i);
        let (sin, cos) = libm::sincos((i / count) as f64);
        let [v1, v2] = [start.velocity[0], start.velocity[1]];
        (start.velocity[0], start.velocity[1]) = (cos * v1 - sin * v2, sin * v1 + cos * v2);
        bare(&launch(&start))
    };
    let until = Until { collisions: COLLISIONS, time: f64::INFINITY };
    let mut lanes: Vec<_> = (0..ORBITS).map(orbit).collect();
    let outcomes = engine.side_by_side(&mut lanes, until, &AtomicBool::new(false));
    let mut collisions = 0;
    for ((i, lane), outcome) in (0..).zip(&lanes).zip(outcomes) {
        let mut alone = orbit(i);
        let end = engine.bare(&mut alone, until);
        if (end, bits(&alone)) != (outcome, bits(lane)) {
            let [side_by_side, alone] = [words(outcome, lane), words(end, &alone)];
            return Err(OtherBits { orbit: i, side_by_side, alone });
        }
        collisions += end.collisions;
    }
    Ok(SameBits { orbits: ORBITS, each: COLLISIONS, collisions })
}

fn numbers<const N: usize, const S: usize>(orbit: &Bare<N, S>) -> Vec<f64> {
    [&orbit.position[..], &orbit.velocity[..], &orbit.spin[..], &[orbit.track.time()]].concat()
}

fn bits<const N: usize, const S: usize>(orbit: &Bare<N, S>) -> Vec<u64> {
    numbers(orbit).into_iter().map(f64::to_bits).collect()
}

fn words<const N: usize, const S: usize>(outcome: Outcome, orbit: &Bare<N, S>) -> String {
    format!("{:?} after {} collisions with {:?}", outcome.stop, outcome.collisions, numbers(orbit))
}

//! Mean free time and mean free path.
use super::{
    Collision, Observer,
    flight::Flight,
    moments::{Mean, Moments},
};
use crate::{merge::Merge, orbit::Orbit};
use core::ops::ControlFlow;

/// Sums over the flights between collisions: their times and their lengths.
///
/// Over the canonical measure at unit speed (spin included) the mean time of a flight is `4A/P` in a planar table of area
/// `A` and perimeter `P`, and its mean length `πA/P`; for a ball in space, volume `V` and surface `S`, `15π/8 · V/S` and
/// `4V/S`: for every strict law. Along a single orbit the means are these only where the motion is ergodic.
#[derive(Clone, Copy, Debug)]
pub struct FreePath<const N: usize, const S: usize> {
    flight: Option<Flight<N, S>>,
    time: Moments,
    length: Moments,
}

impl<const N: usize, const S: usize> FreePath<N, S> {
    /// No flights yet. A flight counts if its start was seen: a collision, or where [`FreePath::follow`] was called.
    ///
    /// To run one orbit after another without an [`Ensemble`](crate::Ensemble), call `follow` or [`next_orbit`](Merge::next_orbit) for
    /// each.
    #[allow(clippy::new_without_default, reason = "one way to begin")]
    pub fn new() -> Self {
        FreePath { flight: None, time: Moments::default(), length: Moments::default() }
    }

    /// The next flight begins where this orbit is: so the first flight of an orbit that starts on the wall is counted.
    pub fn follow<K, T>(&mut self, orbit: &Orbit<f64, N, S, K, T>) {
        self.flight = Some(Flight::from(orbit));
    }

    /// Mean time between collisions \[T\]; its standard error assumes independent flights, such as one of each of many orbits.
    pub fn time(&self) -> Mean {
        self.time.mean()
    }

    /// Mean distance between collisions that the centre travels \[L\].
    pub fn length(&self) -> Mean {
        self.length.mean()
    }
}

impl<K, T, const N: usize, const S: usize> Observer<N, S, K, T> for FreePath<N, S> {
    #[inline]
    fn collision(&mut self, c: &Collision<'_, N, S, K, T>) -> ControlFlow<()> {
        if let Some(flight) = &self.flight {
            let speed = flight.velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
            self.time.add(c.hit.time);
            self.length.add(speed * c.hit.time);
        }
        self.follow(c.orbit);
        ControlFlow::Continue(())
    }
}

/// The flight of `self` that has begun goes on.
impl<const N: usize, const S: usize> Merge for FreePath<N, S> {
    fn merge(self, other: Self) -> Self {
        FreePath { flight: self.flight, time: self.time.merge(other.time), length: self.length.merge(other.length) }
    }
    fn next_orbit(&mut self) {
        self.flight = None;
    }
}

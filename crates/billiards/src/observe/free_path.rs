//! Mean free time and mean free path.
use super::{Collision, Observer, flight::Flight};
use crate::{merge::Merge, orbit::Orbit};
use core::ops::ControlFlow;
use lanes::Double;

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

/// Count, sum and sum of squares.
#[derive(Clone, Copy, Debug)]
struct Moments {
    count: u64,
    sum: Double,
    squares: Double,
}

impl Moments {
    fn add(&mut self, x: f64) {
        self.count += 1;
        self.sum.add(x);
        self.squares.add(x * x);
    }

    fn summary(&self) -> Mean {
        let n = self.count as f64;
        let mean = self.sum.value() / n;
        let variance = (self.squares.value() / n - mean * mean).max(0.0);
        Mean { count: self.count, mean, standard_error: (variance / (n - 1.0)).sqrt() }
    }
}

impl Merge for Moments {
    fn merge(mut self, other: Self) -> Self {
        self.count += other.count;
        for (sum, other) in [(&mut self.sum, other.sum), (&mut self.squares, other.squares)] {
            sum.add(other.high);
            sum.add(other.low);
        }
        self
    }
}

/// A mean over flights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mean {
    /// Of how many; without any, the mean is NaN.
    pub count: u64,
    /// The mean.
    pub mean: f64,
    /// Its standard error, where the flights are independent of one another: one flight of each of many orbits.
    pub standard_error: f64,
}

impl<const N: usize, const S: usize> FreePath<N, S> {
    /// No flights yet. A flight counts if its start was seen: the first collision, or [`FreePath::follow`].
    #[allow(clippy::new_without_default, reason = "one way to begin")]
    pub fn new() -> Self {
        let none = Moments { count: 0, sum: Double::new(0.0), squares: Double::new(0.0) };
        FreePath { flight: None, time: none, length: none }
    }

    /// The next flight begins where this orbit is. An orbit that starts on the wall has its first flight counted so.
    pub fn follow<K, T>(&mut self, orbit: &Orbit<f64, N, S, K, T>) {
        self.flight = Some(Flight::from(orbit));
    }

    /// Mean time between collisions \[T\].
    pub fn time(&self) -> Mean {
        self.time.summary()
    }

    /// Mean distance between collisions that the centre travels \[L\].
    pub fn length(&self) -> Mean {
        self.length.summary()
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
}

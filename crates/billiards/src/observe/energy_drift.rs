//! How well energy is kept.
use super::{Collision, Observer};
use crate::{merge::Merge, orbit::Orbit};
use core::ops::ControlFlow;
use lanes::{Double, two_prod};

/// The largest relative change of the energy since the start.
///
/// The energy is computed in twice the digits of an `f64`, so that the drift is that of the orbit and not of the
/// measurement. In between the collisions at which the energy is restored it is that of what these round; see
/// [`Orbit::restored`].
#[derive(Clone, Copy, Debug)]
pub struct EnergyDrift {
    /// A power of two near 1/speed: squares neither over- nor underflow.
    scale: f64,
    start: Double,
    largest: f64,
}

/// `scale² (|v|² + |w|²)`
fn square(scale: f64, velocity: &[f64], spin: &[f64]) -> Double {
    let mut sum = Double::new(0.0);
    for x in velocity.iter().chain(spin) {
        let (product, error) = two_prod(x * scale, x * scale);
        sum.add(product);
        sum.add(error);
    }
    sum
}

impl EnergyDrift {
    /// The drift of an orbit from where it is now.
    pub fn of<K, T, const N: usize, const S: usize>(orbit: &Orbit<f64, N, S, K, T>) -> Self {
        let mut drift = EnergyDrift { scale: 1.0, start: Double::new(0.0), largest: 0.0 };
        drift.follow(orbit);
        drift
    }

    /// Goes on with another orbit, from where that is now; the largest drift seen stays.
    pub fn follow<K, T, const N: usize, const S: usize>(&mut self, orbit: &Orbit<f64, N, S, K, T>) {
        let size = orbit.velocity.iter().chain(&orbit.spin).fold(0.0, |size: f64, x| size.max(x.abs()));
        self.scale = libm::ldexp(1.0, -libm::frexp(size).1);
        self.start = square(self.scale, &orbit.velocity, &orbit.spin);
    }

    /// `max |E − E₀| / E₀` over the collisions seen.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// `|E − E₀| / E₀` of an orbit as it is.
    pub fn now<K, T, const N: usize, const S: usize>(&self, orbit: &Orbit<f64, N, S, K, T>) -> f64 {
        let now = square(self.scale, &orbit.velocity, &orbit.spin);
        let change = (now.high - self.start.high) + (now.low - self.start.low);
        (change / self.start.high).abs()
    }
}

impl<K, T, const N: usize, const S: usize> Observer<N, S, K, T> for EnergyDrift {
    #[inline]
    fn collision(&mut self, c: &Collision<'_, N, S, K, T>) -> ControlFlow<()> {
        self.largest = larger(self.largest, self.now(c.orbit));
        ControlFlow::Continue(())
    }
}

/// The larger of two numbers; NaN is larger than any.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

impl Merge for EnergyDrift {
    fn merge(self, other: Self) -> Self {
        EnergyDrift { largest: larger(self.largest, other.largest), ..self }
    }
}

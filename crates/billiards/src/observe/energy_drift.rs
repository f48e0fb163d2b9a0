//! How well energy is kept.
use super::{Collision, Observer};
use crate::{energy::EnergyKeeper, merge::Merge, orbit::Orbit};
use core::ops::ControlFlow;
use lanes::{Double, two_prod};

/// The largest relative change of the energy since the start.
///
/// The energy is computed in twice the digits of an `f64`, so that the drift is that of the orbit and not of the
/// measurement. Between the collisions at which the energy is restored it includes the rounding of the collisions since; see
/// [`Orbit::restored`].
///
/// ```
/// use billiards::{Collisions, Orbit, Planar, geometry::tables, laws::Disk, observe::EnergyDrift};
/// use billiards::collision_laws::laws::Restitution;
///
/// // half of the normal velocity is lost at each of two collisions
/// let strip = Planar { table: tables::strip(1.0)?, law: Disk::new(&Restitution::new(0.5, -1.0)?, 1.0)? };
/// let mut orbit = Orbit::<f64, 2, 1>::new([0.0, 0.5], [0.0, 1.0], [0.0], ());
/// let mut drift = EnergyDrift::of(&orbit);
/// strip.run(&mut orbit, &Collisions(2), &mut drift);
/// assert_eq!(drift.largest(), 1.0 - 1.0 / 16.0);
/// # Ok::<(), billiards::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct EnergyDrift {
    /// Where the orbit began, if there is one.
    start: Option<Energy>,
    largest: f64,
}

#[derive(Clone, Copy, Debug)]
struct Energy {
    /// A power of two near 1/speed: squares neither over- nor underflow.
    scale: f64,
    /// In those units.
    square: Double,
}

impl Energy {
    fn of<K, T, const N: usize, const S: usize>(orbit: &Orbit<f64, N, S, K, T>) -> Self {
        let size = orbit.velocity.iter().chain(&orbit.spin).fold(0.0, |size: f64, x| size.max(x.abs()));
        let scale = libm::ldexp(1.0, -libm::frexp(size).1);
        Energy { scale, square: square(scale, &orbit.velocity, &orbit.spin) }
    }

    /// Its relative difference from the energy of a state.
    fn change(&self, velocity: &[f64], spin: &[f64]) -> f64 {
        let now = square(self.scale, velocity, spin);
        let change = (now.high - self.square.high) + (now.low - self.square.low);
        (change / self.square.high).abs()
    }
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
    /// No orbit yet. An orbit that it was not told to [follow](Self::follow) is followed from its first collision.
    ///
    /// To run one orbit after another without an [`Ensemble`](crate::Ensemble), call `follow` or [`next_orbit`](Merge::next_orbit) for
    /// each.
    #[allow(clippy::new_without_default, reason = "one way to begin")]
    pub fn new() -> Self {
        EnergyDrift { start: None, largest: 0.0 }
    }

    /// The drift of an orbit from where it is now.
    pub fn of<K, T, const N: usize, const S: usize>(orbit: &Orbit<f64, N, S, K, T>) -> Self {
        EnergyDrift { start: Some(Energy::of(orbit)), largest: 0.0 }
    }

    /// Goes on with another orbit, from where that is now; the largest drift seen stays.
    pub fn follow<K, T, const N: usize, const S: usize>(&mut self, orbit: &Orbit<f64, N, S, K, T>) {
        self.start = Some(Energy::of(orbit));
    }

    /// `max |E − E₀| / E₀` over the collisions seen.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// `|E − E₀| / E₀` of an orbit as it is; 0 before any orbit has begun.
    pub fn now<K, T, const N: usize, const S: usize>(&self, orbit: &Orbit<f64, N, S, K, T>) -> f64 {
        self.start.map_or(0.0, |start| start.change(&orbit.velocity, &orbit.spin))
    }

    /// Looks at the orbit that it follows, with its energy [restored](Orbit::restored).
    pub fn see_restored<K: EnergyKeeper<f64, N, S>, T, const N: usize, const S: usize>(
        &mut self,
        orbit: &Orbit<f64, N, S, K, T>,
    ) {
        let (velocity, spin) = orbit.restored();
        let start = self.start.get_or_insert_with(|| Energy::of(orbit));
        self.largest = larger(self.largest, start.change(&velocity, &spin));
    }
}

impl<K, T, const N: usize, const S: usize> Observer<N, S, K, T> for EnergyDrift {
    #[inline]
    fn collision(&mut self, c: &Collision<'_, N, S, K, T>) -> ControlFlow<()> {
        let start = self.start.get_or_insert_with(|| Energy::of(c.orbit));
        self.largest = larger(self.largest, start.change(&c.orbit.velocity, &c.orbit.spin));
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
    fn next_orbit(&mut self) {
        self.start = None;
    }
}

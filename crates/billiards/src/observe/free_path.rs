//! Mean free time and mean free path.
use super::{
    Collision, Observer,
    flight::Flight,
    moments::{Mean, Moments},
};
use crate::{merge::Merge, orbit::Orbit};
use core::{f64::consts::PI, ops::ControlFlow};

/// Mean time of a flight over the canonical measure at unit speed, for every strict law: `|Sᵈ⁻¹|/|Bᵈ⁻¹| · V/S` in a table of volume
/// `V` and surface `S`, where velocities have `d` dimensions.
///
/// `ratio` is `V/S` \[L\]. In the plane it is area over perimeter, and the factor `π` for a point (d = 2) and `4` for a disk with spin
/// (d = 3); in space `4` for a point (d = 3) and `15π/8` for a ball with spin (d = 6). Velocities of one dimension bounce between two
/// ends: `2`; of none they do not, and the time is infinite.
///
/// ```
/// use billiards::observe::mean_free_time;
/// use core::f64::consts::PI;
/// // a disk in the unit square, a ball in the unit cube
/// assert_eq!([mean_free_time(3, 1.0 / 4.0), mean_free_time(6, 1.0 / 6.0)], [1.0, 1.875 * PI / 6.0]);
/// ```
pub fn mean_free_time(dimension: usize, ratio: f64) -> f64 {
    if dimension == 0 {
        return f64::INFINITY;
    }
    // the factor c(d) has c(1) = 2, c(2) = π and c(d + 2) = c(d) (d + 1)/d
    let first = 2 - dimension % 2;
    let steps = (first..dimension).step_by(2).map(|d| (d + 1) as f64 / d as f64);
    steps.product::<f64>() * if first == 1 { 2.0 } else { PI } * ratio
}

/// Sums over the flights between collisions: their times and their lengths.
///
/// Over the canonical measure at unit speed (spin included) the mean time of a flight is [`mean_free_time`] for all dimensions of the
/// velocity and spin, and its mean length that for the dimensions of the velocity alone: for every strict law. Along a single orbit the
/// means are these only where the motion is ergodic.
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

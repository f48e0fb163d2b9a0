//! How long an orbit runs.
use crate::track::{Timed, Timing, Tracking};
use lanes::Lane;

/// How long an orbit runs: a number of [`Collisions`], a [`Time`], or a pair of limits.
pub trait Limit<T> {
    /// Whether collision number `n` (from 1), `flight` after the last one, is beyond the limit.
    fn is_beyond(&self, n: u64, track: &T, flight: f64) -> bool;
}

/// A limit of many orbits [side by side](crate::run_side_by_side). Each ends as [`Limit::is_beyond`] says, in the same state as alone;
/// the methods here tell when to ask for that.
pub trait LaneLimit<const N: usize, const S: usize, T: Tracking<N, S>>: Limit<T> {
    /// The number of collisions that no orbit exceeds.
    fn most(&self) -> u64;
    /// In which lanes a flight may be beyond the limit, among those within `most` collisions; `None` if none ever is.
    #[inline(always)]
    fn may_be_beyond<F: Lane>(&self, _track: &T::In<F>, _flight: F) -> Option<F::Mask> {
        None
    }
}

/// A number of collisions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collisions(pub u64);

/// A time \[T\] since the start, as a [`Clock`](crate::Clock) tracks it. The run ends at the last collision up to that time;
/// [`position_at`](crate::Orbit::position_at) tells the rest of the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time(pub f64);

impl<T> Limit<T> for Collisions {
    #[inline(always)]
    fn is_beyond(&self, n: u64, _: &T, _: f64) -> bool {
        n > self.0
    }
}

impl<const N: usize, const S: usize, T: Tracking<N, S>> LaneLimit<N, S, T> for Collisions {
    fn most(&self) -> u64 {
        self.0
    }
}

impl<T: Timed> Limit<T> for Time {
    #[inline(always)]
    fn is_beyond(&self, _: u64, track: &T, flight: f64) -> bool {
        // NaN ends it at once
        !(track.time() + flight <= self.0)
    }
}

impl<const N: usize, const S: usize, T: Timing<N, S>> LaneLimit<N, S, T> for Time {
    fn most(&self) -> u64 {
        u64::MAX
    }
    #[inline(always)]
    fn may_be_beyond<F: Lane>(&self, track: &T::In<F>, flight: F) -> Option<F::Mask> {
        Some(!(T::time_in(track) + flight).lt(flight.same(self.0.next_up())))
    }
}

/// Both: whichever comes first.
impl<T, A: Limit<T>, B: Limit<T>> Limit<T> for (A, B) {
    #[inline(always)]
    fn is_beyond(&self, n: u64, track: &T, flight: f64) -> bool {
        self.0.is_beyond(n, track, flight) || self.1.is_beyond(n, track, flight)
    }
}

impl<const N: usize, const S: usize, T: Tracking<N, S>, A, B> LaneLimit<N, S, T> for (A, B)
where
    A: LaneLimit<N, S, T>,
    B: LaneLimit<N, S, T>,
{
    fn most(&self) -> u64 {
        self.0.most().min(self.1.most())
    }
    #[inline(always)]
    fn may_be_beyond<F: Lane>(&self, track: &T::In<F>, flight: F) -> Option<F::Mask> {
        match (self.0.may_be_beyond(track, flight), self.1.may_be_beyond(track, flight)) {
            (Some(a), Some(b)) => Some(a | b),
            (a, b) => a.or(b),
        }
    }
}

//! How long an orbit runs.
use crate::track::{Timed, Timing, Tracking};
use lanes::Lane;

/// How long an orbit runs: a number of [`Collisions`], a [`Time`], or a pair of limits.
///
/// ```
/// use billiards::{Angle, Limit, Orbit, Planar, Stop, Turned, geometry::tables, laws::Specular};
///
/// /// Up to the first collision by which the disk has turned so far, `|x₀|` [L].
/// struct Turn(f64);
/// impl<T: Turned> Limit<T> for Turn {
///     fn is_beyond(&self, _: u64, track: &T, _: f64) -> bool {
///         track.angle().abs() >= self.0
///     }
/// }
/// let strip = Planar { table: tables::strip(1.0)?, law: Specular };
/// let mut orbit = Orbit::<_, 2, 1, (), _>::new([0.0, 0.5], [0.25, 1.0], [2.0], Angle::new(0.0));
/// let outcome = strip.run(&mut orbit, &Turn(4.0), &mut ());
/// // 1 in half a flight, then 2 in each
/// assert_eq!((outcome.stop, outcome.collisions, orbit.track.angle()), (Stop::Finished, 3, 5.0));
/// # Ok::<(), billiards::Error>(())
/// ```
pub trait Limit<T> {
    /// Whether collision number `n` (from 1), `flight` \[T\] after the last one, is beyond the limit: then the orbit stays at the last one,
    /// where `track` is, and has [finished](crate::Stop::Finished).
    ///
    /// For an orbit that hits nothing any more `flight` is infinite: whoever answers no lets it [escape](crate::Stop::Escaped).
    fn is_beyond(&self, n: u64, track: &T, flight: f64) -> bool;
}

/// A limit of many orbits [side by side](crate::run_side_by_side). Each ends as [`Limit::is_beyond`] says, in the same state as alone;
/// the methods here tell when to ask for that.
///
/// ```
/// use billiards::{Billiard, Collisions, LaneLimit, Limit, Orbit, Tracking, run, run_side_by_side};
/// use billiards::{geometry::walls::Cuboid, lanes::Lane, laws::Specular};
///
/// /// Up to the first flight that would take longer than this [T].
/// struct Before(f64);
/// impl<T> Limit<T> for Before {
///     fn is_beyond(&self, _: u64, _: &T, flight: f64) -> bool {
///         flight > self.0
///     }
/// }
/// impl<const N: usize, const S: usize, T: Tracking<N, S>> LaneLimit<N, S, T> for Before {
///     fn most(&self) -> u64 {
///         u64::MAX
///     }
///     fn may_be_beyond<F: Lane>(&self, _: &T::In<F>, flight: F) -> Option<F::Mask> {
///         Some(flight.same(self.0).lt(flight))
///     }
/// }
/// let rectangle = Cuboid::new([0.0, 0.0], [2.0, 1.0], [[3, 1], [0, 2]])?;
/// let billiard = Billiard { walls: &rectangle, law: &Specular };
/// let start = |i: u64| Orbit::<f64, 2, 0>::new([1.0, 0.5], [1.0, 0.013 * i as f64], [], ());
/// let limit = (Collisions(1000), Before(1.75));
/// let mut collisions = vec![];
/// run_side_by_side(&billiard, &mut (0..100).map(start), &limit, &mut (), &mut |finished| {
///     let alone = run(&billiard, &mut start(finished.index), &limit, &mut ());
///     assert_eq!(finished.outcome, alone);
///     collisions.push(alone.collisions);
/// });
/// assert!([1, 1000].iter().all(|n| collisions.contains(n))); // nearly level at first, or steep
/// # Ok::<(), billiards::Error>(())
/// ```
pub trait LaneLimit<const N: usize, const S: usize, T: Tracking<N, S>>: Limit<T> {
    /// The number of collisions that no orbit exceeds; `u64::MAX` if there is none.
    fn most(&self) -> u64;
    /// In which lanes a `flight` \[T\] may be beyond the limit, among those within `most` collisions: all in which it is, and perhaps
    /// others. `None` if none ever is.
    #[inline(always)]
    fn may_be_beyond<F: Lane>(&self, _track: &T::In<F>, _flight: F) -> Option<F::Mask> {
        None
    }
    /// Whether the run is called off, from now on: then orbits under way end where they are, as
    /// [`Stop::Observer`](crate::Stop::Observer), and no others begin. Asked before each step of all lanes.
    #[inline(always)]
    fn is_called_off(&self) -> bool {
        false
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
        !(track.time_after(flight) <= self.0)
    }
}

impl<const N: usize, const S: usize, T: Timing<N, S>> LaneLimit<N, S, T> for Time {
    fn most(&self) -> u64 {
        u64::MAX
    }
    #[inline(always)]
    fn may_be_beyond<F: Lane>(&self, track: &T::In<F>, flight: F) -> Option<F::Mask> {
        // rounding of the sum moves it by less than two units
        Some(!(T::time_in(track) + flight).lt(flight.same(self.0.next_down().next_down())))
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
    #[inline(always)]
    fn is_called_off(&self) -> bool {
        self.0.is_called_off() || self.1.is_called_off()
    }
}

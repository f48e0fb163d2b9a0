//! The engine's loop for the command line: two compiled copies per kind of walls, bare and watched, for all
//! scenes.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use billiards::observe::LaneObserver;
use billiards::{
    Bounce, Clock, Collision, Collisions, Conserved, EnergyKeeper, LaneLimit, Limit, Motion, Observer, Orbit, Outcome,
    Stop, Time, Timed, Tracking, WithMotion, run, run_side_by_side,
};

use super::event::Event;
use super::frame::Frame;
use super::portraits::{Point, Portraits};
use super::scale::Scale;
use super::trail::{PlanarTrail, Trail};

/// A limit of collisions and of time, whichever is reached first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Until {
    pub(crate) collisions: u64,
    pub(crate) time: f64,
}

impl<T: Timed> Limit<T> for Until {
    #[inline(always)]
    fn is_beyond(&self, n: u64, track: &T, flight: f64) -> bool {
        (Collisions(self.collisions), Time(self.time)).is_beyond(n, track, flight)
    }
}

/// Calls off orbits side by side once it is true.
struct CalledOff<'a>(&'a AtomicBool);

impl<T> Limit<T> for CalledOff<'_> {
    #[inline(always)]
    fn is_beyond(&self, _: u64, _: &T, _: f64) -> bool {
        false
    }
}

impl<const N: usize, const S: usize, T: Tracking<N, S>> LaneLimit<N, S, T> for CalledOff<'_> {
    fn most(&self) -> u64 {
        u64::MAX
    }
    #[inline(always)]
    fn is_called_off(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// An orbit for which only the time is tracked.
pub(crate) type Bare<const N: usize, const S: usize> = Orbit<f64, N, S, Conserved<f64, N>, Clock>;
/// An orbit that is watched.
pub(crate) type Watched<const N: usize, const S: usize, T> = Orbit<f64, N, S, Conserved<f64, N>, (Clock, T)>;

/// The energy correction for an orbit that starts like this, if its law conserves the energy.
pub(crate) fn conserved<const N: usize, const S: usize>(
    strict: bool,
    velocity: &[f64; N],
    spin: &[f64; S],
) -> Conserved<f64, N> {
    <Conserved<f64, N> as EnergyKeeper<f64, N, S>>::new(velocity, spin).only_if(strict)
}

/// Sees every collision of a watched orbit.
#[derive(Debug)]
pub(crate) struct Watch<'a, P> {
    /// Where collisions are stored, if they are wanted.
    pub(crate) events: Option<&'a mut Vec<Event>>,
    /// The portraits that count them, if wanted, and the scale factor of the orbit for these.
    pub(crate) portraits: Option<(&'a mut P, f64)>,
    /// Where their points are stored instead, as long as they are few.
    pub(crate) points: Option<&'a mut Vec<Point>>,
    /// Number of the orbit.
    pub(crate) orbit: u64,
    /// Collisions before this run.
    pub(crate) before: u64,
    pub(crate) scale: Scale,
    /// The user's numbers of the pieces of the table.
    pub(crate) pieces: &'a [u64],
    /// The map from the engine's coordinates to the user's.
    pub(crate) frame: Frame<'a>,
    /// Ends the orbit at the next collision once it is true.
    pub(crate) called_off: &'a AtomicBool,
}

impl<const N: usize, const S: usize, T: Trail<N, S>> Observer<N, S, Conserved<f64, N>, (Clock, T)>
    for Watch<'_, T::Portraits>
{
    #[inline(always)]
    fn collision(&mut self, collision: &Collision<'_, N, S, Conserved<f64, N>, (Clock, T)>) -> ControlFlow<()> {
        if self.events.is_some() {
            let event = self.event(collision);
            self.events.iter_mut().for_each(|events| events.push(event));
        }
        if let Some((portraits, unit)) = &mut self.portraits {
            let Collision { hit, orbit, .. } = collision;
            let point = portraits.point(self.orbit, *unit, hit, &orbit.velocity, &orbit.spin);
            match &mut self.points {
                Some(points) => points.push(point),
                None => portraits.count(&point),
            }
        }
        if self.called_off.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

impl<P> Watch<'_, P> {
    fn event<const N: usize, const S: usize, K: EnergyKeeper<f64, N, S>, T: Trail<N, S>>(
        &self,
        collision: &Collision<'_, N, S, K, (Clock, T)>,
    ) -> Event {
        let Collision { n, orbit, .. } = collision;
        let (clock, trail) = &orbit.track;
        let (velocity, spin) = orbit.restored();
        let (place, cell) = self.frame.place(&orbit.position, trail.cell());
        let mut event = Event {
            orbit: self.orbit,
            n: self.before + n,
            time: self.scale.time_out(clock.time()),
            piece: self.pieces.get(collision.piece()).copied().unwrap_or(collision.piece() as u64),
            angle: self.scale.length_out(trail.angle()),
            cell,
            ..Event::default()
        };
        for i in 0..N {
            event.position[i] = self.scale.length_out(place[i]);
            event.velocity[i] = self.scale.speed_out(velocity[i]);
        }
        for i in 0..S {
            event.spin[i] = self.scale.speed_out(spin[i]);
        }
        event
    }
}

/// A table's walls and a law, ready to run orbits.
pub(crate) trait Engine<const N: usize, const S: usize, T: Trail<N, S>>: Bounce<N, S> {
    /// Runs an orbit without watching it.
    fn bare(&self, orbit: &mut Bare<N, S>, until: Until) -> Outcome;
    /// Runs orbits without watching them, in the lanes of vector registers: bit for bit the same
    /// collisions. Once the run is called off, orbits end where they are, as [`Stop::Observer`].
    fn side_by_side(&self, orbits: &mut [Bare<N, S>], until: Until, called_off: &AtomicBool) -> Vec<Outcome>;
    /// The same, counting every collision.
    fn counted(
        &self,
        orbits: &mut [Bare<N, S>],
        until: Until,
        called_off: &AtomicBool,
        portraits: &mut T::Portraits,
    ) -> Vec<Outcome>;
    /// Runs a watched orbit: bit for bit the same collisions. Once it is called off, it ends as [`Stop::Observer`].
    fn watched(&self, orbit: &mut Watched<N, S, T>, until: Until, watch: &mut Watch<'_, T::Portraits>) -> Outcome;
}

/// Runs orbits side by side, seen by an observer. Without a time limit the time is not checked.
fn side_by_side<B, O, const N: usize, const S: usize>(
    billiard: &B,
    orbits: &mut [Bare<N, S>],
    until: Until,
    called_off: &AtomicBool,
    observer: &mut O,
) -> Vec<Outcome>
where
    B: Motion<N, S>,
    O: LaneObserver<N, S, Conserved<f64, N>, Clock>,
{
    let Until { collisions, time } = until;
    if time < f64::INFINITY {
        up_to(billiard, orbits, &((Collisions(collisions), Time(time)), CalledOff(called_off)), observer)
    } else {
        up_to(billiard, orbits, &(Collisions(collisions), CalledOff(called_off)), observer)
    }
}

/// The same up to a limit.
fn up_to<B, O, const N: usize, const S: usize>(
    billiard: &B,
    orbits: &mut [Bare<N, S>],
    limit: &impl LaneLimit<N, S, Clock>,
    observer: &mut O,
) -> Vec<Outcome>
where
    B: Motion<N, S>,
    O: LaneObserver<N, S, Conserved<f64, N>, Clock>,
{
    // those that have not begun when the run is called off keep this
    let mut outcomes = vec![Outcome { stop: Stop::Observer, collisions: 0 }; orbits.len()];
    let starts = orbits.to_vec();
    run_side_by_side(billiard, &mut starts.into_iter(), limit, observer, &mut |finished| {
        #[allow(clippy::cast_possible_truncation, reason = "an index of this slice")]
        let index = finished.index as usize;
        (orbits[index], outcomes[index]) = (finished.orbit, finished.outcome);
    });
    outcomes
}

/// A computation with an engine on walls of any type: behind a pointer it is compiled only once.
pub(crate) struct WithEngine<A>(pub(crate) A);

impl<R, A: FnOnce(&dyn Engine<2, 1, PlanarTrail>) -> R> WithMotion<2, 1> for WithEngine<A> {
    type Output = R;
    fn run<B: Motion<2, 1> + Bounce<2, 1>>(self, motion: &B) -> R {
        (self.0)(motion)
    }
}

impl<R, A: FnOnce(&dyn Engine<3, 3, ()>) -> R> WithMotion<3, 3> for WithEngine<A> {
    type Output = R;
    fn run<B: Motion<3, 3> + Bounce<3, 3>>(self, motion: &B) -> R {
        (self.0)(motion)
    }
}

impl<B, const N: usize, const S: usize, T> Engine<N, S, T> for B
where
    B: Motion<N, S> + Bounce<N, S>,
    T: Trail<N, S>,
{
    fn bare(&self, orbit: &mut Bare<N, S>, until: Until) -> Outcome {
        run(self, orbit, &until, &mut ())
    }
    fn side_by_side(&self, orbits: &mut [Bare<N, S>], until: Until, called_off: &AtomicBool) -> Vec<Outcome> {
        side_by_side(self, orbits, until, called_off, &mut ())
    }
    fn counted(
        &self,
        orbits: &mut [Bare<N, S>],
        until: Until,
        called_off: &AtomicBool,
        portraits: &mut T::Portraits,
    ) -> Vec<Outcome> {
        side_by_side(self, orbits, until, called_off, portraits)
    }
    fn watched(&self, orbit: &mut Watched<N, S, T>, until: Until, watch: &mut Watch<'_, T::Portraits>) -> Outcome {
        run(self, orbit, &until, watch)
    }
}

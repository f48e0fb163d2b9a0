//! The engine's loop for the command line: two copies of it per kind of walls, bare and watched, for all scenes.

use std::ops::ControlFlow;

use billiards::geometry::WallHit;
use billiards::observe::LaneObserver;
use billiards::{
    Angle, Bounce, Cell, Clock, Collision, Conserved, EnergyKeeper, InLanes, Keeping, Limit, Merge, Motion, Observer,
    Orbit, Outcome, Recurring, Stop, Timed, Track, run, run_side_by_side,
};
use lanes::{Double, Lane};

use super::event::Event;
use super::portraits::{PlanarPortraits, Point};
use super::scale::Scale;

/// Keeps the energy where the law does, in lanes of `F`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Keeper<const N: usize, F = f64> {
    conserved: Conserved<F, N>,
    strict: bool,
}

impl<const N: usize> Keeper<N> {
    /// For an orbit that starts like this, under a law that is `strict` or not.
    pub(crate) fn for_law<const S: usize>(strict: bool, velocity: &[f64; N], spin: &[f64; S]) -> Self {
        Keeper { strict, ..EnergyKeeper::<f64, N, S>::new(velocity, spin) }
    }
}

impl<F: Lane, const N: usize, const S: usize> EnergyKeeper<F, N, S> for Keeper<N, F> {
    #[inline(always)]
    fn new(velocity: &[F; N], spin: &[F; S]) -> Self {
        Keeper { conserved: EnergyKeeper::<F, N, S>::new(velocity, spin), strict: true }
    }
    #[inline(always)]
    fn leave(&mut self, velocity: &mut [F; N], spin: &[F; S], hit: &WallHit<F, N>, beat: u32) {
        if self.strict {
            self.conserved.leave(velocity, spin, hit, beat);
        }
    }
    #[inline(always)]
    fn straighten(&mut self, velocity: &mut [F; N], arrival: F, hit: &WallHit<F, N>) {
        if self.strict {
            EnergyKeeper::<F, N, S>::straighten(&mut self.conserved, velocity, arrival, hit);
        }
    }
    #[inline(always)]
    fn leave_in_frame(&mut self, velocity: &mut [F; N], spin: &mut [F; S], beat: u32) {
        if self.strict {
            self.conserved.leave_in_frame(velocity, spin, beat);
        }
    }
    fn square(&self, lane: usize) -> Option<Double> {
        if self.strict { EnergyKeeper::<F, N, S>::square(&self.conserved, lane) } else { None }
    }
    #[inline(always)]
    fn pass(&mut self, beat: u32) {
        if self.strict {
            EnergyKeeper::<F, N, S>::pass(&mut self.conserved, beat);
        }
    }
    fn recurring(&mut self) -> Option<&mut Recurring<F>> {
        if self.strict { EnergyKeeper::<F, N, S>::recurring(&mut self.conserved) } else { None }
    }
}

impl<F: Lane, const N: usize> InLanes<F> for Keeper<N, F> {
    type One = Keeper<N>;
    fn one(&self, lane: usize) -> Keeper<N> {
        Keeper { conserved: self.conserved.one(lane), strict: self.strict }
    }
    fn all(one: &Keeper<N>, zero: F) -> Self {
        Keeper { conserved: Conserved::all(&one.conserved, zero), strict: one.strict }
    }
    fn put(&mut self, lane: usize, one: &Keeper<N>) {
        self.conserved.put(lane, &one.conserved);
    }
    fn wait(&self, one: &Keeper<N>, beat: u32) -> u64 {
        self.conserved.wait(&one.conserved, beat)
    }
}

impl<const N: usize, const S: usize> Keeping<N, S> for Keeper<N> {
    type In<F: Lane> = Keeper<N, F>;
}

/// So many collisions or so much time, whichever comes first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Until {
    pub(crate) collisions: u64,
    pub(crate) time: f64,
}

impl<T: Timed<f64>> Limit<T> for Until {
    #[inline(always)]
    fn is_beyond(&self, n: u64, track: &T, flight: f64) -> bool {
        n > self.collisions || track.time() + flight > self.time
    }
}

/// What a watched orbit tracks besides the time: in the plane x0 and the lattice cell, in space nothing.
pub(crate) trait Trail<const N: usize, const S: usize>: Track<f64, N, S> + Clone + Send {
    /// The portraits that there are of such orbits.
    type Portraits: Portraits<N, S>;
    /// The spin position x0.
    fn angle(&self) -> f64;
    /// The accumulated translation.
    fn cell(&self) -> [f64; 2];
}

/// The trail of a disk in the plane.
#[derive(Clone, Debug)]
pub(crate) struct PlanarTrail {
    pub(crate) angle: Angle,
    pub(crate) cell: Option<Cell>,
}

impl Track<f64, 2, 1> for PlanarTrail {
    #[inline(always)]
    fn fly(&mut self, from: &[f64; 2], velocity: &[f64; 2], spin: &[f64; 1], hit: &WallHit<f64, 2>) {
        self.angle.fly(from, velocity, spin, hit);
        if let Some(cell) = &mut self.cell {
            cell.fly(from, velocity, spin, hit);
        }
    }
}

impl Trail<2, 1> for PlanarTrail {
    type Portraits = PlanarPortraits;
    fn angle(&self) -> f64 {
        self.angle.0.value()
    }
    fn cell(&self) -> [f64; 2] {
        self.cell.as_ref().map_or([0.0; 2], |cell| cell.cell)
    }
}

impl Trail<3, 3> for () {
    type Portraits = ();
    fn angle(&self) -> f64 {
        0.0
    }
    fn cell(&self) -> [f64; 2] {
        [0.0; 2]
    }
}

/// An orbit of which only the time is tracked.
pub(crate) type Bare<const N: usize, const S: usize> = Orbit<f64, N, S, Keeper<N>, Clock>;
/// An orbit that is watched.
pub(crate) type Watched<const N: usize, const S: usize, T> = Orbit<f64, N, S, Keeper<N>, (Clock, T)>;

/// Counts collisions for density portraits.
pub(crate) trait Portraits<const N: usize, const S: usize>:
    LaneObserver<N, S, Keeper<N>, Clock> + Merge + Send
{
    /// By what an orbit is scaled that goes on like this.
    fn unit(&self, velocity: &[f64; N], spin: &[f64; S]) -> f64;
    /// A collision of an orbit with this unit.
    fn point(&self, orbit: u64, unit: f64, hit: &WallHit<f64, N>, velocity: &[f64; N], spin: &[f64; S]) -> Point;
    /// Counts a collision.
    fn count(&mut self, point: &Point);
    /// These orbits are about to run side by side.
    fn side_by_side(&mut self, orbits: impl Iterator<Item = u64>);
}

/// There are none in space.
impl<const N: usize, const S: usize> Portraits<N, S> for () {
    fn unit(&self, _: &[f64; N], _: &[f64; S]) -> f64 {
        1.0
    }
    fn point(&self, orbit: u64, _: f64, _: &WallHit<f64, N>, _: &[f64; N], _: &[f64; S]) -> Point {
        Point { orbit, velocity: [0.0; 2], reduced: [0.0; 2] }
    }
    fn count(&mut self, _: &Point) {}
    fn side_by_side(&mut self, _: impl Iterator<Item = u64>) {}
}

/// Sees every collision of a watched orbit.
#[derive(Debug)]
pub(crate) struct Watch<'a, P> {
    /// Where collisions go, if they are wanted.
    pub(crate) events: Option<&'a mut Vec<Event>>,
    /// What counts them, if that is wanted, and by what the orbit is scaled for it.
    pub(crate) portraits: Option<(&'a mut P, f64)>,
    /// Where their points go instead, as long as they are few.
    pub(crate) points: Option<&'a mut Vec<Point>>,
    /// Number of the orbit.
    pub(crate) orbit: u64,
    /// Collisions before this run.
    pub(crate) before: u64,
    pub(crate) scale: Scale,
    /// The number that a piece of the table has for the user.
    pub(crate) pieces: &'a [u64],
    /// Where the engine's origin lies.
    pub(crate) shift: [f64; 3],
}

impl<const N: usize, const S: usize, T: Trail<N, S>> Observer<N, S, Keeper<N>, (Clock, T)> for Watch<'_, T::Portraits> {
    #[inline(always)]
    fn collision(&mut self, collision: &Collision<'_, N, S, Keeper<N>, (Clock, T)>) -> ControlFlow<()> {
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
        ControlFlow::Continue(())
    }
}

impl<P> Watch<'_, P> {
    fn event<const N: usize, const S: usize, K, T: Trail<N, S>>(
        &self,
        collision: &Collision<'_, N, S, K, (Clock, T)>,
    ) -> Event {
        let Collision { n, hit, orbit } = collision;
        let (clock, trail) = &orbit.track;
        let mut event = Event {
            orbit: self.orbit,
            n: self.before + n,
            time: self.scale.time_out(clock.time()),
            piece: self.pieces.get(collision.piece()).copied().unwrap_or(collision.piece() as u64),
            own_piece: collision.piece(),
            angle: self.scale.length_out(trail.angle()),
            cell: trail.cell(),
            ..Event::default()
        };
        let normal = hit.unit_normal();
        for i in 0..N {
            event.position[i] = self.scale.length_out(orbit.position[i] + self.shift[i]);
            event.velocity[i] = self.scale.speed_out(orbit.velocity[i]);
            event.normal[i] = normal[i];
        }
        for i in 0..S {
            event.spin[i] = self.scale.speed_out(orbit.spin[i]);
        }
        event
    }
}

/// A table's walls and a law, ready to run orbits.
pub(crate) trait Engine<const N: usize, const S: usize, T: Trail<N, S>>: Bounce<N, S> {
    /// Runs an orbit that nobody watches.
    fn bare(&self, orbit: &mut Bare<N, S>, until: Until) -> Outcome;
    /// Runs orbits that nobody watches, in the lanes of vector registers: the same collisions, bit by bit.
    fn side_by_side(&self, orbits: &mut [Bare<N, S>], collisions: u64) -> Vec<Outcome>;
    /// The same, counting every collision.
    fn counted(&self, orbits: &mut [Bare<N, S>], collisions: u64, portraits: &mut T::Portraits) -> Vec<Outcome>;
    /// Runs an orbit that somebody watches: the same collisions, bit by bit.
    fn watched(&self, orbit: &mut Watched<N, S, T>, until: Until, watch: &mut Watch<'_, T::Portraits>) -> Outcome;
}

/// Runs orbits side by side, seen by an observer.
fn side_by_side<B, O, const N: usize, const S: usize>(
    billiard: &B,
    orbits: &mut [Bare<N, S>],
    collisions: u64,
    observer: &mut O,
) -> Vec<Outcome>
where
    B: Motion<N, S>,
    O: LaneObserver<N, S, Keeper<N>, Clock>,
{
    let mut outcomes = vec![Outcome { stop: Stop::Finished, collisions: 0 }; orbits.len()];
    let starts = orbits.to_vec();
    run_side_by_side(billiard, &mut starts.into_iter(), collisions, observer, &mut |finished| {
        #[allow(clippy::cast_possible_truncation, reason = "an index of this slice")]
        let index = finished.index as usize;
        (orbits[index], outcomes[index]) = (finished.orbit, finished.outcome);
    });
    outcomes
}

impl<B, const N: usize, const S: usize, T> Engine<N, S, T> for B
where
    B: Motion<N, S> + Bounce<N, S>,
    T: Trail<N, S>,
{
    fn bare(&self, orbit: &mut Bare<N, S>, until: Until) -> Outcome {
        run(self, orbit, &until, &mut ())
    }
    fn side_by_side(&self, orbits: &mut [Bare<N, S>], collisions: u64) -> Vec<Outcome> {
        side_by_side(self, orbits, collisions, &mut ())
    }
    fn counted(&self, orbits: &mut [Bare<N, S>], collisions: u64, portraits: &mut T::Portraits) -> Vec<Outcome> {
        side_by_side(self, orbits, collisions, portraits)
    }
    fn watched(&self, orbit: &mut Watched<N, S, T>, until: Until, watch: &mut Watch<'_, T::Portraits>) -> Outcome {
        run(self, orbit, &until, watch)
    }
}

//! The engine's loop for the command line: two copies of it per kind of walls, bare and watched, for all scenes.

use std::ops::ControlFlow;

use billiards::geometry::WallHit;
use billiards::{
    Angle, Bounce, Cell, Clock, Collision, Conserved, EnergyKeeper, InLanes, Keeping, Limit, Motion, Observer, Orbit,
    Outcome, Stop, Timed, Track, run, run_side_by_side,
};
use lanes::Lane;

use super::event::Event;
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
    fn leave_in_frame(&mut self, velocity: &mut [F; N], spin: &mut [F; S], beat: u32) {
        if self.strict {
            self.conserved.leave_in_frame(velocity, spin, beat);
        }
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
    fn replace(&mut self, mask: F::Mask, by: &Self) {
        self.conserved.replace(mask, &by.conserved);
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
    fn angle(&self) -> f64 {
        self.angle.0.value()
    }
    fn cell(&self) -> [f64; 2] {
        self.cell.as_ref().map_or([0.0; 2], |cell| cell.cell)
    }
}

impl Trail<3, 3> for () {
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

/// Sees every collision of a watched orbit.
#[derive(Debug)]
pub(crate) struct Watch<'a> {
    pub(crate) events: Vec<Event>,
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

impl<const N: usize, const S: usize, K, T: Trail<N, S>> Observer<N, S, K, (Clock, T)> for Watch<'_> {
    #[inline(always)]
    fn collision(&mut self, collision: &Collision<'_, N, S, K, (Clock, T)>) -> ControlFlow<()> {
        self.events.push(self.event(collision));
        ControlFlow::Continue(())
    }
}

impl Watch<'_> {
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
pub(crate) trait Engine<const N: usize, const S: usize, T>: Bounce<N, S> {
    /// Runs an orbit that nobody watches.
    fn bare(&self, orbit: &mut Bare<N, S>, until: Until) -> Outcome;
    /// Runs orbits that nobody watches, in the lanes of vector registers: the same collisions, bit by bit.
    fn side_by_side(&self, orbits: &mut [Bare<N, S>], collisions: u64) -> Vec<Outcome>;
    /// Runs an orbit that somebody watches: the same collisions, bit by bit.
    fn watched(&self, orbit: &mut Watched<N, S, T>, until: Until, watch: &mut Watch<'_>) -> Outcome;
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
        let mut outcomes = vec![Outcome { stop: Stop::Finished, collisions: 0 }; orbits.len()];
        let starts = orbits.to_vec();
        run_side_by_side(self, &mut starts.into_iter(), collisions, &mut |finished| {
            #[allow(clippy::cast_possible_truncation, reason = "an index of this slice")]
            let index = finished.index as usize;
            (orbits[index], outcomes[index]) = (finished.orbit, finished.outcome);
        });
        outcomes
    }
    fn watched(&self, orbit: &mut Watched<N, S, T>, until: Until, watch: &mut Watch<'_>) -> Outcome {
        run(self, orbit, &until, watch)
    }
}

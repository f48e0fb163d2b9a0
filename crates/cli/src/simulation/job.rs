//! A few orbits on one thread: one by one where they are watched, side by side where not.

use std::ops::{ControlFlow, Range};
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, SyncSender};
use std::time::{Duration, Instant};

use billiards::observe::EnergyDrift;
use billiards::{Orbit, Outcome, Stop, Timed};

use super::desk::Desk;
use super::engine::{Bare, Engine, Until, Watch, Watched};
use super::portraits::Portraits;
use super::results::{Ended, Results};
use super::scale::Scale;
use super::trail::Trail;
use super::work::{BLOCK, FEWEST_SIDE_BY_SIDE, FULL, Launch, STEPS, Work, batch};
use crate::picture::{MOST_DOTS, layer};

/// A block that takes longer than this is watched, so that an interruption ends it.
const AT_ONCE: Duration = Duration::from_millis(50);

/// A few orbits on one thread.
pub(super) struct Job<'a, const N: usize, const S: usize, T: Trail<N, S>> {
    pub(super) engine: &'a dyn Engine<N, S, T>,
    pub(super) work: &'a Work<'a>,
    /// The desk that formats rows of the record, and the destination of the results.
    pub(super) desk: &'a Desk<'a>,
    pub(super) out: SyncSender<Receiver<Results>>,
    pub(super) results: Results,
    /// What this thread counts for portraits.
    pub(super) portraits: Option<T::Portraits>,
    /// Time spent on the simulation itself.
    pub(super) busy: Duration,
}

/// What is known of an orbit besides its state.
#[derive(Clone, Copy, Debug)]
struct Course {
    orbit: u64,
    scale: Scale,
    /// The time limit, in the engine's unit.
    end: f64,
    stop: Option<Stop>,
    collisions: u64,
    drift: EnergyDrift,
    /// What of [`STEPS`] has been counted as done.
    steps: u64,
}

impl Course {
    /// Notes the outcome of a block, after which the orbit has reached a time.
    fn note(&mut self, outcome: Outcome, until: Until, time: f64, work: &Work<'_>) {
        self.collisions += outcome.collisions;
        let block_is_over = outcome.stop == Stop::Finished && outcome.collisions == until.collisions;
        let goes_on = (block_is_over && self.collisions < work.collisions) || outcome.stop == Stop::Observer;
        self.stop = (!goes_on).then_some(outcome.stop);
        let done = if goes_on {
            progress_of(self.collisions, work.collisions).max(progress_of_time(time, self.end))
        } else {
            STEPS
        };
        self.count(done, work);
    }

    /// Counts a part of the orbit as done.
    fn count(&mut self, done: u64, work: &Work<'_>) {
        work.progress.fetch_add(done - self.steps, Ordering::Relaxed);
        self.steps = done;
    }
}

/// An orbit that is no longer watched.
pub(super) fn bare<const N: usize, const S: usize, T>(orbit: &Watched<N, S, T>) -> Bare<N, S> {
    let &Orbit { position, velocity, spin, keeper, track: (clock, _) } = orbit;
    Orbit { position, velocity, spin, keeper, track: clock }
}

/// An orbit, watched or not.
enum Running<const N: usize, const S: usize, T> {
    Watched(Watched<N, S, T>),
    Bare(Bare<N, S>),
}

impl<const N: usize, const S: usize, T: Trail<N, S>> Job<'_, N, S, T> {
    /// Runs orbits: side by side where they need not be watched individually.
    pub(super) fn run_all(
        &mut self,
        orbits: Range<u64>,
        launch: &(dyn Fn(u64) -> Launch<N, S, T> + Sync),
    ) -> ControlFlow<()> {
        let mut orbits = orbits.peekable();
        while let Some(&orbit) = orbits.peek()
            && !self.work.interrupted.load(Ordering::Relaxed)
        {
            let left = orbits.size_hint().0 as u64;
            if left >= FEWEST_SIDE_BY_SIDE && self.work.is_side_by_side(orbit) {
                self.run_side_by_side(orbit, orbits.map(launch));
                break;
            }
            self.run(orbit, launch(orbit))?;
            orbits.next();
        }
        ControlFlow::Continue(())
    }

    /// Runs one orbit. It is run in blocks of the same size however it is watched, so its bits are the same.
    fn run(&mut self, index: u64, launch: Launch<N, S, T>) -> ControlFlow<()> {
        let mut course = self.course(index, &launch);
        let mut orbit = Running::Watched(launch.orbit);
        // unknown before the first block
        let mut is_quick = false;
        loop {
            let begun = Instant::now();
            let until = self.block(&course);
            let watched = course.collisions < self.work.watched(index);
            orbit = orbit.watched_if(watched || self.portraits.is_some() || !is_quick);
            let shows_points = self.work.shows_points();
            let outcome = match &mut orbit {
                Running::Watched(orbit) => self.watch(orbit, &course, until),
                Running::Bare(orbit) => self.engine.bare(orbit, until),
            };
            orbit.seen_by(&mut course.drift);
            course.note(outcome, until, orbit.time(), self.work);
            let took = begun.elapsed();
            is_quick = took < AT_ONCE;
            self.busy += took;
            if course.stop.is_some() || outcome.stop == Stop::Observer {
                break;
            }
            if shows_points {
                // a single orbit with this many points is a crowd
                self.work.crowded.fetch_or(course.collisions > MOST_DOTS as u64, Ordering::Relaxed);
            }
            self.send_block()?;
            if self.work.interrupted.load(Ordering::Relaxed) {
                break;
            }
        }
        self.end(&orbit, course, self.results.events.len());
        self.send_block()
    }

    /// An orbit at its start.
    fn course(&self, orbit: u64, Launch { orbit: start, scale }: &Launch<N, S, T>) -> Course {
        let (scale, drift) = (*scale, EnergyDrift::of(start));
        Course { orbit, scale, end: scale.time_in(self.work.time), stop: None, collisions: 0, drift, steps: 0 }
    }

    /// The limits of an orbit's next block.
    fn block(&self, course: &Course) -> Until {
        Until { collisions: BLOCK.min(self.work.collisions - course.collisions), time: course.end }
    }

    /// Runs a block of an orbit that is watched.
    fn watch(&mut self, orbit: &mut Watched<N, S, T>, course: &Course, until: Until) -> Outcome {
        let Work { pieces, frame, interrupted, .. } = *self.work;
        let shows_points = self.work.shows_points();
        let Results { events, points, .. } = &mut self.results;
        let wanted = self.work.watched(course.orbit).saturating_sub(course.collisions);
        let most = usize::try_from(wanted).unwrap_or(usize::MAX).saturating_add(events.len());
        let mut portraits = None;
        if let Some(of_thread) = &mut self.portraits {
            let unit = of_thread.unit(&orbit.velocity, &orbit.spin);
            portraits = Some((of_thread, unit));
        }
        let mut watch = Watch {
            events: (wanted > 0).then_some(&mut *events),
            portraits,
            points: shows_points.then_some(points),
            orbit: course.orbit,
            before: course.collisions,
            scale: course.scale,
            pieces,
            frame,
            called_off: interrupted,
        };
        let outcome = self.engine.watched(orbit, until, &mut watch);
        events.truncate(most);
        outcome
    }

    /// Passes on the results so far if they are many.
    fn send_block(&mut self) -> ControlFlow<()> {
        let Results { events, points, .. } = &self.results;
        if events.len().max(points.len()) as u64 >= BLOCK { self.send() } else { ControlFlow::Continue(()) }
    }

    /// Runs orbits, from the given one, side by side, in the same blocks as if they were run one by one. Those of which the first
    /// collisions are watched make their first block one by one.
    fn run_side_by_side(&mut self, first: u64, launches: impl Iterator<Item = Launch<N, S, T>>) {
        let interrupted = self.work.interrupted;
        let watched = self.work.watched(first) > 0;
        let (mut orbits, mut courses, mut events) = (vec![], vec![], vec![]);
        for (index, launch) in (first..).zip(launches) {
            let mut course = self.course(index, &launch);
            let mut orbit = launch.orbit;
            if watched && !interrupted.load(Ordering::Relaxed) {
                let begun = Instant::now();
                let until = self.block(&course);
                let outcome = self.watch(&mut orbit, &course, until);
                course.drift.see_restored(&orbit);
                course.note(outcome, until, orbit.track.0.time(), self.work);
                self.busy += begun.elapsed();
            }
            orbits.push(bare(&orbit));
            courses.push(course);
            events.push(self.results.events.len());
        }
        for mut going in self.in_turn(first, &courses) {
            while !going.is_empty() && !interrupted.load(Ordering::Relaxed) {
                let begun = Instant::now();
                let until = self.block(&courses[going[0]]);
                // up to a time limit there may be any number of collisions, and mostly fewer
                let together = if until.time < f64::INFINITY { going.len() } else { batch(until.collisions) };
                for going in going.chunks(together).take_while(|_| !interrupted.load(Ordering::Relaxed)) {
                    let mut these: Vec<Bare<N, S>> = going.iter().map(|&k| orbits[k]).collect();
                    let outcomes = match &mut self.portraits {
                        Some(portraits) => {
                            portraits.side_by_side(going.iter().map(|&k| first + k as u64));
                            self.engine.counted(&mut these, until, interrupted, portraits)
                        }
                        None => self.engine.side_by_side(&mut these, until, interrupted),
                    };
                    for ((&k, orbit), outcome) in going.iter().zip(these).zip(outcomes) {
                        orbits[k] = orbit;
                        courses[k].drift.see_restored(&orbit);
                        courses[k].note(outcome, until, orbit.track.time(), self.work);
                    }
                }
                going.retain(|&k| courses[k].stop.is_none());
                self.busy += begun.elapsed();
            }
        }
        for ((orbit, course), events) in orbits.into_iter().zip(courses).zip(events) {
            self.end(&Running::Bare(orbit), course, events);
        }
    }

    /// Groups of orbits, from the given one, to run side by side: of those that go on, those that end at the same time together,
    /// and among them those counted in the same layer of portraits, which then fits into the cache.
    fn in_turn(&self, first: u64, courses: &[Course]) -> Vec<Vec<usize>> {
        let end = |k: &usize| courses[*k].end;
        let mut all: Vec<usize> = (0..courses.len()).filter(|&k| courses[k].stop.is_none()).collect();
        all.sort_by(|a, b| end(a).total_cmp(&end(b)));
        let at_once = all.chunk_by_mut(|a, b| end(a) == end(b));
        if self.portraits.is_none() {
            return at_once.map(|all| all.to_vec()).collect();
        }
        let layer = |k: &usize| layer(first + *k as u64);
        let mut turns: Vec<Vec<usize>> = vec![];
        for all in at_once {
            all.sort_by_key(layer);
            let mut of_these: Vec<Vec<usize>> = vec![];
            for of_layer in all.chunk_by(|a, b| layer(a) == layer(b)) {
                match of_these.last_mut() {
                    Some(few) if (few.len() as u64) < FULL => few.extend(of_layer),
                    _ => of_these.push(of_layer.to_vec()),
                }
            }
            turns.append(&mut of_these);
        }
        turns
    }

    /// Notes the end of an orbit, after this many of the events.
    fn end(&mut self, orbit: &Running<N, S, T>, mut course: Course, events: usize) {
        course.count(STEPS, self.work);
        let Course { orbit: index, scale, stop, collisions, drift, .. } = course;
        let (position, velocity) = orbit.end(self.engine, course.end, stop);
        let position = self.work.frame.beyond(&orbit.position(), &position).map(|x| scale.length_out(x));
        let velocity = velocity.map(|v| scale.speed_out(v));
        let out_of_time = stop == Some(Stop::Finished) && collisions < self.work.collisions;
        let time = if out_of_time { self.work.time } else { scale.time_out(orbit.time()) };
        let is_adrift = out_of_time && self.work.drawn && orbit.flight(self.engine) == f64::INFINITY;
        let adrift = is_adrift.then(|| time - scale.time_out(orbit.time()));
        let ended = Ended { orbit: index, stop, collisions, time, drift: drift.largest(), position, velocity, adrift };
        self.results.ends.push((events, ended));
    }

    /// Passes on the results so far.
    pub(super) fn send(&mut self) -> ControlFlow<()> {
        let results = core::mem::take(&mut self.results);
        let Some(place) = self.desk.send(results, &self.out) else { return ControlFlow::Break(()) };
        self.results.events = place;
        ControlFlow::Continue(())
    }
}

/// The part of an orbit that is done, in [`STEPS`].
fn progress_of(n: u64, most: u64) -> u64 {
    part(n as f64 / most.max(1) as f64)
}

fn progress_of_time(time: f64, end: f64) -> u64 {
    if end.is_finite() { part(time / end) } else { 0 }
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and STEPS")]
fn part(of_one: f64) -> u64 {
    (of_one.clamp(0.0, 1.0) * STEPS as f64) as u64
}

impl<const N: usize, const S: usize, T: Trail<N, S>> Running<N, S, T> {
    /// The same orbit, no longer watched unless it is to be.
    fn watched_if(self, watched: bool) -> Self {
        match self {
            Running::Watched(orbit) if !watched => Running::Bare(bare(&orbit)),
            other => other,
        }
    }

    fn position(&self) -> [f64; N] {
        match self {
            Running::Watched(orbit) => orbit.position,
            Running::Bare(orbit) => orbit.position,
        }
    }

    fn position_at(&self, time: f64) -> [f64; N] {
        match self {
            Running::Watched(orbit) => orbit.position_at(time),
            Running::Bare(orbit) => orbit.position_at(time),
        }
    }

    fn seen_by(&self, drift: &mut EnergyDrift) {
        match self {
            Running::Watched(orbit) => drift.see_restored(orbit),
            Running::Bare(orbit) => drift.see_restored(orbit),
        }
    }

    fn restored(&self) -> ([f64; N], [f64; S]) {
        match self {
            Running::Watched(orbit) => orbit.restored(),
            Running::Bare(orbit) => orbit.restored(),
        }
    }

    fn time(&self) -> f64 {
        match self {
            Running::Watched(orbit) => orbit.track.time(),
            Running::Bare(orbit) => orbit.track.time(),
        }
    }

    fn velocity(&self) -> [f64; N] {
        match self {
            Running::Watched(orbit) => orbit.velocity,
            Running::Bare(orbit) => orbit.velocity,
        }
    }

    /// The time to the next wall.
    fn flight(&self, engine: &dyn Engine<N, S, T>) -> f64 {
        engine.first_hit(&self.position(), &self.velocity()).time
    }

    /// Position and velocity at the end: at the time limit, in the corner that the path runs into, or at the last collision.
    fn end(&self, engine: &dyn Engine<N, S, T>, end: f64, stop: Option<Stop>) -> ([f64; N], [f64; 3]) {
        let at = match stop {
            Some(Stop::Finished) if end.is_finite() => self.position_at(end),
            Some(Stop::Corner) => {
                let (from, along) = (self.position(), self.velocity());
                let flight = self.flight(engine);
                // past a corner in which the particle already is, there is no wall
                let flight = if flight < f64::INFINITY { flight } else { 0.0 };
                core::array::from_fn(|i| from[i] + along[i] * flight)
            }
            _ => self.position(),
        };
        let (v, _) = self.restored();
        let mut velocity = [0.0; 3];
        velocity[..N].copy_from_slice(&v);
        (at, velocity)
    }
}

//! All orbits of a scene, on all threads, with results in the order of the orbits whatever the number of threads.

use std::io;
use std::ops::{ControlFlow, Range};
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use billiards::{Orbit, Stop, Timed};
use lanes::{Double, two_prod};

use super::engine::{Bare, Engine, Trail, Until, Watch, Watched};
use super::event::Event;
use super::scale::Scale;

/// Collisions between two looks at the clock, the energy and the user.
const BLOCK: u64 = 4096;
/// Most orbits that one thread takes on at a time.
const MOST_TOGETHER: u64 = 1024;
/// Side by side, one orbit takes as long as all that the lanes hold: three to four times as long as alone.
const FEWEST_SIDE_BY_SIDE: u64 = 8;
/// Fewest and most orbits that one thread takes on to run them side by side.
const LEAST_SIDE_BY_SIDE: u64 = 64;
const MOST_SIDE_BY_SIDE: u64 = 512;
/// Steps in which the progress of an orbit is counted.
pub(crate) const STEPS: u64 = 1 << 20;

/// An orbit at its start.
#[derive(Clone, Debug)]
pub(crate) struct Launch<const N: usize, const S: usize, T> {
    pub(crate) orbit: Watched<N, S, T>,
    pub(crate) scale: Scale,
}

/// What is to be done.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Work<'a> {
    /// Number of orbits.
    pub(crate) orbits: u64,
    /// Collisions per orbit, at most.
    pub(crate) collisions: u64,
    /// Time per orbit, in the user's unit, at most.
    pub(crate) time: f64,
    /// How much of an orbit is watched.
    pub(crate) watch: Extent,
    /// For the user, what number a piece of the table has.
    pub(crate) pieces: &'a [u64],
    /// Where the engine's origin lies, in its unit.
    pub(crate) shift: [f64; 3],
    /// Number of threads.
    pub(crate) threads: usize,
    /// Set when the user has had enough.
    pub(crate) interrupted: &'a AtomicBool,
    /// Counts work done, [`STEPS`] per orbit.
    pub(crate) progress: &'a AtomicU64,
}

/// How much of the orbits is watched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Extent {
    /// The first so many orbits …
    pub(crate) orbits: u64,
    /// … for at least so many collisions.
    pub(crate) collisions: u64,
}

/// How an orbit ended, in the user's units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ended {
    /// Number of the orbit.
    pub(crate) orbit: u64,
    /// Why; nothing if the user interrupted it.
    pub(crate) stop: Option<Stop>,
    /// Collisions made.
    pub(crate) collisions: u64,
    /// Time passed.
    pub(crate) time: f64,
    /// Largest relative deviation of the energy from that of the start.
    pub(crate) drift: f64,
    /// Position at the end.
    pub(crate) position: [f64; 3],
    /// Velocity at the end.
    pub(crate) velocity: [f64; 3],
}

/// Results of consecutive orbits, or of a part of one.
#[derive(Debug, Default)]
pub(crate) struct Results {
    /// Collisions, orbit after orbit.
    pub(crate) events: Vec<Event>,
    /// Ends of orbits, and how many of the events come before each.
    pub(crate) ends: Vec<(usize, Ended)>,
}

/// Runs all orbits; `consume` gets their results in order. Returns the time that the simulation itself took.
pub(crate) fn run_all<const N: usize, const S: usize, T: Trail<N, S>>(
    engine: &dyn Engine<N, S, T>,
    launch: &(dyn Fn(u64) -> Launch<N, S, T> + Sync),
    work: &Work<'_>,
    consume: &mut dyn FnMut(Results) -> io::Result<()>,
) -> io::Result<Duration> {
    let threads = work.threads.max(1);
    // threads take jobs in order, and what comes of them is consumed in that order
    let (queue, jobs) = sync_channel(4 * threads);
    let jobs_left = Mutex::new(JobsLeft { next: 0, queue: Some(queue) });
    std::thread::scope(|scope| {
        let one = || {
            let mut busy = Duration::ZERO;
            while let Some((orbits, out)) = take(&jobs_left, work) {
                let mut job = Job { engine, work, out, results: Results::default(), busy };
                if work.is_bare(&orbits) && orbits.end - orbits.start >= FEWEST_SIDE_BY_SIDE {
                    job.run_side_by_side(orbits.start, &orbits.map(launch).collect::<Vec<_>>());
                } else {
                    // a job ends early if nobody wants its results any more
                    let _ = orbits.into_iter().try_for_each(|orbit| job.run(orbit, launch(orbit)));
                }
                let _ = job.send();
                busy = job.busy;
            }
            busy
        };
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(one)).collect();
        let outcome = jobs.into_iter().flatten().try_for_each(consume);
        let busy = workers.into_iter().map(|worker| worker.join().unwrap_or_else(|panic| resume_unwind(panic))).max();
        let busy = busy.unwrap_or_default();
        outcome.map(|()| busy)
    })
}

impl Work<'_> {
    /// Whether nobody watches these orbits and all that ends them is a number of collisions: then they run side by side.
    fn is_bare(&self, orbits: &Range<u64>) -> bool {
        orbits.start >= self.watched_orbits() && self.time == f64::INFINITY
    }

    fn watched_orbits(&self) -> u64 {
        if self.watch.collisions > 0 { self.watch.orbits } else { 0 }
    }

    /// The next few orbits from the given one, for one thread.
    fn together(&self, first: u64) -> Range<u64> {
        let (together, end) = if self.is_bare(&(first..first)) {
            // enough to fill the lanes again and again, and something for everybody
            let share = self.orbits / (4 * self.threads.max(1) as u64);
            (share.clamp(LEAST_SIDE_BY_SIDE, MOST_SIDE_BY_SIDE), self.orbits)
        } else {
            // so many orbits make a block
            let end = if self.time == f64::INFINITY { self.watched_orbits() } else { self.orbits };
            ((BLOCK / self.collisions.max(1)).clamp(1, MOST_TOGETHER), end.min(self.orbits))
        };
        first..end.min(first.saturating_add(together))
    }
}

/// Orbits that no thread has taken yet, and where those that take them say so.
struct JobsLeft {
    next: u64,
    queue: Option<SyncSender<Receiver<Results>>>,
}

/// The next job, and where its results go.
fn take(left: &Mutex<JobsLeft>, work: &Work<'_>) -> Option<(Range<u64>, SyncSender<Results>)> {
    let mut left = left.lock().unwrap_or_else(PoisonError::into_inner);
    let JobsLeft { next, queue } = &mut *left;
    let orbits = work.together(*next);
    let (out, results) = sync_channel(2);
    let wanted = !orbits.is_empty() && !work.interrupted.load(Ordering::Relaxed);
    if wanted && queue.as_ref().is_some_and(|queue| queue.send(results).is_ok()) {
        *next = orbits.end;
        return Some((orbits, out));
    }
    *queue = None;
    None
}

/// A few orbits on one thread.
struct Job<'a, const N: usize, const S: usize, T> {
    engine: &'a dyn Engine<N, S, T>,
    work: &'a Work<'a>,
    out: SyncSender<Results>,
    results: Results,
    /// Time spent on the simulation itself.
    busy: Duration,
}

/// What is known of an orbit besides its state.
#[derive(Clone, Copy, Debug)]
struct Course {
    orbit: u64,
    stop: Option<Stop>,
    collisions: u64,
    drift: f64,
}

/// An orbit that nobody watches any more.
fn bare<const N: usize, const S: usize, T>(orbit: &Watched<N, S, T>) -> Bare<N, S> {
    let &Orbit { position, velocity, spin, keeper, track: (clock, _) } = orbit;
    Orbit { position, velocity, spin, keeper, track: clock }
}

/// An orbit, watched or not.
enum Running<const N: usize, const S: usize, T> {
    Watched(Watched<N, S, T>),
    Bare(Bare<N, S>),
}

impl<const N: usize, const S: usize, T: Trail<N, S>> Job<'_, N, S, T> {
    /// Runs one orbit. It is run in blocks of the same size however it is watched, so its bits are the same.
    fn run(&mut self, index: u64, launch: Launch<N, S, T>) -> ControlFlow<()> {
        let Work { collisions: most, watch, progress, interrupted, .. } = *self.work;
        let scale = launch.scale;
        let end = scale.time_in(self.work.time);
        let watched = if index < watch.orbits { watch.collisions } else { 0 };
        let energy = Energy::of(&launch.orbit);
        let mut orbit = Running::Watched(launch.orbit);
        let (mut n, mut drift, mut steps) = (0, 0.0_f64, 0);
        let stop = loop {
            let begun = Instant::now();
            let until = Until { collisions: BLOCK.min(most - n), time: end };
            orbit = orbit.watched_if(n < watched);
            let outcome = match &mut orbit {
                Running::Watched(orbit) => {
                    let events = core::mem::take(&mut self.results.events);
                    let Work { pieces, shift, .. } = *self.work;
                    let mut watch = Watch { events, orbit: index, before: n, scale, pieces, shift };
                    let outcome = self.engine.watched(orbit, until, &mut watch);
                    self.results.events = watch.events;
                    outcome
                }
                Running::Bare(orbit) => self.engine.bare(orbit, until),
            };
            n += outcome.collisions;
            drift = drift.max(orbit.energy().drift_from(&energy));
            let now = progress_of(n, most).max(progress_of_time(orbit.time(), end));
            progress.fetch_add(now - steps, Ordering::Relaxed);
            steps = now;
            self.busy += begun.elapsed();
            let block_is_over = outcome.stop == Stop::Finished && outcome.collisions == until.collisions && n < most;
            if !block_is_over {
                break Some(outcome.stop);
            }
            if self.results.events.len() as u64 >= BLOCK {
                self.send()?;
            }
            if interrupted.load(Ordering::Relaxed) {
                break None;
            }
        };
        progress.fetch_add(STEPS - steps, Ordering::Relaxed);
        self.end(&orbit, scale, Course { orbit: index, stop, collisions: n, drift });
        if self.results.events.len() as u64 >= BLOCK {
            self.send()?;
        }
        ControlFlow::Continue(())
    }

    /// Runs orbits that nobody watches, from the given one, in blocks as they would be run one by one.
    fn run_side_by_side(&mut self, first: u64, launches: &[Launch<N, S, T>]) {
        let Work { collisions: most, progress, interrupted, .. } = *self.work;
        let energies: Vec<Energy> = launches.iter().map(|launch| Energy::of(&launch.orbit)).collect();
        let scales: Vec<Scale> = launches.iter().map(|launch| launch.scale).collect();
        let mut orbits: Vec<Bare<N, S>> = launches.iter().map(|launch| bare(&launch.orbit)).collect();
        let course = |k: usize| Course { orbit: first + k as u64, stop: None, collisions: 0, drift: 0.0 };
        let mut courses: Vec<Course> = (0..orbits.len()).map(course).collect();
        let mut going: Vec<usize> = (0..orbits.len()).collect();
        let mut n = 0;
        while !going.is_empty() && (n == 0 || !interrupted.load(Ordering::Relaxed)) {
            let begun = Instant::now();
            let block = BLOCK.min(most - n);
            let mut these: Vec<Bare<N, S>> = going.iter().map(|&k| orbits[k]).collect();
            let outcomes = self.engine.side_by_side(&mut these, block);
            for ((&k, orbit), outcome) in going.iter().zip(these).zip(outcomes) {
                orbits[k] = orbit;
                let course = &mut courses[k];
                course.collisions += outcome.collisions;
                course.drift = course.drift.max(Energy::of(&orbits[k]).drift_from(&energies[k]));
                if outcome.stop != Stop::Finished || course.collisions == most {
                    course.stop = Some(outcome.stop);
                    progress.fetch_add(STEPS - progress_of(n, most), Ordering::Relaxed);
                } else {
                    progress.fetch_add(progress_of(n + block, most) - progress_of(n, most), Ordering::Relaxed);
                }
            }
            going.retain(|&k| courses[k].stop.is_none());
            n += block;
            self.busy += begun.elapsed();
        }
        progress.fetch_add((STEPS - progress_of(n, most)) * going.len() as u64, Ordering::Relaxed);
        for ((orbit, scale), course) in orbits.into_iter().zip(scales).zip(courses) {
            self.end(&Running::Bare(orbit), scale, course);
        }
    }

    /// Notes the end of an orbit.
    fn end(&mut self, orbit: &Running<N, S, T>, scale: Scale, course: Course) {
        let Course { orbit: index, stop, collisions, drift } = course;
        let (position, velocity) = orbit.end(scale.time_in(self.work.time), stop);
        let position = core::array::from_fn(|i| scale.length_out(position[i] + self.work.shift[i]));
        let velocity = velocity.map(|v| scale.speed_out(v));
        let out_of_time = stop == Some(Stop::Finished) && collisions < self.work.collisions;
        let time = if out_of_time { self.work.time } else { scale.time_out(orbit.time()) };
        let ended = Ended { orbit: index, stop, collisions, time, drift, position, velocity };
        self.results.ends.push((self.results.events.len(), ended));
    }

    /// Hands over the results so far.
    fn send(&mut self) -> ControlFlow<()> {
        let results = core::mem::take(&mut self.results);
        match self.out.send(results) {
            Ok(()) => ControlFlow::Continue(()),
            Err(_) => ControlFlow::Break(()),
        }
    }
}

/// Part of an orbit that is done, in [`STEPS`].
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

    fn state(&self) -> (&[f64; N], &[f64; N]) {
        match self {
            Running::Watched(orbit) => (&orbit.position, &orbit.velocity),
            Running::Bare(orbit) => (&orbit.position, &orbit.velocity),
        }
    }

    fn time(&self) -> f64 {
        match self {
            Running::Watched(orbit) => orbit.track.time(),
            Running::Bare(orbit) => orbit.track.time(),
        }
    }

    fn energy(&self) -> Energy {
        match self {
            Running::Watched(orbit) => Energy::of(orbit),
            Running::Bare(orbit) => Energy::of(orbit),
        }
    }

    /// Position and velocity at the end: at the end of time, or at the last collision.
    fn end(&self, end: f64, stop: Option<Stop>) -> ([f64; 3], [f64; 3]) {
        let (at, v) = self.state();
        let flown = if stop == Some(Stop::Finished) && end.is_finite() { (end - self.time()).max(0.0) } else { 0.0 };
        let (mut position, mut velocity) = ([0.0; 3], [0.0; 3]);
        for i in 0..N {
            position[i] = at[i] + v[i] * flown;
            velocity[i] = v[i];
        }
        (position, velocity)
    }
}

/// `|v|² + |w|²` to twice the usual precision, so that a drift of one rounding is seen as such.
#[derive(Clone, Copy, Debug)]
struct Energy(Double);

impl Energy {
    fn of<const N: usize, const S: usize, K, T>(orbit: &Orbit<f64, N, S, K, T>) -> Energy {
        let mut sum = Double::new(0.0);
        for x in orbit.velocity.iter().chain(&orbit.spin) {
            let (square, rest) = two_prod(*x, *x);
            sum.add(square);
            sum.add(rest);
        }
        Energy(sum)
    }

    /// The relative deviation.
    fn drift_from(&self, start: &Energy) -> f64 {
        let (now, then) = (self.0, start.0);
        (((now.high - then.high) + (now.low - then.low)) / then.high).abs()
    }
}

//! All orbits of a scene, on all threads, with results in the order of the orbits whatever the number of threads.

use std::io;
use std::ops::Range;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use billiards::{Merge, Stop};

use super::desk::Desk;
use super::engine::{Engine, Trail, Watched};
use super::event::Event;
use super::job::{BLOCK, Job};
use super::portraits::Point;
use super::recorder::Recorder;
use super::scale::Scale;

/// Most orbits that one thread takes on at a time.
const MOST_TOGETHER: u64 = 1024;
/// Side by side, one orbit takes as long as all that the lanes hold: three to four times as long as alone.
pub(super) const FEWEST_SIDE_BY_SIDE: u64 = 8;
/// Fewest and most orbits that one thread takes on to run them side by side.
pub(super) const LEAST_SIDE_BY_SIDE: u64 = 64;
const MOST_SIDE_BY_SIDE: u64 = 512;
/// The same where they are counted for portraits, and their collisions: each layer of a portrait goes through the cache, and
/// stays there for as long as its orbits run.
const MOST_COUNTED: u64 = 1 << 16;
const COUNTED: u64 = 1 << 25;
/// So many blocks of a job wait to be consumed, or to be formatted by other threads.
const BLOCKS: usize = 4;
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
    /// What writes watched collisions into the record, and whether they are drawn as well.
    pub(crate) recorder: Option<Recorder<'a>>,
    pub(crate) drawn: bool,
    /// Whether collisions are counted for portraits.
    pub(crate) counted: bool,
    /// Whether points of portraits are too many to be shown one by one, and only counted.
    pub(crate) crowded: &'a AtomicBool,
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
    /// Collisions, orbit after orbit, if somebody draws them.
    pub(crate) events: Vec<Event>,
    /// The same as so many rows of the record.
    pub(crate) rows: u64,
    pub(crate) formatted: Vec<u8>,
    /// The same as points of portraits, as long as they are few.
    pub(crate) points: Vec<Point>,
    /// Ends of orbits, and how many of the events come before each.
    pub(crate) ends: Vec<(usize, Ended)>,
}

/// Empty portraits.
pub(crate) type NewPortraits<'a, P> = Option<&'a (dyn Fn() -> P + Sync)>;

/// Runs all orbits; `consume` gets their results in order. Returns the time that the simulation itself took, and what was
/// counted for portraits.
pub(crate) fn run_all<const N: usize, const S: usize, T: Trail<N, S>>(
    engine: &dyn Engine<N, S, T>,
    launch: &(dyn Fn(u64) -> Launch<N, S, T> + Sync),
    portraits: NewPortraits<'_, T::Portraits>,
    work: &Work<'_>,
    consume: &mut dyn FnMut(Results) -> io::Result<()>,
) -> io::Result<(Duration, Option<T::Portraits>)> {
    let threads = work.threads.max(1);
    // threads take jobs in order, and what comes of them is consumed in that order
    let (queue, jobs) = sync_channel(4 * threads);
    let jobs_left = Mutex::new(JobsLeft { next: 0, queue: Some(queue) });
    let desk = Desk::new(work.recorder, work.drawn, threads);
    std::thread::scope(|scope| {
        let one = || {
            let _over = Over(&jobs_left);
            let (mut busy, mut portraits) = (Duration::ZERO, portraits.map(|new| new()));
            loop {
                let _at_work = desk.busy();
                let Some((orbits, out)) = take(&jobs_left, work) else { break };
                let results = Results::default();
                let mut job = Job { engine, work, desk: &desk, out, results, portraits, busy };
                // a job ends early if nobody wants its results any more
                let _ = job.run_all(orbits, launch).is_continue() && job.send().is_continue();
                (busy, portraits) = (job.busy, job.portraits);
            }
            desk.help_on();
            (busy, portraits)
        };
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(one)).collect();
        let outcome = jobs.into_iter().flatten().flatten().try_for_each(consume);
        let of_all = workers.into_iter().map(|worker| worker.join().unwrap_or_else(|panic| resume_unwind(panic)));
        let (busy, portraits) = of_all.fold((Duration::ZERO, None), |(longest, all), (busy, portraits)| {
            let portraits = match (all, portraits) {
                (Some(all), Some(portraits)) => Some(T::Portraits::merge(all, portraits)),
                (one, other) => one.or(other),
            };
            (longest.max(busy), portraits)
        });
        outcome.map(|()| (busy, portraits))
    })
}

impl Work<'_> {
    /// Whether nobody watches these orbits and all that ends them is a number of collisions: then they run side by side.
    pub(super) fn is_bare(&self, orbits: &Range<u64>) -> bool {
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
            let most = if self.counted {
                (COUNTED / self.collisions.max(1)).clamp(MOST_SIDE_BY_SIDE, MOST_COUNTED)
            } else {
                MOST_SIDE_BY_SIDE
            };
            (share.clamp(LEAST_SIDE_BY_SIDE, most), self.orbits)
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
    queue: Option<SyncSender<Receiver<Receiver<Results>>>>,
}

/// Ends the work when a thread ends, be it by a panic: nobody waits for ever.
struct Over<'a>(&'a Mutex<JobsLeft>);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).queue = None;
    }
}

/// The next job, and where its results go.
fn take(left: &Mutex<JobsLeft>, work: &Work<'_>) -> Option<(Range<u64>, SyncSender<Receiver<Results>>)> {
    let mut left = left.lock().unwrap_or_else(PoisonError::into_inner);
    let JobsLeft { next, queue } = &mut *left;
    let orbits = work.together(*next);
    let (out, results) = sync_channel(BLOCKS);
    let wanted = !orbits.is_empty() && !work.interrupted.load(Ordering::Relaxed);
    if wanted && queue.as_ref().is_some_and(|queue| queue.send(results).is_ok()) {
        *next = orbits.end;
        return Some((orbits, out));
    }
    *queue = None;
    None
}

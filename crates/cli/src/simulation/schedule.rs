//! Runs all orbits of a scene on all threads, with results in the order of the orbits whatever the number of threads.

use std::io;
use std::ops::Range;
use std::panic::resume_unwind;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Mutex, PoisonError};
use std::thread::Builder;
use std::time::Duration;

use billiards::Merge;

use super::desk::Desk;
use super::engine::Engine;
use super::job::Job;
use super::results::Results;
use super::trail::Trail;
use super::work::{Launch, Work};

/// Number of blocks of a job that may wait to be consumed, or to be formatted by other threads.
const BLOCKS: usize = 4;

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
    // threads take jobs in order, and their results are consumed in that order
    let (queue, jobs) = sync_channel(4 * threads);
    let jobs_left = Mutex::new(JobsLeft { next: 0, queue: Some(queue) });
    let desk = Desk::new(work.recorder, work.drawn);
    std::thread::scope(|scope| {
        let one = || {
            let _over = Over(&jobs_left);
            let (mut busy, mut portraits) = (Duration::ZERO, portraits.map(|new| new()));
            loop {
                let _at_work = desk.busy();
                let Some((orbits, out)) = take(&jobs_left, work) else { break };
                let results = Results::default();
                let mut job = Job { engine, work, desk: &desk, out, results, portraits, busy };
                // a job ends early if its results are no longer wanted
                let _ = job.run_all(orbits, launch).is_continue() && job.send().is_continue();
                (busy, portraits) = (job.busy, job.portraits);
            }
            desk.help_on();
            (busy, portraits)
        };
        // if the system cannot start so many threads, fewer do the same work
        let spawn = |_| Builder::new().spawn_scoped(scope, one);
        let (workers, refused): (Vec<_>, Vec<_>) = (0..threads).map(spawn).partition(Result::is_ok);
        if let (true, Some(Err(error))) = (workers.is_empty(), refused.into_iter().next()) {
            return Err(error);
        }
        let outcome = {
            let consumer = desk.consumer();
            let mut results = jobs.into_iter().flatten().flatten();
            results.try_for_each(|results| {
                consumer.has_taken();
                consume(results)
            })
        };
        let of_all =
            workers.into_iter().flatten().map(|worker| worker.join().unwrap_or_else(|panic| resume_unwind(panic)));
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

/// The orbits that no thread has taken yet, and the channel on which threads announce the jobs they take.
struct JobsLeft {
    next: u64,
    queue: Option<SyncSender<Receiver<Receiver<Results>>>>,
}

/// Ends the work when a thread ends, even by a panic, so that no other waits for ever.
struct Over<'a>(&'a Mutex<JobsLeft>);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).queue = None;
    }
}

/// The next job, and the channel for its results.
fn take(left: &Mutex<JobsLeft>, work: &Work<'_>) -> Option<(Range<u64>, SyncSender<Receiver<Results>>)> {
    let mut left = left.lock().unwrap_or_else(PoisonError::into_inner);
    let JobsLeft { next, queue } = &mut *left;
    let orbits = work.next_job(*next);
    let (out, results) = sync_channel(BLOCKS);
    let wanted = !orbits.is_empty() && !work.interrupted.load(Ordering::Relaxed);
    if wanted && queue.as_ref().is_some_and(|queue| queue.send(results).is_ok()) {
        *next = orbits.end;
        return Some((orbits, out));
    }
    *queue = None;
    None
}

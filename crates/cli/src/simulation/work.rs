//! The work of a run, and how much of it a thread takes on at a time.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use billiards::SEATS;

use super::engine::Watched;
use super::frame::Frame;
use super::recorder::Recorder;
use super::scale::Scale;
use crate::picture::ORBITS;

/// Collisions between two looks at the clock and the energy.
pub(super) const BLOCK: u64 = 4096;
/// Most orbits that one thread takes on at a time.
const MOST_TOGETHER: u64 = 1024;
/// Side by side, a single orbit takes as long as full lanes: three to four times as long as alone.
pub(super) const FEWEST_SIDE_BY_SIDE: u64 = 8;
/// Orbits that fill both vectors of a twin: half as many take as long.
pub(super) const FULL: u64 = 2 * FEWEST_SIDE_BY_SIDE;
/// Fewest and most orbits that one thread takes on to run them side by side, if there are as many for each thread: enough to refill lanes
/// whose orbits have ended, and few enough that their states stay in the nearest cache.
const LEAST_SIDE_BY_SIDE: u64 = 64;
const MOST_SIDE_BY_SIDE: u64 = 512;
/// Fewest where collisions are counted for portraits: enough to fill the lanes with orbits of each colour, one colour after another.
/// With orbits of all colours at a time, 200 of them took three times as long.
const LEAST_COUNTED: u64 = FULL * ORBITS.len() as u64;
/// Orbits of this many collisions are shared among threads even where that leaves fewer for each.
const LONG: u64 = 1 << 13;
/// Most orbits of a job whose collisions are counted for portraits, and most of these collisions: each layer of a portrait goes
/// through the cache, and stays there as long as its orbits run.
const MOST_COUNTED: u64 = 1 << 16;
const COUNTED: u64 = 1 << 28;
/// Collisions of all orbits together between two updates of the progress.
const GLANCE: u64 = 1 << 18;

/// The number of orbits that, run side by side in blocks of `block` collisions each, make about [`GLANCE`] collisions: enough to
/// fill all lanes again and again.
pub(super) fn batch(block: u64) -> usize {
    usize::try_from(GLANCE / block.max(1)).unwrap_or(usize::MAX - SEATS).max(1).next_multiple_of(SEATS)
}

/// Steps in which the progress of an orbit is counted.
pub(super) const STEPS: u64 = 1 << 20;

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
    /// The recorder that writes watched collisions into the record, and whether they are drawn as well.
    pub(crate) recorder: Option<Recorder<'a>>,
    pub(crate) drawn: bool,
    /// Whether collisions are counted for portraits.
    pub(crate) counted: bool,
    /// Whether points of portraits are too many to be shown one by one, and only counted.
    pub(crate) crowded: &'a AtomicBool,
    /// The user's numbers of the pieces of the table.
    pub(crate) pieces: &'a [u64],
    /// The map from the engine's coordinates to the user's.
    pub(crate) frame: Frame<'a>,
    /// Number of threads.
    pub(crate) threads: usize,
    /// Set when the user interrupts the run.
    pub(crate) interrupted: &'a AtomicBool,
    /// Counts work done, [`STEPS`] per orbit.
    pub(crate) progress: &'a AtomicU64,
}

/// How much of the orbits is watched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Extent {
    /// This many first orbits …
    pub(crate) orbits: u64,
    /// … for this many collisions.
    pub(crate) collisions: u64,
}

impl Work<'_> {
    /// How many collisions of an orbit are watched.
    pub(super) fn watched(&self, orbit: u64) -> u64 {
        if orbit < self.watch.orbits { self.watch.collisions } else { 0 }
    }

    /// Whether an orbit and those after it run side by side: not if they are watched beyond the first block.
    pub(super) fn is_side_by_side(&self, orbit: u64) -> bool {
        self.watched(orbit) <= BLOCK && !self.shows_points()
    }

    /// The largest possible number of points in a portrait.
    pub(crate) fn most_points(&self) -> f64 {
        self.orbits as f64 * self.collisions as f64
    }

    /// Whether points of portraits are passed on one by one.
    pub(super) fn shows_points(&self) -> bool {
        self.counted && !self.crowded.load(Ordering::Relaxed)
    }

    /// Fewest orbits that one thread takes on, starting with the given one.
    fn least_side_by_side(&self, first: u64) -> u64 {
        let threads = self.threads.max(1) as u64;
        let least = if self.counted { LEAST_COUNTED } else { LEAST_SIDE_BY_SIDE };
        if threads == 1 || self.collisions < LONG {
            least
        } else if self.orbits.saturating_sub(first) < FEWEST_SIDE_BY_SIDE {
            // which run one after another
            1
        } else {
            // the same number for all, and all twins full
            self.orbits.div_ceil(threads).next_multiple_of(FULL).min(least)
        }
    }

    /// The next few orbits from the given one, for one thread.
    pub(super) fn next_job(&self, first: u64) -> Range<u64> {
        // those of a job are all watched, or none of them
        let end = if self.watched(first) > 0 { self.watch.orbits.min(self.orbits) } else { self.orbits };
        // while points are passed on one by one, jobs are small, so that none waits long for another
        let together = if self.is_side_by_side(first) {
            // enough to fill the lanes again and again; each job takes a share of the remaining orbits, so jobs become smaller
            let share = self.orbits.saturating_sub(first) / (2 * self.threads.max(1) as u64);
            let share = share - share % SEATS as u64;
            let most = if self.counted {
                (COUNTED / self.collisions.max(1)).clamp(MOST_SIDE_BY_SIDE, MOST_COUNTED)
            } else {
                MOST_SIDE_BY_SIDE
            };
            share.clamp(self.least_side_by_side(first), most)
        } else {
            // the number of orbits that make a block
            (BLOCK / self.collisions.max(1)).clamp(1, MOST_TOGETHER)
        };
        first..end.min(first.saturating_add(together))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_long_orbits_are_shared_among_the_threads() {
        let (crowded, interrupted, progress) = (AtomicBool::new(true), AtomicBool::new(false), AtomicU64::new(0));
        let jobs = |orbits, collisions, threads, counted| {
            let work = Work {
                orbits,
                collisions,
                time: f64::INFINITY,
                watch: Extent { orbits: 0, collisions: 0 },
                recorder: None,
                drawn: false,
                counted,
                crowded: &crowded,
                pieces: &[],
                frame: Frame::default(),
                threads,
                interrupted: &interrupted,
                progress: &progress,
            };
            let (mut next, mut sizes) = (0, vec![]);
            while next < orbits {
                let job = work.next_job(next);
                sizes.push(job.end - job.start);
                next = job.end;
            }
            sizes
        };
        let long = 1_000_000;
        assert_eq!(jobs(2, long, 2, false), [1, 1]);
        assert_eq!(jobs(12, long, 2, false), [12]);
        assert_eq!(jobs(20, long, 2, false), [16, 1, 1, 1, 1]);
        assert_eq!(jobs(64, long, 2, false), [32; 2]);
        assert_eq!(jobs(64, long, 8, false), [16; 4]);
        assert_eq!(jobs(128, long, 2, false), [64; 2]);
        // no splitting where nothing is gained
        assert_eq!(jobs(64, long, 1, false), [64]);
        assert_eq!(jobs(64, 100, 2, false), [64]);
        // those that are counted fill the lanes colour by colour
        assert_eq!(jobs(200, long, 2, true), [112, 88]);
        assert_eq!(jobs(200, long, 1, true), [128, 72]);
        assert_eq!(jobs(512, long, 2, true), [128; 4]);
    }

    #[test]
    fn orbits_side_by_side_fill_all_seats() {
        for block in [0, 1, 100, 1000, 4000, BLOCK, 100_000, u64::MAX] {
            assert_eq!(batch(block) % SEATS, 0, "{block}");
        }
        assert_eq!([4000, BLOCK].map(batch), [96, 64]);
    }

    #[test]
    fn every_orbit_is_in_one_job() {
        const NONE: Extent = Extent { orbits: 0, collisions: 0 };
        const FEW: Extent = Extent { orbits: 3, collisions: 10 };
        const ALL: Extent = Extent { orbits: u64::MAX, collisions: u64::MAX };
        let (interrupted, progress) = (AtomicBool::new(false), AtomicU64::new(0));
        let mut cases = vec![];
        for watch in [NONE, FEW, ALL] {
            for (orbits, collisions) in [(1, 10), (2, 1), (500, 300), (10_000, 100_000), (10_000, u64::MAX)] {
                for time in [f64::INFINITY, 40.0] {
                    for threads in [1, 2, 5] {
                        cases.extend(
                            [None, Some(false), Some(true)].map(|c| (watch, orbits, collisions, time, threads, c)),
                        );
                    }
                }
            }
        }
        for (watch, orbits, collisions, time, threads, counted) in cases {
            let crowded = AtomicBool::new(counted == Some(true));
            let work = Work {
                orbits,
                collisions,
                time,
                watch,
                recorder: None,
                drawn: false,
                counted: counted.is_some(),
                crowded: &crowded,
                pieces: &[],
                frame: Frame::default(),
                threads,
                interrupted: &interrupted,
                progress: &progress,
            };
            let mut next = 0;
            loop {
                let job = work.next_job(next);
                if job.is_empty() {
                    break;
                }
                assert!(job.start == next && job.end <= orbits, "{job:?} {work:?}");
                next = job.end;
            }
            assert_eq!(next, orbits, "{work:?}");
        }
    }
}

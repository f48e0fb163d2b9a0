//! Many orbits on many threads, with results that do not depend on how many threads there are.
use crate::merge::Merge;
use core::ops::{ControlFlow, Range};
use rayon::prelude::*;

/// A range of orbit numbers, cut into blocks that threads work through.
///
/// Each block begins with empty statistics and runs its orbits in order; blocks are merged in order. So the result is the
/// same, to the last bit, on any number of threads, and memory holds a few blocks' statistics however long the orbits run.
/// Blocks are aligned to multiples of their length: parts of an ensemble that run on different machines, cut at such
/// multiples, have the blocks of the whole.
///
/// ```
/// use billiards::{Canonical, Collisions, Conserved, Ensemble, Orbit, Planar, Starts, laws::Disk};
/// use billiards::{collision_laws::laws::NoSlip, geometry::tables, observe::FreePath};
///
/// let square = Planar { table: tables::square(1.0)?, law: Disk::new(&NoSlip, 0.5_f64.sqrt())? };
/// let canonical = Canonical::new(&square.table, 1.0, 1)?;
/// let paths = Ensemble::of(1000).run(FreePath::new, |i, paths| {
///     let start = canonical.start(i);
///     let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>>::new(start.position, start.velocity, start.spin, ());
///     paths.follow(&orbit);
///     square.run(&mut orbit, &Collisions(10), paths);
/// });
/// assert_eq!(paths.time().count, 10_000);
/// assert!((paths.time().mean - 1.0).abs() < 0.1); // 4A/P = 1
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ensemble {
    orbits: Range<u64>,
    block: u64,
}

/// Orbits per block by default: enough to make the cost of merging negligible.
const BLOCK: u64 = 256;

impl Ensemble {
    /// Orbits 0 to `count` − 1.
    pub fn of(count: u64) -> Self {
        Ensemble::part(0..count)
    }

    /// The orbits with these numbers.
    pub fn part(orbits: Range<u64>) -> Self {
        Ensemble { orbits, block: BLOCK }
    }

    /// The same in blocks of this many orbits, at least one. Sums of numbers may be rounded differently with other blocks; counts are the
    /// same.
    #[must_use]
    pub fn in_blocks_of(self, orbits: u64) -> Self {
        Ensemble { block: orbits.max(1), ..self }
    }

    /// Runs `orbit(i, statistics)` for every orbit number, on the threads of the current rayon pool.
    pub fn run<M: Merge + Send>(&self, empty: impl Fn() -> M + Sync, orbit: impl Fn(u64, &mut M) + Sync) -> M {
        self.run_while(empty, orbit, |_| ControlFlow::Continue(())).1
    }

    /// The same, calling `progress` now and then with the number of the first orbit not run yet; `Break` ends the run.
    /// Returns that number and the statistics of the orbits before it.
    pub fn run_while<M: Merge + Send>(
        &self,
        empty: impl Fn() -> M + Sync,
        orbit: impl Fn(u64, &mut M) + Sync,
        mut progress: impl FnMut(u64) -> ControlFlow<()>,
    ) -> (u64, M) {
        // enough blocks at a time that threads seldom wait for the last one
        let at_a_time = 8 * rayon::current_num_threads() as u64;
        let Range { start, end } = self.orbits;
        let mut done = start.min(end);
        let mut total: Option<M> = None;
        while done < end {
            let first = done / self.block;
            let many: Vec<M> = (first..first.saturating_add(at_a_time))
                .into_par_iter()
                .map(|block| self.of_block(block))
                .filter(|orbits| !orbits.is_empty())
                .map(|orbits| {
                    let mut statistics = empty();
                    for i in orbits {
                        statistics.next_orbit();
                        orbit(i, &mut statistics);
                    }
                    statistics
                })
                .collect();
            total = many.into_iter().fold(total, |total, next| {
                Some(match total {
                    Some(total) => total.merge(next),
                    None => next,
                })
            });
            done = first.saturating_add(at_a_time).saturating_mul(self.block).min(end);
            if progress(done).is_break() {
                break;
            }
        }
        (done, total.unwrap_or_else(empty))
    }

    /// The orbits of one block.
    fn of_block(&self, block: u64) -> Range<u64> {
        let from = block.saturating_mul(self.block);
        from.max(self.orbits.start)..from.saturating_add(self.block).min(self.orbits.end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sum that tells in which order it was made.
    fn harmonic(ensemble: &Ensemble) -> f64 {
        struct Sum(f64);
        impl Merge for Sum {
            fn merge(self, other: Sum) -> Sum {
                Sum(self.0 + other.0)
            }
        }
        ensemble.run(|| Sum(0.0), |i, sum| sum.0 += 1.0 / (i as f64 + 0.3)).0
    }

    #[test]
    fn the_number_of_threads_does_not_change_a_bit() {
        let ensemble = Ensemble::part(100..20_000).in_blocks_of(37);
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| harmonic(&ensemble))
        };
        let one = on(1);
        assert!([2, 3, 8].iter().all(|&threads| on(threads) == one));
    }

    #[test]
    fn every_orbit_runs_exactly_once_and_in_order() {
        for (range, block) in [(0..1000, 7), (13..14, 256), (5..5, 3), (250..777, 1)] {
            let run = Ensemble::part(range.clone()).in_blocks_of(block);
            assert_eq!(run.run(Vec::new, |i, seen: &mut Vec<u64>| seen.push(i)), range.collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_run_that_is_stopped_says_how_far_it_came() {
        let mut calls = 0;
        let (done, seen) = Ensemble::of(u64::MAX).run_while(
            || 0,
            |_, seen: &mut u64| *seen += 1,
            |_| {
                calls += 1;
                if calls == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
        );
        assert_eq!(done, seen);
    }
}

//! What a method costs on a table, and how good it is.

use std::collections::BTreeMap;
use std::error::Error;
use std::time::Duration;

use super::Effort;
use super::case::Case;
use super::clock::timed;
use super::law::Law;
use super::method::{self, End, Method};
use super::real::{DoubleDouble, Real};
use super::state::{State, worse};

/// Numbers of collisions after which errors are measured.
pub const STOPS: [u64; 3] = [1, 10, 100];

/// Number of collisions after which drifts are measured, unless that takes too long.
const LONG_RUN: u64 = 100_000;
/// Number of orbits that are followed for so long.
const LONG_ORBITS: usize = 4;

/// A point outside the table by more than this fraction of its size is lost.
///
/// The coarsest polyline lies 5·10⁻⁴ off the boundary.
const OUTSIDE: f64 = 1e-2;

/// A method on a table.
#[derive(Clone, Debug)]
pub struct Score {
    /// Name of the table.
    pub table: &'static str,
    /// Name of the method.
    pub method: &'static str,
    /// Number of pieces, where the method has a choice.
    pub pieces: Option<usize>,
    /// Time that it took to prepare the method.
    pub build: Duration,
    /// Processor time per collision, in nanoseconds: the median of some rounds.
    pub nanoseconds: f64,
    /// Errors after the numbers of collisions in [`STOPS`].
    pub errors: [Spread; 3],
    /// How well long orbits conserve what they should.
    pub drift: Drift,
    /// What became of the orbits.
    pub lost: Lost,
}

/// Errors of several orbits: those whose right states are known because they do not end in a corner before. Without such
/// orbits, NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// The median.
    pub median: f64,
    /// The largest.
    pub worst: f64,
}

/// How far conserved quantities have drifted; infinite where an orbit was lost on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift {
    /// The number of collisions asked of each orbit.
    pub collisions: u64,
    /// Largest relative deviation of the energy.
    pub energy: f64,
    /// The table's own invariant and its largest deviation.
    pub invariant: Option<(&'static str, f64)>,
}

/// Orbits that a method has lost: how many ended early, but not in a corner, by reason, or outside the table.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lost {
    /// Those from ordinary starts.
    pub ordinary: BTreeMap<&'static str, usize>,
    /// Those that start nearly along a wall.
    pub grazing: BTreeMap<&'static str, usize>,
    /// Number of orbits of each kind.
    pub of: usize,
}

/// How an orbit is lost, if it is.
fn loss(end: End, outside: f64) -> Option<&'static str> {
    match end {
        End::Lost(stop) => Some(stop.name()),
        End::Whole | End::Corner if !(outside <= OUTSIDE) => Some("outside"),
        End::Whole | End::Corner => None,
    }
}

/// A table with starts and with the right answers.
#[derive(Debug)]
pub struct Exam<'a> {
    case: &'a Case,
    law: Law,
    starts: Vec<State<f64>>,
    grazing: Vec<State<f64>>,
    /// The right states after [`STOPS`], as far as there are any.
    right: Vec<Vec<State<DoubleDouble>>>,
    effort: Effort,
}

impl<'a> Exam<'a> {
    /// Computes the reference answers, in about 106 bits.
    ///
    /// # Errors
    /// There are no starts on this table, or no right answers.
    pub fn new(case: &'a Case, law: Law, effort: Effort) -> Result<Self, Box<dyn Error>> {
        let starts = case.starts(effort.orbits())?;
        let textbook = case.textbook::<DoubleDouble>(law).ok_or("the textbook method cannot treat all of its walls")?;
        let follow = |start: &State<f64>| {
            let mut at = start.to(DoubleDouble::of);
            let mut states = vec![];
            for n in 1..=STOPS[2] {
                if textbook.step(&mut at).is_err() {
                    break;
                }
                if STOPS.contains(&n) {
                    states.push(at);
                }
            }
            states
        };
        let right = starts.iter().map(follow).collect();
        Ok(Exam { case, law, grazing: case.grazing_starts(effort.orbits())?, starts, right, effort })
    }

    /// Puts a method to the test.
    ///
    /// # Errors
    /// It cannot be prepared.
    pub fn score(&self, entry: &method::Entry, pieces: Option<usize>) -> Result<Score, Box<dyn Error>> {
        // walls are prepared when a path first needs them
        let (method, build) = timed(|| {
            let method = (entry.build)(self.case, self.law, pieces)?;
            method.bulk(&self.starts, 1);
            Ok::<_, Box<dyn Error>>(method)
        });
        let method = &*method?;
        let nanoseconds = self.nanoseconds(method);
        let (errors, ordinary) = self.errors(method);
        let mut grazing = BTreeMap::new();
        for how in self.grazing.iter().filter_map(|start| self.loses(method, start)) {
            *grazing.entry(how).or_default() += 1;
        }
        let lost = Lost { ordinary, grazing, of: self.starts.len() };
        let drift = self.drift(method, nanoseconds);
        let (table, method) = (self.case.name, entry.name);
        Ok(Score { table, method, pieces, build, nanoseconds, errors, drift, lost })
    }

    /// Processor time per collision: the median of some rounds, all of the same work.
    fn nanoseconds(&self, method: &dyn Method) -> f64 {
        let round = |collisions: u64| {
            let (made, time) = timed(|| method.bulk(&self.starts, collisions));
            (made, time.as_secs_f64())
        };
        let budget = self.effort.round().as_secs_f64();
        let mut collisions = 1;
        while round(collisions).1 < 0.5 * budget && collisions < 1 << 24 {
            collisions *= 2;
        }
        let mut times: Vec<f64> = (0..self.effort.rounds())
            .map(|_| round(collisions))
            .map(|(made, seconds)| 1e9 * seconds / made.max(1) as f64)
            .collect();
        median(&mut times)
    }

    fn errors(&self, method: &dyn Method) -> ([Spread; 3], BTreeMap<&'static str, usize>) {
        let mut errors: [Vec<f64>; 3] = Default::default();
        let mut lost = BTreeMap::new();
        for (start, right) in self.starts.iter().zip(&self.right) {
            let mut seen = 0;
            let mut outside = 0.0;
            let end = method.trace(start, &STOPS, &mut |k, state| {
                seen = k + 1;
                outside = self.case.outside(state);
                if let Some(right) = right.get(k) {
                    errors[k].push(state.error(right, self.case.size));
                }
            });
            if let Some(how) = loss(end, outside) {
                *lost.entry(how).or_default() += 1;
            }
            // also where a corner ends what should go on
            errors[seen.min(right.len())..right.len()].iter_mut().for_each(|errors| errors.push(f64::INFINITY));
        }
        (errors.map(|mut errors| Spread::of(&mut errors)), lost)
    }

    fn loses(&self, method: &dyn Method, start: &State<f64>) -> Option<&'static str> {
        let mut outside = 0.0;
        let end = method.trace(start, &STOPS, &mut |_, state| outside = worse(outside, self.case.outside(state)));
        loss(end, outside)
    }

    fn drift(&self, method: &dyn Method, nanoseconds: f64) -> Drift {
        let budget = 1e9 * 5.0 * self.effort.round().as_secs_f64();
        let mut collisions = LONG_RUN;
        while collisions > 1000 && collisions as f64 * nanoseconds > budget {
            collisions /= 10;
        }
        let invariant = self.case.invariant(self.law);
        let (mut energy, mut moved) = (0.0, 0.0);
        for start in self.starts.iter().take(LONG_ORBITS) {
            let mut first = None;
            let stops = [1, collisions / 100, collisions / 10, collisions];
            let end = method.trace(start, &stops, &mut |_, state| {
                energy = worse(energy, state.energy_drift(start));
                if let Some(invariant) = &invariant {
                    let value = (invariant.of)(state);
                    moved = worse(moved, (value - *first.get_or_insert(value)).abs());
                }
            });
            if matches!(end, End::Lost(_)) {
                (energy, moved) = (f64::INFINITY, f64::INFINITY);
            }
        }
        Drift { collisions, energy, invariant: invariant.map(|invariant| (invariant.name, moved)) }
    }
}

impl Spread {
    fn of(errors: &mut [f64]) -> Spread {
        Spread { median: median(errors), worst: errors.iter().copied().fold(0.0, worse) }
    }
}

/// The median; NaN if there are no values.
fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

impl Score {
    /// Where the method fails, in words.
    pub fn failures(&self) -> Vec<String> {
        let mut all = vec![];
        for (what, lost) in [("", &self.lost.ordinary), ("grazing ", &self.lost.grazing)] {
            if !lost.is_empty() {
                let count: usize = lost.values().sum();
                let how: Vec<_> = lost.keys().copied().collect();
                all.push(format!("loses {count} of {} {what}orbits ({})", self.lost.of, how.join(", ")));
            }
        }
        let medians = || (0..2).map(|k| (STOPS[k], self.errors[k].median));
        if let Some((stop, _)) = medians().find(|(_, median)| *median > OUTSIDE) {
            all.push(format!("more than 1 % off after {stop}"));
        }
        if let Some((stop, _)) = medians().find(|(_, median)| median.is_nan()) {
            all.push(format!("none to compare after {stop}"));
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::super::case::CASES;
    use super::*;

    /// Ends every orbit in a corner, before its first collision.
    struct EndsAtOnce;

    impl Method for EndsAtOnce {
        fn trace(&self, _: &State<f64>, _: &[u64], _: &mut dyn FnMut(usize, &State<f64>)) -> End {
            End::Corner
        }
        fn bulk(&self, _: &[State<f64>], _: u64) -> u64 {
            0
        }
    }

    #[test]
    fn a_method_that_ends_where_the_orbit_goes_on_is_infinitely_far_off() {
        let circle = CASES[0].build().unwrap();
        let exam = Exam::new(&circle, Law::NoSlip, Effort::Quick).unwrap();
        let (errors, _) = exam.errors(&EndsAtOnce);
        assert!(errors.iter().all(|spread| [spread.median, spread.worst] == [f64::INFINITY; 2]), "{errors:?}");
    }
}

//! Run time against error on this machine: what accuracy costs, method by method.
//!
//! Every method computes the same orbits. They are compared with a textbook program in about 106 bits
//! ([`textbook`]), so that errors down to the rounding of an `f64` are visible, and timed by the processor time of
//! the thread. [`stress`] covers the cases in which programs break.

pub mod case;
pub mod chart;
pub mod clock;
pub mod law;
pub mod method;
pub mod real;
pub mod report;
pub mod score;
pub mod state;
pub mod stress;
pub mod textbook;

use std::error::Error;
use std::time::Duration;

use case::{CASES, Case};
use law::Law;
use method::METHODS;
use score::{Exam, Score};

/// How long it may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Some ten seconds.
    Quick,
    /// About a minute.
    Full,
}

impl Effort {
    /// Orbits per table.
    fn orbits(self) -> u64 {
        if self == Effort::Quick { 16 } else { 64 }
    }

    /// Number of rounds, whose median time counts.
    fn rounds(self) -> usize {
        if self == Effort::Quick { 3 } else { 7 }
    }

    /// About how long a round takes.
    fn round(self) -> Duration {
        Duration::from_millis(if self == Effort::Quick { 5 } else { 40 })
    }
}

/// Something to be timed.
#[derive(Clone, Copy, Debug)]
struct Job {
    method: &'static method::Entry,
    pieces: Option<usize>,
}

/// Times every method on a table, and tells `progress` what it is about to do.
///
/// # Errors
/// A table or a method cannot be built.
pub fn measure(
    table: &case::Entry,
    law: Law,
    effort: Effort,
    progress: &mut dyn FnMut(&str),
) -> Result<Vec<Score>, Box<dyn Error>> {
    let case: Case = table.build()?;
    let exam = Exam::new(&case, law, effort)?;
    let jobs = METHODS
        .iter()
        .flat_map(|method| (method.sizes)(&case, effort).into_iter().map(move |pieces| Job { method, pieces }));
    jobs.map(|Job { method, pieces }| {
        progress(&format!("{}, {}", case.name, method.name));
        exam.score(method, pieces)
    })
    .collect()
}

/// The tables of that name; all if there is none.
pub fn tables(only: Option<&str>) -> Vec<&'static case::Entry> {
    CASES.iter().filter(|entry| only.is_none_or(|only| entry.name == only)).collect()
}

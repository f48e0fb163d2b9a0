//! The textbook program, in double and in single precision.

use billiards::Stop;

use super::super::case::Case;
use super::super::chart::Mark;
use super::super::law::Law;
use super::super::real::Real;
use super::super::state::State;
use super::super::textbook::Textbook;
use super::{Built, End, Entry, Method, always};

pub(super) const DOUBLE: Entry = Entry {
    name: "textbook f64",
    summary: "the formulas of a textbook as they stand, without care for rounding",
    mark: Mark::Plus,
    sizes: always,
    build: |case, law, _| build::<f64>(case, law),
};

pub(super) const SINGLE: Entry = Entry {
    name: "textbook f32",
    summary: "the same in single precision",
    mark: Mark::Cross,
    sizes: always,
    build: |case, law, _| build::<f32>(case, law),
};

fn build<R: Real + 'static>(case: &Case, law: Law) -> Built {
    let textbook = case.textbook::<R>(law).ok_or("the textbook method cannot treat all of its walls")?;
    Ok(Box::new(textbook))
}

impl<R: Real> Method for Textbook<R> {
    fn trace(&self, start: &State<f64>, stops: &[u64], look: &mut dyn FnMut(usize, &State<f64>)) -> End {
        let mut at = start.to(R::of);
        let mut done = 0;
        for (k, &stop) in stops.iter().enumerate() {
            while done < stop {
                if self.step(&mut at).is_err() {
                    return End::Lost(Stop::Escaped);
                }
                done += 1;
            }
            look(k, &at.to(R::value));
        }
        End::Whole
    }

    fn bulk(&self, starts: &[State<f64>], collisions: u64) -> u64 {
        let run = |start: &State<f64>| {
            let mut at = start.to(R::of);
            (0..collisions).take_while(|_| self.step(&mut at).is_ok()).count() as u64
        };
        starts.iter().map(run).sum()
    }
}

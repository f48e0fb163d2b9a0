//! Disks with their mass near the middle, or far out.

use billiards::collision_laws::laws::NoSlip;
use billiards::geometry::tables;
use billiards::laws::Disk;

use super::super::Effort;
use super::super::law::Law;
use super::super::method::exact::{trace, with_engine};
use super::super::state::{State, worse};
use super::{Entry, Tally, Trial, directions, start};
use crate::simulation::PlanarLaw;

pub(super) const SMALL: Entry = Entry {
    name: "gamma to 0",
    summary: "no-slip disks with gamma^2 = 1e-300 ... 1e-24: they move like a specular point, whatever their spin",
    run: |effort| {
        on(&[1e-300, 1e-100, 1e-24], effort, |law, start| {
            let specular = after(&Law::Specular.planar(), start, 10);
            let rough = after(law, start, 10);
            // 2γ per collision, in a circle, where deviations do not grow much
            rough.iter().zip(&specular).map(|(a, b)| difference(a, b)).fold(0.0, worse)
        })
    },
};

pub(super) const LARGE: Entry = Entry {
    name: "gamma to infinity",
    summary: "no-slip disks with gamma^2 = 1e24 ... 1e300: they go back the way they came",
    run: |effort| {
        on(&[1e24, 1e100, 1e300], effort, |law, start| {
            let states = after(law, start, 10);
            // every second collision is at the same place with the same velocity
            states.windows(3).map(|w| difference(&w[0], &w[2])).fold(0.0, worse)
        })
    },
};

fn difference(a: &State<f64>, b: &State<f64>) -> f64 {
    let off = |x: &[f64; 3], y: &[f64; 3]| (0..3).map(|i| (x[i] - y[i]).abs()).fold(0.0, worse);
    worse(off(&a.position, &b.position), off(&a.velocity, &b.velocity))
}

/// The states after each of a number of collisions.
fn after(law: &PlanarLaw, start: &State<f64>, collisions: u64) -> Vec<State<f64>> {
    let Ok(table) = tables::circle(1.0) else { return vec![] };
    let mut states = vec![];
    let stops: Vec<u64> = (1..=collisions).collect();
    with_engine(&table, law, |engine| trace(engine, start, &stops, &mut |_, state| states.push(*state)));
    states
}

fn on(
    gammas: &[f64],
    effort: Effort,
    error: impl Fn(&PlanarLaw, &State<f64>) -> f64,
) -> Result<Tally, Box<dyn std::error::Error>> {
    let table = tables::circle(1.0)?;
    let collisions = if effort == Effort::Quick { 1000 } else { 100_000 };
    let mut tally = Tally::default();
    for gamma_squared in gammas {
        let law = PlanarLaw::Uniform(Disk::new(&NoSlip, libm::sqrt(*gamma_squared))?);
        let starts: Vec<_> = directions(8).map(|angle| start([0.1, 0.2], angle)).collect();
        let trial = Trial { table: &table, law: law.clone(), collisions, open: false };
        let mut part = trial.run(&starts);
        part.known = "the limit, and energy";
        for start in &starts {
            let start = State::from_parts(&start.position, &start.velocity, &start.spin);
            part.error = worse(part.error, error(&law, &start));
        }
        tally.join(part);
    }
    Ok(tally)
}

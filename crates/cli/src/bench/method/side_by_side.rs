//! The engine on the table's own pieces, many orbits in the lanes of vector registers.

use super::super::case::{Case, Space};
use super::super::chart::Mark;
use super::super::law::Law;
use super::super::state::{State, first};
use super::{End, Entry, Method, always, in_steps};
use crate::simulation::{PlanarLaw, SpatialLaw};
use billiards::{Collisions, Conserved, EnergyKeeper, Finished, Orbit, Planar, Spatial, Stop};

pub(super) const ENTRY: Entry = Entry {
    name: "exact, side by side",
    summary: "the same to the last bit, many orbits at a time in vector registers",
    mark: Mark::Diamond,
    sizes: always,
    build: |case, law, _| Ok(build(case, law)),
};

fn build(case: &Case, law: Law) -> Box<dyn Method> {
    match &case.space {
        Space::Plane(table) => Box::new(Plane { billiard: Planar { table: table.clone(), law: law.planar() } }),
        Space::Room(table) => Box::new(Room { billiard: Spatial { table: table.clone(), law: law.spatial() } }),
    }
}

/// Orbits that agree bit for bit with those run alone.
struct Plane {
    billiard: Planar<PlanarLaw>,
}

struct Room {
    billiard: Spatial<SpatialLaw>,
}

/// An orbit with its energy.
type Kept<const N: usize, const S: usize> = Orbit<f64, N, S, Conserved<f64, N>>;

/// Enough orbits to keep all lanes of all vectors busy.
const ORBITS: usize = 512;

/// Runs one orbit, in a lane of its own, and shows its state on the way.
fn follow<const N: usize, const S: usize>(
    start: &State<f64>,
    stops: &[u64],
    look: &mut dyn FnMut(usize, &State<f64>),
    mut run: impl FnMut(Kept<N, S>, u64, &mut dyn FnMut(Finished<N, S, Conserved<f64, N>, ()>)),
) -> End
where
    Conserved<f64, N>: EnergyKeeper<f64, N, S>,
{
    let mut orbit: Kept<N, S> = Orbit::new(first(&start.position), first(&start.velocity), first(&start.spin), ());
    in_steps(stops, look, |collisions| {
        let mut stop = Stop::Finished;
        run(orbit, collisions, &mut |finished| (orbit, stop) = (finished.orbit, finished.outcome.stop));
        (stop, State::from_parts(&orbit.position, &orbit.velocity, &orbit.spin))
    })
}

/// The starts, repeated until there are enough.
fn many<const N: usize, const S: usize>(starts: &[State<f64>]) -> impl Iterator<Item = Kept<N, S>> {
    let start = |s: &State<f64>| Orbit::new(first(&s.position), first(&s.velocity), first(&s.spin), ());
    starts.iter().map(start).cycle().take(ORBITS.max(starts.len()))
}

/// So many collisions each that the total is about that of the starts alone.
fn share(starts: &[State<f64>], collisions: u64) -> u64 {
    (collisions * starts.len() as u64 / ORBITS.max(starts.len()) as u64).max(1)
}

impl Method for Plane {
    fn trace(&self, start: &State<f64>, stops: &[u64], look: &mut dyn FnMut(usize, &State<f64>)) -> End {
        follow(start, stops, look, |orbit, collisions, finished| {
            self.billiard.run_side_by_side(&mut std::iter::once(orbit), &Collisions(collisions), &mut (), finished);
        })
    }
    fn bulk(&self, starts: &[State<f64>], collisions: u64) -> u64 {
        let mut made = 0;
        let mut finished = |f: Finished<2, 1, Conserved<f64, 2>, ()>| made += f.outcome.collisions;
        let each = share(starts, collisions);
        self.billiard.run_side_by_side(&mut many(starts), &Collisions(each), &mut (), &mut finished);
        made
    }
}

impl Method for Room {
    fn trace(&self, start: &State<f64>, stops: &[u64], look: &mut dyn FnMut(usize, &State<f64>)) -> End {
        follow(start, stops, look, |orbit, collisions, finished| {
            self.billiard.run_side_by_side(&mut std::iter::once(orbit), &Collisions(collisions), &mut (), finished);
        })
    }
    fn bulk(&self, starts: &[State<f64>], collisions: u64) -> u64 {
        let mut made = 0;
        let mut finished = |f: Finished<3, 3, Conserved<f64, 3>, ()>| made += f.outcome.collisions;
        let each = share(starts, collisions);
        self.billiard.run_side_by_side(&mut many(starts), &Collisions(each), &mut (), &mut finished);
        made
    }
}

//! The engine on the table's own pieces: what `billiards run` does.

use billiards::geometry::Table;
use billiards::geometry::tables::SpatialTable;
use billiards::{Clock, Conserved, OnWalls, Orbit, Outcome};

use super::super::case::{Case, Space};
use super::super::chart::Mark;
use super::super::law::Law;
use super::super::state::{State, first};
use super::{End, Entry, Method, always, in_steps};
use crate::simulation::{Bare, Engine, PlanarLaw, PlanarTrail, SpatialLaw, Trail, Until, WithEngine};

pub(super) const ENTRY: Entry = Entry {
    name: "exact",
    summary: "the engine on exact pieces, one orbit at a time",
    mark: Mark::Disk,
    sizes: always,
    build: |case, law, _| Ok(build(case, law)),
};

pub(super) fn build(case: &Case, law: Law) -> Box<dyn Method> {
    match &case.space {
        Space::Plane(table) => Box::new(Plane { table: table.clone(), law: law.planar() }),
        Space::Room(table) => Box::new(Room { table: table.clone(), law: law.spatial() }),
    }
}

/// The engine on a planar table.
pub(super) struct Plane {
    pub(super) table: Table,
    pub(super) law: PlanarLaw,
}

/// The engine on a table in space.
struct Room {
    table: SpatialTable,
    law: SpatialLaw,
}

/// Runs something with the engine for a planar table.
pub(in crate::bench) fn with_engine<R>(
    table: &Table,
    law: &PlanarLaw,
    then: impl FnOnce(&dyn Engine<2, 1, PlanarTrail>) -> R,
) -> R {
    table.with_walls(OnWalls { law, then: WithEngine(then) })
}

impl Method for Plane {
    fn trace(&self, start: &State<f64>, stops: &[u64], look: &mut dyn FnMut(usize, &State<f64>)) -> End {
        with_engine(&self.table, &self.law, |engine| trace(engine, start, stops, look))
    }
    fn bulk(&self, starts: &[State<f64>], collisions: u64) -> u64 {
        with_engine(&self.table, &self.law, |engine| bulk(engine, starts, collisions))
    }
}

impl Room {
    fn with_engine<R>(&self, then: impl FnOnce(&dyn Engine<3, 3, ()>) -> R) -> R {
        self.table.with_walls(OnWalls { law: &self.law, then: WithEngine(then) })
    }
}

impl Method for Room {
    fn trace(&self, start: &State<f64>, stops: &[u64], look: &mut dyn FnMut(usize, &State<f64>)) -> End {
        self.with_engine(|engine| trace(engine, start, stops, look))
    }
    fn bulk(&self, starts: &[State<f64>], collisions: u64) -> u64 {
        self.with_engine(|engine| bulk(engine, starts, collisions))
    }
}

/// An orbit at its start.
pub(in crate::bench) fn orbit<const N: usize, const S: usize>(start: &State<f64>) -> Bare<N, S>
where
    Conserved<f64, N>: billiards::EnergyKeeper<f64, N, S>,
{
    Orbit::new(first(&start.position), first(&start.velocity), first(&start.spin), Clock::new(0.0))
}

fn until(collisions: u64) -> Until {
    Until { collisions, time: f64::INFINITY }
}

/// Runs one orbit and shows its state on the way.
pub(in crate::bench) fn trace<const N: usize, const S: usize, T: Trail<N, S>>(
    engine: &dyn Engine<N, S, T>,
    start: &State<f64>,
    stops: &[u64],
    look: &mut dyn FnMut(usize, &State<f64>),
) -> End {
    let mut orbit = orbit::<N, S>(start);
    in_steps(stops, look, |collisions| {
        let Outcome { stop, .. } = engine.bare(&mut orbit, until(collisions));
        (stop, State::from_parts(&orbit.position, &orbit.velocity, &orbit.spin))
    })
}

/// Runs each start for a number of collisions.
pub(super) fn bulk<const N: usize, const S: usize, T: Trail<N, S>>(
    engine: &dyn Engine<N, S, T>,
    starts: &[State<f64>],
    collisions: u64,
) -> u64 {
    starts.iter().map(|start| engine.bare(&mut orbit::<N, S>(start), until(collisions)).collisions).sum()
}

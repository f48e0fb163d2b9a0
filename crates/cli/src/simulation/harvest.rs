//! What is kept of a run: the record, the material of pictures, the totals.

use std::collections::BTreeMap;
use std::io;

use billiards::Stop;
use billiards::geometry::Lattice;

use super::event::Event;
use super::paths::Paths;
use super::schedule::{Ended, Extent, Results};
use crate::picture::{self, Cloud, Material, Needs, Reduced};
use crate::record::{Columns, RecordWriter, Row};

/// Most orbits that a picture shows as lines.
const MOST_PATHS: u64 = 200;
/// How a stop is called that the user asked for.
pub(crate) const INTERRUPTED: &str = "interrupted";

/// Totals of a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Totals {
    /// Orbits that ended, or were interrupted on the way.
    pub(crate) orbits: u64,
    /// Collisions.
    pub(crate) collisions: u64,
    /// Time, summed over the orbits.
    pub(crate) time: f64,
    /// Largest relative energy drift.
    pub(crate) drift: f64,
    /// How many orbits ended for which reason.
    pub(crate) stops: BTreeMap<&'static str, u64>,
}

/// Takes results in the order of the orbits and keeps what is asked for.
pub(crate) struct Harvest<'a> {
    columns: Columns,
    record: Option<Box<dyn RecordWriter + Send>>,
    paths: Option<Paths>,
    velocities: Option<Cloud>,
    reduced: Option<Reduced>,
    seen: &'a dyn Seen,
    /// Legs shown of each orbit.
    legs: u64,
    /// Where the orbit at hand is, in lattice cells.
    cell: [f64; 2],
    totals: Totals,
}

/// How pictures see a table.
pub(crate) trait Seen {
    /// Where an orbit starts, in the plane of the picture; not folded into the unit cell of a lattice.
    fn start(&self, orbit: u64) -> [f64; 2];
    /// A point in the plane of the picture.
    fn point(&self, position: [f64; 3]) -> [f64; 2];
    /// A direction in the plane of the picture.
    fn direction(&self, velocity: [f64; 3]) -> [f64; 2];
    /// An empty reduced phase space, where there is one.
    fn reduced(&self) -> Option<Reduced>;
    /// The arc length of a collision.
    fn arc_length(&self, event: &Event) -> f64;
}

impl<'a> Harvest<'a> {
    /// For a record, if there is one, and for pictures with these needs, of so many orbits.
    pub(crate) fn new(
        columns: Columns,
        record: Option<Box<dyn RecordWriter + Send>>,
        needs: &[Needs],
        lattice: Option<Lattice>,
        orbits: u64,
        seen: &'a dyn Seen,
    ) -> Self {
        Harvest {
            columns,
            record,
            paths: needs.contains(&Needs::Paths).then(|| Paths::new(lattice)),
            velocities: needs.contains(&Needs::Velocities).then(picture::velocities),
            reduced: needs.contains(&Needs::Reduced).then(|| seen.reduced()).flatten(),
            seen,
            legs: (picture::MOST_LEGS as u64 / orbits.clamp(1, MOST_PATHS)).max(1),
            cell: [0.0; 2],
            totals: Totals::default(),
        }
    }

    /// How much of the orbits must be watched.
    pub(crate) fn extent(&self) -> Extent {
        if self.record.is_some() || self.velocities.is_some() || self.reduced.is_some() {
            Extent { orbits: u64::MAX, collisions: u64::MAX }
        } else if self.paths.is_some() {
            Extent { orbits: MOST_PATHS, collisions: self.legs }
        } else {
            Extent { orbits: 0, collisions: 0 }
        }
    }

    /// Takes results.
    ///
    /// # Errors
    /// The record cannot be written.
    pub(crate) fn take(&mut self, results: &Results) -> io::Result<()> {
        let (mut events, mut taken) = (&results.events[..], 0);
        for (before, ended) in &results.ends {
            let (now, later) = events.split_at(before - taken);
            (events, taken) = (later, *before);
            now.iter().try_for_each(|event| self.event(event))?;
            self.end(ended);
        }
        events.iter().try_for_each(|event| self.event(event))
    }

    fn event(&mut self, event: &Event) -> io::Result<()> {
        if let Some(record) = &mut self.record {
            write(&mut **record, self.columns, event)?;
        }
        if let Some(velocities) = &mut self.velocities {
            velocities.add(event.orbit, portrait(event));
        }
        if let Some(reduced) = &mut self.reduced {
            let [_, tangential] = portrait(event);
            reduced.add(event.orbit, self.seen.arc_length(event), tangential);
        }
        if event.n <= self.legs
            && let Some(paths) = Self::paths_of(&mut self.paths, event.orbit, self.seen, &mut self.cell)
        {
            paths.fly(self.seen.point(event.position), [event.cell[0] - self.cell[0], event.cell[1] - self.cell[1]]);
            self.cell = event.cell;
        }
        Ok(())
    }

    /// The lines, the last of which is that of an orbit; none if the orbit is not shown.
    fn paths_of<'p>(
        paths: &'p mut Option<Paths>,
        orbit: u64,
        seen: &dyn Seen,
        cell: &mut [f64; 2],
    ) -> Option<&'p mut Paths> {
        let paths = paths.as_mut().filter(|_| orbit < MOST_PATHS)?;
        while paths.started() <= orbit {
            *cell = paths.start(seen.start(paths.started()));
        }
        Some(paths)
    }

    fn end(&mut self, ended: &Ended) {
        let totals = &mut self.totals;
        totals.orbits += 1;
        totals.collisions += ended.collisions;
        totals.time += ended.time;
        totals.drift = totals.drift.max(ended.drift);
        *totals.stops.entry(ended.stop.map_or(INTERRUPTED, Stop::name)).or_default() += 1;
        if ended.collisions <= self.legs
            && let Some(paths) = Self::paths_of(&mut self.paths, ended.orbit, self.seen, &mut self.cell)
        {
            match ended.stop {
                Some(Stop::Escaped) => paths.escape(self.seen.direction(ended.velocity)),
                Some(Stop::Finished) => paths.rest(self.seen.point(ended.position)),
                _ => {}
            }
        }
    }

    /// What pictures are drawn from (except for the walls), and the totals; completes the record.
    ///
    /// # Errors
    /// The record cannot be written.
    pub(crate) fn finish(self) -> io::Result<(Material, Totals)> {
        if let Some(record) = self.record {
            record.finish()?;
        }
        let material = Material {
            paths: self.paths.map(Paths::into_paths).unwrap_or_default(),
            velocities: self.velocities,
            reduced: self.reduced,
            ..Material::default()
        };
        Ok((material, self.totals))
    }
}

/// `(v0, v·t)` of the velocity scaled to length one, where `t = J ν`.
fn portrait(event: &Event) -> [f64; 2] {
    let ([v1, v2, _], [v0, ..], [n1, n2, _]) = (event.velocity, event.spin, event.normal);
    let speed = libm::hypot(v0, libm::hypot(v1, v2));
    [v0 / speed, (v2 * n1 - v1 * n2) / speed]
}

fn write(record: &mut dyn RecordWriter, columns: Columns, event: &Event) -> io::Result<()> {
    let ([x1, x2, x3], [v1, v2, v3], [w1, w2, w3]) = (event.position, event.velocity, event.spin);
    #[allow(clippy::cast_possible_truncation, reason = "a number of cells")]
    let cell = event.cell.map(|c| c as i64);
    let mut row = |state: &[f64]| {
        let Event { orbit, n, time, piece, .. } = *event;
        record.row(&Row { orbit, n, time, piece, state, cell: &cell[..columns.cells()] })
    };
    if columns.dimension == 2 {
        row(&[event.angle, x1, x2, w1, v1, v2])
    } else {
        row(&[x1, x2, x3, v1, v2, v3, w1, w2, w3])
    }
}

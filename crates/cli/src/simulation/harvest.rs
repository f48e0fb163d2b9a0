//! What is kept of a run: the record, the material of pictures, the totals.

use std::collections::BTreeMap;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};

use billiards::Stop;
use billiards::geometry::Lattice;
use lanes::Double;

use super::event::Event;
use super::horizon::Horizons;
use super::paths::Paths;
use super::portraits::Clouds;
use super::results::{Ended, Results};
use super::work::Extent;
use crate::picture::{self, Material, Needs, Reduced};
use crate::record::RecordFile;
use crate::whole_file::WholeFile;

/// Most orbits that a picture shows as lines.
const MOST_PATHS: u64 = 200;
/// The name of a stop requested by the user.
pub(crate) const INTERRUPTED: &str = "interrupted";

/// Totals of a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Totals {
    /// Orbits that ended, or were interrupted on the way.
    pub(crate) orbits: u64,
    /// Collisions.
    pub(crate) collisions: u64,
    /// Time, summed over the orbits.
    pub(crate) time: Double,
    /// Largest relative energy drift.
    pub(crate) drift: f64,
    /// How many orbits ended for which reason.
    pub(crate) stops: BTreeMap<&'static str, u64>,
}

/// What is kept once all orbits are run.
pub(crate) struct Kept {
    /// What pictures are drawn from.
    pub(crate) material: Material,
    /// The totals.
    pub(crate) totals: Totals,
    /// The record, not yet under its name.
    pub(crate) record: Option<WholeFile>,
}

/// Takes results in the order of the orbits and keeps what the scene asks for.
pub(crate) struct Harvest<'a> {
    record: Option<RecordFile<'a>>,
    paths: Option<Paths>,
    pub(crate) clouds: Clouds,
    /// Set once points need no longer be passed on one by one.
    crowded: &'a AtomicBool,
    seen: &'a dyn Seen,
    horizons: &'a Horizons,
    /// Legs shown of each orbit.
    legs: u64,
    /// The lattice cell of the current orbit.
    cell: [f64; 2],
    totals: Totals,
}

/// How pictures see a table.
pub(crate) trait Seen {
    /// Where an orbit starts, in the plane of the picture; not folded into the unit cell of a lattice.
    fn start(&self, orbit: u64) -> [f64; 2];
    /// A point in the plane of the picture.
    fn point(&self, position: [f64; 3]) -> [f64; 2];
    /// The same for where the time of an orbit is over that meets no wall any more: it need not be shown.
    fn rest(&self, position: [f64; 3]) -> [f64; 2];
    /// A direction in the plane of the picture.
    fn direction(&self, velocity: [f64; 3]) -> [f64; 2];
    /// An empty reduced phase space, where there is one.
    fn reduced(&self) -> Option<Reduced>;
}

impl<'a> Harvest<'a> {
    /// A harvest for a record, if there is one, and for pictures with these needs, of a number of
    /// orbits.
    pub(crate) fn new(
        record: Option<RecordFile<'a>>,
        needs: &[Needs],
        lattice: Option<Lattice>,
        orbits: u64,
        seen: &'a dyn Seen,
        horizons: &'a Horizons,
        crowded: &'a AtomicBool,
    ) -> Self {
        let legs = (picture::MOST_LEGS / usize::try_from(orbits.clamp(1, MOST_PATHS)).unwrap_or(1)).max(1);
        Harvest {
            record,
            paths: needs.contains(&Needs::Paths).then(|| Paths::new(lattice, legs)),
            clouds: Clouds {
                velocities: needs.contains(&Needs::Velocities).then(picture::velocities),
                reduced: needs.contains(&Needs::Reduced).then(|| seen.reduced()).flatten(),
            },
            crowded,
            seen,
            horizons,
            legs: legs as u64,
            cell: [0.0; 2],
            totals: Totals::default(),
        }
    }

    /// Whether lines are drawn of single collisions.
    pub(crate) fn draws_paths(&self) -> bool {
        self.paths.is_some()
    }

    /// How much of the orbits must be watched, besides counting.
    pub(crate) fn extent(&self) -> Extent {
        if self.record.is_some() {
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
        if let Some(record) = &mut self.record {
            record.write(results.rows, &results.formatted)?;
        }
        let (mut events, mut taken) = (&results.events[..], 0);
        for (before, ended) in &results.ends {
            let (now, later) = events.split_at(before - taken);
            (events, taken) = (later, *before);
            for event in now {
                self.event(event);
            }
            self.end(ended);
        }
        for event in events {
            self.event(event);
        }
        results.points.iter().for_each(|point| self.clouds.add(point));
        if self.clouds.are_crowded() {
            self.crowded.store(true, Ordering::Relaxed);
        }
        Ok(())
    }

    fn event(&mut self, event: &Event) {
        if event.n <= self.legs
            && let Some(paths) = Self::paths_of(&mut self.paths, event.orbit, self.seen, &mut self.cell)
        {
            paths.fly(self.seen.point(event.position), [event.cell[0] - self.cell[0], event.cell[1] - self.cell[1]]);
            self.cell = event.cell;
            if self.horizons.last_known(event.orbit) == Some(event.n) {
                paths.mark_horizon();
            }
        }
    }

    /// The lines, the last of which is that of the given orbit; `None` if the orbit is not shown.
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
        totals.time.add(ended.time);
        // an energy that is NaN counts as the greatest drift
        if ended.drift > totals.drift || ended.drift.is_nan() {
            totals.drift = ended.drift;
        }
        *totals.stops.entry(ended.stop.map_or(INTERRUPTED, Stop::name)).or_default() += 1;
        if ended.collisions <= self.legs
            && let Some(paths) = Self::paths_of(&mut self.paths, ended.orbit, self.seen, &mut self.cell)
        {
            let (position, direction) = (ended.position, self.seen.direction(ended.velocity));
            match (ended.stop, ended.adrift) {
                (Some(Stop::Escaped), _) => paths.escape(direction),
                (Some(Stop::Finished), Some(time)) => paths.drift(direction, time, self.seen.rest(position)),
                (Some(Stop::Finished | Stop::Corner), _) => paths.rest(self.seen.point(position)),
                _ => {}
            }
        }
    }

    /// Everything that is kept, except for the walls in pictures.
    ///
    /// # Errors
    /// The record cannot be written.
    pub(crate) fn finish(self) -> io::Result<Kept> {
        let record = self.record.map(RecordFile::complete).transpose()?;
        let material = Material {
            paths: self.paths.map(Paths::into_paths).unwrap_or_default(),
            velocities: self.clouds.velocities,
            reduced: self.clouds.reduced,
            ..Material::default()
        };
        Ok(Kept { material, totals: self.totals, record })
    }
}

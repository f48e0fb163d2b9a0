//! A scene run: its table built, its starts checked, its orbits run on all cores, what is asked for kept.

mod boundary;
mod engine;
mod event;
mod harvest;
mod law;
mod paths;
mod planar;
mod scale;
mod schedule;
mod start;
mod strokes;
mod summary;

use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64};
use std::time::Duration;

use billiards::geometry::Lattice;

use crate::document::Diagnostic;
use crate::picture::{Material, Needs, PICTURES, Picture};
use crate::record::{self, Columns};
use crate::scene::{Limit, Scene};
use crate::whole_file::WholeFile;

use harvest::{Harvest, Totals};
use planar::Planar;
use schedule::{Launch, Work, run_all};

pub use summary::Summary;

/// A scene whose table is built and whose starts are checked.
#[derive(Debug)]
pub struct Simulation {
    scene: Scene,
    planar: Planar,
}

/// How a simulation is run, and how far it is.
#[derive(Debug)]
pub struct Control {
    /// Number of threads; the results do not depend on it.
    pub threads: usize,
    /// Set to end the run and keep what is done.
    pub interrupted: AtomicBool,
    done: AtomicU64,
}

impl Control {
    /// With this many threads.
    pub fn new(threads: usize) -> Self {
        Control { threads, interrupted: AtomicBool::new(false), done: AtomicU64::new(0) }
    }

    /// Orbits done so far, in millionths, more or less.
    pub fn steps_done(&self) -> u64 {
        self.done.load(std::sync::atomic::Ordering::Relaxed)
    }
}

/// What a run has left.
#[derive(Clone, Debug)]
pub struct Done {
    /// The summary.
    pub summary: Summary,
    /// The files written, the summary among them.
    pub files: Vec<PathBuf>,
}

impl Simulation {
    /// Builds the table of a scene and checks everything that depends on it.
    ///
    /// # Errors
    /// All that is wrong with the scene, at its place in the file.
    pub fn new(scene: Scene) -> Result<Self, Vec<Diagnostic>> {
        let planar = Planar::new(&scene)?;
        Ok(Simulation { scene, planar })
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What [`Control::steps_done`] will be at the end.
    pub fn steps(&self) -> u64 {
        self.planar.orbits().saturating_mul(schedule::STEPS)
    }

    /// Runs all orbits and writes what the scene asks for into a folder.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn run(&self, folder: &Path, control: &Control) -> io::Result<Done> {
        let pictures: Vec<&Picture> =
            PICTURES.iter().filter(|known| self.scene.output.pictures.iter().any(|asked| asked.0 == known.name)).collect();
        let needs: Vec<Needs> = pictures.iter().map(|picture| picture.needs).collect();
        let (mut material, totals, busy) = self.orbits(folder, &needs, control)?;
        material.outline = strokes::of(&self.planar.drawn.table, self.planar.drawn.factor);
        let mut files: Vec<PathBuf> = self.scene.output.collisions.iter().map(|format| record::path(folder, *format)).collect();
        for file in pictures.iter().flat_map(|picture| (picture.draw)(&material)) {
            let path = folder.join(file.name);
            WholeFile::write(&path, &file.content)?;
            files.push(path);
        }
        let summary = Summary::new(&self.scene, self.planar.orbits(), &totals, busy, control.threads);
        let path = folder.join("summary.json");
        WholeFile::write(&path, summary.json().as_bytes())?;
        files.insert(0, path);
        Ok(Done { summary, files })
    }

    fn orbits(&self, folder: &Path, needs: &[Needs], control: &Control) -> io::Result<(Material, Totals, Duration)> {
        let planar = &self.planar;
        let columns = Columns { dimension: self.scene.dimension, lattice: planar.centres.lattice().is_some() };
        let record = self.scene.output.collisions.map(|format| record::create(folder, format, columns)).transpose()?;
        let start = |orbit| planar.lifted_start(orbit);
        let lattice = planar.centres.lattice().and_then(|lattice| {
            Lattice::new(&lattice.vectors().iter().map(|v| v / planar.drawn.factor).collect::<Vec<_>>()).ok()
        });
        let mut harvest = Harvest::new(columns, record, needs, lattice, planar.orbits(), &start);
        let (collisions, time) = match self.scene.limit {
            Some(Limit::Collisions(n)) => (n.value, f64::INFINITY),
            Some(Limit::Time(time)) => (u64::MAX, time.value),
            None => (0, f64::INFINITY),
        };
        let work = Work {
            orbits: planar.orbits(),
            collisions,
            time,
            watch: harvest.extent(),
            pieces: &planar.pieces,
            threads: control.threads,
            interrupted: &control.interrupted,
            progress: &control.done,
        };
        let launch = |orbit| {
            let start = planar.start(orbit);
            Launch { orbit: planar.launch(&start), scale: start.scale }
        };
        let busy = planar.with_engine(|engine| run_all(engine, &launch, &work, &mut |results| harvest.take(&results)))?;
        let (material, totals) = harvest.finish()?;
        Ok((material, totals, busy))
    }
}

//! Runs a scene: builds its table, checks its starts, runs its orbits on all cores, and keeps what the scene asks for.

mod bearings;
mod boundary;
mod counter;
mod departure;
mod describe;
mod desk;
mod drawing;
mod engine;
mod event;
mod frame;
mod harvest;
mod horizon;
mod job;
mod law;
mod look;
mod mesh;
mod overwritten;
mod paths;
mod places;
mod planar;
mod portraits;
mod recorder;
mod remote;
mod results;
mod room;
mod same_bits;
mod scale;
mod schedule;
mod sectors;
mod setup;
mod spatial;
mod start;
mod stretches;
pub(crate) mod strokes;
mod summary;
mod trail;
mod unrolled;
mod wires;
mod words;
mod work;

use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU64};
use std::time::{Duration, Instant};

use billiards::geometry::Lattice;

use crate::document::Diagnostic;
use crate::picture::{Material, Needs, PICTURES, Picture};
use crate::record::{self, Columns, RecordFile};
use crate::scene::{Limit, Scene};
use crate::whole_file::WholeFile;

pub(crate) use engine::{Bare, Engine, Until, WithEngine};
pub(crate) use law::{PlanarLaw, SpatialLaw, any_law};
pub(crate) use summary::host;
pub(crate) use trail::{PlanarTrail, Trail};

use frame::Frame;
use harvest::{Harvest, Kept, Seen};
use look::{Flat, Solid};
use planar::Planar;
use recorder::Recorder;
use schedule::run_all;
use spatial::Spatial;
use summary::Files;
use work::{Launch, Work};

pub use describe::{Description, First, PieceOf, Region, StartOf, Volume};
pub use horizon::{Horizons, OfOrbit};
pub use same_bits::{OtherBits, SameBits};
pub use setup::Setup;
pub use summary::Summary;
pub(crate) use words::{plural, point, short};

/// A scene whose table is built and whose starts are checked.
#[derive(Debug)]
pub struct Simulation {
    scene: Scene,
    body: Body,
}

#[derive(Debug)]
enum Body {
    Plane(Box<Planar>),
    Space(Box<Spatial>),
}

/// How a simulation is run, and its progress.
#[derive(Debug)]
pub struct Control {
    /// Number of threads; the results do not depend on it.
    pub threads: usize,
    /// Set it to end the run and keep what is done.
    pub interrupted: AtomicBool,
    done: AtomicU64,
    /// When the orbits began, after their horizons.
    begun: OnceLock<Instant>,
}

impl Control {
    /// With this many threads.
    pub fn new(threads: usize) -> Self {
        Control { threads, interrupted: AtomicBool::new(false), done: AtomicU64::new(0), begun: OnceLock::new() }
    }

    /// For how long the orbits have been running; `None` while it is still examined how long their digits last.
    pub fn running(&self) -> Option<Duration> {
        self.begun.get().map(Instant::elapsed)
    }

    /// Approximate number of orbits done so far, in units of 2⁻²⁰ of an orbit.
    pub fn steps_done(&self) -> u64 {
        self.done.load(std::sync::atomic::Ordering::Relaxed)
    }
}

/// The name of the summary's file.
const SUMMARY: &str = "summary.json";

/// The results of a run.
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
    /// Everything that is wrong with the scene, with its place in the file.
    pub fn new(scene: Scene) -> Result<Self, Vec<Diagnostic>> {
        let body = if scene.dimension == 2 {
            Body::Plane(Box::new(Planar::new(&scene)?))
        } else {
            Body::Space(Box::new(Spatial::new(&scene)?))
        };
        let simulation = Simulation { scene, body };
        let impossible = simulation.impossible_pictures();
        if impossible.is_empty() { Ok(simulation) } else { Err(impossible) }
    }

    /// Pictures asked for that do not exist for this table.
    fn impossible_pictures(&self) -> Vec<Diagnostic> {
        let infinite = match &self.body {
            Body::Plane(planar) => !planar.centres.perimeter().is_finite(),
            Body::Space(_) => false,
        };
        let why = |needs| match (needs, &self.body) {
            (Needs::Velocities | Needs::Reduced, Body::Space(_)) => {
                Some("needs the reduced phase space, which only planar tables have")
            }
            (Needs::Reduced, _) if infinite => Some("needs walls of finite length"),
            _ => None,
        };
        let asked = self.scene.output.pictures.iter();
        asked
            .filter_map(|(name, span)| {
                let picture = PICTURES.iter().find(|picture| picture.name == *name)?;
                Some(self.scene.source.diagnostic(*span, format!("the picture \"{name}\" {}", why(picture.needs)?)))
            })
            .collect()
    }

    /// The scene.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// How many orbits there are.
    pub fn orbits(&self) -> u64 {
        match &self.body {
            Body::Plane(planar) => planar.orbits(),
            Body::Space(spatial) => spatial.orbits(),
        }
    }

    /// What [`Control::steps_done`] will be at the end.
    pub fn steps(&self) -> u64 {
        self.orbits().saturating_mul(work::STEPS)
    }

    /// Runs all orbits and writes what the scene asks for into a folder.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn run(&self, folder: &Path, control: &Control) -> io::Result<Done> {
        let pictures = self.pictures();
        let needs: Vec<Needs> = pictures.iter().map(|picture| picture.needs).collect();
        let limit = self.limit();
        // hash the inputs as they are now, not as they are hours later
        let inputs = Summary::inputs(&self.scene)?;
        // fail now rather than after hours
        self.outputs(folder).iter().try_for_each(|path| WholeFile::probe(path))?;
        let horizons = match &self.body {
            Body::Plane(planar) => planar.horizons([limit.0 as f64, limit.1], control),
            Body::Space(spatial) => spatial.horizons([limit.0 as f64, limit.1], control),
        }
        .map_err(io::Error::other)?;
        control.begun.get_or_init(Instant::now);
        let asked = Asked { folder, needs: &needs, horizons: &horizons };
        let (kept, busy) = match &self.body {
            Body::Plane(planar) => self.in_plane(planar, &asked, control)?,
            Body::Space(spatial) => self.in_space(spatial, &asked, control)?,
        };
        let record = self.scene.output.collisions.map(|format| format.path(folder));
        let mut files: Vec<PathBuf> = record.into_iter().collect();
        // no file gets its name before all are complete: a run that fails or is ended leaves those of an earlier one alone
        let mut whole = Vec::from_iter(kept.record);
        for file in pictures.iter().flat_map(|picture| (picture.draw)(&kept.material)) {
            let path = folder.join(file.name);
            whole.push(WholeFile::with(&path, &file.content)?);
            files.push(path);
        }
        let written = files.iter().filter_map(|file| Some(file.file_name()?.to_string_lossy().into_owned())).collect();
        let listed = Files { read: inputs, written };
        let path = folder.join(SUMMARY);
        let summary = Summary::new(&self.scene, self.orbits(), &kept.totals, horizons, listed, busy, control.threads);
        whole.push(WholeFile::with(&path, summary.json().as_bytes())?);
        WholeFile::finish(whole)?;
        files.insert(0, path);
        Ok(Done { summary, files })
    }

    /// The pictures that the scene asks for.
    fn pictures(&self) -> Vec<&'static Picture> {
        let drawn = &self.scene.output.pictures;
        PICTURES.iter().filter(|known| drawn.iter().any(|picture| picture.0 == known.name)).collect()
    }

    /// The files that a run may write into a folder.
    fn outputs(&self, folder: &Path) -> Vec<PathBuf> {
        let pictures = self.pictures().into_iter().flat_map(|picture| picture.files).map(|name| folder.join(name));
        let record = self.scene.output.collisions.map(|format| format.path(folder));
        pictures.chain(record).chain([folder.join(SUMMARY)]).collect()
    }

    fn in_plane(&self, planar: &Planar, asked: &Asked<'_>, control: &Control) -> io::Result<(Kept, Duration)> {
        let starts = planar.starts().map_err(io::Error::other)?;
        let lattice = planar.centres.lattice().and_then(|lattice| {
            Lattice::new(&lattice.vectors().iter().map(|v| v / planar.drawn.factor).collect::<Vec<_>>()).ok()
        });
        let seen = Flat::new(planar, &*starts);
        let crowded = AtomicBool::new(false);
        let format = self.format(lattice.is_some());
        let mut harvest = self.harvest(asked, format.as_ref(), lattice, &seen, &crowded)?;
        let work = Work {
            pieces: &planar.pieces,
            frame: planar.frame(),
            ..self.work(&harvest, format.as_ref(), control, &crowded)
        };
        let portraits = planar.portraits(&harvest.clouds, work.most_points());
        let launch = |orbit| {
            let start = starts(orbit);
            Launch { orbit: planar.launch(&start), scale: start.scale }
        };
        let (busy, counts) = planar.with_engine(|engine| {
            run_all(engine, &launch, portraits.as_deref(), &work, &mut |results| harvest.take(&results))
        })?;
        harvest.clouds.merge(counts);
        let draws_walls = harvest.draws_paths();
        let mut kept = harvest.finish()?;
        if draws_walls {
            self.draw_walls(planar, &mut kept.material);
        }
        Ok((kept, busy))
    }

    /// Adds to the material of pictures the walls as drawn, and the lines around the region of centres and the unit cell.
    fn draw_walls(&self, planar: &Planar, material: &mut Material) {
        let factor = planar.drawn.factor;
        material.solids = strokes::solids(&planar.drawn.table, factor);
        material.outline = strokes::of(&planar.drawn.table, factor);
        material.radius = self.scene.particle.radius.value;
        if material.radius > 0.0 {
            material.guides = strokes::of(&planar.centres, factor);
        }
        if let Some(lattice) = planar.centres.lattice() {
            material.guides.extend(strokes::of_cell(lattice, factor));
        }
    }

    fn in_space(&self, spatial: &Spatial, asked: &Asked<'_>, control: &Control) -> io::Result<(Kept, Duration)> {
        let starts = spatial.starts().map_err(io::Error::other)?;
        let seen = Solid::new(spatial, &*starts);
        let crowded = AtomicBool::new(false);
        let format = self.format(false);
        let mut harvest = self.harvest(asked, format.as_ref(), None, &seen, &crowded)?;
        let frame = Frame { shift: spatial.shift.into(), cell: None };
        let work = Work { frame, ..self.work(&harvest, format.as_ref(), control, &crowded) };
        let launch = |orbit| {
            let start = starts(orbit);
            Launch { orbit: spatial.launch(&start), scale: start.scale }
        };
        let (busy, _) = spatial
            .with_engine(|engine| run_all(engine, &launch, None, &work, &mut |results| harvest.take(&results)))?;
        let draws_walls = harvest.draws_paths();
        let mut kept = harvest.finish()?;
        if draws_walls {
            seen.draw(&mut kept.material);
        }
        Ok((kept, busy))
    }

    /// How the record is written, if one is requested.
    fn format(&self, lattice: bool) -> Option<(Box<dyn record::Format>, Columns)> {
        let columns = Columns { dimension: self.scene.dimension, lattice };
        self.scene.output.collisions.map(|format| ((format.writer)(columns), columns))
    }

    fn harvest<'a>(
        &self,
        asked: &Asked<'a>,
        format: Option<&'a (Box<dyn record::Format>, Columns)>,
        lattice: Option<Lattice>,
        seen: &'a dyn Seen,
        crowded: &'a AtomicBool,
    ) -> io::Result<Harvest<'a>> {
        let path = self.scene.output.collisions.map(|format| format.path(asked.folder));
        let record = format.zip(path).map(|((format, columns), path)| RecordFile::create(&path, &**format, *columns));
        Ok(Harvest::new(record.transpose()?, asked.needs, lattice, self.orbits(), seen, asked.horizons, crowded))
    }

    /// Most collisions and the longest time of an orbit.
    fn limit(&self) -> (u64, f64) {
        match self.scene.limit {
            Some(Limit::Collisions(n)) => (n.value, f64::INFINITY),
            Some(Limit::Time(time)) => (u64::MAX, time.value),
            None => (0, f64::INFINITY),
        }
    }

    fn work<'a>(
        &self,
        harvest: &Harvest<'_>,
        format: Option<&'a (Box<dyn record::Format>, Columns)>,
        control: &'a Control,
        crowded: &'a AtomicBool,
    ) -> Work<'a> {
        let (collisions, time) = self.limit();
        Work {
            orbits: self.orbits(),
            collisions,
            time,
            watch: harvest.extent(),
            recorder: format.map(|(format, columns)| Recorder { format: &**format, columns: *columns }),
            drawn: harvest.draws_paths(),
            counted: harvest.clouds.any(),
            crowded,
            pieces: &[],
            frame: Frame::default(),
            threads: control.threads,
            interrupted: &control.interrupted,
            progress: &control.done,
        }
    }
}

/// What is requested of a run, and where.
struct Asked<'a> {
    folder: &'a Path,
    needs: &'a [Needs],
    horizons: &'a Horizons,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Source;
    use crate::scene::Request;

    /// The picture of the orbits of a scene with a limit.
    fn drawn(name: &str, scene: &str, limit: &str) -> String {
        let folder = std::env::temp_dir().join(format!("billiards-drawn-{}-{name}", std::process::id()));
        let scene = format!("law = \"specular\"\n{scene}\n[run]\n{limit}\n[output]\npictures = [\"orbit\"]\n");
        let scene = Scene::parse(&Source::new("x.toml", &scene), &Request::default()).unwrap();
        Simulation::new(scene).unwrap().run(&folder, &Control::new(1)).unwrap();
        let picture = std::fs::read_to_string(folder.join("orbit.svg")).unwrap();
        std::fs::remove_dir_all(folder).unwrap();
        picture
    }

    const OBSTACLES: &str = "[[table.boundary]]\ncircle = { center = [0, 0], radius = 1, domain = \"outside\" }\n\
        [[table.boundary]]\ncircle = { center = [4, 0], radius = 1, domain = \"outside\" }\n\
        [[orbit]]\nposition = [2, 0]\nvelocity = [1, 0.01]";
    const BALLS: &str = "[table]\ndimension = 3\n\
        [[table.boundary]]\nsphere = { center = [0, 0, 0], radius = 1, domain = \"outside\" }\n\
        [[table.boundary]]\nsphere = { center = [4, 0, 0], radius = 1, domain = \"outside\" }\n\
        [[orbit]]\nposition = [2, 0, 0]\nvelocity = [1, 0.01, 0.02]";
    const FLOOR: &str = "[[table.boundary]]\nline = { through = [0, 0], direction = [1, 0] }\n\
        [[orbit]]\nposition = [0, 1]\nvelocity = [1, -1]";
    const WEDGE: &str = "table = { name = \"wedge\", angle = 1.2 }\n\
        [[orbit]]\nposition = [0, 1]\nvelocity = [-1, 0.1]";
    const PILLARS: &str = "[table]\nlattice = [[3, 0]]\n\
        [[table.boundary]]\ncircle = { center = [0, 0], radius = 1, domain = \"outside\" }\n\
        [[orbit]]\nposition = [1.5, 0]\nvelocity = [1, 0.02]";

    #[test]
    fn a_flight_that_meets_no_wall_until_the_time_is_over_does_not_shrink_the_picture() {
        for (name, scene) in
            [("obstacles", OBSTACLES), ("balls", BALLS), ("floor", FLOOR), ("wedge", WEDGE), ("pillars", PILLARS)]
        {
            let whole = drawn(name, scene, "collisions = 100");
            for time in ["1e6", "1e30"] {
                assert!(drawn(name, scene, &format!("time = {time}")) == whole, "{name}, until {time}");
            }
        }
    }

    #[test]
    fn a_short_flight_that_meets_no_wall_until_the_time_is_over_is_shown_to_its_end() {
        for (name, scene) in [("short", FLOOR), ("shorter", OBSTACLES), ("shortest", BALLS)] {
            let [whole, picture, earlier] =
                ["collisions = 100", "time = 9", "time = 8"].map(|limit| drawn(name, scene, limit));
            assert!(picture != whole && picture != earlier, "{name}");
        }
    }
}

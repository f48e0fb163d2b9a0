//! The description of a scene before it runs, for `billiards check`.

use std::fmt;
use std::sync::atomic::AtomicBool;

use billiards::Stop;
use billiards::geometry::tables::SpatialTable;
use billiards::geometry::{self, Figure, Lattice, Piece, Vector2, Walls, WithWalls};
use billiards::observe::mean_free_time;
use serde::Serialize;

use super::engine::{Engine, Until, Watch};
use super::frame::Frame;
use super::planar::Planar;
use super::setup::Setup;
use super::spatial::{Space, Spatial};
use super::start::Spins;
use super::trail::Trail;
use super::words::{point, short};
use super::work::Launch;
use super::{Body, Simulation};

use crate::scene::{Scene, Starts};

/// Most starts that are described.
const MOST_STARTS: u64 = 10;

/// A scene described. Lengths are in the scene's unit; `None` stands for infinity.
#[derive(Clone, Debug, Serialize)]
pub struct Description {
    /// The scene's title, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Table, law and particle.
    #[serde(flatten)]
    pub setup: Setup,
    /// The pieces as drawn.
    pub pieces: Vec<PieceOf>,
    /// The walls as drawn.
    pub walls: Region,
    /// Where the centre of the particle can be, if its radius is positive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centres: Option<Region>,
    /// Radius of the largest disk that fits in, and its centre.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_disk: Option<(f64, [f64; 2])>,
    /// Mean time between collisions in the invariant measure, at unit speed, spin included. Where no law turns velocity into spin it is
    /// given for ensembles only: it is the mean over orbits, each of which keeps its spin. `None` where a law is not strict.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_free_time: Option<f64>,
    /// The same where no law turns velocity into spin, at unit speed of the centre.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_free_time_without_spin: Option<f64>,
    /// The walls that the engine found for the table.
    pub engine: String,
    /// Number of orbits.
    pub orbits: u64,
    /// The first few of them.
    pub starts: Vec<StartOf>,
}

/// A piece of wall.
#[derive(Clone, Debug, Serialize)]
pub struct PieceOf {
    /// What it is.
    pub kind: String,
    /// Its length in the plane, if that is finite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<f64>,
    /// Where it is; in space, the openings of its surface.
    pub place: String,
    /// The unit normal in its middle, into the table.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 2]>,
    /// Its law.
    pub law: String,
}

/// A region and its measures.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Region {
    /// Number of pieces.
    pub pieces: usize,
    /// Area, in the plane; of a unit cell on a lattice.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area: Option<f64>,
    /// Perimeter, in the plane; of a unit cell on a lattice.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub perimeter: Option<f64>,
    /// Volume, in space.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume: Option<Volume>,
    /// Area of the walls, in space.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface: Option<f64>,
    /// Points where the direction of the boundary jumps, and how many of them point into the table.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corners: Option<[usize; 2]>,
    /// Areas (in space volumes) of its connected parts; none for an explicit boundary in space, which is not measured.
    pub parts: Vec<Option<f64>>,
    /// Perimeters of these, in the plane.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub perimeters: Vec<Option<f64>>,
}

/// A volume in the scene's unit: the cube of a length, which may over- or underflow; then JSON has null.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Volume {
    /// What it is.
    Of(f64),
    /// Finite, but larger than any number.
    TooLarge,
    /// Positive, but smaller than any number with all its digits.
    TooSmall,
}

impl Volume {
    /// The volume in the scene's unit from that in units of `1/factor`; `None` if it is infinite.
    fn scaled(volume: f64, factor: f64) -> Option<Volume> {
        // in steps: the cube of the factor alone might overflow
        let x = volume / factor / factor / factor;
        volume.is_finite().then_some(match x {
            _ if !x.is_finite() => Volume::TooLarge,
            _ if x < f64::MIN_POSITIVE && volume > 0.0 => Volume::TooSmall,
            _ => Volume::Of(x),
        })
    }

    fn number(self) -> Option<f64> {
        if let Volume::Of(x) = self { Some(x) } else { None }
    }
}

impl Region {
    /// By how much the ratio of area to perimeter, to which mean free times are proportional, differs in each part from that of all of it.
    /// Nothing where there is one part, or where the ratio is infinite.
    pub fn factors(&self) -> Vec<Option<f64>> {
        let (Some(area), Some(perimeter), true) = (self.area, self.perimeter, self.parts.len() > 1) else {
            return vec![];
        };
        let factor = |(part, length): (&Option<f64>, &Option<f64>)| Some((*part)? / area * (perimeter / (*length)?));
        self.parts.iter().zip(&self.perimeters).map(factor).collect()
    }
}

/// Where an orbit starts, and its first collision.
#[derive(Clone, Debug, Serialize)]
pub struct StartOf {
    /// Position of the centre.
    pub position: Vec<f64>,
    /// Distance of the centre from the nearest wall it can reach.
    pub distance: f64,
    /// Time and piece of the first collision, or why there is none.
    pub first: First,
}

/// The first event of an orbit.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum First {
    /// A wall, after some time.
    Hit {
        /// The time.
        time: f64,
        /// The piece.
        piece: u64,
    },
    /// No wall: why the orbit ends.
    Nothing(&'static str),
}

impl fmt::Display for First {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Hit { time, piece } => write!(f, "hits piece {piece} at t = {}", short(*time)),
            Self::Nothing(stop) => f.write_str(stop),
        }
    }
}

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

impl Simulation {
    /// Describes the scene.
    pub fn describe(&self) -> Description {
        let scene = &self.scene;
        let mut description = Description {
            title: scene.title.clone(),
            setup: Setup::of(scene),
            pieces: vec![],
            walls: Region::default(),
            centres: None,
            largest_disk: None,
            mean_free_time: None,
            mean_free_time_without_spin: None,
            engine: String::new(),
            orbits: self.orbits(),
            starts: vec![],
        };
        match &self.body {
            Body::Plane(planar) => in_plane(scene, planar, &mut description),
            Body::Space(spatial) => in_space(scene, spatial, &mut description),
        }
        description
    }
}

fn in_plane(scene: &Scene, planar: &Planar, description: &mut Description) {
    let factor = planar.drawn.factor;
    let table = &planar.drawn.table;
    let laws = planar.drawn.laws.iter().map(|own| own.as_ref().unwrap_or(&scene.law.kind));
    description.pieces =
        table.pieces().iter().zip(laws).map(|(piece, law)| piece_of(&**piece, factor, law.to_string())).collect();
    let walls = table.describe();
    description.walls = region(&walls, factor);
    let disk = walls.largest_disk;
    // the distance is stationary at its maximum: the centre is known to half the digits of the radius
    let clean = |x: f64| if x.abs() < 1e-8 * disk.radius { 0.0 } else { x / factor };
    let center = table.lattice().map_or(disk.center, |lattice| in_unit_cell(lattice, &disk.center));
    description.largest_disk = finite(disk.radius).map(|radius| (radius / factor, [center.x, center.y].map(clean)));
    let centres = if scene.particle.radius.value > 0.0 {
        let centres = planar.centres.describe();
        description.centres = Some(region(&centres, factor));
        centres
    } else {
        walls
    };
    let ratio = centres.area() / centres.perimeter / factor;
    if planar.strict {
        let times = [3, 2].map(|dimension| mean_free_time(dimension, ratio));
        mean_free_times(scene, planar.keeps_spin(), times, description);
    }
    description.engine = planar.centres.with_walls(NameOfWalls);
    let Ok(starts) = planar.starts() else { return };
    description.starts = planar.with_engine(|engine| {
        (0..planar.orbits().min(MOST_STARTS))
            .map(|orbit| {
                let start = starts(orbit);
                let position = planar.lifted(&start).to_vec();
                let distance = planar.centres.signed_distance(&Vector2::from(start.position)) / factor;
                let launch = Launch { orbit: planar.launch(&start), scale: start.scale };
                StartOf {
                    position,
                    distance: if distance > 0.0 { distance } else { 0.0 },
                    first: first(engine, launch, &planar.pieces),
                }
            })
            .collect()
    });
}

/// The copy of a point in the unit cell; a point at the far edge, within half the digits, is replaced by its copy at the near one.
fn in_unit_cell(lattice: &Lattice, point: &Vector2<f64>) -> Vector2<f64> {
    point - lattice.translation(lattice.coordinates(point).map(|x| libm::floor(x + 1e-8)))
}

fn in_space(scene: &Scene, spatial: &Spatial, description: &mut Description) {
    let out = |x: f64| x / spatial.factor;
    let laws = spatial.laws.iter().map(|own| own.as_ref().unwrap_or(&scene.law.kind));
    let place = |i: usize| match spatial.walls.get(i).map_or(0, |wall| wall.spec.rims()) {
        0 => String::new(),
        1 => "open along 1 edge".into(),
        edges => format!("open along {edges} edges"),
    };
    description.pieces = spatial
        .pieces
        .iter()
        .zip(laws)
        .enumerate()
        .map(|(i, (kind, law))| PieceOf {
            kind: kind.clone(),
            length: None,
            place: place(i),
            normal: None,
            law: law.to_string(),
        })
        .collect();
    description.walls = region_of_space(spatial.built_in.as_ref(), spatial);
    let named = if let Space::Named(table) = &spatial.centres { Some(table) } else { None };
    description.centres = (spatial.radius > 0.0).then(|| region_of_space(named, spatial));
    description.engine = match &spatial.centres {
        Space::Named(table) => {
            let ratio = out(table.volume() / table.surface_area());
            if spatial.strict {
                let times = [6, 3].map(|dimension| mean_free_time(dimension, ratio));
                mean_free_times(scene, spatial.keeps_spin(), times, description);
            }
            table.with_walls(NameOfWalls)
        }
        Space::Room(room) => room.with_walls(NameOfWalls),
    };
    let Ok(starts) = spatial.starts() else { return };
    description.starts = spatial.with_engine(|engine| {
        (0..spatial.orbits().min(MOST_STARTS))
            .map(|orbit| {
                let start = starts(orbit);
                let position = (0..3).map(|i| start.scale.length_out(start.position[i] + spatial.shift[i])).collect();
                let distance = out(spatial.centres.distance(&start.position.into()));
                let launch = Launch { orbit: spatial.launch(&start), scale: start.scale };
                StartOf {
                    position,
                    distance: if distance > 0.0 { distance } else { 0.0 },
                    first: first(engine, launch, &[]),
                }
            })
            .collect()
    });
}

/// A region of space: measured if it is a built-in table.
fn region_of_space(table: Option<&SpatialTable>, spatial: &Spatial) -> Region {
    let volume = table.and_then(|table| Volume::scaled(table.volume(), spatial.factor));
    Region {
        pieces: spatial.pieces.len(),
        volume,
        surface: table.and_then(|table| finite(table.surface_area() / spatial.factor / spatial.factor)),
        parts: table.map(|_| volume.and_then(Volume::number)).into_iter().collect(),
        ..Region::default()
    }
}

/// Notes the mean times between collisions, with and without spin, where they describe the orbits of the scene, that is, under strict
/// laws. Other laws have no invariant measure with these means. Where laws keep the spin, the centre keeps its speed.
fn mean_free_times(scene: &Scene, keep_spin: bool, [with, without]: [f64; 2], description: &mut Description) {
    let is_ensemble = matches!(scene.starts, Starts::Ensemble(_));
    let is_point = Spins::of(&scene.particle) == Spins::Still;
    description.mean_free_time = finite(with).filter(|_| !is_point && (!keep_spin || is_ensemble));
    description.mean_free_time_without_spin = finite(without).filter(|_| is_point || keep_spin);
}

/// The first collision of an orbit.
fn first<const N: usize, const S: usize, T: Trail<N, S>>(
    engine: &dyn Engine<N, S, T>,
    launch: Launch<N, S, T>,
    pieces: &[u64],
) -> First {
    let mut events = vec![];
    let mut watch = Watch {
        events: Some(&mut events),
        portraits: None,
        points: None,
        orbit: 0,
        before: 0,
        scale: launch.scale,
        pieces,
        frame: Frame::default(),
        called_off: &AtomicBool::new(false),
    };
    let mut orbit = launch.orbit;
    let outcome = engine.watched(&mut orbit, Until { collisions: 1, time: f64::INFINITY }, &mut watch);
    match events.first() {
        Some(event) => First::Hit { time: event.time, piece: event.piece },
        None => First::Nothing(if outcome.stop == Stop::Escaped { "escapes at once" } else { outcome.stop.name() }),
    }
}

fn region(of: &geometry::Description, factor: f64) -> Region {
    let area = |area: f64| finite(area / factor / factor);
    Region {
        pieces: of.pieces,
        area: area(of.area()),
        perimeter: finite(of.perimeter / factor),
        volume: None,
        surface: None,
        corners: Some([of.corners, of.re_entrant_corners]),
        parts: of.components.iter().map(|part| area(part.area)).collect(),
        perimeters: of.components.iter().map(|part| finite(part.perimeter / factor)).collect(),
    }
}

fn piece_of(piece: &dyn Piece, factor: f64, law: String) -> PieceOf {
    let at = |p: Vector2<f64>| point(&[p.x / factor, p.y / factor], 0.0);
    let radius = |r: f64| short(r / factor);
    let (kind, place) = match piece.figure() {
        Figure::Segment { ends: [a, b] } => ("segment", format!("{} to {}", at(a), at(b))),
        Figure::Ray { from, direction, .. } => {
            ("ray", format!("from {} along {}", at(from), point(&[direction.x, direction.y], 0.0)))
        }
        Figure::Line { through, direction } => {
            ("line", format!("through {} along {}", at(through), point(&[direction.x, direction.y], 0.0)))
        }
        Figure::Arc { center, radius: r, ends: [a, b], inside } => (
            if inside { "focusing arc" } else { "dispersing arc" },
            format!("{} to {} about {}, radius {}", at(a), at(b), at(center), radius(r)),
        ),
        Figure::Circle { center, radius: r, inside } => (
            if inside { "focusing circle" } else { "dispersing circle" },
            format!("about {}, radius {}", at(center), radius(r)),
        ),
        Figure::Other => (
            "curve",
            match piece.ends() {
                Some([a, b]) => format!("{} to {}", at(a), at(b)),
                None => format!("closed, through {}", at(piece.point_at(0.5 * piece.length()))),
            },
        ),
    };
    let length = piece.length();
    let middle = if length.is_finite() { 0.5 * length } else { 0.0 };
    let normal = piece.landing_at(middle).normal;
    PieceOf { kind: kind.into(), length: finite(length / factor), place, normal: Some(normal.into()), law }
}

/// The walls that a table chooses, by the name of their type.
struct NameOfWalls;

impl<const N: usize> WithWalls<N> for NameOfWalls {
    type Output = String;
    fn run<W: Walls<N>>(self, _: &W) -> String {
        plain(core::any::type_name::<W>())
    }
}

/// The name of a type without module paths: `Around<Cuboid, Scatterer>`.
fn plain(name: &str) -> String {
    let mut plain = String::new();
    for part in name.split_inclusive(['<', '>', ',', ' ']) {
        plain += part.rsplit("::").next().unwrap_or(part);
    }
    // lifetimes and the dimension carry no information
    ["<'_>", "'_, ", "<2>", "<3>", "<2, 0>", "<2, 1>", "<3, 0>", "<3, 1>", "<3, 2>"]
        .iter()
        .fold(plain, |name, dimension| name.replace(dimension, ""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn type_names_become_plain_words() {
        assert_eq!(plain("geometry::walls::capsule::Capsule"), "Capsule");
        assert_eq!(plain("a::Both<b::c::Cuboid<2>, d::Scatterer<2>>"), "Both<Cuboid, Scatterer>");
        assert_eq!(plain("a::Slab<2, 1>"), "Slab");
        assert_eq!(plain("a::Around<b::Sphere<3>, c::ByLane<d::Obstacles<'_>>>"), "Around<Sphere, ByLane<Obstacles>>");
        assert_eq!(plain("a::Few<'_, b::Arc>"), "Few<Arc>");
    }

    #[test]
    fn a_volume_that_no_number_can_express_is_neither_infinite_nor_zero() {
        let factor = |exponent: i32| libm::ldexp(1.0, exponent);
        assert_eq!(Volume::scaled(4.0, factor(-366)), Some(Volume::TooLarge));
        assert_eq!(Volume::scaled(4.0, factor(366)), Some(Volume::TooSmall));
        assert_eq!(Volume::scaled(4.0, factor(1)), Some(Volume::Of(0.5)));
        assert_eq!(Volume::scaled(f64::INFINITY, factor(1)), None);
        let json = |volume: Volume| serde_json::to_string(&volume).unwrap();
        assert_eq!([Volume::TooLarge, Volume::TooSmall, Volume::Of(0.5)].map(json), ["null", "null", "0.5"]);
    }

    #[test]
    fn short_numbers_have_six_digits() {
        assert_eq!([short(1.0 / 3.0), short(0.25), short(1e-7), short(0.0)], ["0.333333", "0.25", "1e-7", "0"]);
    }
}

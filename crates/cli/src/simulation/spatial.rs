//! A ball on a table in space.

use billiards::geometry::parry::{Closest, Room, Side, Solid};
use billiards::geometry::tables::{self, SpatialTable, WallAt};
use billiards::geometry::{Boundary as _, Error, Extent, Line, Surface, Vector3, WallHit};
use billiards::{BallLaw, Bend, Bounce, CanonicalSpatial, Clock, Felt, OnWalls, Orbit};

use super::Control;
use super::boundary;
use super::departure::departed;
use super::engine::{Engine, Watched, WithEngine, conserved};
use super::horizon::{self, Horizons};
use super::law::{Place, SpatialLaw, keeps_spin};
use super::remote::{self, Remote};
use super::room::{self, Entered};
use super::scale::{Scale, to_unity};
use super::start::{self, ByNumber, Spins, Start, Starts, Still};
use super::wires::Wall;
use super::words::short;
use crate::document::{Diagnostic, Span};
use crate::scene::{self, Arguments, LawKind, Sample, Scene, TableShape};

/// A scene in space, ready to run.
#[derive(Debug)]
pub(crate) struct Spatial {
    /// A built-in table as drawn, all lengths multiplied by the factor.
    pub(crate) built_in: Option<SpatialTable>,
    /// Where centres move, its corner or centre at the origin.
    pub(crate) centres: Space,
    /// Shift from the engine's origin to the user's: the particle's radius, where the table begins at a corner.
    pub(crate) shift: Vector3<f64>,
    /// All lengths are multiplied by this power of two.
    pub(crate) factor: f64,
    /// Radius of the particle, in the scene's unit.
    pub(crate) radius: f64,
    /// The walls as drawn, in the scene's unit.
    pub(crate) walls: Vec<Wall>,
    /// What each piece is.
    pub(crate) pieces: Vec<String>,
    /// The laws of pieces that have their own.
    pub(crate) laws: Vec<Option<LawKind>>,
    law: SpatialLaw,
    /// Whether every collision conserves the energy.
    pub(crate) strict: bool,
    starts: Starts<3, 3>,
}

/// A region of space.
#[derive(Debug)]
pub(crate) enum Space {
    /// A built-in table.
    Named(SpatialTable),
    /// Bounded by an explicit boundary.
    Room(Room),
}

/// Where a point lies with respect to a region.
#[derive(Clone, Debug, Default)]
pub(crate) struct Touched {
    /// If it lies outside, how far, and beyond which piece (the one beyond which it lies farthest).
    pub(crate) outside: Option<(f64, usize)>,
    /// Normals of the walls on which it lies, into the region.
    pub(crate) normals: Vec<Vector3<f64>>,
}

impl Space {
    /// Where a point lies. A point given on a wall is on it within the rounding of coordinates.
    pub(crate) fn touched(&self, point: &Vector3<f64>) -> Touched {
        let walls = match self {
            Space::Named(table) => table.walls_at(point),
            Space::Room(room) => {
                let seen = |(piece, solid): (usize, &Solid)| {
                    let Closest { distance, normal, .. } = solid.closest(point);
                    WallAt { piece, distance, normal, slack: solid.slack(point) }
                };
                room.solids().iter().enumerate().map(seen).collect()
            }
        };
        let mut touched = Touched::default();
        for WallAt { piece, distance, normal, slack } in walls {
            if distance < -slack {
                if touched.outside.is_none_or(|(most, _)| most < -distance) {
                    touched.outside = Some((-distance, piece));
                }
            } else if distance <= slack {
                touched.normals.push(normal);
            }
        }
        touched
    }

    /// Whether a path that starts on walls of a room hits one at once, as a path from an edge may although it leaves one face.
    fn is_hit_at_once(&self, path: &Line<3>) -> bool {
        let Space::Room(room) = self else { return false };
        let speed = path.velocity.norm();
        let at_once =
            |solid: &Solid| solid.first_hit(path).is_some_and(|hit| hit.time * speed <= solid.slack(&path.point));
        room.solids().iter().any(at_once)
    }

    /// The time after which a path that starts on walls of a room, and may hit one at once, is away from them.
    fn time_to_leave(&self, path: &Line<3>) -> Option<f64> {
        let Space::Room(room) = self else { return None };
        room.time_to_leave(path)
    }

    /// The distance of a point from the boundary; negative outside.
    pub(crate) fn distance(&self, point: &Vector3<f64>) -> f64 {
        match self {
            Space::Named(table) => table.signed_distance(point),
            Space::Room(room) => room.distance(point),
        }
    }

    /// A box around the bounded walls of a room.
    fn bounded(&self) -> Option<Extent<3>> {
        let Space::Room(room) = self else { return None };
        let boxes = room.solids().iter().map(Solid::extent);
        remote::bounded(boxes)
    }

    /// A box around the region; infinite where the region is.
    pub(crate) fn extent(&self) -> Extent<3> {
        match self {
            Space::Named(table) => table.extent(),
            Space::Room(room) => room.extent(),
        }
    }
}

impl Spatial {
    /// Builds everything and checks every start.
    pub(crate) fn new(scene: &Scene) -> Result<Spatial, Vec<Diagnostic>> {
        let entered = match &scene.table.shape {
            TableShape::Named { .. } => vec![],
            TableShape::Boundary(entries) => room::walls(scene, entries)?,
        };
        let factor = to_unity(boundary::lengths(scene, entered.iter().filter_map(Entered::size_in_file)));
        let (built_in, centres, shift, walls, pieces, mut laws) = match &scene.table.shape {
            TableShape::Named { model, arguments, .. } => {
                let table = named(scene, model.name, arguments, factor).map_err(|d| vec![*d])?;
                let ends = table.extent().max / factor;
                let sizes = ["size_1", "size_2", "size_3"].into_iter().zip(ends.iter().copied().map(short));
                let with_sizes =
                    |name: &&str| sizes.clone().fold(String::from(*name), |name, (of, x)| name.replace(of, &x));
                let pieces: Vec<String> = table.pieces().iter().map(with_sizes).collect();
                let laws = vec![None; pieces.len()];
                let wall = |(spec, center, side)| Wall { spec, center, side }.scaled(1.0 / factor);
                let walls = table.solids().into_iter().map(wall).collect();
                let (centres, shift) = table.offset(scene.particle.radius.value * factor).map_err(|error| {
                    vec![match error {
                        Error::NothingLeft { largest, .. } => room::too_large(scene, largest / factor),
                        error => *boundary::wrong_argument(scene, arguments, &error, factor),
                    }]
                })?;
                (Some(table), Space::Named(centres), shift, walls, pieces, laws)
            }
            TableShape::Boundary(entries) => {
                let room = room::between(scene, entries, &entered, factor)?;
                let (walls, pieces): (Vec<_>, Vec<_>) =
                    entered.into_iter().map(|entered| (entered.wall, entered.name)).unzip();
                let laws = entries.iter().map(|entry| entry.law.as_ref().map(|law| law.kind.clone())).collect();
                (None, Space::Room(room), Vector3::zeros(), walls, pieces, laws)
            }
        };
        boundary::own_laws(scene, &mut laws).map_err(|d| vec![*d])?;
        let kinds: Vec<_> = laws.iter().map(|own| own.as_ref().unwrap_or(&scene.law.kind)).collect();
        let gamma = libm::sqrt(scene.particle.gamma_squared.value);
        let place = Place { radius: scene.particle.radius.value * factor, shift, factor };
        let law = SpatialLaw::new(&kinds, gamma, &place)
            .map_err(|what| vec![scene.source.diagnostic(scene.law.span, what)])?;
        let strict = law.is_strict();
        let starts = match &scene.starts {
            scene::Starts::Orbits(orbits) => {
                let given = start::all(orbits, |orbit| checked(scene, &centres, &walls, &shift, orbit, factor));
                Starts::Given(given.map_err(|wrong| {
                    if has_no_place(&centres, &walls, factor) { vec![room::no_place(scene)] } else { wrong }
                })?)
            }
            scene::Starts::Ensemble(ensemble) => Starts::Ensemble(ensemble.clone(), Spins::of(&scene.particle)),
        };
        if let Starts::Ensemble(ensemble, _) = &starts {
            match ensemble.sample.value {
                Sample::Canonical => {}
                Sample::Grid => {
                    let what = "in space, the sample must be \"canonical\"";
                    return Err(vec![scene.source.diagnostic(ensemble.sample.span, what)]);
                }
            }
            if let Space::Room(room) = &centres {
                room.surface().map_err(|error| match error {
                    Error::Vanished if has_no_place(&centres, &walls, factor) => vec![room::no_place(scene)],
                    other => vec![start::undrawable(scene, ensemble, &other)],
                })?;
            }
        }
        drop(kinds);
        Ok(Spatial {
            built_in,
            centres,
            shift,
            factor,
            radius: scene.particle.radius.value,
            walls,
            pieces,
            laws,
            law,
            strict,
            starts,
        })
    }

    /// How many orbits there are.
    pub(crate) fn orbits(&self) -> u64 {
        self.starts.count()
    }

    /// A box around the walls as drawn, in the scene's unit; infinite where they are.
    pub(crate) fn extent(&self) -> Extent<3> {
        let Extent { min, max } = drawn(&self.walls, self.factor).extent();
        Extent { min: min / self.factor, max: max / self.factor }
    }

    /// The start of an orbit, by its number.
    pub(crate) fn starts(&self) -> Result<ByNumber<'_, 3, 3>, billiards::Error> {
        let (ensemble, spins) = match self.starts.given() {
            Ok(starts) => return Ok(starts),
            Err(ensemble) => ensemble,
        };
        let scale = Scale { length: self.factor, speed: to_unity([ensemble.speed.value]) };
        let surface: Box<dyn Surface + '_> = match &self.centres {
            Space::Named(table) => Box::new(table),
            Space::Room(room) => Box::new(room.surface()?),
        };
        let (speed, seed) = (ensemble.speed.value * scale.speed, ensemble.seed);
        let drawn: Box<dyn billiards::Starts<3, 3>> = match spins {
            Spins::Spinning => Box::new(CanonicalSpatial::new(surface, speed, seed)?),
            Spins::Still => Box::new(Still(CanonicalSpatial::of_points(surface, speed, seed)?)),
        };
        Ok(Box::new(move |i| {
            let start = drawn.start(i);
            let (position, velocity, spin) = (start.position, start.velocity, start.spin);
            Start { position, velocity, spin, angle: 0.0, cell: [0.0; 2], departure: 0.0, scale }
        }))
    }

    /// An orbit at its start.
    pub(crate) fn launch(&self, start: &Start<3, 3>) -> Watched<3, 3, ()> {
        let orbit = Orbit {
            position: start.position,
            velocity: start.velocity,
            spin: start.spin,
            keeper: conserved(self.strict, &start.velocity, &start.spin),
            track: (Clock::new(0.0), ()),
        };
        departed(orbit, start.departure)
    }

    /// How long the digits of the first orbits last, within a number of collisions and a time.
    pub(crate) fn horizons(&self, limit: [f64; 2], control: &Control) -> Result<Horizons, billiards::Error> {
        let starts = self.starts()?;
        let Extent { min, max } = self.centres.extent();
        let size = horizon::size(min.as_slice(), max.as_slice());
        Ok(self.with_engine(|engine| {
            let billiard: &dyn Bounce<3, 3> = engine;
            let of_room;
            let walls: &(dyn Bend<3> + Sync) = match &self.centres {
                Space::Named(table) => table,
                Space::Room(room) => {
                    of_room = FeltRoom { felt: Felt(billiard), room };
                    &of_room
                }
            };
            let launch = |orbit| {
                let start = starts(orbit);
                (start, self.launch(&start))
            };
            Horizons::of(engine, walls, size, self.orbits(), &launch, limit, control)
        }))
    }

    /// Whether no collision under a strict law turns velocity into spin.
    pub(crate) fn keeps_spin(&self) -> bool {
        keeps_spin(&self.law, self.laws.len())
    }

    /// Runs something with the engine for this table and law.
    pub(crate) fn with_engine<R>(&self, then: impl FnOnce(&dyn Engine<3, 3, ()>) -> R) -> R {
        let on = OnWalls { law: &self.law, then: WithEngine(then) };
        match &self.centres {
            Space::Named(table) => table.with_walls(on),
            Space::Room(room) => room.with_walls(on),
        }
    }
}

/// A built-in table as drawn, all lengths multiplied by a factor.
fn named(scene: &Scene, name: &str, arguments: &Arguments, factor: f64) -> Result<SpatialTable, Box<Diagnostic>> {
    let wrong = |error: &Error| boundary::wrong_argument(scene, arguments, error, factor);
    let entry = tables::find(name).ok_or_else(|| wrong(&Error::Empty))?;
    let values = entry.scaled(&boundary::values(entry, arguments), factor);
    entry.spatial(&values).map_err(|error| wrong(&error))
}

/// The room between walls as drawn, all lengths multiplied by a factor.
fn drawn(walls: &[Wall], factor: f64) -> Room {
    let scaled = walls.iter().map(|wall| wall.scaled(factor));
    Room::new(scaled.filter_map(|wall| wall.spec.solid(wall.center, wall.side).ok()).collect())
}

/// Whether no place for the particle is found between walls as drawn, although there is room for a point; all lengths multiplied by a factor.
fn has_no_place(centres: &Space, walls: &[Wall], factor: f64) -> bool {
    let Space::Room(room) = centres else { return false };
    matches!(room.surface(), Err(Error::Vanished)) && drawn(walls, factor).surface().is_ok()
}

/// A start in a region of space, or what is wrong with it. The region's origin lies at `shift`.
fn checked(
    scene: &Scene,
    centres: &Space,
    walls: &[Wall],
    shift: &Vector3<f64>,
    orbit: &scene::Orbit,
    length: f64,
) -> Result<Start<3, 3>, Box<Diagnostic>> {
    let mut start: Start<3, 3> = start::scaled(orbit, length);
    let point = Vector3::from(start.position) - shift;
    start.position = point.into();
    let velocity = Vector3::from(start.velocity);
    if let Some(remote) = centres.bounded().and_then(|walls| Remote::of(&point, &velocity, &walls)) {
        return Err(Box::new(start::too_far(scene, orbit, &remote, length)));
    }
    let touched = centres.touched(&point);
    let at = orbit.position.span;
    if let Some((distance, piece)) = touched.outside {
        // in front of an open mesh, its region of centres ends no farther away than the radius
        let behind = distance / length - scene.particle.radius.value;
        if let Some(mesh) = walls.get(piece).filter(|wall| behind > 0.0 && wall.spec.rims() > 0) {
            return Err(Box::new(start_behind(scene, at, behind, piece, mesh.side)));
        }
        return Err(Box::new(start::outside(scene, at, distance / length, piece as u64)));
    }
    let (leaves, path) = (touched.normals.iter().all(|normal| velocity.dot(normal) > 0.0), Line { point, velocity });
    if leaves && !centres.is_hit_at_once(&path) {
        return Ok(start);
    }
    let Some(departure) = centres.time_to_leave(&path) else {
        let what = "the start lies on a wall and does not move into the table";
        return Err(Box::new(
            scene.source.diagnostic(at, what).with_help("turn the velocity, or start farther from the wall"),
        ));
    };
    start.departure = departure;
    Ok(start)
}

/// The error that a start lies this far behind an open mesh.
fn start_behind(scene: &Scene, at: Span, distance: f64, piece: usize, side: Side) -> Diagnostic {
    let what = format!(
        "the start lies {} behind piece {piece}, an open mesh with the table on its other side",
        short(distance)
    );
    let other = if side == Side::Outside { "inside" } else { "outside" };
    let help = format!("start in front of it, or exchange its sides with domain = \"{other}\"");
    scene.source.diagnostic(at, what).with_help(help)
}

/// The walls of a room, with their curvature, for error estimates.
struct FeltRoom<'a> {
    felt: Felt<'a, 3, 3>,
    room: &'a Room,
}

impl Bend<3> for FeltRoom<'_> {
    fn bend(&self, hit: &WallHit<f64, 3>, flight: f64, along: &[f64; 3]) -> [f64; 3] {
        self.felt.bend(hit, flight, along)
    }
    fn size(&self, hit: &WallHit<f64, 3>) -> f64 {
        self.room.solids().get(hit.number()).map_or(0.0, Solid::size)
    }
}

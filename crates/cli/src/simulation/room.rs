//! A region of space bounded entry by entry.

use billiards::geometry::Error;
use billiards::geometry::import::{self, Imported, Place};
use billiards::geometry::parry::{Room, Side, SolidSpec};

use crate::document::{Diagnostic, LARGEST, SMALLEST, Spanned, spell};
use crate::scene::{self, Border, Domain, Entry, Scene};

use super::boundary::in_user_units;
use super::drawing::{self, Reader};
use super::wires::Wall;
use super::words::short;

/// A wall of an explicit boundary as drawn: every entry is one piece.
pub(crate) struct Entered {
    pub(crate) name: String,
    pub(crate) wall: Wall,
    /// Where each triangle is in the file of a mesh.
    places: Vec<Place>,
}

/// The walls of an explicit boundary.
pub(crate) fn walls(scene: &Scene, entries: &[Entry]) -> Result<Vec<Entered>, Vec<Diagnostic>> {
    entries.iter().map(|entry| wall(scene, entry).map_err(|wrong| vec![*wrong])).collect()
}

/// The room for the centre of the particle between walls, all lengths multiplied by a factor.
pub(crate) fn between(
    scene: &Scene,
    entries: &[Entry],
    walls: &[Entered],
    factor: f64,
) -> Result<Room, Vec<Diagnostic>> {
    let radius = scene.particle.radius.value;
    let (mut solids, mut wrong) = (vec![], vec![]);
    for (entered, entry) in walls.iter().zip(entries) {
        let wall = entered.wall.scaled(factor).of_centres(radius * factor);
        match wall.and_then(|wall| wall.spec.solid(wall.center, wall.side)) {
            Ok(solid) => solids.push(solid),
            Err(Error::NothingLeft { largest, .. }) => wrong.push(too_large(scene, largest / factor)),
            Err(error) => wrong.push(scene.source.diagnostic(entry.span, entered.complaint(&error, factor))),
        }
    }
    if wrong.is_empty() { Ok(Room::new(solids)) } else { Err(wrong) }
}

impl Entered {
    /// The largest coordinate of a mesh about its centre; `None` for what the scene itself describes.
    pub(crate) fn size_in_file(&self) -> Option<f64> {
        (!self.places.is_empty()).then(|| largest(&self.wall.spec))
    }

    /// An error about this wall, all lengths multiplied by a factor, in the user's units and with the place in its file.
    fn complaint(&self, error: &Error, factor: f64) -> String {
        match error {
            Error::Triangle { triangle, problem } if *triangle < self.places.len() => {
                format!("{}, {}: the face {problem}", self.name, self.places[*triangle])
            }
            error => in_user_units(error, factor).to_string(),
        }
    }
}

/// The error that the particle does not fit, and the largest that would.
pub(crate) fn too_large(scene: &Scene, largest: f64) -> Diagnostic {
    let what = format!(
        "a ball of radius {} has no room to move in the table; its radius must be less than {}",
        spell(scene.particle.radius.value),
        short(largest)
    );
    scene.source.diagnostic(scene.particle.radius.span, what)
}

/// The error that no place for the particle was found between the walls, although a smaller one
/// would fit.
pub(crate) fn no_place(scene: &Scene) -> Diagnostic {
    let what = format!(
        "a ball of radius {} has no room to move between the walls: no point that far from all of them was found",
        spell(scene.particle.radius.value)
    );
    let diagnostic = scene.source.diagnostic(scene.particle.radius.span, what);
    diagnostic.with_help("make the radius smaller, or put the walls farther apart")
}

/// An entry of the boundary.
fn wall(scene: &Scene, entry: &Entry) -> Result<Entered, Box<Diagnostic>> {
    let mut places = vec![];
    let (name, spec, center, side) = match &entry.border {
        Border::Circle { center, radius, domain } => {
            ("sphere", SolidSpec::Ball { radius: radius.value }, coordinates(&center.value), side(*domain))
        }
        Border::Plane { through, normal } => {
            let normal = SolidSpec::HalfSpace { normal: coordinates(&normal.value) };
            ("plane", normal, coordinates(&through.value), Side::Outside)
        }
        Border::Shape { shape: scene::Shape::Spatial { name, spec, center }, domain, .. } => {
            (*name, spec.clone(), *center, side(*domain))
        }
        Border::Mesh { file, unit, center, domain } => {
            let read = mesh(scene, file, *unit)?;
            places = read.places;
            (&file.value[..], read.walls, coordinates(&center.value), side(*domain))
        }
        _ => return Err(Box::new(scene.source.diagnostic(entry.span, "this is no wall in space"))),
    };
    Ok(Entered { name: name.into(), wall: Wall { spec, center, side }, places })
}

/// Triangles from a file whose unit has this length.
fn mesh(scene: &Scene, file: &Spanned<String>, unit: f64) -> Result<Imported<SolidSpec>, Box<Diagnostic>> {
    let readers: [(&str, Reader<Imported<SolidSpec>>); 2] =
        [("stl", import::stl), ("obj", |bytes| import::obj(&String::from_utf8_lossy(bytes)))];
    let Imported { walls, places } = drawing::read(scene, file, "a mesh is read from a .stl or .obj file", &readers)?;
    let walls = walls.scaled(unit);
    let largest = largest(&walls);
    if (SMALLEST..=LARGEST).contains(&largest) {
        return Ok(Imported { walls, places });
    }
    let what = format!("the largest coordinate of {} is {}", file.value, short(largest));
    let help =
        format!("coordinates, times `unit`, may be as large as {LARGEST:e} and must not all be below {SMALLEST:e}");
    Err(Box::new(scene.source.diagnostic(file.span, what).with_help(help)))
}

/// The largest coordinate of a mesh.
fn largest(mesh: &SolidSpec) -> f64 {
    match mesh {
        SolidSpec::TriMesh { vertices, .. } => vertices.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs())),
        _ => 0.0,
    }
}

fn coordinates(p: &[f64]) -> [f64; 3] {
    [0, 1, 2].map(|i| p[i])
}

fn side(domain: Domain) -> Side {
    match domain {
        Domain::Inside => Side::Inside,
        Domain::Outside => Side::Outside,
    }
}

//! A region of space bounded entry by entry.

use billiards::geometry::Error;
use billiards::geometry::parry::{Room, Side, Solid, SolidSpec};

use crate::document::{Diagnostic, spell};
use crate::scene::{self, Border, Domain, Entry, Scene};

use super::words::short;

/// The room of an explicit boundary, all lengths multiplied by a factor, and what each piece is. Every entry is one piece.
pub(crate) fn explicit(scene: &Scene, entries: &[Entry], factor: f64) -> Result<(Room, Vec<String>), Vec<Diagnostic>> {
    let (mut solids, mut names, mut wrong) = (vec![], vec![], vec![]);
    let radius = scene.particle.radius.value;
    for entry in entries {
        match solid(&entry.border, radius, factor) {
            Ok((name, solid)) => {
                names.push(name);
                solids.push(solid);
            }
            Err(Error::NothingLeft { largest, .. }) => wrong.push(too_large(scene, largest / factor)),
            Err(error) => wrong.push(scene.source.diagnostic(entry.span, error.to_string())),
        }
    }
    if wrong.is_empty() { Ok((Room::new(solids), names)) } else { Err(wrong) }
}

/// That the particle has no room, and what would have.
pub(crate) fn too_large(scene: &Scene, largest: f64) -> Diagnostic {
    let what = format!(
        "a ball of radius {} has no room to move in the table; its radius must be less than {}",
        spell(scene.particle.radius.value),
        short(largest)
    );
    scene.source.diagnostic(scene.particle.radius.span, what)
}

/// An entry of the boundary, moved into the table by the particle's radius, and what it is.
fn solid(border: &Border, radius: f64, factor: f64) -> Result<(String, Solid), Error> {
    let (name, spec, center, side) = match border {
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
        _ => return Err(Error::Shape { shape: "shape", why: "it is planar" }),
    };
    let (spec, shift) = spec.scaled(factor).parallel(side, radius * factor)?;
    let center = [0, 1, 2].map(|i| center[i] * factor + shift[i]);
    Ok((name.into(), spec.solid(center, side)?))
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

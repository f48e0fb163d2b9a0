//! A region of space bounded entry by entry.

use billiards::geometry::parry::{Room, Side, Solid, SolidSpec};
use billiards::geometry::{Error, Vector3};

use crate::document::Diagnostic;
use crate::scene::{self, Border, Domain, Entry, Scene};

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
            Err(error) => wrong.push(scene.source.diagnostic(entry.span, error.to_string())),
        }
    }
    if wrong.is_empty() { Ok((Room::new(solids), names)) } else { Err(wrong) }
}

/// An entry of the boundary, moved into the table by the particle's radius, and what it is.
fn solid(border: &Border, radius: f64, factor: f64) -> Result<(String, Solid), Error> {
    let point = |p: &[f64]| [0, 1, 2].map(|i| p[i] * factor);
    let moved = radius * factor;
    match border {
        Border::Circle { center, radius, domain } => {
            let inside = *domain == Domain::Inside;
            let radius = radius.value * factor + if inside { -moved } else { moved };
            let side = side(*domain);
            Ok(("sphere".into(), SolidSpec::Ball { radius }.solid(point(&center.value), side)?))
        }
        Border::Plane { through, normal } => {
            let unit = super::scale::to_unity(normal.value.iter().copied());
            let normal = Vector3::from_fn(|i, _| normal.value[i] * unit);
            let through = Vector3::from(point(&through.value)) + normal * (moved / normal.norm());
            let half = SolidSpec::HalfSpace { normal: normal.into() };
            Ok(("plane".into(), half.solid(through.into(), Side::Outside)?))
        }
        Border::Shape { shape, domain, .. } if radius == 0.0 => match shape {
            scene::Shape::Spatial { name, spec, center } => {
                Ok(((*name).into(), spec.scaled(factor).solid(center.map(|x| x * factor), side(*domain))?))
            }
            scene::Shape::Planar { .. } => Err(Error::Shape { shape: "shape", why: "it is planar" }),
        },
        _ => Err(Error::Shape {
            shape: "shape",
            why: "in space, particles of positive radius move between spheres and planes only; give the shape a rounding instead",
        }),
    }
}

fn side(domain: Domain) -> Side {
    match domain {
        Domain::Inside => Side::Inside,
        Domain::Outside => Side::Outside,
    }
}

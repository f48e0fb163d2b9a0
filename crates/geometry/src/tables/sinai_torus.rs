//! The Sinai billiard on a torus.
use super::registry::{Build, Entry, Parameter};
use super::vertices::{positive, within};
use crate::{Error, Lattice, Table, shapes::Circle};
use nalgebra::Vector2;

/// The flat torus with unit cell `[0, side)²` without the disk of the given radius about its middle \[L\]; one piece.
/// Area of a cell `a² − π r²`, perimeter `2π r`.
///
/// The periodic Lorentz gas on the square lattice. Dispersing; ergodic and mixing with specular reflections
/// ([Sinai 1970]).
///
/// # Errors
/// [`Error::Parameter`] unless both are positive and finite, and the disks of neighbouring cells are disjoint.
pub fn sinai_torus(radius: f64, side: f64) -> Result<Table, Error> {
    positive("radius", radius)?;
    positive("side", side)?;
    within("radius", radius, 2.0 * radius < side, "less than half of side")?;
    let lattice = Lattice::new(&[Vector2::new(side, 0.0), Vector2::new(0.0, side)])?;
    Table::periodic(vec![Box::new(Circle::new(Vector2::repeat(0.5 * side), radius, false)?)], Some(lattice))
}

pub(super) const ENTRY: Entry = Entry {
    name: "sinai-torus",
    summary: "a disk in the middle of a square whose opposite sides are identified (Sinai)",
    parameters: &[Parameter::length("radius", 0.25), Parameter::length("side", 1.0)],
    build: Build::Planar(|v| sinai_torus(v.number("radius")?, v.number("side")?)),
};

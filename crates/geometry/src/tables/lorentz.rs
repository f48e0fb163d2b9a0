//! The periodic Lorentz gas.
use super::registry::{Build, Entry, Parameter};
use super::vertices::{positive, within};
use crate::{Error, Lattice, Table, shapes::Circle};
use nalgebra::Vector2;

/// The plane without disks of radius `r` about the points of the hexagonal lattice `a (1, 0)`, `a (1/2, √3/2)` with
/// spacing `a` \[L\], the origin among them; one piece. Area of a cell `√3 a²/2 − π r²`, perimeter `2π r`.
///
/// The horizon is finite (no free flight is longer than some bound) where `r ≥ √3 a/4`. References: [Lorentz 1905],
/// [Bunimovich–Sinai 1981].
///
/// # Errors
/// [`Error::Parameter`] unless both are positive and finite, and the disks are disjoint.
pub fn lorentz(radius: f64, spacing: f64) -> Result<Table, Error> {
    positive("radius", radius)?;
    positive("spacing", spacing)?;
    within("radius", radius, 2.0 * radius < spacing, "less than half of spacing")?;
    let lattice = Lattice::new(&[Vector2::new(spacing, 0.0), Vector2::new(0.5, 0.5 * 3.0_f64.sqrt()) * spacing])?;
    Table::periodic(vec![Box::new(Circle::new(Vector2::zeros(), radius, false)?)], Some(lattice))
}

pub(super) const ENTRY: Entry = Entry {
    name: "lorentz",
    summary: "disks at the points of a hexagonal lattice (Lorentz)",
    parameters: &[Parameter::length("radius", 0.45).required(), Parameter::length("spacing", 1.0)],
    build: Build::Planar(|v| lorentz(v.number("radius")?, v.number("spacing")?)),
};

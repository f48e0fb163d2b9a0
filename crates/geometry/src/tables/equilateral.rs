//! The equilateral triangle.
use super::registry::{Build, Entry, Parameter};
use super::vertices::{positive, sides};
use crate::{Error, Table};
use nalgebra::Vector2;

/// The triangle `(0, 0), (a, 0), (a/2, √3 a/2)` of side `a` \[L\]; piece i starts at vertex i. Area `√3 a²/4`,
/// perimeter `3 a`.
///
/// Every no-slip orbit of a uniform disk in it is periodic up to rotation, with period 2, 3, 4 or 6.
///
/// # Errors
/// [`Error::Parameter`] unless the side is positive and finite.
pub fn equilateral(side: f64) -> Result<Table, Error> {
    positive("side", side)?;
    let apex = Vector2::new(0.5, 0.5 * 3.0_f64.sqrt()) * side;
    Table::new(sides(&[Vector2::zeros(), Vector2::new(side, 0.0), apex])?)
}

pub(super) const ENTRY: Entry = Entry {
    name: "equilateral",
    summary: "an equilateral triangle with a vertex at the origin and a side along +x1",
    parameters: &[Parameter::length("side", 1.0)],
    build: Build::Planar(|v| equilateral(v.number("side")?)),
};

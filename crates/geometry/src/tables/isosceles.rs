//! The isosceles triangle.
use super::registry::{Build, Entry, Parameter};
use super::vertices::{positive, sides};
use crate::{Error, Table};
use nalgebra::Vector2;

/// The triangle `(−b/2, 0), (b/2, 0), (0, h)` with base `b` and height `h` \[L\]; pieces: 0 base, then
/// counter-clockwise. Area `b h/2`, perimeter `b + √(b² + 4 h²)`.
///
/// # Errors
/// [`Error::Parameter`] unless base and height are positive and finite.
pub fn isosceles(base: f64, height: f64) -> Result<Table, Error> {
    let half = 0.5 * positive("base", base)?;
    positive("height", height)?;
    Table::new(sides(&[Vector2::new(-half, 0.0), Vector2::new(half, 0.0), Vector2::new(0.0, height)])?)
}

pub(super) const ENTRY: Entry = Entry {
    name: "isosceles",
    summary: "an isosceles triangle, base on the x1 axis with its middle at the origin",
    parameters: &[Parameter::length("base", 1.0), Parameter::length("height", 1.25)],
    build: Build::Planar(|v| isosceles(v.number("base")?, v.number("height")?)),
};

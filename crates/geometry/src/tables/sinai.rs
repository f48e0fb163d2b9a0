//! The Sinai billiard in a square.
use super::rectangle;
use super::registry::{Build, Entry, Parameter};
use super::vertices::{positive, sides, within};
use crate::{Error, Table, shapes::Circle};
use nalgebra::Vector2;

/// The square `0 < x₁, x₂ < side` without the disk of the given radius in its middle \[L\]; pieces: 0 bottom, then
/// counter-clockwise, 4 the disk. Area `a² − π r²`, perimeter `4 a + 2π r`.
///
/// Dispersing; ergodic and mixing with specular reflections ([Sinai 1970]).
///
/// # Errors
/// [`Error::Parameter`] unless both are positive and finite, and the disk fits into the square.
pub fn sinai(side: f64, radius: f64) -> Result<Table, Error> {
    positive("side", side)?;
    positive("radius", radius)?;
    within("radius", radius, 2.0 * radius < side, "less than half of side")?;
    let mut pieces = sides(&rectangle::corners([side, side])?)?;
    pieces.push(Box::new(Circle::new(Vector2::repeat(0.5 * side), radius, false)?));
    Table::new(pieces)
}

pub(super) const ENTRY: Entry = Entry {
    name: "sinai",
    summary: "a square with a disk in its middle (Sinai)",
    parameters: &[Parameter::length("side", 1.0), Parameter::length("radius", 0.25)],
    build: Build::Planar(|v| sinai(v.number("side")?, v.number("radius")?)),
};

//! The rectangle.
use super::registry::{Build, Entry, Parameter};
use super::vertices::{positive, sides};
use crate::{Error, Table};
use nalgebra::Vector2;

/// The vertices of a rectangle with a corner at the origin, once its size is checked.
pub(super) fn corners([width, height]: [f64; 2]) -> Result<[Vector2<f64>; 4], Error> {
    positive("size", width)?;
    positive("size", height)?;
    Ok([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]].map(Vector2::from))
}

/// The rectangle `0 < xᵢ < sizeᵢ` \[L\]; pieces: 0 bottom, then counter-clockwise. Area `a b`, perimeter `2 (a + b)`.
///
/// # Errors
/// [`Error::Parameter`] unless the sizes are positive and finite.
pub fn rectangle(size: [f64; 2]) -> Result<Table, Error> {
    Table::new(sides(&corners(size)?)?)
}

pub(super) const ENTRY: Entry = Entry {
    name: "rectangle",
    summary: "a rectangle with a corner at the origin",
    parameters: &[Parameter::lengths("size", &[2.0, 1.0])],
    build: Build::Planar(|v| rectangle(v.list("size")?)),
};

//! The strip between two parallel lines.
use super::registry::{Build, Entry, Parameter};
use super::vertices::positive;
use crate::{Error, Piece, Table, shapes::FullLine};
use nalgebra::Vector2;

/// The strip `0 < x₂ < width` \[L\]; pieces: 0 lower, 1 upper. Infinite.
///
/// Every no-slip orbit that is not parallel to the strip stays within a bounded part of it ([Broomhead–Gutkin
/// 1993]).
///
/// # Errors
/// [`Error::Parameter`] unless the width is positive and finite.
pub fn strip(width: f64) -> Result<Table, Error> {
    positive("width", width)?;
    let line = |height: f64, direction: f64| -> Result<Box<dyn Piece>, Error> {
        Ok(Box::new(FullLine::new(Vector2::new(0.0, height), Vector2::new(direction, 0.0))?))
    };
    Table::new(vec![line(0.0, 1.0)?, line(width, -1.0)?])
}

pub(super) const ENTRY: Entry = Entry {
    name: "strip",
    summary: "the plane between two parallel lines, 0 < x2 < width",
    parameters: &[Parameter::length("width", 1.0)],
    build: Build::Planar(|v| strip(v.number("width")?)),
};

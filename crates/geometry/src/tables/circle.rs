//! The disk.
use super::registry::{Build, Entry, Parameter};
use super::vertices::positive;
use crate::{Error, Table, shapes::Circle};
use nalgebra::Vector2;

/// The disk of the given radius \[L\] about the origin; one piece. Area `π r²`, perimeter `2π r`.
///
/// Integrable, for the specular and the no-slip law alike.
///
/// # Errors
/// [`Error::Parameter`] unless the radius is positive and finite.
pub fn circle(radius: f64) -> Result<Table, Error> {
    positive("radius", radius)?;
    Table::new(vec![Box::new(Circle::new(Vector2::zeros(), radius, true)?)])
}

pub(super) const ENTRY: Entry = Entry {
    name: "circle",
    summary: "the inside of a circle about the origin",
    parameters: &[Parameter::length("radius", 1.0)],
    build: Build::Planar(|v| circle(v.number("radius")?)),
};

//! The inside of a sphere.
use super::registry::{Build, Entry, Parameter};
use super::{SpatialTable, vertices::positive};
use crate::{Error, walls::Sphere};
use nalgebra::Vector3;

/// The ball of the given radius \[L\] about the origin; one piece. Volume `4π r³/3`, surface `4π r²`.
///
/// # Errors
/// [`Error::Parameter`] unless the radius is positive and finite, [`Error::Length`] unless it is between 10⁻¹⁵⁰ and 10¹⁵⁰.
pub fn ball(radius: f64) -> Result<SpatialTable, Error> {
    positive("radius", radius)?;
    Ok(SpatialTable::ball(radius, Sphere::new(Vector3::zeros(), radius, 0)?))
}

pub(super) const ENTRY: Entry = Entry {
    name: "ball",
    summary: "the inside of a sphere about the origin",
    parameters: &[Parameter::length("radius", 1.0)],
    build: Build::Spatial(|v| ball(v.number("radius")?)),
};

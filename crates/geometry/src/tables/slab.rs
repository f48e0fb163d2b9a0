//! The slab between two planes.
use super::registry::{Build, Entry, Parameter};
use super::{SpatialTable, vertices::positive};
use crate::{Error, walls::Slab};

/// The slab `0 < x₃ < height` \[L\]; pieces: 0 floor, 1 ceiling. Volume and surface are infinite.
///
/// A no-slip ball in it stays within a bounded part, unless it moves parallel to the planes.
///
/// # Errors
/// [`Error::Parameter`] unless the height is positive and finite.
pub fn slab(height: f64) -> Result<SpatialTable, Error> {
    positive("height", height)?;
    Ok(SpatialTable::slab(height, Slab::new(0.0, height, [0, 1])?))
}

pub(super) const ENTRY: Entry = Entry {
    name: "slab",
    summary: "the space between two parallel planes, 0 < x3 < height",
    parameters: &[Parameter::length("height", 1.0)],
    build: Build::Spatial(|v| slab(v.number("height")?)),
};

//! The box.
use super::registry::{Build, Entry, Parameter};
use super::{SpatialTable, vertices::positive};
use crate::{Error, walls::Cuboid};

/// The box `0 < xᵢ < sizeᵢ` \[L\]; the lower and the upper wall of axis i = 0, 1, 2 are the pieces 2 i and 2 i + 1.
///
/// Volume `a b c`, surface `2 (a b + b c + c a)`.
///
/// # Errors
/// [`Error::Parameter`] unless the sizes are positive and finite.
pub fn cuboid(size: [f64; 3]) -> Result<SpatialTable, Error> {
    for length in size {
        positive("size", length)?;
    }
    Ok(SpatialTable::cuboid(size, Cuboid::new([0.0; 3], size, [[0, 1], [2, 3], [4, 5]])?))
}

pub(super) const ENTRY: Entry = Entry {
    name: "box",
    summary: "the inside of a box, 0 < x_i < size_i",
    parameters: &[Parameter::lengths("size", &[1.0, 1.0, 1.0])],
    build: Build::Spatial(|v| cuboid(v.list("size")?)),
};

//! The regular hexagon.
use super::registry::{Build, Entry, Parameter};
use super::{polygon, vertices::positive};
use crate::{Error, Table};

/// The regular hexagon of side `a` \[L\] about the origin, vertex 0 at `(a, 0)`; piece i starts at vertex i. Area
/// `3√3 a²/2`, perimeter `6 a`.
///
/// # Errors
/// [`Error::Parameter`] unless the side is positive and finite.
pub fn hexagon(side: f64) -> Result<Table, Error> {
    positive("side", side)?;
    polygon(6, side)
}

pub(super) const ENTRY: Entry = Entry {
    name: "hexagon",
    summary: "a regular hexagon about the origin, a vertex on the +x1 axis",
    parameters: &[Parameter::length("side", 1.0)],
    build: Build::Planar(|v| hexagon(v.number("side")?)),
};

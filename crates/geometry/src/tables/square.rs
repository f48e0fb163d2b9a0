//! The square.
use super::registry::{Build, Entry, Parameter};
use super::{rectangle, vertices::positive};
use crate::{Error, Table};

/// The square `0 < x₁, x₂ < side` \[L\]; pieces: 0 bottom, then counter-clockwise. Area `a²`, perimeter `4 a`.
///
/// # Errors
/// [`Error::Parameter`] unless the side is positive and finite.
pub fn square(side: f64) -> Result<Table, Error> {
    positive("side", side)?;
    rectangle([side, side])
}

pub(super) const ENTRY: Entry = Entry {
    name: "square",
    summary: "a square with a corner at the origin",
    parameters: &[Parameter::length("side", 1.0)],
    build: Build::Planar(|v| square(v.number("side")?)),
};

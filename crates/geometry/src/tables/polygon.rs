//! Regular polygons.
use super::registry::{Build, Entry, Parameter};
use super::vertices::{number_of, positive, regular};
use crate::{Error, Table};

/// The regular polygon with `n` sides of length `a` \[L\] about the origin, vertex 0 on the +x₁ axis; piece i starts at
/// vertex i. Area `n a²/(4 tan(π/n))`, perimeter `n a`.
///
/// # Errors
/// [`Error::Count`] unless there are 3 to 1 000 000 sides, [`Error::Parameter`] unless their length is positive and finite.
pub fn polygon(n: usize, side: f64) -> Result<Table, Error> {
    number_of("sides", n, 3)?;
    positive("side", side)?;
    Table::new(regular(n, side)?)
}

pub(super) const ENTRY: Entry = Entry {
    name: "polygon",
    summary: "a regular polygon about the origin, a vertex on the +x1 axis",
    parameters: &[Parameter::count("sides", 3, 5.0).required(), Parameter::length("side", 1.0)],
    build: Build::Planar(|v| polygon(v.count("sides")?, v.number("side")?)),
};

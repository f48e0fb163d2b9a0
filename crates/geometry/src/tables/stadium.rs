//! The stadium.
use super::registry::{Build, Entry, Parameter};
use super::vertices::positive;
use crate::{Error, Outline, Table, shapes::Arc};
use nalgebra::Vector2;

/// The stadium: all points within `r` of the segment from `(−h, 0)` to `(h, 0)` \[L\]; pieces: 0 bottom side, 1 right
/// cap, 2 top side, 3 left cap. Area `4 h r + π r²`, perimeter `4 h + 2π r`.
///
/// Ergodic and hyperbolic with specular reflections ([Bunimovich 1979]); not ergodic without slip.
///
/// # Errors
/// [`Error::Parameter`] unless half length and radius are positive and finite.
pub fn stadium(half_length: f64, radius: f64) -> Result<Table, Error> {
    let (h, r) = (positive("half_length", half_length)?, positive("radius", radius)?);
    let v = Vector2::new;
    let cap = |x: f64, from: f64| Arc::with_radius(v(x, 0.0), r, v(x, from), v(x, -from), true);
    let outline = Outline::from(v(-h, -r))
        .line_to(v(h, -r))?
        .piece(Box::new(cap(h, -r)?))?
        .line_to(v(-h, r))?
        .piece(Box::new(cap(-h, r)?))?;
    Table::new(outline.close()?)
}

pub(super) const ENTRY: Entry = Entry {
    name: "stadium",
    summary: "two half disks joined by straight sides (Bunimovich), centre at the origin",
    parameters: &[Parameter::length("half_length", 1.0), Parameter::length("radius", 1.0)],
    build: Build::Planar(|v| stadium(v.number("half_length")?, v.number("radius")?)),
};

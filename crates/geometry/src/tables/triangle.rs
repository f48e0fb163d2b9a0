//! Any triangle.
use super::registry::{Build, Entry, Parameter};
use super::vertices::{sides, within};
use crate::{Error, Table};
use nalgebra::Vector2;

/// The triangle with the given vertices \[L\], counter-clockwise; piece i starts at vertex i. Area
/// `½ (b − a) × (c − a)`.
///
/// # Errors
/// [`Error::Parameter`] unless the vertices are finite, [`Error::ZeroLength`] where two coincide, and
/// [`Error::Orientation`] where they are clockwise or on one line.
pub fn triangle(vertices: [Vector2<f64>; 3]) -> Result<Table, Error> {
    for &x in vertices.iter().flat_map(|v| v.iter()) {
        within("vertices", x, x.is_finite(), "finite")?;
    }
    let pieces = sides(&vertices)?;
    let [a, b, c] = vertices;
    let (ab, ac) = (b - a, c - a);
    // scaled, so that neither a large nor a small triangle is misjudged
    let (ab, ac) = (ab / ab.amax(), ac / ac.amax());
    if ab.perp(&ac) > 0.0 { Table::new(pieces) } else { Err(Error::Orientation { piece: 0 }) }
}

pub(super) const ENTRY: Entry = Entry {
    name: "triangle",
    summary: "a triangle, its vertices counter-clockwise",
    parameters: &[Parameter::points("vertices", &[[0.0, 0.0], [1.0, 0.0], [0.25, 0.75]]).required()],
    build: Build::Planar(|v| triangle(v.points("vertices")?)),
};

//! The ellipse.
use super::registry::{Build, Entry, Parameter};
use super::vertices::positive;
use crate::{Error, Table, shapes::Ellipse};
use nalgebra::Vector2;

/// The ellipse `x₁²/a² + x₂²/b² < 1` with semi-axes `[a, b]` \[L\]; one piece. Area `π a b`, perimeter `4 a E(e)`, a
/// complete elliptic integral.
///
/// Integrable with specular reflections: the product of the angular momenta about the two foci is conserved.
///
/// # Errors
/// [`Error::Parameter`] unless the semi-axes are positive and finite.
pub fn ellipse(semi_axes: [f64; 2]) -> Result<Table, Error> {
    for length in semi_axes {
        positive("semi_axes", length)?;
    }
    Table::new(vec![Box::new(Ellipse::new(Vector2::zeros(), semi_axes, 0.0, true)?)])
}

pub(super) const ENTRY: Entry = Entry {
    name: "ellipse",
    summary: "the inside of an ellipse about the origin, axes along x1 and x2",
    parameters: &[Parameter::lengths("semi_axes", &[2.0, 1.0])],
    build: Build::Planar(|v| ellipse(v.list("semi_axes")?)),
};

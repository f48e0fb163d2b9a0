//! The wedge between two rays.
use super::registry::{Build, Entry, Parameter};
use super::vertices::within;
use crate::{Error, Table, shapes::Ray};
use core::f64::consts::{FRAC_PI_3, PI};
use nalgebra::Vector2;

/// The wedge of the given opening angle (radians) with its apex at the origin and the bisector along +x₂; pieces:
/// 0 right wall, 1 left wall. Infinite.
///
/// # Errors
/// [`Error::Parameter`] unless the angle is between 0 and π.
pub fn wedge(angle: f64) -> Result<Table, Error> {
    within("angle", angle, angle > 0.0 && angle < PI, "between 0 and pi")?;
    let (sin, cos) = (libm::sin(0.5 * angle), libm::cos(0.5 * angle));
    let apex = Vector2::zeros();
    Table::new(vec![
        Box::new(Ray::new(apex, Vector2::new(sin, cos), true)?),
        Box::new(Ray::new(apex, Vector2::new(-sin, cos), false)?),
    ])
}

pub(super) const ENTRY: Entry = Entry {
    name: "wedge",
    summary: "the plane between two rays from the origin, bisector along +x2",
    parameters: &[Parameter::angle("angle", FRAC_PI_3).required()],
    build: Build::Planar(|v| wedge(v.number("angle")?)),
};

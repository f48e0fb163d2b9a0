//! Bodies, one per file.

mod ball;
mod planar;
mod point;
mod rigid;
mod spatial;

pub use ball::Ball;
pub use planar::Planar;
pub use point::Point;
pub use rigid::{Inertia, RigidBody};
pub use spatial::Spatial;

use crate::Error;

/// `value`, if it is positive and finite.
fn positive(quantity: &'static str, value: f64) -> Result<f64, Error> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(Error::NotPositive { quantity, value }) }
}

/// `value`, a product of positive numbers, if it lies in the range where numbers have all their digits.
fn in_range(quantity: &'static str, value: f64) -> Result<f64, Error> {
    if value.is_normal() {
        return Ok(value);
    }
    Err(if value.is_finite() { Error::TooSmall { quantity, value } } else { Error::TooLarge { quantity } })
}

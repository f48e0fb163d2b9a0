//! The channel with curved walls.
use super::registry::{Build, Entry, Parameter};
use super::vertices::{positive, within};
use crate::{
    Error, Lattice, Piece, Table,
    shapes::{Arc, Segment},
};
use nalgebra::Vector2;

/// Least non-zero sagitta, in units of the length. Points of an arc carry the rounding of its radius, here 125 000
/// lengths.
const FLATTEST: f64 = 1e-6;

/// A channel of period `length` along x₁ whose walls are equal arcs with ends at `x₂ = 0` and `x₂ = height`; pieces:
/// 0 lower, 1 upper.
///
/// The arcs rise by `sagitta` into the table (`> 0`: concave walls, dispersing), or recede from it (`< 0`: convex
/// walls, focusing); all are lengths \[L\]. Their radius is `(length²/4 + sagitta²)/(2 |sagitta|)`. With 0 the walls
/// are straight.
///
/// # Errors
/// [`Error::Parameter`] unless length and height are positive and finite, the sagitta is between minus and plus half
/// of the length and less than half of the height (so that arcs do not overlap), and it is 0 or at least a millionth
/// of the length.
pub fn channel(length: f64, height: f64, sagitta: f64) -> Result<Table, Error> {
    positive("length", length)?;
    positive("height", height)?;
    within("sagitta", sagitta, 2.0 * sagitta.abs() < length, "between minus and plus half of length")?;
    within("sagitta", sagitta, 2.0 * sagitta < height, "less than half of height (so that the channel is open)")?;
    let flat = sagitta != 0.0 && sagitta.abs() < FLATTEST * length;
    within(
        "sagitta",
        sagitta,
        !flat,
        "0, or at least a millionth of length (a flatter wall cannot be told from a straight one)",
    )?;
    let v = Vector2::new;
    let half = 0.5 * length;
    // from `a` to `b`, table on the left; `up` = +1 where that is above
    let wall = |a: Vector2<f64>, b: Vector2<f64>, up: f64| -> Result<Box<dyn Piece>, Error> {
        if sagitta == 0.0 {
            return Ok(Box::new(Segment::new(a, b)?));
        }
        let radius = 0.5 * (half * (half / sagitta.abs()) + sagitta.abs());
        // from the chord to the centre, which lies outside the table where the wall disperses:
        // (half² − sagitta²)/(2 sagitta)
        let offset = 0.5 * (half + sagitta) * ((half - sagitta) / sagitta);
        let center = v(half, a.y - up * offset);
        Ok(Box::new(Arc::with_radius(center, radius, a, b, sagitta < 0.0)?))
    };
    let lower = wall(v(0.0, 0.0), v(length, 0.0), 1.0)?;
    let upper = wall(v(length, height), v(0.0, height), -1.0)?;
    Table::periodic(vec![lower, upper], Some(Lattice::new(&[v(length, 0.0)])?))
}

pub(super) const ENTRY: Entry = Entry {
    name: "channel",
    summary: "a channel whose walls bulge into it (sagitta > 0) or out of it (< 0), its ends identified",
    parameters: &[
        Parameter::length("length", 1.0),
        Parameter::length("height", 1.0),
        Parameter::displacement("sagitta", 0.125).required(),
    ],
    build: Build::Planar(|v| channel(v.number("length")?, v.number("height")?, v.number("sagitta")?)),
};

//! The flower.
use super::registry::{Build, Entry, Parameter};
use super::vertices::{number_of, on_circumcircle, positive, root_of_unity, within};
use crate::{Error, Outline, Table, shapes::Arc};
use nalgebra::Vector2;

/// The flower: a regular `n`-gon about the origin with sides of length `a` replaced by arcs of radius `ρ ≥ a/2` that
/// bulge outwards \[L\], at most half circles; piece 0 is on the right, then counter-clockwise.
///
/// The petals' centres lie `a/(2 tan(π/n)) − √(ρ² − a²/4)` from the origin. With `n = 4` and `a = 2` the corners are
/// `(±1, ±1)`. With specular reflections it is ergodic where the petals' circles lie inside ([Bunimovich 1979]).
///
/// # Errors
/// [`Error::Count`] unless there are 2 to 1 000 000 petals, [`Error::Parameter`] unless their size is positive and finite.
pub fn flower(petals: usize, petal_radius: f64, side: f64) -> Result<Table, Error> {
    let n = number_of("petals", petals, 2)?;
    let radius = positive("petal_radius", petal_radius)?;
    let half = 0.5 * positive("side", side)?;
    within("petal_radius", radius, radius >= half, "at least half of side (so that a petal spans it)")?;
    let [cos, sin] = root_of_unity(1, 2 * n);
    let center = half * (cos / sin) - ((radius - half) * (radius + half)).sqrt();
    let corner = |k: usize| on_circumcircle(2 * k + 2 * n - 1, n, side);
    let mut outline = Outline::from(corner(0));
    for k in 0..n {
        let center = Vector2::from(root_of_unity(k, n)) * center;
        outline = outline.piece(Box::new(Arc::with_radius(center, radius, corner(k), corner((k + 1) % n), true)?))?;
    }
    Table::new(outline.close()?)
}

pub(super) const ENTRY: Entry = Entry {
    name: "flower",
    summary: "arcs that bulge outwards between corners on a circle about the origin, the first one centred on +x1 (Bunimovich)",
    parameters: &[
        Parameter::count("petals", 2, 4.0),
        Parameter::length("petal_radius", 1.25),
        Parameter::length("side", 2.0),
    ],
    build: Build::Planar(|v| flower(v.count("petals")?, v.number("petal_radius")?, v.number("side")?)),
};

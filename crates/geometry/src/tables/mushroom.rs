//! The mushroom.
use super::registry::{Build, Entry, Parameter};
use super::vertices::{positive, within};
use crate::{Error, Outline, Table, shapes::Arc};
use nalgebra::Vector2;

/// The mushroom: the upper half of the disk of radius `r` about the origin on a stem of width `w < 2 r` and height `h`
/// \[L\]; pieces: 0 stem bottom, 1 stem right, 2 cap floor right, 3 cap, 4 cap floor left, 5 stem left. Area
/// `π r²/2 + w h`, perimeter `(π + 2) r + 2 h`.
///
/// With specular reflections it has an integrable island, the orbits that never leave the cap, and one ergodic
/// component ([Bunimovich 2001]).
///
/// # Errors
/// [`Error::Parameter`] unless all are positive and finite, and the stem is narrower than the cap.
pub fn mushroom(cap_radius: f64, stem_width: f64, stem_height: f64) -> Result<Table, Error> {
    let r = positive("cap_radius", cap_radius)?;
    let w = 0.5 * positive("stem_width", stem_width)?;
    let h = positive("stem_height", stem_height)?;
    within("stem_width", stem_width, w < r, "less than twice cap_radius")?;
    let v = Vector2::new;
    let outline = Outline::from(v(-w, -h))
        .line_to(v(w, -h))?
        .line_to(v(w, 0.0))?
        .line_to(v(r, 0.0))?
        .piece(Box::new(Arc::with_radius(v(0.0, 0.0), r, v(r, 0.0), v(-r, 0.0), true)?))?
        .line_to(v(-w, 0.0))?
        .line_to(v(-w, -h))?;
    Table::new(outline.close()?)
}

pub(super) const ENTRY: Entry = Entry {
    name: "mushroom",
    summary: "a half disk on a rectangular stem (Bunimovich), the cap's centre at the origin",
    parameters: &[
        Parameter::length("cap_radius", 1.0),
        Parameter::length("stem_width", 0.5),
        Parameter::length("stem_height", 0.75),
    ],
    build: Build::Planar(|v| mushroom(v.number("cap_radius")?, v.number("stem_width")?, v.number("stem_height")?)),
};

//! The pocketed rectangle.
use super::rectangle;
use super::registry::{Build, Entry, Parameter};
use super::vertices::{positive, within};
use crate::{Error, Outline, Table, shapes::Arc};
use nalgebra::Vector2;

/// A rectangle with a corner at the origin and a circular pocket in the middle of its top side; pieces: 0 bottom,
/// 1 right, 2 top right, 3 pocket, 4 top left, 5 left.
///
/// The pocket is part of a circle of radius `r` and reaches `d` beyond the side \[L\], `0 < d < 2 r`: an arc that is
/// more than half a circle where `d > r`. Its opening has the width `2 √(d (2 r − d))`, less than the rectangle's.
///
/// # Errors
/// [`Error::Parameter`] unless all are positive and finite, the pocket is open, and its opening fits into the side.
pub fn pocket(size: [f64; 2], pocket_radius: f64, pocket_depth: f64) -> Result<Table, Error> {
    let [a, b, c, d] = rectangle::corners(size)?;
    let r = positive("pocket_radius", pocket_radius)?;
    let depth = positive("pocket_depth", pocket_depth)?;
    within("pocket_depth", depth, depth < 2.0 * r, "less than twice pocket_radius (so that the pocket is open)")?;
    let half = (depth * (2.0 * r - depth)).sqrt();
    let v = Vector2::new;
    let middle = 0.5 * c.x;
    within("size", c.x, half < middle, "wider than the opening of the pocket")?;
    let (right, left) = (v(middle + half, c.y), v(middle - half, c.y));
    let circle = Arc::with_radius(v(middle, c.y + (depth - r)), r, right, left, true)?;
    let outline =
        Outline::from(a).line_to(b)?.line_to(c)?.line_to(right)?.piece(Box::new(circle))?.line_to(d)?.line_to(a)?;
    Table::new(outline.close()?)
}

pub(super) const ENTRY: Entry = Entry {
    name: "pocket",
    summary: "a rectangle with a circular pocket that reaches pocket_depth beyond the middle of its top side",
    parameters: &[
        Parameter::lengths("size", &[2.0, 1.0]),
        Parameter::length("pocket_radius", 0.3125),
        Parameter::length("pocket_depth", 0.5625),
    ],
    build: Build::Planar(|v| pocket(v.list("size")?, v.number("pocket_radius")?, v.number("pocket_depth")?)),
};

//! Open wedges: bounded orbits, periodic at special angles.
use super::super::camera::{along, cross};
use super::super::motion::{Path, follow, no_slip};
use super::super::portrait::colour;
use super::super::sheet::{LABEL, Sheet, fit};
use super::super::{Drawing, Effort, Figure};
use crate::picture::{Anchor, Style, Window};
use billiards::geometry::{Error, tables};
use core::f64::consts::PI;
use paper::wedge;

pub(super) const FIGURE: Figure = Figure {
    name: "wedges",
    title: "Wedges of four angles",
    place: "Figure 9",
    caption: "Bounded orbits in open wedges. For most angles they are not periodic (left and right). For θ = π/3 they have period 4 in \
              the reduced phase space, whatever the start, and the disk is turned by some angle after each period; for θ = 0.27092 \
              they have period 10, and the rotation returns too.",
    parameters: "θ = 0.8, π/3, 0.27092 (α = 6π/5) and 2; uniform disk, γ² = 1/2. The disk starts on the bisector, its velocity 0.6 ρ from \
                 the axis of periodicity, ρ the radius of the cap of velocities that never escape. 90 collisions; 24 at π/3, 40 at 0.27092.",
    draw,
};

/// The uniform disk's `γ²`.
pub(super) const HALF: f64 = 0.5;

/// A bounded orbit in the wedge of angle `theta`: from the bisector, its velocity a part of ρ away from the axis, in the
/// direction `side` (0: outwards).
pub(super) fn bounded(theta: f64, part: f64, side: f64, collisions: u64) -> Result<Path, Error> {
    let axis = wedge::axis(theta, HALF);
    let out = [0.0, 0.0, 1.0];
    let tilt = along(out.map(|x| x * libm::cos(side)), libm::sin(side), cross(axis, out));
    let rho = part * wedge::inradius(theta, HALF);
    let v = along(axis.map(|x| x * libm::cos(rho)), libm::sin(rho), tilt);
    Ok(follow(&no_slip(tables::wedge(theta)?), [0.0, 0.0, 1.0], v, collisions))
}

/// Draws a wedge with an orbit into a panel.
pub(super) fn panel(
    sheet: &mut Sheet,
    theta: f64,
    path: &Path,
    corner: [f64; 2],
    size: [f64; 2],
    width: f64,
) -> Result<(), Error> {
    let table = tables::wedge(theta)?;
    let points = path.plane();
    let high = points.iter().fold(0.0_f64, |m, p| m.max(p[1]));
    let half = points.iter().fold(0.0_f64, |m, p| m.max(p[0].abs()));
    let window = Window { low: [-half, -0.02 * high], high: [half, high] }.padded(0.05);
    let view = fit(window, corner, size[0], size[1]);
    sheet.chain(&view, points, Style::line(colour(0), width));
    sheet.within(&view, |sheet| sheet.walls(&view, &table));
    Ok(())
}

fn draw(_: Effort) -> Drawing {
    let special = 0.270_918_520_456_220_2;
    let mut sheet = Sheet::new(330.0, 124.0);
    let panels = [(0.8, "θ = 0.8", 90), (PI / 3.0, "θ = π/3", 24), (special, "θ = 0.2709…", 40), (2.0, "θ = 2", 90)];
    let mut left = 3.0;
    for (i, (theta, name, collisions)) in panels.into_iter().enumerate() {
        let width = [78.0, 82.0, 46.0, 112.0][i];
        let path = bounded(theta, 0.6, 0.9, collisions)?;
        panel(&mut sheet, theta, &path, [left, 3.0], [width, 104.0], if collisions > 60 { 0.25 } else { 0.5 })?;
        sheet.label_as([left + 0.5 * width, 116.0], LABEL, Anchor::Middle, name);
        left += width + 2.0;
    }
    Ok(sheet.svg)
}

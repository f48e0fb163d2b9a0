//! The approach to the axis of periodicity.
use super::super::camera::unit;
use super::super::motion::{follow, no_slip};
use super::super::sheet::{LABEL, Sheet};
use super::super::{Drawing, Effort, Figure};
use super::wedges::panel;
use crate::picture::Anchor;
use billiards::geometry::tables;
use core::f64::consts::FRAC_PI_2;

pub(super) const FIGURE: Figure = Figure {
    name: "wedge-axis",
    title: "The axis of periodicity of a right angle",
    place: "Figure 10",
    caption: "In the wedge of angle π/2 an orbit with ẋ₀ = ẋ₁ and ẋ₂ = 0 has period 2 (right). With a little of ẋ₂ the orbits surround it: from \
              left to right ẋ₂ becomes smaller. In general the axis is ẋ₀/ẋ₁ = sin(θ/2)/γ, rotation counted counter-clockwise.",
    parameters: "θ = π/2, uniform disk, γ² = 1/2, velocities proportional to (1, 1, ẋ₂), from the bisector; 60 collisions. The paper \
                 counts x₀ clockwise: there the velocities are (−1, 1, ẋ₂).",
    draw,
};

fn draw(_: Effort) -> Drawing {
    let billiard = no_slip(tables::wedge(FRAC_PI_2)?);
    let mut sheet = Sheet::new(336.0, 84.0);
    for (i, (outwards, name)) in
        [(0.25, "ẋ_2 = 0.25"), (0.1, "ẋ_2 = 0.1"), (0.02, "ẋ_2 = 0.02"), (0.0, "ẋ_2 = 0")].into_iter().enumerate()
    {
        let path = follow(&billiard, [0.0, 0.0, 1.0], unit([1.0, 1.0, outwards]), 60);
        let left = 3.0 + 83.0 * i as f64;
        panel(&mut sheet, FRAC_PI_2, &path, [left, 3.0], [80.0, 62.0], 0.35)?;
        sheet.label_as([left + 40.0, 76.0], LABEL, Anchor::Middle, name);
    }
    Ok(sheet.svg)
}

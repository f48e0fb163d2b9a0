//! The wedge in which all bounded orbits have period eight.
use super::super::sheet::Sheet;
use super::super::{Drawing, Effort, Figure};
use super::wedges::{bounded, panel};
use crate::picture::COLUMN;
use paper::wedge;

pub(super) const FIGURE: Figure = Figure {
    name: "wedge-period-eight",
    title: "The wedge of period eight",
    place: "Figure 12",
    caption: "In the wedge of angle θ = arccos(1/2 − (3/2) cos(π/4)) = 2.16598 two collisions turn velocities by α = π/2, and every bounded \
              orbit has period 8 up to rotation: two of them. For period 2n take α = 2π/n; the paper's π/n gives 4n.",
    parameters: "Uniform disk, γ² = 1/2; starts on the bisector, velocities 0.45 ρ and 0.6 ρ from the axis of periodicity; 32 collisions.",
    draw,
};

fn draw(_: Effort) -> Drawing {
    let theta = wedge::opening_of_turn(core::f64::consts::FRAC_PI_2).ok_or("no such wedge")?;
    let mut sheet = Sheet::new(COLUMN, 150.0);
    for (i, (part, side)) in [(0.45, 0.5), (0.6, 1.1)].into_iter().enumerate() {
        let path = bounded(theta, part, side, 32)?;
        panel(&mut sheet, theta, &path, [8.0, 3.0 + 74.0 * i as f64], [COLUMN - 16.0, 70.0], 0.5)?;
    }
    Ok(sheet.svg)
}

//! The circle and its two caustics.
use super::super::motion::{Path, follow, no_slip};
use super::super::portrait::colour;
use super::super::sheet::{LABEL, Sheet, fit};
use super::super::{Drawing, Effort, Figure, UNIFORM};
use crate::picture::{Anchor, Colour, Style, Window};
use billiards::geometry::{Error, tables};

pub(super) const FIGURE: Figure = Figure {
    name: "circle-caustics",
    title: "Double caustics of the circle",
    place: "Figure 14",
    caption: "Orbits in a circle touch two concentric caustics in turn, each flight at its middle (left). They coincide for \
              ẋ₁ = √2 ẋ₀, where rotation never changes and orbits are those of a standard billiard (middle), and also for \
              ẋ₀ = −√2 ẋ₁, a family the paper leaves out: the velocity reverses at every collision, and the orbit goes to and fro on one \
              chord (right).",
    parameters: "Radius 1, uniform disk, γ² = 1/2; (v₀, vₜ) = (0.42, 0.28), 80 collisions; (0.5, 0.71), 40 collisions; (0.55, −0.39).",
    draw,
};

/// The orbit that leaves the lowest point of the unit circle with tangential velocity (v₀, vₜ), the normal one given.
pub(super) fn orbit([v0, vt]: [f64; 2], vn: f64, collisions: u64) -> Result<Path, Error> {
    Ok(follow(&no_slip(tables::circle(1.0)?), [0.0, 0.0, -1.0], [v0, -vt, vn], collisions))
}

fn draw(_: Effort) -> Drawing {
    let side = 105.0;
    let mut sheet = Sheet::new(3.0 * (side + 4.0) + 2.0, side + 20.0);
    let root = libm::sqrt(2.0);
    let panels = [
        ([0.42, 0.28], 80, "r_1 ≠ r_2"),
        ([0.5, 0.5 * root], 40, "ẋ_1 = √2 ẋ_0"),
        ([0.55, -0.55 / root], 4, "ẋ_0 = −√2 ẋ_1"),
    ];
    for (i, (v, collisions, name)) in panels.into_iter().enumerate() {
        let left = 3.0 + (side + 4.0) * i as f64;
        let view = fit(Window { low: [-1.0, -1.0], high: [1.0, 1.0] }, [left, 3.0], side, side);
        let vn = (1.0 - v[0] * v[0] - v[1] * v[1]).sqrt();
        let path = orbit(v, vn, collisions)?;
        sheet.chain(&view, path.plane(), Style::line(colour(0), if collisions > 10 { 0.3 } else { 0.7 }));
        // γ² = 1/2: vₜ after the next collision
        let next = (2.0 * UNIFORM * v[0] + (1.0 - UNIFORM * UNIFORM) * v[1]) / (1.0 + UNIFORM * UNIFORM);
        for (tau, ink) in [(v[1], colour(1)), (next, colour(2))] {
            let r = tau.abs() / libm::hypot(tau, vn);
            sheet.svg.circle(view.place([0.0, 0.0]), r * view.scale(), Style::line(ink, 0.8));
        }
        sheet.svg.circle(view.place([0.0, 0.0]), view.scale(), Style::line(Colour::BLACK, 0.7));
        sheet.label_as([left + 0.5 * side, side + 13.0], LABEL, Anchor::Middle, name);
    }
    Ok(sheet.svg)
}

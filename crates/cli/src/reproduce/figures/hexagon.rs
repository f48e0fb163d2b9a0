//! The velocity portrait of the hexagon.
use super::super::motion::{follow, no_slip};
use super::super::portrait::{Portrait, colour, starts};
use super::super::sheet::{Sheet, fit};
use super::super::{Drawing, Effort, Figure};
use crate::picture::{Style, Window};
use billiards::geometry::tables;

pub(super) const FIGURE: Figure = Figure {
    name: "hexagon",
    title: "The regular hexagon",
    place: "Figure 4",
    caption: "Left: one orbit of a disk that does not slip. Right: the velocity portrait, the points (v₀, vₜ) after every collision, of \
              many orbits, each in its colour. Closed curves surround periodic points; nothing here looks ergodic.",
    parameters: "Side 1, uniform disk, γ² = 1/2; orbits start by the canonical measure (seed 4): 150 × 1500 collisions, with --quick \
                 80 × 1000; those that spread over an area are grey. The orbit on the left is one of them, 200 collisions.",
    draw,
};

fn draw(effort: Effort) -> Drawing {
    let billiard = no_slip(tables::hexagon(1.0)?);
    let (orbits, collisions) = if effort == Effort::Quick { (80, 1000) } else { (150, 1500) };
    let starts = starts(&billiard.table, 4, orbits)?;
    let mut portrait = Portrait::new(480);
    portrait.orbits(&billiard, &starts, collisions);
    let mut sheet = Sheet::new(320.0, 164.0);
    let half = libm::sqrt(3.0) / 2.0;
    let view = fit(Window { low: [-1.0, -half], high: [1.0, half] }, [3.0, 3.0], 150.0, 158.0);
    let s = &starts[5];
    let x = [0.0, s.position[0], s.position[1]];
    let path = follow(&billiard, x, [s.spin[0], s.velocity[0], s.velocity[1]], 200);
    sheet.chain(&view, path.plane(), Style::line(colour(0), 0.35).with_opacity(0.8));
    sheet.walls(&view, &billiard.table);
    portrait.draw(&mut sheet, [160.0, 3.0], 158.0);
    Ok(sheet.svg)
}

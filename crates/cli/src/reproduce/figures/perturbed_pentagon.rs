//! The pentagon, bent more and more.
use super::super::motion::no_slip;
use super::super::portrait::{Portrait, starts};
use super::super::sheet::{LABEL, Sheet, fit};
use super::super::{Drawing, Effort, Figure};
use crate::picture::{Anchor, Window};
use billiards::geometry::tables;

pub(super) const FIGURE: Figure = Figure {
    name: "perturbed-pentagon",
    title: "The pentagon with bent sides",
    place: "Figure 21",
    caption: "Velocity portraits of regular pentagons whose sides are bent outwards by smooth bumps, C² at the vertices. Closed curves persist under \
              small perturbations, and the largest survive the larger ones.",
    parameters: "Side 1, bumps of height 0.003, 0.01 and 0.03; uniform disk, γ² = 1/2; orbits start by the canonical measure (seed 12): 100 × 2500 \
                 collisions each (--quick 60 × 800), grey where they spread over an area.",
    draw,
};

fn draw(effort: Effort) -> Drawing {
    let (orbits, collisions) = if effort == Effort::Quick { (60, 800) } else { (100, 2500) };
    let side = 118.0;
    let mut sheet = Sheet::new(3.0 * (side + 3.0) + 3.0, side + 19.0);
    for (i, amount) in [0.003, 0.01, 0.03].into_iter().enumerate() {
        let billiard = no_slip(tables::perturbed_polygon(5, 1.0, amount)?);
        let mut portrait = Portrait::new(560);
        portrait.orbits(&billiard, &starts(&billiard.table, 12, orbits)?, collisions);
        let left = 3.0 + (side + 3.0) * i as f64;
        portrait.draw(&mut sheet, [left, 3.0], side);
        let extent = billiard.table.extent();
        let window = Window { low: extent.min.into(), high: extent.max.into() };
        let view = fit(window, [left + side - 18.0, 3.0], 18.0, 18.0);
        sheet.walls(&view, &billiard.table);
        sheet.label_as([left + 0.5 * side, side + 12.0], LABEL, Anchor::Middle, &format!("{amount}"));
    }
    Ok(sheet.svg)
}

//! Portraits of the stadium, the mushroom, the pocketed rectangle and the moon.
use super::super::motion::no_slip;
use super::super::portrait::{Portrait, starts};
use super::super::sheet::{Sheet, fit};
use super::super::{Drawing, Effort, Figure};
use crate::picture::Window;
use billiards::geometry::tables;

pub(super) const FIGURE: Figure = Figure {
    name: "portraits",
    title: "Stadium, mushroom, pocket and moon",
    place: "Figure 20",
    caption: "Velocity portraits of four tables whose standard billiards are ergodic or have a large ergodic component. Without slip, closed \
              curves of bounded orbits lie inside seas that look chaotic. Stadium and pocketed rectangle above, mushroom and moon below; the \
              table in the corner of each.",
    parameters: "Stadium 1, 1; pocket 2 × 1 with radius 0.3125 and depth 0.3125; mushroom 1, 0.5, 0.75; moon 1, 0.75, 1. Uniform disk, \
                 γ² = 1/2; orbits start by the canonical measure (seed 11): 700 × 5000 collisions each (--quick 150 × 2000), \
                 grey where they spread over an area.",
    draw,
};

fn draw(effort: Effort) -> Drawing {
    let (orbits, collisions) = if effort == Effort::Quick { (150, 2000) } else { (700, 5000) };
    let side = 158.0;
    let mut sheet = Sheet::new(2.0 * side + 9.0, 2.0 * side + 9.0);
    let all = [
        tables::stadium(1.0, 1.0)?,
        tables::pocket([2.0, 1.0], 0.3125, 0.3125)?,
        tables::mushroom(1.0, 0.5, 0.75)?,
        tables::moon(1.0, 0.75, 1.0)?,
    ];
    for (i, table) in all.into_iter().enumerate() {
        let corner = [3.0 + (side + 3.0) * (i % 2) as f64, 3.0 + (side + 3.0) * (i / 2) as f64];
        let billiard = no_slip(table);
        let mut portrait = Portrait::new(620);
        portrait.orbits(&billiard, &starts(&billiard.table, 11, orbits)?, collisions);
        portrait.draw(&mut sheet, corner, side);
        let extent = billiard.table.extent();
        let window = Window { low: extent.min.into(), high: extent.max.into() };
        let view = fit(window, [corner[0] + side - 25.0, corner[1]], 25.0, 18.0);
        sheet.walls(&view, &billiard.table);
    }
    Ok(sheet.svg)
}

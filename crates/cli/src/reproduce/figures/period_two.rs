//! Stability of the period-2 orbit between two disks.
use super::super::camera::unit;
use super::super::motion::{follow, no_slip};
use super::super::portrait::colour;
use super::super::sheet::{LABEL, Sheet, fit};
use super::super::{BEYOND, Drawing, Effort, Figure};
use crate::picture::{Anchor, Colour, Stroke, Style, Window};
use billiards::geometry::tables;

pub(super) const FIGURE: Figure = Figure {
    name: "period-two",
    title: "Stability of period two",
    place: BEYOND,
    caption: "A disk on a torus, near the orbit that goes to and fro between two neighbours, perpendicular to both, on either side of the threshold. \
              If the gap d between the disks of radius R is less than 2γ²R this period-2 orbit is elliptic and what starts near it stays near \
              (left). If it is more the orbit is hyperbolic and they leave (right). Period-2 orbits at an angle a to the normals have spin and \
              a greater threshold, chords of the length 2(γ² + sin²a)R/cos a.",
    parameters: "Spacing 1, uniform disk, γ² = 1/2: d/R = 0.778 < 1 for R = 0.36, d/R = 1.226 > 1 for R = 0.31. Both start in the middle of the gap with \
                 v proportional to (0.06, 1, 0.06); the first 160 of 400 collisions are drawn.",
    draw,
};

fn draw(_: Effort) -> Drawing {
    let side = 132.0;
    let mut sheet = Sheet::new(2.0 * side + 12.0, side + 20.0);
    for (i, (radius, name)) in [(0.36, "d/R = 0.78"), (0.31, "d/R = 1.23")].into_iter().enumerate() {
        let billiard = no_slip(tables::sinai_torus(radius, 1.0)?);
        let path = follow(&billiard, [0.0, 0.0, 0.5], unit([0.06, 1.0, 0.06]), 400);
        let gone = path.hits.iter().position(|h| h.x[1].abs() > 0.5 || (h.x[2] - 0.5).abs() > 0.5);
        let left = 3.0 + (side + 6.0) * i as f64;
        let view = fit(Window { low: [-0.27, 0.23], high: [0.27, 0.77] }, [left, 3.0], side, side);
        sheet.within(&view, |sheet| {
            for x in [-0.5, 0.5] {
                let outline = Stroke::Circle { center: [x, 0.5], radius }.outline(&view);
                sheet.svg.path(&outline, Style::line(Colour::BLACK, 0.7).filled(Colour::SOLID));
            }
            let points = path.plane().into_iter().take(gone.map_or(161, |n| n + 2));
            sheet.chain(&view, points, Style::line(colour(i), 0.3));
        });
        sheet.svg.rectangle(
            view.place([-0.27, 0.23]),
            view.place([0.27, 0.77]),
            Style::line(Colour(0xa0, 0xa0, 0xa0), 0.35),
        );
        let text = format!("{name}, \"{} collisions\"", gone.unwrap_or(path.hits.len()));
        sheet.label_as([left + 0.5 * side, side + 13.0], LABEL, Anchor::Middle, &text);
    }
    Ok(sheet.svg)
}

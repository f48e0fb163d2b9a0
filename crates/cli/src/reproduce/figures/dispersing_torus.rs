//! The disk on a torus and its bounded component.
use super::super::camera::unit;
use super::super::motion::{follow, no_slip};
use super::super::portrait::{Portrait, SEA, colour, starts};
use super::super::sheet::{Sheet, fit};
use super::super::{Drawing, Effort, Figure};
use crate::picture::{Colour, Stroke, Style, Window};
use billiards::geometry::tables;

pub(super) const FIGURE: Figure = Figure {
    name: "dispersing-torus",
    title: "A dispersing billiard with a bounded component",
    place: "Figure 5, right",
    caption: "A disk on a flat torus, that is, the periodic Lorentz gas. With specular reflections this billiard is ergodic. Without slip, \
              orbits near the period-2 orbit perpendicular to two neighbours stay there for ever if the gap is less than 2γ² radii (left; \
              coloured curves on the right); others wander through the grey sea. If the gap is greater, there are orbits that stay \
              as well, near period-2 orbits with spin, at an angle to both neighbours.",
    parameters: "Radius 0.4, spacing 1: gap/R = 1/2 < 2γ² = 1. Orbits start by the canonical measure (seed 6): 30 × 20 000 collisions \
                 (--quick 15 × 4000); 10 more start in the gap.",
    draw,
};

const RADIUS: f64 = 0.4;

fn draw(effort: Effort) -> Drawing {
    let billiard = no_slip(tables::sinai_torus(RADIUS, 1.0)?);
    let (orbits, collisions) = if effort == Effort::Quick { (15, 4000) } else { (30, 20_000) };
    let mut portrait = Portrait::new(760);
    for start in &starts(&billiard.table, 6, orbits)? {
        portrait.orbit(&billiard, start, collisions, SEA);
    }
    let mut sheet = Sheet::new(310.0, 156.0);
    let window = Window { low: [-0.04, 0.0], high: [2.04, 2.0] };
    let view = fit(window, [3.0, 3.0], 150.0, 150.0);
    let disk = |i: u32, j: u32| Stroke::Circle { center: [f64::from(i) + 0.5, f64::from(j) + 0.5], radius: RADIUS };
    for k in 0..4 {
        let outline = disk(k % 2, k / 2).outline(&view);
        sheet.svg.path(&outline, Style::line(Colour::BLACK, 0.7).filled(Colour::SOLID));
    }
    let guide = Style::line(Colour(0xa0, 0xa0, 0xa0), 0.35);
    for t in [0.0, 1.0, 2.0] {
        sheet.dashed(view.place([t, 0.0]), view.place([t, 2.0]), guide);
        sheet.dashed(view.place([0.0, t]), view.place([2.0, t]), guide);
    }
    for i in 0..10_u32 {
        let (a, b) = (0.09 * f64::from(i % 5), 0.11 * f64::from(i / 5));
        let path = follow(&billiard, [0.0, 0.0, 0.5], unit([a, 1.0, 0.02 + b]), 3000);
        let stays = path.hits.iter().all(|hit| hit.x[1].abs() < 0.2 && (hit.x[2] - 0.5).abs() < 0.4);
        let ink = if stays { colour(i as usize % 3) } else { SEA };
        for hit in &path.hits {
            portrait.add(hit.tangential(), ink);
        }
        if i == 7 {
            let shifted = path.plane().into_iter().take(80).map(|[x, y]| [x + 1.0, y]);
            sheet.chain(&view, shifted, Style::line(colour(1), 0.22));
        }
    }
    portrait.draw(&mut sheet, [157.0, 3.0], 150.0);
    Ok(sheet.svg)
}

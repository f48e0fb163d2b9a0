//! The stadium and its bounded component.
use super::super::camera::unit;
use super::super::motion::{follow, no_slip};
use super::super::portrait::{Portrait, SEA, colour, starts};
use super::super::sheet::{Sheet, fit};
use super::super::{Drawing, Effort, Figure};
use crate::picture::{Style, Window};
use billiards::geometry::tables;

pub(super) const FIGURE: Figure = Figure {
    name: "stadium",
    title: "The stadium is not ergodic",
    place: "Figure 5, left",
    caption: "An orbit that starts nearly straight across the parallel sides never leaves them: between them the stadium is a strip, and \
              orbits in a strip are bounded. On the right these orbits, in colour, fill a region of positive measure about the centre \
              of the velocity portrait, inside the grey sea of the others.",
    parameters: "Half length 1, radius 1, uniform disk, γ² = 1/2. Orbits start by the canonical measure (seed 5), grey: 40 × 20 000 \
                 collisions (--quick 20 × 4000); 14 more start in the middle \
                 with v proportional to (a, a/2, 1), 0.03 ≤ a ≤ 0.485, grey if they leave the straight sides within 3000 collisions: \
                 those with a ≥ 0.31.",
    draw,
};

fn draw(effort: Effort) -> Drawing {
    let billiard = no_slip(tables::stadium(1.0, 1.0)?);
    let (orbits, collisions) = if effort == Effort::Quick { (20, 4000) } else { (40, 20_000) };
    let mut portrait = Portrait::new(760);

    for start in &starts(&billiard.table, 5, orbits)? {
        portrait.orbit(&billiard, start, collisions, SEA);
    }
    let mut shown = Vec::new();
    for i in 0..14 {
        let a = 0.03 + 0.035 * f64::from(i);
        let path = follow(&billiard, [0.0, 0.0, 0.0], unit([a, 0.5 * a, 1.0]), 3000);
        let stays = path.hits.iter().all(|hit| hit.piece % 2 == 0);
        let ink = if stays { colour(shown.len() % 3) } else { SEA };
        for hit in &path.hits {
            portrait.add(hit.tangential(), ink);
        }
        if stays {
            shown.push(path);
        }
    }
    let mut sheet = Sheet::new(340.0, 146.0);
    let view = fit(Window { low: [-2.0, -1.0], high: [2.0, 1.0] }, [3.0, 3.0], 188.0, 140.0);
    let bounded = shown.get(shown.len() / 2).ok_or("no bounded orbit")?;
    sheet.chain(&view, bounded.plane().into_iter().take(60), Style::line(colour(0), 0.4));
    sheet.walls(&view, &billiard.table);
    portrait.draw(&mut sheet, [197.0, 3.0], 140.0);
    Ok(sheet.svg)
}

//! A disk that meets a wall without slipping.
use super::super::motion::{follow, no_slip};
use super::super::portrait::colour;
use super::super::sheet::{Sheet, fit};
use super::super::{Drawing, Effort, Figure, UNIFORM};
use crate::picture::{COLUMN, Colour, Style, Window};
use billiards::geometry::tables;
use core::f64::consts::PI;

pub(super) const FIGURE: Figure = Figure {
    name: "spin-exchange",
    title: "A disk that does not slip",
    place: "Figure 1",
    caption: "A disk meets a wall. In a no-slip collision the velocity of the point of contact reverses: linear and angular velocity are exchanged, and \
              their energy together is kept. Arrows are velocities of the centre; the arc shows the spin after the collision (before it there is none).",
    parameters: "Uniform disk of radius 0.3, γ² = 1/2, without spin and with velocity (0.8, −0.6) before the collision.",
    draw,
};

const RADIUS: f64 = 0.3;

fn draw(_: Effort) -> Drawing {
    let path = follow(&no_slip(tables::strip(9.0)?), [0.0, -1.2, 0.9], [0.0, 0.8, -0.6], 1);
    let hit = path.hits.first().ok_or("the disk meets no wall")?;
    let out = 1.5;
    let last = [hit.x[1] + out * hit.v[1], hit.x[2] + out * hit.v[2]];
    let mut sheet = Sheet::new(COLUMN, 118.0);
    let view = fit(Window { low: [-1.65, -0.42], high: [1.15, 1.3] }, [3.0, 3.0], COLUMN - 6.0, 112.0);
    let floor = -RADIUS;
    sheet.region(
        &view,
        [[-1.65, floor], [1.15, floor], [1.15, floor - 0.1], [-1.65, floor - 0.1]],
        Style::area(Colour::SOLID),
    );
    sheet.chain(&view, [[-1.65, floor], [1.15, floor]], Style::line(Colour::BLACK, 0.8));
    sheet.chain(&view, [[-1.2, 0.9], [0.0, 0.0], last], Style::line(Colour(0xa0, 0xa0, 0xa0), 0.4));
    let turned = out * hit.v[0] / (UNIFORM * RADIUS);
    for (at, angle) in [([-1.2, 0.9], 0.0), ([0.0, 0.0], 0.0), (last, turned)] {
        let style = Style::line(colour(0), 0.7).filled(Colour::WHITE).with_opacity(0.95);
        sheet.svg.circle(view.place(at), RADIUS * view.scale(), style);
        let tip = |a: f64| [at[0] + RADIUS * libm::cos(a), at[1] + RADIUS * libm::sin(a)];
        sheet.chain(&view, [at, tip(angle - 0.5 * PI)], Style::line(colour(0), 0.5));
    }
    let speed = |at: [f64; 2], v: [f64; 2]| [at[0] + 0.62 * v[0], at[1] + 0.62 * v[1]];
    sheet.arrow(view.place([-1.2, 0.9]), view.place(speed([-1.2, 0.9], [0.8, -0.6])), colour(1), 0.9);
    sheet.arrow(view.place(last), view.place(speed(last, [hit.v[1], hit.v[2]])), colour(1), 0.9);
    let sweep = hit.v[0] / (UNIFORM * RADIUS) * 0.35;
    let on = |t: f64| [last[0] + 0.38 * libm::cos(t), last[1] + 0.38 * libm::sin(t)];
    let arc: Vec<_> = (0..=30).map(|i| on(0.2 + sweep * f64::from(i) / 30.0)).collect();
    sheet.chain(&view, arc[..28].iter().copied(), Style::line(colour(2), 0.8));
    sheet.arrow(view.place(arc[27]), view.place(arc[30]), colour(2), 0.8);
    Ok(sheet.svg)
}

//! The strip in which every orbit is periodic.
use super::super::motion::{follow, no_slip_with};
use super::super::portrait::colour;
use super::super::sheet::{Sheet, fit};
use super::super::{BEYOND, Drawing, Effort, Figure};
use super::strip;
use crate::picture::{COLUMN, Colour, Style, Window};
use billiards::geometry::tables;

pub(super) const FIGURE: Figure = Figure {
    name: "strip-periodic",
    title: "The strip with γ² = 1/3",
    place: BEYOND,
    caption: "Whether orbits in a strip are periodic depends on the mass distribution: they are if β is a rational multiple of π. For γ² = 1/3, β = 60° \
              and every orbit has period 6, rotation included. Left: in the plane; right: seen along x₂, with the lines of contact points.",
    parameters: "γ² = 1/3, width 1, v = (0.3, 0.42, √(1 − 0.3² − 0.42²)), 60 collisions: ten periods on top of one another.",
    draw,
};

fn draw(_: Effort) -> Drawing {
    let gamma = 1.0 / libm::sqrt(3.0);
    let v = [0.3, 0.42, libm::sqrt(1.0 - 0.3 * 0.3 - 0.42 * 0.42)];
    let path = follow(&no_slip_with(tables::strip(1.0)?, gamma), [0.0, 0.0, 0.5], v, 60);
    let [c0, c1] = strip::middle(&path, gamma).ok_or(strip::ONE_WALL)?;
    let half = 0.66;
    let mut sheet = Sheet::new(COLUMN, 108.0);
    let view = fit(Window { low: [-half, -0.16], high: [half, 1.16] }, [3.0, 3.0], 108.0, 102.0);
    sheet.chain(&view, path.plane().into_iter().map(|[x, y]| [x - c1, y]), Style::line(colour(0), 0.5));
    for y in [0.0, 1.0] {
        sheet.chain(&view, [[-half, y], [half, y]], Style::line(Colour::BLACK, 0.8));
    }
    let view = fit(Window { low: [-half, -half], high: [half, half] }, [117.0, 3.0], 106.0, 102.0);
    for side in [1.0, -1.0] {
        let t = 0.62;
        sheet.chain(&view, [[-gamma * t, -side * t], [gamma * t, side * t]], Style::line(Colour::BLACK, 0.5));
    }
    let seen: Vec<_> = path.points().iter().skip(1).map(|p| [p[0] - c0, p[1] - c1]).collect();
    sheet.chain(&view, seen.iter().copied(), Style::line(colour(0), 0.5));
    let dots: Vec<_> = seen.iter().map(|p| view.place(*p)).collect();
    sheet.svg.dots(dots, 2.2, colour(1), 1.0);
    sheet.arrow(view.place([-0.64, -0.3]), view.place([-0.38, -0.3]), Colour::BLACK, 0.4);
    sheet.arrow(view.place([-0.64, -0.3]), view.place([-0.64, -0.04]), Colour::BLACK, 0.4);
    let [x, y] = view.place([-0.38, -0.3]);
    sheet.label([x + 7.0, y], "x_0");
    let [x, y] = view.place([-0.64, -0.04]);
    sheet.label([x, y - 7.0], "x_1");
    Ok(sheet.svg)
}

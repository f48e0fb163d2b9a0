//! The strip with rotation as the third axis.
use super::super::camera::Camera;
use super::super::motion::{follow, no_slip};
use super::super::portrait::colour;
use super::super::sheet::Sheet;
use super::super::{Drawing, Effort, Figure, UNIFORM};
use super::strip;
use crate::picture::{COLUMN, Colour, Style, View, Window};
use billiards::geometry::tables;

pub(super) const FIGURE: Figure = Figure {
    name: "strip-rotation",
    title: "The strip with rotation as third axis",
    place: "Figure 7",
    caption: "The orbit of the previous figure in (x₀, x₁, x₂). The contact points of each wall lie on a straight line; the two lines, of \
              slopes ±1/γ = ±√2, are what bounds the orbit.",
    parameters: "As the previous figure, 60 collisions.",
    draw,
};

fn draw(_: Effort) -> Drawing {
    let (v, ladder) = strip::start();
    let path = follow(&no_slip(tables::strip(1.0)?), [0.0, 0.0, 0.5], v, 60);
    let [c0, c1] = strip::middle(&path, UNIFORM).ok_or(strip::ONE_WALL)?;
    let camera = Camera::at(-20.0, 22.0);
    let shifted = |p: [f64; 3]| [p[0] - c0, p[1] - c1, p[2]];
    let see = |p: [f64; 3]| camera.see(p);
    let (r0, r1) = (0.5 * libm::sqrt(1.5) * ladder + 0.15, 0.5 * libm::sqrt(3.0) * ladder + 0.15);
    let corners = [[-r0, -r1], [r0, -r1], [r0, r1], [-r0, r1]];
    let floor = |h: f64| corners.map(|[a, b]| see([a, b, h]));
    let around = Window::around(floor(0.0).into_iter().chain(floor(1.0))).ok_or("empty")?.padded(0.07);
    let view = View::fit(around, [3.0, 3.0], COLUMN - 6.0, 300.0);
    let mut sheet = Sheet::new(COLUMN, view.size()[1] + 6.0);
    let grey = Colour(0x80, 0x80, 0x80);
    // where the lines of contact points leave the rectangle
    let reach = (r1 / 1.0).min(r0 / UNIFORM);
    let contact = |sheet: &mut Sheet, h: f64, side: f64| {
        let ends = [-reach, reach].map(|t| see([UNIFORM * t, side * t, h]));
        sheet.chain(&view, ends, Style::line(colour(1), 0.8));
    };
    sheet.region(&view, floor(0.0), Style::line(grey, 0.4).filled(Colour::SOLID));
    contact(&mut sheet, 0.0, 1.0);
    sheet.chain(&view, path.points().into_iter().map(|p| see(shifted(p))), Style::line(colour(0), 0.35));
    let dots = |piece: usize| path.hits.iter().filter(move |h| h.piece == piece).map(|h| view.place(see(shifted(h.x))));
    sheet.svg.dots(dots(0), 1.4, Colour::BLACK, 1.0);
    sheet.region(&view, floor(1.0), Style::line(grey, 0.4).filled(Colour::WHITE).with_opacity(0.35));
    sheet.region(&view, floor(1.0), Style::line(grey, 0.4));
    contact(&mut sheet, 1.0, -1.0);
    sheet.svg.dots(dots(1), 1.4, Colour::BLACK, 1.0);
    let name = |sheet: &mut Sheet, from: [f64; 3], to: [f64; 3], text: &str, by: [f64; 2]| {
        let (a, b) = (view.place(see(from)), view.place(see(to)));
        sheet.arrow(a, b, Colour::BLACK, 0.4);
        sheet.label([b[0] + by[0], b[1] + by[1]], text);
    };
    let origin = [r0, -r1, 0.0];
    name(&mut sheet, origin, [r0, -r1 + 0.45, 0.0], "x_1", [2.0, 7.0]);
    name(&mut sheet, [-r0, -r1, 0.0], [-r0 + 0.6, -r1, 0.0], "x_0", [-9.0, 3.0]);
    name(&mut sheet, origin, [r0, -r1, 0.25], "x_2", [6.5, 0.0]);
    Ok(sheet.svg)
}

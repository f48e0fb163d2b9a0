//! The strip seen along x₂: a ladder that slides on two lines.
use super::super::motion::{follow, no_slip};
use super::super::portrait::colour;
use super::super::sheet::Sheet;
use super::super::{Drawing, Effort, Figure, UNIFORM};
use super::strip;
use crate::picture::{AXES_MARGIN, Axis, COLUMN, Colour, Label, Style, View, Window, axes};
use billiards::geometry::tables;
use core::f64::consts::FRAC_PI_2;

pub(super) const FIGURE: Figure = Figure {
    name: "astroid",
    title: "The strip as a sliding ladder",
    place: "Figure 8",
    caption: "The same orbit seen along x₂, from the point where the lines of contact points cross. Each flight is a segment of length ℓ with \
              an end on each line, a ladder that slides; the curve it touches, drawn where the touching point lies on the ladder, is a \
              parallel curve of an astroid. The box is √(3/2) ℓ wide in x₀ and √3 ℓ wide in x₁. Its corners are the farthest points \
              that contact points could reach; the orbit comes as near to them as one likes.",
    parameters: "As the previous two figures, 160 collisions.",
    draw,
};

/// The ends of the ladder of length `l` in direction `u`: the first on the line of slope 1/γ, the second on the other.
fn ladder(l: f64, u: [f64; 2]) -> [[f64; 2]; 2] {
    // a (γ, 1) − b (γ, −1) = l u
    let (d, s) = (l * u[0] / UNIFORM, l * u[1]);
    let (a, b) = (0.5 * (s + d), 0.5 * (s - d));
    [[UNIFORM * a, a], [UNIFORM * b, -b]]
}

/// The envelope of the ladders, where neighbouring ones cross, as far as it lies on the ladders themselves: four arcs.
///
/// In the direction `(cos t, sin t)` the crossing lies on the ladder if `t` is within `arctan γ` of a multiple of π/2.
fn envelope(l: f64) -> [Vec<[f64; 2]>; 4] {
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let at = |t: f64| {
        let (u, w) = ([libm::cos(t), libm::sin(t)], [-libm::sin(t), libm::cos(t)]);
        let ([p, _], [dp, _]) = (ladder(l, u), ladder(l, w));
        // P + s u with (P' + s w) × u = 0
        let s = -cross(dp, u) / cross(w, u);
        [p[0] + s * u[0], p[1] + s * u[1]]
    };
    let part = |i: i32| libm::atan(UNIFORM) * f64::from(i) / 90.0;
    [0.0, 1.0, 2.0, 3.0].map(|k| (-90..=90).map(|i| at(k * FRAC_PI_2 + part(i))).collect())
}

fn draw(_: Effort) -> Drawing {
    let (v, l) = strip::start();
    let path = follow(&no_slip(tables::strip(1.0)?), [0.0, 0.0, 0.5], v, 160);
    let [c0, c1] = strip::middle(&path, UNIFORM).ok_or(strip::ONE_WALL)?;
    let seen = |p: [f64; 3]| [p[0] - c0, p[1] - c1];
    let (r0, r1) = (0.5 * libm::sqrt(1.5) * l, 0.5 * libm::sqrt(3.0) * l);
    let window = Window { low: [-r0 - 0.12, -r1 - 0.12], high: [r0 + 0.12, r1 + 0.12] };
    let [left, below] = AXES_MARGIN;
    let side = 225.0;
    let view = View::fit(window, [left, 3.0], COLUMN - left - 3.0, side);
    let mut sheet = Sheet::new(left + view.size()[0] + 4.0, view.size()[1] + below + 3.0);
    let box_corners = [[-r0, -r1], [r0, -r1], [r0, r1], [-r0, r1], [-r0, -r1]];
    for pair in box_corners.windows(2) {
        sheet.dashed(view.place(pair[0]), view.place(pair[1]), Style::line(Colour(0x70, 0x70, 0x70), 0.4));
    }
    let flights = path.points().into_iter().skip(1).map(seen);
    sheet.chain(&view, flights, Style::line(colour(0), 0.22).with_opacity(0.9));
    for side in [1.0, -1.0] {
        let t = (window.high[0] / UNIFORM).min(window.high[1]);
        let line = [[-UNIFORM * t, -side * t], [UNIFORM * t, side * t]];
        sheet.chain(&view, line, Style::line(Colour::BLACK, 0.5));
    }
    for arc in envelope(l) {
        sheet.chain(&view, arc, Style::line(colour(1), 0.8));
    }
    let axis = |low: f64, high: f64, index: &str| Axis::between(low, high, 4, Label::indexed("x", index));
    axes(&mut sheet.svg, &view, &axis(window.low[0], window.high[0], "0"), &axis(window.low[1], window.high[1], "1"));
    Ok(sheet.svg)
}

//! The collision as a half-turn in (x₀, x₁, x₂).
use super::super::camera::{Camera, along, cross, dot, turn, unit};
use super::super::motion::{follow, no_slip};
use super::super::sheet::Sheet;
use super::super::{Drawing, Effort, Figure, UNIFORM};
use crate::picture::{COLUMN, Colour, ORBITS, Style, View, Window};
use billiards::geometry::tables;
use core::f64::consts::PI;

pub(super) const FIGURE: Figure = Figure {
    name: "collision-cone",
    title: "A no-slip collision is a half-turn",
    place: "Figure 2",
    caption: "A collision with the wall x₂ = 0 in the space of (x₀, x₁, x₂), where x₀ = γRθ is the scaled angle of the disk. The \
              velocity after the collision, Cv, and the velocity before it, v, lie opposite to one another on a cone: C is the \
              half-turn about e, the direction in the wall in which the disk rolls without slipping. The axis e makes the angle \
              β/2, tan(β/2) = γ, with the x₁ axis. (The paper reaches Cv on another cone, about the normal: it reflects v, reverses the \
              spin, and turns by β.)",
    parameters: "Uniform disk, γ² = 1/2. v = (0.15, 0.55, −0.82) before the collision; Cv is computed by the engine.",
    draw,
};

fn draw(_: Effort) -> Drawing {
    let v = unit([0.15, 0.55, -0.82]);
    let start = [1.0 - v[0] / v[2].abs(), -v[1] / v[2].abs(), 1.0];
    let path = follow(&no_slip(tables::strip(4.0)?), start, v, 1);
    let after = path.hits.first().ok_or("the disk meets no wall")?.v;
    let e = unit([UNIFORM, -1.0, 0.0]);
    let camera = Camera::at(54.0, 24.0);
    let window = Window { low: [-1.3, -1.08], high: [1.3, 1.16] };
    let mut sheet = Sheet::new(COLUMN, 196.0);
    let view = View::fit(window, [3.0, 3.0], COLUMN - 6.0, 190.0);
    let see = |p: [f64; 3]| camera.see(p);
    let at = |p: [f64; 3]| view.place(see(p));
    let [blue, red, grey] = [ORBITS[0], ORBITS[1], Colour(0x70, 0x70, 0x70)];
    // the half of the cone below the wall, the wall, the half above
    let (height, radius) = (dot(v, e), (1.0 - dot(v, e) * dot(v, e)).sqrt());
    let centre = along([0.0; 3], height, e);
    let (p, q) = ([0.0, 0.0, 1.0], cross(e, [0.0, 0.0, 1.0]));
    let on = |t: f64| along(along(centre, radius * libm::cos(t), p), radius * libm::sin(t), q);
    let arc = |from: f64, to: f64| (0..=60).map(move |i| on(from + (to - from) * f64::from(i) / 60.0)).map(see);
    let tint = Colour::WHITE.mix(ORBITS[5], 0.30);
    let half = |sheet: &mut Sheet, from: f64, to: f64| {
        let rim: Vec<_> = core::iter::once([0.0, 0.0]).chain(arc(from, to)).collect();
        sheet.region(&view, rim, Style::area(tint).with_opacity(0.6));
        sheet.chain(&view, arc(from, to), Style::line(ORBITS[5], 0.5));
    };
    half(&mut sheet, 0.5 * PI, 1.5 * PI);
    let wall = [[-0.9, -1.0, 0.0], [0.9, -1.0, 0.0], [0.9, 0.9, 0.0], [-0.9, 0.9, 0.0]];
    sheet.region(&view, wall.map(see), Style::line(grey, 0.4).filled(Colour::SOLID).with_opacity(0.7));
    half(&mut sheet, -0.5 * PI, 0.5 * PI);
    // e and β/2
    sheet.dashed(at(along([0.0; 3], -0.75, e)), at(along([0.0; 3], 0.9, e)), Style::line(Colour::BLACK, 0.5));
    sheet.label(at(along([0.0; 3], 1.0, e)), "e");
    let angle = libm::atan(UNIFORM);
    let sweep = |i: i32| turn([0.0, -0.5, 0.0], [0.0, 0.0, 1.0], angle * f64::from(i) / 20.0);
    sheet.chain(&view, (0..=20).map(|i| see(sweep(i))), Style::line(Colour::BLACK, 0.4));
    sheet.label(at(turn([0.0, -0.62, 0.0], [0.0, 0.0, 1.0], 0.5 * angle)), "β/2");
    // the axes
    for (tip, name) in [([0.98, 0.0, 0.0], "x_0"), ([0.0, 1.0, 0.0], "x_1"), ([0.0, 0.0, 0.95], "x_2")] {
        sheet.arrow(at([0.0; 3]), at(tip), grey, 0.4);
        sheet.label(at(tip.map(|x| 1.09 * x)), name);
    }
    sheet.chain(&view, [[0.0, 0.0], see([0.0, -0.85, 0.0])], Style::line(grey, 0.3));
    // the velocities
    sheet.arrow(at(v.map(|x| -x)), at([0.0; 3]), red, 1.0);
    sheet.dashed(at([0.0; 3]), at(v), Style::line(red, 0.8));
    sheet.arrow(at([0.0; 3]), at(after), blue, 1.0);
    // the half-turn from v to Cv, along the rim
    let phase = |w: [f64; 3]| libm::atan2(dot(w, q), dot(w, p));
    let (from, to) = (phase(v), phase(after));
    let to = if to < from { to + 2.0 * PI } else { to };
    sheet.chain(&view, arc(from, to - 0.1), Style::line(Colour::BLACK, 0.7));
    sheet.arrow(at(on(to - 0.2)), at(on(to)), Colour::BLACK, 0.5);
    let beside = |w: [f64; 3], by: [f64; 2]| [at(w)[0] + by[0], at(w)[1] + by[1]];
    sheet.label(beside(v.map(|x| -0.8 * x), [-8.0, 0.0]), "v");
    sheet.label(beside(v, [8.0, 3.0]), "v");
    sheet.label(beside(after, [-4.0, -8.0]), "Cv");
    Ok(sheet.svg)
}

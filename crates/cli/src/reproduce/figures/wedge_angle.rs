//! The rotation angle of the velocities against the angle of the wedge.
use super::super::camera::{along, dot, unit};
use super::super::portrait::colour;
use super::super::sheet::Sheet;
use super::super::{Drawing, Effort, Figure};
use super::wedges::{HALF, bounded};
use crate::picture::{AXES_MARGIN, Axis, COLUMN, Colour, Label, Style, View, Window, axes};
use core::f64::consts::PI;
use paper::wedge;

pub(super) const FIGURE: Figure = Figure {
    name: "wedge-angle",
    title: "Wedge angle and rotation angle",
    place: "Figure 11",
    caption: "Two collisions in a wedge of angle θ turn the velocity about the axis of periodicity by α. The curve is \
              cos α = (32/9) cos⁴(θ/2) − (16/3) cos²(θ/2) + 1; the dots are measured along orbits. Where α = 2π/n (dashed, n = 2, 3, 4, 5) all \
              bounded orbits have period 2n up to rotation.",
    parameters: "Uniform disk, γ² = 1/2; one orbit for each of 23 angles, α between velocities after the first and the second collision with \
                 the same wall, folded to [0, π].",
    draw,
};

fn draw(_: Effort) -> Drawing {
    let window = Window { low: [0.0, 0.0], high: [3.2, 3.2] };
    let [left, below] = AXES_MARGIN;
    let side = COLUMN - left - 6.0;
    let view = View::fit(window, [left, 3.0], side, side);
    let mut sheet = Sheet::new(COLUMN, side + below + 3.0);
    for n in 2..=5_u32 {
        let theta = wedge::opening_of_turn(2.0 * PI / f64::from(n)).ok_or("no such wedge")?;
        let alpha = 2.0 * PI / f64::from(n);
        let grey = Style::line(Colour(0x90, 0x90, 0x90), 0.4);
        sheet.dashed(view.place([0.0, alpha]), view.place([theta, alpha]), grey);
        sheet.dashed(view.place([theta, alpha]), view.place([theta, 0.0]), grey);
        let [x, y] = view.place([theta, 0.0]);
        sheet.label_as([x + 8.0, y - 7.0], 7.0, crate::picture::Anchor::Middle, &n.to_string());
    }
    let curve = (0..=400).map(|i| PI * f64::from(i) / 400.0).map(|theta| {
        let c2 = libm::pow(libm::cos(0.5 * theta), 2.0);
        let cos: f64 = (32.0 / 9.0 * c2 - 16.0 / 3.0) * c2 + 1.0;
        [theta, libm::acos(cos.clamp(-1.0, 1.0))]
    });
    let curve: Vec<_> = curve.collect();
    sheet.chain(&view, curve, Style::line(colour(0), 0.8));
    for i in 1..24 {
        let theta = PI * f64::from(i) / 24.0;
        let axis = wedge::axis(theta, HALF);
        let path = bounded(theta, 0.5, 0.4, 6)?;
        let mut across = path.hits.iter().filter(|hit| hit.piece == 0).map(|h| unit(along(h.v, -dot(h.v, axis), axis)));
        let (a, b) = across.next().zip(across.next()).ok_or("the orbit escapes")?;
        let alpha = libm::acos(dot(a, b).clamp(-1.0, 1.0));
        sheet.svg.circle(view.place([theta, alpha]), 1.6, Style::line(Colour::WHITE, 0.4).filled(colour(1)));
    }
    let axis = |symbol: &str| Axis::between(0.0, 3.2, 4, Label::indexed(symbol, ""));
    axes(&mut sheet.svg, &view, &axis("θ"), &axis("α"));
    Ok(sheet.svg)
}

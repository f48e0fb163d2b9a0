//! Which wedges are periodic, for every mass distribution.
use super::super::portrait::colour;
use super::super::sheet::Sheet;
use super::super::{BEYOND, Drawing, Effort, Figure};
use crate::picture::{AXES_MARGIN, Anchor, Axis, COLUMN, Colour, Label, Style, View, Window, axes};
use core::f64::consts::PI;
use paper::fractions::reduced_numerators;

pub(super) const FIGURE: Figure = Figure {
    name: "wedge-chart",
    title: "All periodic wedges",
    place: BEYOND,
    caption: "The wedge is solved for every γ: with δ = arccos(cos(θ/2)/√(1+γ²)) a collision turns the folded velocity by 2δ. On the curves δ = πp/q, \
              that is γ² = cos²(θ/2)/cos²(πp/q) − 1, all bounded orbits are periodic up to rotation, with period q if q is even and 2q if it is odd; \
              q odd (red) makes the rotation return too. The dashed line is the uniform disk.",
    parameters: "Curves with q ≤ 9, labelled p/q; θ in units of π.",
    draw,
};

#[allow(clippy::unnecessary_wraps, reason = "other figures can fail")]
fn draw(_: Effort) -> Drawing {
    let window = Window { low: [0.0, 0.0], high: [1.0, 1.0] };
    let [left, below] = AXES_MARGIN;
    let (above, side) = (11.0, COLUMN - left - 3.0);
    let view = View::fit(window, [left, above], side, side);
    let mut sheet = Sheet::new(COLUMN, above + side + below);
    for q in 3..=9_u32 {
        for p in reduced_numerators(q) {
            let cos = libm::cos(PI * f64::from(p) / f64::from(q));
            let most = (1.0 / (cos * cos) - 1.0).min(1.0);
            // from one edge of the frame to another
            let at = |i: i32| {
                let square = most * f64::from(i) / 600.0;
                [2.0 * libm::acos(((1.0 + square).sqrt() * cos).min(1.0)) / PI, square]
            };
            let ink = if q % 2 == 1 { colour(1) } else { colour(0) };
            sheet.chain(&view, (0..=600).map(at), Style::line(ink, 1.6 / f64::from(q).sqrt() - 0.2));
            let [x, y] = view.place(at(600));
            // at the left edge between this curve and the next, otherwise above the frame
            let (at, anchor) =
                if x < left + 1.0 { ([x + 3.0, y - 3.0], Anchor::Start) } else { ([x, y - 4.5], Anchor::Middle) };
            sheet.label_as(at, 5.0, anchor, &format!("{p}/{q}"));
        }
    }
    sheet.dashed(view.place([0.0, 0.5]), view.place([1.0, 0.5]), Style::line(Colour::BLACK, 0.5));
    let axis = |symbol: &str, index: &str| Axis::between(0.0, 1.0, 5, Label::indexed(symbol, index));
    axes(&mut sheet.svg, &view, &axis("θ/π", ""), &axis("γ²", ""));
    Ok(sheet.svg)
}

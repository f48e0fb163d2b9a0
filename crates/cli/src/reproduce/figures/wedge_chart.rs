//! Which wedges are periodic, for every mass distribution.
use super::super::portrait::colour;
use super::super::sheet::Sheet;
use super::super::{BEYOND, Drawing, Effort, Figure};
use crate::picture::{AXES_MARGIN, Anchor, Axis, COLUMN, Colour, Label, Style, View, Window, axes};
use core::f64::consts::PI;

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
    let side = COLUMN - left - 18.0;
    let view = View::fit(window, [left, 3.0], side, side);
    let mut sheet = Sheet::new(COLUMN, side + below + 3.0);
    let mut labels: Vec<([f64; 2], String)> = Vec::new();
    for q in 3..=9_u32 {
        for p in (1..q).filter(|p| 2 * p < q && gcd(*p, q) == 1) {
            let cos = libm::cos(PI * f64::from(p) / f64::from(q));
            let at = |i: i32| {
                let theta = f64::from(i) / 600.0;
                let c = libm::cos(0.5 * PI * theta) / cos;
                [theta, c * c - 1.0]
            };
            let points: Vec<_> = (0..=600).map(at).filter(|z| z[1] >= -0.004 && z[1] <= 1.004).collect();
            let Some(&top) = points.first() else { continue };
            let ink = if q % 2 == 1 { colour(1) } else { colour(0) };
            sheet.chain(
                &view,
                points.iter().map(|z| [z[0], z[1].clamp(0.0, 1.0)]),
                Style::line(ink, 1.6 / f64::from(q).sqrt() - 0.2),
            );
            labels.push((top, format!("{p}/{q}")));
        }
    }
    labels.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]).then(b.0[1].total_cmp(&a.0[1])));
    for ([theta, g], text) in labels {
        let [x, y] = view.place([theta, g]);
        let at = if theta < 0.01 && g < 0.95 { [x + 3.0, y - 4.0] } else { [x + 2.0, y + 6.0] };
        let size = 6.0;
        let wide = 2.7 * text.len() as f64;
        sheet.svg.rectangle(
            [at[0] - 0.5, at[1] - 3.0],
            [at[0] + wide, at[1] + 3.0],
            Style::area(Colour::WHITE).with_opacity(0.8),
        );
        sheet.label_as(at, size, Anchor::Start, &text);
    }
    sheet.dashed(view.place([0.0, 0.5]), view.place([1.0, 0.5]), Style::line(Colour::BLACK, 0.5));
    let axis = |symbol: &str, index: &str| Axis::between(0.0, 1.0, 5, Label::indexed(symbol, index));
    axes(&mut sheet.svg, &view, &axis("θ/π", ""), &axis("γ²", ""));
    Ok(sheet.svg)
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

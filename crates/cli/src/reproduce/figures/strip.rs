//! The strip in the plane.
use super::super::motion::{Path, follow, no_slip};
use super::super::portrait::colour;
use super::super::sheet::{LABEL, Sheet};
use super::super::{Drawing, Effort, Figure, UNIFORM};
use crate::picture::{Anchor, COLUMN, Colour, Style, View, Window};
use billiards::geometry::tables;
use paper::strip::crossing;

pub(super) const FIGURE: Figure = Figure {
    name: "strip",
    title: "Orbits in a strip are bounded",
    place: "Figure 6",
    caption: "An orbit between two parallel walls. It fills an interval of length √3 ℓ, where ℓ = √(1/ẋ₂² − 1) for unit speed and unit width: \
              the upper bracket. The constant of the paper, √(3/2), belongs to the width in x₀ (next figures); its interval, the lower \
              bracket, is too short. For any γ the factor is √(1+γ²)/γ.",
    parameters: "Width 1, uniform disk, γ² = 1/2, v = (0.35, 0.45, √(1 − 0.35² − 0.45²)), 120 collisions.",
    draw,
};

/// The velocity of the start, of length one, and ℓ.
pub(super) fn start() -> ([f64; 3], f64) {
    let [a, b] = [0.35, 0.45];
    let v2 = (1.0_f64 - a * a - b * b).sqrt();
    ([a, b, v2], libm::hypot(a, b) / v2)
}

/// The middle of an orbit in `(x₀, x₁)`: where the lines of contact points cross, from a collision on each wall; `None` without one.
pub(super) fn middle(path: &Path, gamma: f64) -> Option<[f64; 2]> {
    let line = |piece: usize, rise: f64| {
        let hit = path.hits.iter().find(|hit| hit.piece == piece)?;
        Some(([hit.x[0], hit.x[1]], [gamma, rise]))
    };
    Some(crossing([line(0, 1.0)?, line(1, -1.0)?]))
}

/// Why an orbit has no middle.
pub(super) const ONE_WALL: &str = "no collision on one of the walls";

fn draw(_: Effort) -> Drawing {
    let (v, ladder) = start();
    let path = follow(&no_slip(tables::strip(1.0)?), [0.0, 0.0, 0.5], v, 120);
    let [_, middle] = middle(&path, UNIFORM).ok_or(ONE_WALL)?;
    let half = 0.5 * libm::sqrt(3.0) * ladder;
    let papers = 0.5 * libm::sqrt(1.5) * ladder;
    let window = Window { low: [middle - half - 0.25, -0.3], high: [middle + half + 0.25, 1.3] };
    let view = View::fit(window, [3.0, 3.0], COLUMN - 6.0, 400.0);
    let mut sheet = Sheet::new(COLUMN, view.size()[1] + 6.0);
    sheet.chain(&view, path.plane(), Style::line(colour(0), 0.3).with_opacity(0.85));
    for y in [0.0, 1.0] {
        sheet.chain(&view, [[window.low[0], y], [window.high[0], y]], Style::line(Colour::BLACK, 0.8));
    }
    for (y, half, ink, text) in [(1.13, half, colour(0), "√3 ℓ"), (-0.13, papers, colour(1), "√(3/2) ℓ")] {
        let ([a, b], [c, _]) = (view.place([middle - half, y]), view.place([middle + half, y]));
        let [_, wall] = view.place([middle, libm::round(y)]);
        sheet.arrow([0.5 * (a + c), b], [a, b], ink, 0.5);
        sheet.arrow([0.5 * (a + c), b], [c, b], ink, 0.5);
        let far = view.place([middle, 1.0 - libm::round(y)])[1];
        for x in [a, c] {
            sheet.dashed([x, b], [x, if y > 0.0 { far } else { wall }], Style::line(ink, 0.4));
        }
        let lift = if y > 0.0 { -8.0 } else { 8.0 };
        sheet.label_as([0.5 * (a + c), b + lift], LABEL, Anchor::Middle, text);
    }
    Ok(sheet.svg)
}

//! The work-precision chart: time per collision against error, both on logarithmic scales.

use super::case::CASES;
use super::method::METHODS;
use super::score::{STOPS, Score};
use crate::picture::{Anchor, Colour, ORBITS, Outline, Style, Svg, escape};

/// Width and height of the page, and of the frame in it.
const PAGE: [f64; 2] = [540.0, 330.0];
const CORNER: [f64; 2] = [34.0, 20.0];
const FRAME: [f64; 2] = [330.0, 278.0];
/// Left end of the legend.
const LEGEND: f64 = 382.0;
const TEXT: f64 = 8.5;
const NUMBER: f64 = 7.5;
/// Size of exponents; not in percent, which some viewers take relative to the page.
const RAISED: f64 = 5.25;
const HAIR: Style = Style::line(Colour::BLACK, 0.4);

/// The errors shown are those after this one of [`STOPS`].
const SHOWN: usize = 1;
/// Errors below this are drawn at this value: a few hundredths of a rounding.
const LEAST: f64 = 1e-17;
/// Errors above this are drawn at this value: the particle is lost.
const MOST: f64 = 10.0;

/// How a method is marked.
#[derive(Clone, Copy, Debug)]
pub enum Mark {
    /// A full disk.
    Disk,
    /// A full diamond.
    Diamond,
    /// A full square.
    Square,
    /// A full triangle.
    Triangle,
    /// Six rays.
    Star,
    /// A circle.
    Ring,
    /// The outline of a square.
    Box,
    /// An upright cross.
    Plus,
    /// A diagonal cross.
    Cross,
}

/// Draws time against error.
pub fn draw(scores: &[Score]) -> Svg {
    let mut svg = Svg::new(PAGE[0], PAGE[1]);
    let times = || scores.iter().map(|score| libm::log10(score.nanoseconds)).filter(|x| x.is_finite());
    let low = libm::floor(times().fold(1.0, f64::min));
    let high = libm::ceil(times().fold(low + 3.0, f64::max));
    let scale = Scale { x: [low, high], y: [libm::log10(LEAST), libm::log10(MOST)] };
    scale.axes(&mut svg);
    for method in METHODS {
        for table in CASES {
            let points: Vec<[f64; 2]> = scores
                .iter()
                .filter(|score| score.method == method.name && score.table == table.name)
                .map(|score| scale.place(score.nanoseconds, score.errors[SHOWN].median))
                .collect();
            let colour = colour_of(table.name);
            if points.len() > 1 {
                let mut line = Outline::new();
                line.chain(points.iter().copied());
                svg.path(&line, Style::line(colour, 0.4).with_opacity(0.5));
            }
            for point in points {
                method.mark.draw(&mut svg, point, colour);
            }
        }
    }
    legend(&mut svg, scores);
    svg
}

/// From decades to the page.
struct Scale {
    x: [f64; 2],
    y: [f64; 2],
}

impl Scale {
    fn across(&self, decade: f64) -> f64 {
        CORNER[0] + FRAME[0] * (decade - self.x[0]) / (self.x[1] - self.x[0])
    }

    fn up(&self, decade: f64) -> f64 {
        CORNER[1] + FRAME[1] * (self.y[1] - decade) / (self.y[1] - self.y[0])
    }

    fn place(&self, nanoseconds: f64, error: f64) -> [f64; 2] {
        let error = if error.is_nan() { MOST } else { error.clamp(LEAST, MOST) };
        [self.across(libm::log10(nanoseconds)), self.up(libm::log10(error))]
    }

    fn axes(&self, svg: &mut Svg) {
        let [left, top] = CORNER;
        let (right, bottom) = (left + FRAME[0], top + FRAME[1]);
        let faint = Style::line(Colour::GUIDE, 0.3);
        for decade in decades(self.x) {
            let at = self.across(decade);
            svg.line([at, top], [at, bottom], faint);
            svg.text([at, bottom + 10.0], NUMBER, Anchor::Middle, &power(decade));
        }
        for decade in decades(self.y).filter(|decade| decade % 2.0 == 0.0) {
            let at = self.up(decade);
            svg.line([left, at], [right, at], faint);
            svg.text([left - 4.0, at + 2.5], NUMBER, Anchor::End, &power(decade));
        }
        // points on the frame mean values at least as large, or at most as small
        svg.text([left - 4.0, top + 2.5], NUMBER, Anchor::End, "lost");
        svg.text([left - 4.0, bottom + 2.5], NUMBER, Anchor::End, &format!("\u{2264} {}", power(self.y[0])));
        svg.rectangle(CORNER, [right, bottom], HAIR);
        let what = format!("median error after {} collisions, of the table’s size", STOPS[SHOWN]);
        svg.text([left, top - 7.0], TEXT, Anchor::Start, &what);
        let what = "processor time per collision, in nanoseconds";
        svg.text([0.5 * (left + right), bottom + 24.0], TEXT, Anchor::Middle, what);
    }
}

/// The whole decades of a range.
fn decades([low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
    core::iter::successors(Some(libm::ceil(low)), move |decade| (decade + 1.0 <= high).then_some(decade + 1.0))
}

/// A power of ten.
fn power(decade: f64) -> String {
    format!("10<tspan font-size=\"{RAISED}\" dy=\"-3\">{}</tspan>", format!("{decade}").replace('-', "\u{2212}"))
}

fn colour_of(table: &str) -> Colour {
    let number = CASES.iter().position(|entry| entry.name == table).unwrap_or(0);
    // two more colours than orbits have
    let more = [Colour::BLACK, Colour(0xb4, 0x00, 0xff)];
    ORBITS.iter().chain(&more).copied().nth(number).unwrap_or(Colour::MIDDLE)
}

impl Mark {
    fn draw(self, svg: &mut Svg, [x, y]: [f64; 2], colour: Colour) {
        let (solid, line) = (Style::area(colour), Style::line(colour, 0.8));
        let mut polygon = |points: &[[f64; 2]], style: Style| {
            let mut outline = Outline::new();
            outline.chain(points.iter().map(|[dx, dy]| [x + dx, y + dy])).close();
            svg.path(&outline, style);
        };
        let r = 2.3;
        match self {
            Mark::Disk => svg.circle([x, y], r, solid),
            Mark::Diamond => polygon(&[[0.0, -1.35 * r], [1.1 * r, 0.0], [0.0, 1.35 * r], [-1.1 * r, 0.0]], solid),
            Mark::Square => polygon(&[[-r, -r], [r, -r], [r, r], [-r, r]].map(|p| p.map(|c| 0.9 * c)), solid),
            Mark::Triangle => polygon(&[[0.0, -1.2 * r], [1.15 * r, r], [-1.15 * r, r]], solid),
            Mark::Ring => svg.circle([x, y], 0.85 * r, line.filled(Colour::WHITE)),
            Mark::Box => {
                let side = 0.8 * r;
                polygon(&[[-side, -side], [side, -side], [side, side], [-side, side]], line.filled(Colour::WHITE));
            }
            Mark::Plus => strokes(svg, [x, y], r, &[0.0, 90.0], line),
            Mark::Cross => strokes(svg, [x, y], r, &[45.0, 135.0], line),
            Mark::Star => strokes(svg, [x, y], 1.1 * r, &[0.0, 60.0, 120.0], line),
        }
    }
}

/// Strokes through a point, at angles in degrees.
fn strokes(svg: &mut Svg, [x, y]: [f64; 2], r: f64, angles: &[f64], style: Style) {
    for angle in angles {
        let (sin, cos) = libm::sincos(angle.to_radians());
        svg.line([x - 1.2 * r * cos, y - 1.2 * r * sin], [x + 1.2 * r * cos, y + 1.2 * r * sin], style);
    }
}

fn legend(svg: &mut Svg, scores: &[Score]) {
    let step = 12.0;
    let mut y = CORNER[1] + 4.0;
    for method in METHODS.iter().filter(|method| scores.iter().any(|score| score.method == method.name)) {
        method.mark.draw(svg, [LEGEND, y], Colour::BLACK);
        svg.text([LEGEND + 8.0, y + 2.8], TEXT, Anchor::Start, &escape(method.name));
        y += step;
    }
    if scores.iter().any(|score| score.pieces.is_some()) {
        let [few, many] = [2.0, 3.0].map(power);
        let what = format!("{few}<tspan dy=\"3\">, {many}</tspan><tspan dy=\"3\">, … pieces, joined by a line</tspan>");
        svg.text([LEGEND + 8.0, y + 2.8], NUMBER, Anchor::Start, &what);
        y += step;
    }
    y += 0.7 * step;
    for table in CASES.iter().filter(|table| scores.iter().any(|score| score.table == table.name)) {
        svg.line([LEGEND - 4.0, y], [LEGEND + 4.0, y], Style::line(colour_of(table.name), 2.5));
        svg.text([LEGEND + 8.0, y + 2.8], TEXT, Anchor::Start, &escape(table.name));
        y += step;
    }
}

//! Axes: a thin frame with a few round numbers.

use super::ink::Colour;
use super::svg::{Anchor, Style, Svg, escape};
use super::view::View;

/// Size of axis labels.
const LABEL: f64 = 9.0;
/// Size of numbers at ticks.
const NUMBER: f64 = 7.5;
/// Length of a tick.
const TICK: f64 = 2.5;
/// Width of frames and ticks.
pub(super) const HAIRLINE: f64 = 0.4;

/// The name of a quantity: an italic letter with an index and a plain word before or after.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Label {
    /// The letter.
    pub symbol: String,
    /// Its index, if any.
    pub index: String,
}

impl Label {
    /// `v0` as v with index 0.
    pub fn indexed(symbol: &str, index: &str) -> Self {
        Self { symbol: symbol.into(), index: index.into() }
    }

    fn markup(&self) -> String {
        let symbol = format!("<tspan font-style=\"italic\">{}</tspan>", escape(&self.symbol));
        if self.index.is_empty() {
            return symbol;
        }
        format!("{symbol}<tspan font-size=\"70%\" dx=\"0.5\" dy=\"2\">{}</tspan>", escape(&self.index))
    }
}

/// One axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// What is measured.
    pub label: Label,
    /// Numbers.
    pub ticks: Vec<f64>,
    /// Where a number stands in the picture's plane: it times this.
    pub unit: f64,
}

impl Axis {
    /// The same, drawn so many times larger.
    #[must_use]
    pub fn stretched(self, unit: f64) -> Self {
        Self { unit, ..self }
    }

    /// An axis with about `many` round numbers between two ends.
    pub fn between(low: f64, high: f64, many: usize, label: Label) -> Self {
        Self { label, ticks: ticks(low, high, many), unit: 1.0 }
    }
}

/// Room that axes need beside the frame: left, below.
pub const MARGIN: [f64; 2] = [31.0, 25.0];

/// White on the right of the frame.
pub(super) const BESIDE: f64 = 3.0;

/// Draws a frame around a view, with ticks and numbers below and on the left.
pub fn draw(svg: &mut Svg, view: &View, x: &Axis, y: &Axis) {
    let [left, top] = view.corner();
    let [width, height] = view.size();
    let (right, bottom) = (left + width, top + height);
    let hair = Style::line(Colour::BLACK, HAIRLINE);
    svg.rectangle([left, top], [right, bottom], hair);
    let names = numbers(&x.ticks);
    for (&tick, name) in x.ticks.iter().zip(&names) {
        let [at, _] = view.place([tick * x.unit, 0.0]);
        svg.line([at, bottom], [at, bottom - TICK], hair);
        svg.line([at, top], [at, top + TICK], hair);
        // A minus sign should not push its digit off the tick.
        let shift = if name.starts_with('\u{2212}') { -0.22 * NUMBER } else { 0.0 };
        // the last number may reach as far beyond the frame as the page does
        let half = 0.25 * NUMBER * name.chars().count() as f64;
        let middle = (at + shift).min(right + BESIDE - half);
        svg.text([middle, bottom + 0.75 * NUMBER + 3.0], NUMBER, Anchor::Middle, name);
    }
    let names = numbers(&y.ticks);
    for (&tick, name) in y.ticks.iter().zip(&names) {
        let [_, at] = view.place([0.0, tick * y.unit]);
        svg.line([left, at], [left + TICK, at], hair);
        svg.line([right, at], [right - TICK, at], hair);
        svg.text([left - 3.0, at + 0.33 * NUMBER], NUMBER, Anchor::End, name);
    }
    svg.text([0.5 * (left + right), bottom + 2.0 + NUMBER + LABEL + 1.0], LABEL, Anchor::Middle, &x.label.markup());
    svg.text([left - 3.0 - 2.9 * NUMBER, 0.5 * (top + bottom) + 0.3 * LABEL], LABEL, Anchor::Middle, &y.label.markup());
}

/// About `many` round numbers (1, 2 or 5 times a power of ten apart) between two ends.
///
/// ```
/// assert_eq!(billiards_cli::picture::ticks(-1.05, 1.05, 5), [-1.0, -0.5, 0.0, 0.5, 1.0]);
/// ```
pub fn ticks(low: f64, high: f64, many: usize) -> Vec<f64> {
    let rough = (high - low) / many.max(1) as f64;
    if !(rough > 0.0 && rough.is_finite()) {
        return Vec::new();
    }
    let exponent = libm::floor(libm::log10(rough));
    // A power of ten and its multiple exactly, as one would write it: 0.3 rather than 3 * 0.1.
    let (up, down) = if exponent >= 0.0 { (libm::pow(10.0, exponent), 1.0) } else { (1.0, libm::pow(10.0, -exponent)) };
    let lead = rough / up * down;
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter().find(|f| lead <= f * 1.0001).unwrap_or(10.0);
    let step = |i: f64| i * factor * up / down;
    // a tick at the very end is shown though the quotient is rounded, and one that nobody could see beyond it is no harm
    let slack = 1e-9;
    let first = libm::ceil(low / step(1.0) - slack);
    let count = libm::floor(high / step(1.0) + slack) - first;
    let mut ticks = Vec::new();
    let mut i = 0.0;
    while i <= count && ticks.len() < 4 * many.max(1) {
        let tick = step(first + i);
        ticks.push(if tick == 0.0 { 0.0 } else { tick });
        i += 1.0;
    }
    ticks
}

/// The numbers at ticks, all with the same number of decimals and a true minus sign.
fn numbers(ticks: &[f64]) -> Vec<String> {
    let largest = ticks.iter().fold(0.0f64, |m, t| m.max(t.abs()));
    if largest >= 1e5 || (largest > 0.0 && largest < 1e-3) {
        return ticks.iter().map(|t| minus(&format!("{t:e}"))).collect();
    }
    let decimals = (0..12).find(|d| ticks.iter().all(|t| format!("{t:.d$}").parse() == Ok(*t))).unwrap_or(12);
    ticks.iter().map(|t| minus(&format!("{t:.decimals$}"))).collect()
}

fn minus(text: &str) -> String {
    text.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_numbers_within_the_range() {
        assert_eq!(ticks(0.0, 1.0, 5), [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]);
        assert_eq!(ticks(-3.0, 11.0, 4), [0.0, 5.0, 10.0]);
        assert_eq!(ticks(0.0, 3e-7, 3), [0.0, 1e-7, 2e-7, 3e-7]);
        assert_eq!(ticks(1.0, 1.0, 3), [] as [f64; 0]);
        assert_eq!(ticks(f64::NAN, 1.0, 3), [] as [f64; 0]);
        for (low, high) in [(0.013, 0.9), (-1e100, 1e101), (5.0, 5.001)] {
            let found = ticks(low, high, 5);
            assert!((2..=12).contains(&found.len()), "{found:?}");
        }
    }

    #[test]
    fn numbers_share_their_decimals() {
        assert_eq!(numbers(&[-0.5, 0.0, 0.5]), ["\u{2212}0.5", "0.0", "0.5"]);
        assert_eq!(numbers(&[0.0, 5.0]), ["0", "5"]);
        assert_eq!(numbers(&[0.0, 2e-7]), ["0e0", "2e\u{2212}7"]);
    }
}

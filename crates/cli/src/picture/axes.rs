//! Axes: a thin frame with a few round numbers.

use std::fmt::Write as _;

use super::ink::Colour;
use super::svg::{Anchor, Short, Style, Svg, escape};
use super::view::View;

/// Size of axis labels.
const LABEL: f64 = 9.0;
/// Size of numbers at ticks.
const NUMBER: f64 = 7.5;
/// Size of indices and exponents, as a fraction.
const SMALL: f64 = 0.7;
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

    /// The label, with the power of ten that is left out of the numbers at the ticks.
    fn markup(&self, exponent: i32) -> String {
        let mut markup = format!("<tspan font-style=\"italic\">{}</tspan>", escape(&self.symbol));
        // not in percent, which some viewers take relative to the page; writing to a string cannot fail
        let small = Short(SMALL * LABEL);
        let mut back = 0;
        if !self.index.is_empty() {
            let _ = write!(markup, "<tspan font-size=\"{small}\" dx=\"0.5\" dy=\"2\">{}</tspan>", escape(&self.index));
            back = -2;
        }
        if exponent != 0 {
            let exponent = minus(&exponent.to_string());
            let _ = write!(
                markup,
                "<tspan dy=\"{back}\"> / 10</tspan><tspan font-size=\"{small}\" dy=\"-3\">{exponent}</tspan>"
            );
        }
        markup
    }

    /// Approximate width of the markup in a serif face.
    fn width(&self, exponent: i32) -> f64 {
        let of = |text: &str, share: f64| share * LABEL * text.chars().count() as f64;
        let name = of(&self.symbol, 0.45) + of(&self.index, 0.5 * SMALL);
        // a slash between two spaces, two digits, and those of the power
        let power = 1.8 * LABEL + of(&exponent.to_string(), 0.5 * SMALL);
        if exponent == 0 { name } else { name + power }
    }

    /// Writes it in the middle of the line about a point.
    fn write(&self, svg: &mut Svg, [x, y]: [f64; 2], exponent: i32) {
        let markup = self.markup(exponent);
        if exponent == 0 {
            svg.text([x, y], LABEL, Anchor::Middle, &markup);
        } else {
            // CairoSVG centres every part of a text separately, so that they overlap; left-aligned, it puts them in a row
            svg.text([x - 0.5 * self.width(exponent), y], LABEL, Anchor::Start, &markup);
        }
    }
}

/// One axis.
#[derive(Clone, Debug)]
pub struct Axis {
    /// What is measured.
    pub label: Label,
    /// Numbers.
    pub ticks: Vec<f64>,
    /// Coordinate in the picture's plane of the number 1: other numbers are multiplied by this.
    pub unit: f64,
}

impl Axis {
    /// The same, drawn this many times larger.
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

/// Width of a digit in `DejaVu` Serif, in units of the size of the face.
pub const WIDEST_DIGIT: f64 = 0.64;

/// White on the right of the frame.
pub(super) const BESIDE: f64 = 3.0;

/// Draws a frame around a view, with ticks and numbers below and on the left.
pub fn draw(svg: &mut Svg, view: &View, x: &Axis, y: &Axis) {
    let [left, top] = view.corner();
    let [width, height] = view.size();
    let (right, bottom) = (left + width, top + height);
    let hair = Style::line(Colour::BLACK, HAIRLINE);
    svg.rectangle([left, top], [right, bottom], hair);
    let (names, x_power) = numbers(&x.ticks);
    for (&tick, name) in x.ticks.iter().zip(&names) {
        let [at, _] = view.place([tick * x.unit, 0.0]);
        svg.line([at, bottom], [at, bottom - TICK], hair);
        svg.line([at, top], [at, top + TICK], hair);
        // A minus sign should not push its digit off the tick.
        let shift = if name.starts_with('\u{2212}') { -0.22 * NUMBER } else { 0.0 };
        // the last number may reach beyond the frame only as far as the page does, in the widest of the usual serif faces
        let half = 0.5 * WIDEST_DIGIT * NUMBER * name.chars().count() as f64;
        let middle = (at + shift).min(right + BESIDE - half);
        svg.text([middle, bottom + 0.75 * NUMBER + 3.0], NUMBER, Anchor::Middle, name);
    }
    let (names, y_power) = numbers(&y.ticks);
    for (&tick, name) in y.ticks.iter().zip(&names) {
        let [_, at] = view.place([0.0, tick * y.unit]);
        svg.line([left, at], [left + TICK, at], hair);
        svg.line([right, at], [right - TICK, at], hair);
        svg.text([left - 3.0, at + 0.33 * NUMBER], NUMBER, Anchor::End, name);
    }
    let [across, up] = [0.5 * (left + right), 0.5 * (top + bottom)];
    x.label.write(svg, [across, bottom + 2.0 + NUMBER + LABEL + 1.0], x_power);
    y.label.write(svg, [left - 3.0 - 2.9 * NUMBER, up + 0.3 * LABEL], y_power);
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
    // Exact multiples of a power of ten, as people write them: 0.3 rather than 3 * 0.1.
    let (up, down) = if exponent >= 0.0 { (libm::pow(10.0, exponent), 1.0) } else { (1.0, libm::pow(10.0, -exponent)) };
    let lead = rough / up * down;
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter().find(|f| lead <= f * 1.0001).unwrap_or(10.0);
    let step = |i: f64| i * factor * up / down;
    // a tick at the very end is shown although the quotient is rounded; one that is invisibly beyond the end does no harm
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

/// The numbers at ticks, all with the same number of decimals and a true minus sign, and the power of ten by which they are
/// to be multiplied.
fn numbers(ticks: &[f64]) -> (Vec<String>, i32) {
    let largest = ticks.iter().fold(0.0f64, |m, t| m.max(t.abs()));
    let exponent = if largest >= 1e5 || (largest > 0.0 && largest < 1e-3) { exponent(largest) } else { 0 };
    let (up, down) = (libm::pow(10.0, f64::from(exponent.max(0))), libm::pow(10.0, f64::from(-exponent.min(0))));
    let plain: Vec<f64> = ticks.iter().map(|tick| tick / up * down).collect();
    // the power of ten, the quotient and the tick itself are rounded
    let is_right = |digits: usize, x: f64| {
        format!("{x:.digits$}").parse::<f64>().is_ok_and(|read| (read - x).abs() <= 1e-12 * largest / up * down)
    };
    let decimals = (0..12).find(|digits| plain.iter().all(|x| is_right(*digits, *x))).unwrap_or(12);
    (plain.iter().map(|x| minus(&format!("{x:.decimals$}"))).collect(), exponent)
}

/// The power of ten in a positive number.
fn exponent(x: f64) -> i32 {
    format!("{x:e}").rsplit('e').next().and_then(|exponent| exponent.parse().ok()).unwrap_or(0)
}

fn minus(text: &str) -> String {
    text.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::super::Window;
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
    fn the_last_number_is_on_the_page_in_a_wide_face_too() {
        let (frame, page) = (100.0, 100.0 + 31.0 + BESIDE);
        let view = View::fit(Window { low: [0.0, 0.0], high: [2000.0, 1000.0] }, [31.0, 3.0], frame, 50.0);
        let label = || Label::indexed("s", "");
        let mut svg = Svg::new(page, 80.0);
        draw(&mut svg, &view, &Axis::between(0.0, 2000.0, 4, label()), &Axis::between(0.0, 1000.0, 4, label()));
        let text = svg.to_string();
        let last = text.split("<text x=\"").find(|part| part.contains(">2000<")).unwrap();
        let middle: f64 = last.split('"').next().unwrap().parse().unwrap();
        assert!(middle + 2.0 * 0.64 * NUMBER < page + 0.01, "{last}");
    }

    #[test]
    fn numbers_share_their_decimals() {
        let texts = |ticks: &[f64]| numbers(ticks).0;
        assert_eq!(texts(&[-0.5, 0.0, 0.5]), ["\u{2212}0.5", "0.0", "0.5"]);
        assert_eq!(texts(&[0.0, 5.0]), ["0", "5"]);
        assert_eq!(numbers(&[0.0, 99_000.0]).1, 0);
    }

    #[test]
    fn a_power_of_ten_stands_at_the_axis_and_not_at_its_numbers() {
        assert_eq!(numbers(&[0.0, 2e-7]), (vec!["0".into(), "2".into()], -7));
        assert_eq!(numbers(&[0.0, 5e5, 1.5e6]), (vec!["0.0".into(), "0.5".into(), "1.5".into()], 6));
        for (low, high) in [(0.0, 1.7e141), (-3e-9, 0.0), (0.0, 1.3e6), (-1e-150, 1e-150), (2.1e5, 2.2e5)] {
            let (names, power) = numbers(&ticks(low, high, 5));
            assert!(power.abs() > 4 && names.iter().all(|name| name.chars().count() <= 5), "{names:?} {power}");
        }
        let label = Label { symbol: "s".into(), index: String::new() };
        assert!(label.markup(-9).ends_with(">\u{2212}9</tspan>") && label.markup(0).ends_with(">s</tspan>"));
        for (power, anchor, x) in [(0, "middle", 100.0), (-9, "start", 100.0 - 0.5 * label.width(-9))] {
            let mut svg = Svg::new(200.0, 100.0);
            label.write(&mut svg, [100.0, 50.0], power);
            let start = format!("<text x=\"{}\" y=\"50\" font-size=\"9\" text-anchor=\"{anchor}\">", Short(x));
            assert!(svg.to_string().contains(&start), "{svg}");
        }
        assert!(!Label::indexed("v", "0").markup(3).contains('%'), "CairoSVG takes percents of the page");
    }
}

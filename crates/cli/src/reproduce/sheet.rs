//! A page for several panels, and the strokes that figures share.

use std::fmt::Write as _;

use billiards::geometry::Table;

use crate::picture::{Anchor, Colour, Outline, Style, Svg, View, Window, escape};
use crate::simulation::strokes;

/// Width of walls.
const WALL: f64 = 0.7;
/// Size of labels.
pub(super) const LABEL: f64 = 8.5;

/// A page under construction.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    pub(super) svg: Svg,
}

impl Sheet {
    /// An empty page.
    pub(super) fn new(width: f64, height: f64) -> Self {
        Sheet { svg: Svg::new(width, height) }
    }

    /// A chain of lines in the plane.
    pub(super) fn chain(&mut self, view: &View, points: impl IntoIterator<Item = [f64; 2]>, style: Style) {
        let mut outline = Outline::new();
        outline.chain(points.into_iter().map(|p| view.place(p)));
        self.svg.path(&outline, style);
    }

    /// A closed, filled polygon in the plane.
    pub(super) fn region(&mut self, view: &View, points: impl IntoIterator<Item = [f64; 2]>, style: Style) {
        let mut outline = Outline::new();
        outline.chain(points.into_iter().map(|p| view.place(p))).close();
        self.svg.path(&outline, style);
    }

    /// A line of short dashes on the page.
    pub(super) fn dashed(&mut self, from: [f64; 2], to: [f64; 2], style: Style) {
        const DASH: f64 = 2.4;
        let d = [to[0] - from[0], to[1] - from[1]];
        let length = libm::hypot(d[0], d[1]);
        let at = |s: f64| [from[0] + d[0] * s / length, from[1] + d[1] * s / length];
        let mut outline = Outline::new();
        let mut s = 0.0;
        while s < length {
            outline.move_to(at(s)).line_to(at((s + DASH).min(length)));
            s += 1.8 * DASH;
        }
        self.svg.path(&outline, style);
    }

    /// An arrow on the page, its head in proportion to its width.
    pub(super) fn arrow(&mut self, from: [f64; 2], to: [f64; 2], colour: Colour, width: f64) {
        let d = [to[0] - from[0], to[1] - from[1]];
        let length = libm::hypot(d[0], d[1]);
        if length > 0.0 {
            let (u, head) = ([d[0] / length, d[1] / length], 3.0 + 3.0 * width);
            let base = [to[0] - head * u[0], to[1] - head * u[1]];
            self.svg.line(from, base, Style::line(colour, width));
            let half = 0.32 * head;
            let wing = |side: f64| [base[0] - side * half * u[1], base[1] + side * half * u[0]];
            self.svg.path(Outline::new().chain([to, wing(1.0), wing(-1.0)]).close(), Style::area(colour));
        }
    }

    /// A formula whose middle is at a point of the page; see [`math`].
    pub(super) fn label(&mut self, [x, y]: [f64; 2], text: &str) {
        self.svg.text([x, y + 0.33 * LABEL], LABEL, Anchor::Middle, &math(text));
    }

    /// A formula of another size and anchor.
    pub(super) fn label_as(&mut self, [x, y]: [f64; 2], size: f64, anchor: Anchor, text: &str) {
        self.svg.text([x, y + 0.33 * size], size, anchor, &math(text));
    }

    /// Draws the walls of a table.
    pub(super) fn walls(&mut self, view: &View, table: &Table) {
        for stroke in strokes::of(table, 1.0) {
            self.svg.path(&stroke.outline(view), Style::line(Colour::BLACK, WALL));
        }
    }

    /// What `draw` draws, clipped to a view.
    pub(super) fn within(&mut self, view: &View, draw: impl FnOnce(&mut Sheet)) {
        let mut inner = Sheet { svg: Svg::new(0.0, 0.0) };
        core::mem::swap(&mut inner.svg, &mut self.svg);
        inner.svg.clipped(view.corner(), view.size(), |svg| {
            let mut sheet = Sheet { svg: core::mem::replace(svg, Svg::new(0.0, 0.0)) };
            draw(&mut sheet);
            *svg = sheet.svg;
        });
        self.svg = inner.svg;
    }
}

/// A view of a window with room of `width` × `height` on the page, centred in it.
pub(super) fn fit(window: Window, [x, y]: [f64; 2], width: f64, height: f64) -> View {
    let [w, h] = View::fit(window, [0.0, 0.0], width, height).size();
    View::fit(window, [x + 0.5 * (width - w), y + 0.5 * (height - h)], width, height)
}

/// Markup of a formula: letters are italic, `_` and `^` lower and raise the next character or `{group}`, and words
/// are put between quotes.
pub(super) fn math(text: &str) -> String {
    let mut markup = String::new();
    let mut quoted = false;
    // The current vertical offset, and the space before the next run of characters.
    let mut off = 0.0;
    let mut chars = text.chars().peekable();
    let mut space = 0.0;
    let put = |markup: &mut String, run: &str, italic: bool, small: bool, [dx, dy]: [f64; 2]| {
        let face = if italic { " font-style=\"italic\"" } else { "" };
        // relative to the text around it: CairoSVG takes percentages relative to the page
        let size = if small { " font-size=\"0.7em\"" } else { "" };
        let right = if dx == 0.0 { String::new() } else { format!(" dx=\"{dx}em\"") };
        let down = if dy == 0.0 { String::new() } else { format!(" dy=\"{dy}\"") };
        // Writing to a string cannot fail.
        let _ = write!(markup, "<tspan{face}{size}{right}{down}>{}</tspan>", escape(run));
    };
    while let Some(c) = chars.next() {
        match c {
            '"' => quoted = !quoted,
            '_' | '^' if !quoted => {
                let to = if c == '_' { 2.0 } else { -3.0 };
                let run: String = if chars.next_if_eq(&'{').is_some() {
                    chars.by_ref().take_while(|c| *c != '}').collect()
                } else {
                    chars.next().into_iter().collect()
                };
                let italic = run.chars().all(char::is_alphabetic);
                put(&mut markup, &run, italic, true, [space, to - off]);
                (off, space) = (to, 0.0);
            }
            // Renderers drop a space that is the whole content of an element, so the next character is moved
            // instead.
            ' ' => space += 0.28,
            // As much as looks alike in one element: so words can be searched for, and no renderer puts one character on top of another.
            c => {
                let is_italic = |c: char| !quoted && c.is_alphabetic() && c != 'π';
                let italic = is_italic(c);
                let goes_on =
                    |c: &char| if quoted { *c != '"' } else { !"\"_^ ".contains(*c) && is_italic(*c) == italic };
                let mut run = c.to_string();
                while let Some(next) = chars.next_if(goes_on) {
                    run.push(next);
                }
                put(&mut markup, &run, italic, false, [space, -off]);
                (off, space) = (0.0, 0.0);
            }
        }
    }
    markup
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_numbers_are_written_in_one_piece() {
        let [words, numbers] = [math("\"mean time\" = 12.5"), math("2πγx_0 (3)")];
        assert_eq!(words, "<tspan>mean time</tspan><tspan dx=\"0.28em\">=</tspan><tspan dx=\"0.28em\">12.5</tspan>");
        let index = "<tspan font-size=\"0.7em\" dy=\"2\">0</tspan><tspan dx=\"0.28em\" dy=\"-2\">(3)</tspan>";
        assert_eq!(numbers, format!("<tspan>2π</tspan><tspan font-style=\"italic\">γx</tspan>{index}"));
    }

    #[test]
    fn indices_have_a_size_that_no_renderer_takes_of_the_page() {
        let markup = math("v_0^{12}");
        assert!(markup.contains("font-size=\"0.7em\"") && !markup.contains('%'), "{markup}");
    }
}

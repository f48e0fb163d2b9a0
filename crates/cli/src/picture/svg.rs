//! A small writer of SVG. Lengths are points of 1/72 inch; equal input gives equal bytes.

use std::fmt::{self, Write as _};

use super::ink::Colour;

/// Faces for text, best first.
const FACES: &str = "'Latin Modern Roman', 'CMU Serif', 'STIX Two Text', 'Libertinus Serif', 'Times New Roman', \
                     'Liberation Serif', 'DejaVu Serif', serif";

/// A picture under construction.
#[derive(Clone, Debug)]
pub struct Svg {
    width: f64,
    height: f64,
    body: String,
}

/// How a line or area is painted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Colour of the line, if there is one.
    pub stroke: Option<Colour>,
    /// Width of the line.
    pub width: f64,
    /// Colour of the area, if it is filled.
    pub fill: Option<Colour>,
    /// How opaque, 0 … 1.
    pub opacity: f64,
}

impl Style {
    /// A line.
    pub const fn line(colour: Colour, width: f64) -> Self {
        Self { stroke: Some(colour), width, fill: None, opacity: 1.0 }
    }

    /// An area.
    pub const fn area(colour: Colour) -> Self {
        Self { stroke: None, width: 0.0, fill: Some(colour), opacity: 1.0 }
    }

    /// The same, filled too.
    #[must_use]
    pub const fn filled(mut self, colour: Colour) -> Self {
        self.fill = Some(colour);
        self
    }

    /// The same, more or less opaque.
    #[must_use]
    pub const fn with_opacity(mut self, opacity: f64) -> Self {
        self.opacity = opacity;
        self
    }
}

/// Which point of a text is placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its left end.
    Start,
    /// Its middle.
    Middle,
    /// Its right end.
    End,
}

/// The outline of a path, step by step.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    steps: String,
    /// The current point, unless the outline is closed there.
    at: Option<[f64; 2]>,
}

/// A stroke that begins this near to the end of an outline continues it: ends of arcs are rounded.
const SAME: f64 = 1e-3;

impl Outline {
    /// An empty outline.
    pub fn new() -> Self {
        Self::default()
    }

    /// Starts a new part at a point.
    pub fn move_to(&mut self, [x, y]: [f64; 2]) -> &mut Self {
        self.at = Some([x, y]);
        self.push(format_args!("M{} {}", Short(x), Short(y)))
    }

    /// Continues from a point if the outline has come to it; otherwise starts a new part there.
    pub fn go_on_from(&mut self, [x, y]: [f64; 2]) -> &mut Self {
        match self.at {
            Some([u, v]) if (x - u).abs() <= SAME && (y - v).abs() <= SAME => self,
            _ => self.move_to([x, y]),
        }
    }

    /// A straight line to a point.
    pub fn line_to(&mut self, [x, y]: [f64; 2]) -> &mut Self {
        self.at = Some([x, y]);
        self.push(format_args!("L{} {}", Short(x), Short(y)))
    }

    /// A circular arc to a point: whether it is more than half a circle, and whether it turns clockwise on the page.
    pub fn arc_to(&mut self, [x, y]: [f64; 2], radius: f64, large: bool, clockwise: bool) -> &mut Self {
        let r = Short(radius);
        self.at = Some([x, y]);
        self.push(format_args!("A{r} {r} 0 {} {} {} {}", u8::from(large), u8::from(clockwise), Short(x), Short(y)))
    }

    /// Back to the start of this part.
    pub fn close(&mut self) -> &mut Self {
        self.at = None;
        self.push(format_args!("Z"))
    }

    /// Lines through points in turn, continuing the outline if it is at the first of them.
    pub fn chain(&mut self, points: impl IntoIterator<Item = [f64; 2]>) -> &mut Self {
        for (i, point) in points.into_iter().enumerate() {
            if i == 0 {
                self.go_on_from(point)
            } else {
                self.line_to(point)
            };
        }
        self
    }

    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    fn push(&mut self, step: fmt::Arguments<'_>) -> &mut Self {
        // Writing to a string cannot fail.
        let _ = self.steps.write_fmt(step);
        self
    }
}

/// A coordinate to a thousandth of a point, written as short as possible.
pub(super) struct Short(pub(super) f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = format!("{:.3}", self.0);
        let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
        f.write_str(if text == "-0" { "0" } else { text })
    }
}

impl Svg {
    /// An empty page.
    pub fn new(width: f64, height: f64) -> Self {
        Self { width, height, body: String::new() }
    }

    /// Width and height of the page.
    pub fn size(&self) -> [f64; 2] {
        [self.width, self.height]
    }

    /// Draws a path.
    pub fn path(&mut self, outline: &Outline, style: Style) {
        if !outline.is_empty() {
            self.element(format_args!("<path d=\"{}\"{}/>", outline.steps, Painted(style)));
        }
    }

    /// Draws paths of one style, which is written once. Paths that are not opaque are darker where they cross.
    pub fn paths(&mut self, outlines: impl IntoIterator<Item = Outline>, style: Style) {
        let mut outlines = outlines.into_iter().filter(|outline| !outline.is_empty()).peekable();
        if outlines.peek().is_none() {
            return;
        }
        self.element(format_args!("<g{}>", Painted(style)));
        outlines.for_each(|outline| self.element(format_args!("<path d=\"{}\"/>", outline.steps)));
        self.element(format_args!("</g>"));
    }

    /// Draws a straight line.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], style: Style) {
        self.path(Outline::new().move_to(from).line_to(to), style);
    }

    /// Draws a circle.
    pub fn circle(&mut self, [x, y]: [f64; 2], radius: f64, style: Style) {
        let (x, y, r) = (Short(x), Short(y), Short(radius));
        self.element(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"{}/>", Painted(style)));
    }

    /// Draws a rectangle by two opposite corners.
    pub fn rectangle(&mut self, a: [f64; 2], b: [f64; 2], style: Style) {
        let mut outline = Outline::new();
        outline.chain([a, [b[0], a[1]], b, [a[0], b[1]]]).close();
        self.path(&outline, style);
    }

    /// Draws many dots of one size.
    pub fn dots(&mut self, points: impl IntoIterator<Item = [f64; 2]>, diameter: f64, colour: Colour, opacity: f64) {
        let mut outline = Outline::new();
        for point in points {
            // A line of zero length with round ends is a dot, in half the bytes of a circle.
            outline.move_to(point).push(format_args!("h0"));
        }
        self.path(&outline, Style::line(colour, diameter).with_opacity(opacity));
    }

    /// Writes text; `content` may hold markup, so plain text needs escaping.
    pub fn text(&mut self, [x, y]: [f64; 2], size: f64, anchor: Anchor, content: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (x, y, size) = (Short(x), Short(y), Short(size));
        self.element(format_args!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\">{content}</text>"
        ));
    }

    /// Places a PNG image between two opposite corners.
    pub fn image(&mut self, png: &[u8], [x, y]: [f64; 2], [width, height]: [f64; 2]) {
        let (x, y, w, h) = (Short(x), Short(y), Short(width), Short(height));
        self.element(format_args!(
            "<image x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" preserveAspectRatio=\"none\" \
             href=\"data:image/png;base64,{}\"/>",
            base64(png)
        ));
    }

    /// Draws what `draw` draws, clipped to a rectangle.
    pub fn clipped(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], draw: impl FnOnce(&mut Self)) {
        let number = self.body.matches("<clipPath").count();
        let (x, y, w, h) = (Short(x), Short(y), Short(width), Short(height));
        self.element(format_args!(
            "<clipPath id=\"clip{number}\"><rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/></clipPath>\n\
             <g clip-path=\"url(#clip{number})\">"
        ));
        draw(self);
        self.element(format_args!("</g>"));
    }

    fn element(&mut self, element: fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = self.body.write_fmt(element);
        self.body.push('\n');
    }
}

impl fmt::Display for Svg {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (w, h) = (Short(self.width), Short(self.height));
        writeln!(f, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>")?;
        writeln!(
            f,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}pt\" height=\"{h}pt\" viewBox=\"0 0 {w} {h}\" \
             stroke-linecap=\"round\" stroke-linejoin=\"round\" font-family=\"{FACES}\" fill=\"{}\">",
            Hex(Colour::BLACK)
        )?;
        writeln!(f, "<rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>")?;
        f.write_str(&self.body)?;
        writeln!(f, "</svg>")
    }
}

/// Attributes of a style.
struct Painted(Style);

impl fmt::Display for Painted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.fill {
            Some(colour) => write!(f, " fill=\"{}\"", Hex(colour))?,
            None => f.write_str(" fill=\"none\"")?,
        }
        if let Some(colour) = self.0.stroke {
            write!(f, " stroke=\"{}\" stroke-width=\"{}\"", Hex(colour), Short(self.0.width))?;
        }
        if self.0.opacity < 1.0 {
            let what = if self.0.stroke.is_some() { "stroke-opacity" } else { "fill-opacity" };
            write!(f, " {what}=\"{}\"", Short(self.0.opacity))?;
        }
        Ok(())
    }
}

struct Hex(Colour);

impl fmt::Display for Hex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Colour(r, g, b) = self.0;
        write!(f, "#{r:02x}{g:02x}{b:02x}")
    }
}

/// Text with the special characters of XML escaped, and forbidden ones left out.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => {}
            c => escaped.push(c),
        }
    }
    escaped
}

/// Base 64 (RFC 4648).
fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let n = chunk.iter().fold(0u32, |n, b| n << 8 | u32::from(*b)) << (8 * (3 - chunk.len()));
        for i in 0..4 {
            if i <= chunk.len() {
                text.push(char::from(DIGITS[(n >> (18 - 6 * i) & 63) as usize]));
            } else {
                text.push('=');
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        for (plain, coded) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")] {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn coordinates_are_as_short_as_they_go() {
        let short = |x: f64| Short(x).to_string();
        assert_eq!(
            [short(1.0), short(-0.0001), short(0.1005), short(100.0), short(-2.5)],
            ["1", "0", "0.101", "100", "-2.5"]
        );
    }

    #[test]
    fn a_page_is_well_formed_xml() {
        let mut svg = Svg::new(100.0, 50.0);
        svg.clipped([0.0, 0.0], [10.0, 10.0], |svg| svg.circle([1.0, 2.0], 3.0, Style::area(Colour::BLACK)));
        svg.text([5.0, 5.0], 8.0, Anchor::Middle, &escape("a < b & \"c\"\u{0}"));
        svg.dots([[1.0, 1.0], [2.0, 2.0]], 0.5, Colour::BLACK, 0.5);
        let text = svg.to_string();
        let document = roxmltree::Document::parse(&text).unwrap();
        assert_eq!(document.descendants().filter(|n| n.has_tag_name("circle")).count(), 1);
    }
}

//! Path data: the small language of the `d` attribute.
//!
//! The reader is our own: `kurbo`'s turns elliptical arcs into cubic curves, whereas here they stay exact.
use core::ops::Range;
use nalgebra::Vector2;

/// Reads numbers and letters.
#[derive(Clone, Debug)]
pub(super) struct Scanner<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Scanner<'a> {
    pub(super) fn new(text: &'a str) -> Scanner<'a> {
        Scanner::part(text, 0..text.len())
    }

    /// Reads a part of a text, but counts characters from its beginning.
    pub(super) fn part(text: &'a str, part: Range<usize>) -> Scanner<'a> {
        let mut scanner = Scanner { text: &text[..part.end], at: part.start };
        scanner.skip();
        scanner
    }

    fn rest(&self) -> &'a [u8] {
        &self.text.as_bytes()[self.at..]
    }

    /// Skips blanks and commas.
    fn skip(&mut self) {
        while self.rest().first().is_some_and(|c| c.is_ascii_whitespace() || *c == b',') {
            self.at += 1;
        }
    }

    pub(super) fn is_at_end(&self) -> bool {
        self.rest().is_empty()
    }

    fn is_at_number(&self) -> bool {
        self.rest().first().is_some_and(|c| c.is_ascii_digit() || b"+-.".contains(c))
    }

    fn fail(&self, wanted: &str) -> String {
        let found: String = self.text.get(self.at..).unwrap_or("").chars().take(12).collect();
        let found = if found.is_empty() { "the end".into() } else { format!("{found:?}") };
        format!("expected {wanted} at character {}, found {found}", self.at + 1)
    }

    /// A finite number; it ends where no further character can belong to it.
    pub(super) fn number(&mut self) -> Result<f64, String> {
        let text = self.rest();
        let digits = |from: usize| text[from..].iter().take_while(|c| c.is_ascii_digit()).count();
        let mut end = usize::from(text.first().is_some_and(|c| b"+-".contains(c)));
        end += digits(end);
        if text.get(end) == Some(&b'.') {
            end += 1 + digits(end + 1);
        }
        if text.get(end).is_some_and(|c| b"eE".contains(c)) {
            let sign = usize::from(text.get(end + 1).is_some_and(|c| b"+-".contains(c)));
            let exponent = digits((end + 1 + sign).min(text.len()));
            if exponent > 0 {
                end += 1 + sign + exponent;
            }
        }
        match core::str::from_utf8(&text[..end]).ok().and_then(|s| s.parse::<f64>().ok()) {
            Some(value) if value.is_finite() => {
                self.at += end;
                self.skip();
                Ok(value)
            }
            Some(_) => Err(self.fail("a number between -1e150 and 1e150")),
            None => Err(self.fail("a number")),
        }
    }

    /// `0` or `1`, which need no separator.
    fn flag(&mut self) -> Result<bool, String> {
        let value = match self.rest().first() {
            Some(b'0') => false,
            Some(b'1') => true,
            _ => return Err(self.fail("a flag, 0 or 1,")),
        };
        self.at += 1;
        self.skip();
        Ok(value)
    }

    fn letter(&mut self) -> Result<u8, String> {
        match self.rest().first() {
            Some(&c) if b"MmLlHhVvCcSsQqTtAaZz".contains(&c) => {
                self.at += 1;
                self.skip();
                Ok(c)
            }
            _ => Err(self.fail("a path command")),
        }
    }
}

/// A part of a path that starts with a move.
#[derive(Clone, Debug)]
pub(super) struct Subpath {
    pub(super) start: Vector2<f64>,
    pub(super) edges: Vec<Draw>,
    /// Whether the path data close it.
    pub(super) closed: bool,
}

/// An edge of a path.
#[derive(Clone, Copy, Debug)]
pub(super) enum Draw {
    Line(Vector2<f64>),
    Cubic(Vector2<f64>, Vector2<f64>, Vector2<f64>),
    Arc { radii: [f64; 2], tilt: f64, large: bool, sweep: bool, to: Vector2<f64> },
}

impl Draw {
    pub(super) fn end(&self) -> Vector2<f64> {
        match *self {
            Draw::Line(to) | Draw::Cubic(.., to) | Draw::Arc { to, .. } => to,
        }
    }
    /// Points from which its size is estimated.
    pub(super) fn points(&self) -> Vec<Vector2<f64>> {
        match *self {
            Draw::Cubic(b, c, d) => vec![b, c, d],
            _ => vec![self.end()],
        }
    }
}

/// The vertices of a polygon.
pub(super) fn points(text: &str) -> Result<Vec<Vector2<f64>>, String> {
    let mut scanner = Scanner::new(text);
    let mut points = vec![];
    while !scanner.is_at_end() {
        points.push(Vector2::new(scanner.number()?, scanner.number()?));
    }
    Ok(points)
}

/// The parts of a path.
pub(super) fn parse(text: &str) -> Result<Vec<Subpath>, String> {
    let mut scanner = Scanner::new(text);
    let mut parts: Vec<Subpath> = vec![];
    let mut at = Vector2::zeros();
    // the last control point, for the smooth commands
    let (mut cubic, mut quadratic) = (None, None);
    let mut command = b'M';
    let mut first = true;
    while !scanner.is_at_end() {
        if first || !scanner.is_at_number() {
            command = scanner.letter()?;
            if first && !b"Mm".contains(&command) {
                return Err("a path must start with M or m".into());
            }
        } else if b"Zz".contains(&command) {
            return Err(scanner.fail("a path command"));
        }
        first = false;
        let relative = command.is_ascii_lowercase();
        let base = if relative { at } else { Vector2::zeros() };
        let point = |scanner: &mut Scanner| Ok::<_, String>(base + Vector2::new(scanner.number()?, scanner.number()?));
        let mut next = (None, None);
        let draw = match command.to_ascii_uppercase() {
            b'M' => {
                at = point(&mut scanner)?;
                parts.push(Subpath { start: at, edges: vec![], closed: false });
                // further points are lines
                command = if relative { b'l' } else { b'L' };
                (cubic, quadratic) = (None, None);
                continue;
            }
            b'Z' => {
                // the part after a closed one starts where that one did
                if let Some(part) = parts.last_mut() {
                    part.closed = true;
                    at = part.start;
                }
                parts.push(Subpath { start: at, edges: vec![], closed: false });
                (cubic, quadratic) = (None, None);
                continue;
            }
            b'L' => Draw::Line(point(&mut scanner)?),
            b'H' => Draw::Line(Vector2::new(base.x + scanner.number()?, at.y)),
            b'V' => Draw::Line(Vector2::new(at.x, base.y + scanner.number()?)),
            b'C' | b'S' => {
                let reflected = cubic.map_or(at, |c: Vector2<f64>| at * 2.0 - c);
                let b = if command.eq_ignore_ascii_case(&b'C') { point(&mut scanner)? } else { reflected };
                let c = point(&mut scanner)?;
                next.0 = Some(c);
                Draw::Cubic(b, c, point(&mut scanner)?)
            }
            b'Q' | b'T' => {
                let reflected = quadratic.map_or(at, |c: Vector2<f64>| at * 2.0 - c);
                let c = if command.eq_ignore_ascii_case(&b'Q') { point(&mut scanner)? } else { reflected };
                next.1 = Some(c);
                let to = point(&mut scanner)?;
                let third = 2.0 / 3.0;
                Draw::Cubic(at + (c - at) * third, to + (c - to) * third, to)
            }
            _ => {
                let radii = [scanner.number()?.abs(), scanner.number()?.abs()];
                let (tilt, large, sweep) = (scanner.number()?, scanner.flag()?, scanner.flag()?);
                Draw::Arc { radii, tilt, large, sweep, to: point(&mut scanner)? }
            }
        };
        (cubic, quadratic) = next;
        at = draw.end();
        if let Some(part) = parts.last_mut() {
            part.edges.push(draw);
        }
    }
    parts.retain(|part| !part.edges.is_empty());
    Ok(parts)
}

/// The rounding of the ends and radii of an arc, and that of the formulas here, change the square of half its chord, in units of its radius,
/// by no more than this many times the rounding of coordinates.
const ROUNDING: f64 = 8.0;

/// The centre of an elliptic arc given by its ends, and its radii, enlarged where they are too small to reach; `None`
/// where the arc is straight (SVG 1.1, F.6.5 and F.6.6).
///
/// An arc whose chord is a diameter within rounding is half the ellipse. Its centre is at a height of `√(1 − d²)` over the chord, where `d` is
/// half the chord in units of the radius: rounding of `d` would move it by some 10⁻⁸.
pub(super) fn center(
    from: Vector2<f64>,
    to: Vector2<f64>,
    radii: [f64; 2],
    tilt: f64,
    large: bool,
    sweep: bool,
) -> Option<(Vector2<f64>, [f64; 2])> {
    if radii.contains(&0.0) || from == to {
        return None;
    }
    let angle = tilt * (core::f64::consts::PI / 180.0);
    let (cos, sin) = (libm::cos(angle), libm::sin(angle));
    let half = (from - to) * 0.5;
    // in units in which the ellipse is a circle of radius 1
    let turned = Vector2::new(cos * half.x + sin * half.y, cos * half.y - sin * half.x);
    let d = Vector2::new(turned.x / radii[0], turned.y / radii[1]);
    let square = d.norm_squared();
    let scale = square.sqrt().max(1.0);
    let rounding = ROUNDING * f64::EPSILON * from.amax().max(to.amax()) * (d.x.abs() / radii[0] + d.y.abs() / radii[1]);
    let radii = radii.map(|r| r * scale);
    let height = if square > 1.0 - rounding { 0.0 } else { ((1.0 - square) / square).sqrt() };
    let height = if large == sweep { -height } else { height };
    let c = Vector2::new(d.y * height * radii[0], -d.x * height * radii[1]);
    let middle = (from + to) * 0.5;
    let center = Vector2::new(cos * c.x - sin * c.y, sin * c.x + cos * c.y) + middle;
    center.iter().all(|x| x.is_finite()).then_some((center, radii))
}

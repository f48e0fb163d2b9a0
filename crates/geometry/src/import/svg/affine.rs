//! Affine maps of the plane, as SVG writes them.
use super::path::Scanner;
use nalgebra::Vector2;

/// `(x, y) ↦ (a x + c y + e, b x + d y + f)`
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine([f64; 6]);

impl Affine {
    pub(super) const IDENTITY: Affine = Affine([1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    /// From axes with y down to axes with y up.
    pub(super) const FLIP: Affine = Affine([1.0, 0.0, 0.0, -1.0, 0.0, 0.0]);

    pub(super) fn translation(x: f64, y: f64) -> Affine {
        Affine([1.0, 0.0, 0.0, 1.0, x, y])
    }

    /// The composition: first `inner`, then this map.
    pub(super) fn after(&self, inner: &Affine) -> Affine {
        let ([a, b, c, d, e, f], [p, q, r, s, t, u]) = (self.0, inner.0);
        Affine([a * p + c * q, b * p + d * q, a * r + c * s, b * r + d * s, a * t + c * u + e, b * t + d * u + f])
    }

    pub(super) fn apply(&self, p: Vector2<f64>) -> Vector2<f64> {
        let [a, b, c, d, e, f] = self.0;
        Vector2::new(a * p.x + c * p.y + e, b * p.x + d * p.y + f)
    }

    pub(super) fn determinant(&self) -> f64 {
        let [a, b, c, d, ..] = self.0;
        a * d - b * c
    }

    /// Semi-axes and angle of the image of an ellipse with the given radii, the first at `tilt` (degrees) to the x axis:
    /// singular values of the linear part.
    pub(super) fn ellipse(&self, radii: [f64; 2], tilt: f64) -> ([f64; 2], f64) {
        let [a, b, c, d, ..] = self.after(&rotation(tilt)).0;
        let (a, b, c, d) = (a * radii[0], b * radii[0], c * radii[1], d * radii[1]);
        // an ellipse with axes along the coordinate axes keeps them exactly
        if b == 0.0 && c == 0.0 {
            return ([a.abs(), d.abs()], 0.0);
        }
        let (e, f, g, h) = (0.5 * (a + d), 0.5 * (a - d), 0.5 * (b + c), 0.5 * (b - c));
        let (q, r) = (libm::hypot(e, h), libm::hypot(f, g));
        ([q + r, (q - r).abs()], 0.5 * (libm::atan2(g, f) + libm::atan2(h, e)))
    }
}

/// The rotation by an angle in degrees, exact for right angles.
fn rotation(degrees: f64) -> Affine {
    let quarters = libm::round(degrees / 90.0);
    let rest = (degrees - 90.0 * quarters) * (core::f64::consts::PI / 180.0);
    let (mut cos, mut sin) = (libm::cos(rest), libm::sin(rest));
    let turns = quarters - 4.0 * libm::floor(quarters / 4.0);
    for k in 1..4 {
        if turns >= f64::from(k) {
            (cos, sin) = (-sin, cos);
        }
    }
    Affine([cos, sin, -sin, cos, 0.0, 0.0])
}

/// A list of transformations.
pub(super) fn parse(text: &str) -> Result<Affine, String> {
    let mut all = Affine::IDENTITY;
    let mut rest = text.trim_start_matches(|c: char| c.is_whitespace() || c == ',');
    while !rest.is_empty() {
        let (name, after) = rest.split_once('(').ok_or_else(|| format!("transform: no parenthesis after {rest:?}"))?;
        let start = text.len() - after.len();
        let (inside, after) = after.split_once(')').ok_or("transform: a parenthesis is not closed")?;
        let mut scanner = Scanner::part(text, start..start + inside.len());
        let mut n = vec![];
        while !scanner.is_at_end() {
            n.push(scanner.number().map_err(|problem| format!("transform: {problem}"))?);
        }
        let name = name.trim();
        let tan = |degrees: f64| libm::tan(degrees * (core::f64::consts::PI / 180.0));
        let next = match (name, n.as_slice()) {
            ("matrix", &[a, b, c, d, e, f]) => Affine([a, b, c, d, e, f]),
            ("translate", &[x]) => Affine::translation(x, 0.0),
            ("translate", &[x, y]) => Affine::translation(x, y),
            ("scale", &[s]) => Affine([s, 0.0, 0.0, s, 0.0, 0.0]),
            ("scale", &[x, y]) => Affine([x, 0.0, 0.0, y, 0.0, 0.0]),
            ("rotate", &[angle]) => rotation(angle),
            ("rotate", &[angle, x, y]) => {
                Affine::translation(x, y).after(&rotation(angle)).after(&Affine::translation(-x, -y))
            }
            ("skewX", &[angle]) => Affine([1.0, 0.0, tan(angle), 1.0, 0.0, 0.0]),
            ("skewY", &[angle]) => Affine([1.0, tan(angle), 0.0, 1.0, 0.0, 0.0]),
            _ => return Err(format!("transform: {name}({inside}) is not a known transformation")),
        };
        all = all.after(&next);
        rest = after.trim_start_matches(|c: char| c.is_whitespace() || c == ',');
    }
    Ok(all)
}

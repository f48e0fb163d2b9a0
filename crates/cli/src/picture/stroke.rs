//! Walls as lines on a page.

use super::svg::Outline;
use super::view::{View, Window};

/// A piece of wall.
#[derive(Clone, Debug, PartialEq)]
pub enum Stroke {
    /// A segment between two points.
    Segment([f64; 2], [f64; 2]),
    /// An infinite line: a point and a direction.
    Line([f64; 2], [f64; 2]),
    /// A half-infinite line: its end and a direction.
    Ray([f64; 2], [f64; 2]),
    /// An arc: centre, radius, angle of its start, angle swept (counter-clockwise positive).
    Arc {
        /// Centre.
        center: [f64; 2],
        /// Radius.
        radius: f64,
        /// Angle of the start.
        start: f64,
        /// Angle swept, counter-clockwise positive.
        sweep: f64,
    },
    /// A whole circle.
    Circle {
        /// Centre.
        center: [f64; 2],
        /// Radius.
        radius: f64,
    },
    /// Any curve, as a chain of points close enough together to look smooth.
    Chain(Vec<[f64; 2]>),
}

/// The inside of closed strokes and chains of strokes: each stroke begins where the one before it ends, or begins a new
/// chain.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// The strokes around it.
    pub edge: Vec<Stroke>,
    /// Whether it is a hollow in an obstacle drawn before, rather than an obstacle.
    pub is_hollow: bool,
}

/// Strokes as one outline on the page, which is continuous where a stroke begins at the end of the last.
pub(super) fn joined(strokes: &[Stroke], view: &View) -> Outline {
    let mut outline = Outline::new();
    for stroke in strokes {
        stroke.trace(view, &mut outline);
    }
    outline
}

impl Stroke {
    /// Points that a window must contain to show this piece; for an infinite one, its finite end.
    pub(super) fn extent(&self) -> Vec<[f64; 2]> {
        match *self {
            Self::Segment(a, b) => vec![a, b],
            Self::Line(..) => vec![],
            Self::Ray(a, _) => vec![a],
            Self::Arc { center, radius, start, sweep } => {
                // Its ends, and its extreme points: multiples of a quarter turn.
                let quarter = core::f64::consts::FRAC_PI_2;
                let (low, high) = if sweep < 0.0 { (start + sweep, start) } else { (start, start + sweep) };
                let mut points = vec![on(center, radius, low), on(center, radius, high)];
                let mut turn = libm::ceil(low / quarter);
                while turn * quarter < high && points.len() < 8 {
                    points.push(on(center, radius, turn * quarter));
                    turn += 1.0;
                }
                points
            }
            Self::Circle { center: [x, y], radius: r } => vec![[x - r, y - r], [x + r, y + r]],
            Self::Chain(ref points) => points.clone(),
        }
    }

    /// The distance of a point from an infinite piece.
    pub(super) fn distance(&self, at: [f64; 2]) -> Option<f64> {
        let (&Self::Line([x, y], [u, v]) | &Self::Ray([x, y], [u, v])) = self else { return None };
        let (square, [a, b]) = (u * u + v * v, [at[0] - x, at[1] - y]);
        let least = if matches!(self, Self::Ray(..)) { 0.0 } else { f64::NEG_INFINITY };
        let along = ((a * u + b * v) / square).max(least);
        Some(libm::hypot(a - along * u, b - along * v))
    }

    /// Its outline on the page.
    pub fn outline(&self, view: &View) -> Outline {
        let mut outline = Outline::new();
        self.trace(view, &mut outline);
        outline
    }

    /// Adds it to an outline.
    fn trace(&self, view: &View, outline: &mut Outline) {
        let window = view.window();
        match *self {
            Self::Segment(a, b) => {
                outline.chain([view.place(a), view.place(b)]);
            }
            Self::Line(point, direction) => clipped(outline, view, window, point, direction, f64::NEG_INFINITY),
            Self::Ray(point, direction) => clipped(outline, view, window, point, direction, 0.0),
            Self::Arc { center, radius, start, sweep } => {
                // Two halves: a single arc of nearly a whole turn would be lost to rounding.
                let (middle, end) = (start + 0.5 * sweep, start + sweep);
                let large = sweep.abs() > 2.0 * core::f64::consts::PI;
                outline.go_on_from(view.place(on(center, radius, start)));
                for angle in [middle, end] {
                    outline.arc_to(view.place(on(center, radius, angle)), radius * view.scale(), large, sweep < 0.0);
                }
            }
            Self::Circle { center, radius } => {
                let (a, b) = ([center[0] + radius, center[1]], [center[0] - radius, center[1]]);
                let r = radius * view.scale();
                outline.move_to(view.place(a));
                outline.arc_to(view.place(b), r, false, false).arc_to(view.place(a), r, false, false).close();
            }
            Self::Chain(ref points) => {
                outline.chain(points.iter().map(|p| view.place(*p)));
            }
        }
    }
}

fn clipped(outline: &mut Outline, view: &View, window: Window, point: [f64; 2], direction: [f64; 2], from: f64) {
    if let Some(ends) = window.clip(point, direction, [from, f64::INFINITY]) {
        outline.chain(ends.map(|p| view.place(p)));
    }
}

fn on(center: [f64; 2], radius: f64, angle: f64) -> [f64; 2] {
    [center[0] + radius * libm::cos(angle), center[1] + radius * libm::sin(angle)]
}

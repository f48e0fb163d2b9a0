//! Bézier curves as smoothly joined circular arcs.
use super::contour::{Edge, Oval, Pen};
use crate::{Piece, shapes::Arc};
use nalgebra::Vector2;

/// Arcs with a radius of more than this many times the size of the drawing are drawn straight: distant centres cost
/// accuracy.
const FLAT: f64 = 1024.0;

/// Most halvings of a curve; a tolerance at the level of rounding needs about 17 for a wild one.
const HALVINGS: u32 = 24;

/// How far the arcs may be from the curve, and how large the drawing is \[L\].
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    pub(super) tolerance: f64,
    pub(super) size: f64,
}

impl Fit {
    /// Draws the cubic curve with the given control points, the first of which is where the pen is.
    pub(super) fn cubic(&self, pen: &mut Pen, curve: [Vector2<f64>; 4]) {
        self.halve(pen, curve, HALVINGS);
    }

    fn halve(&self, pen: &mut Pen, curve: [Vector2<f64>; 4], halvings: u32) {
        if curve[3] == curve[0] && curve[1] == curve[0] && curve[2] == curve[0] {
            return;
        }
        if halvings == 0 {
            pen.draw(Edge::Line, curve[3]);
            return;
        }
        if let Some((joint, edges)) = self.biarc(&curve) {
            pen.draw(edges[0], joint);
            pen.draw(edges[1], curve[3]);
            return;
        }
        let [a, b] = halves(curve);
        self.halve(pen, a, halvings - 1);
        self.halve(pen, b, halvings - 1);
    }

    /// Two arcs with the ends and the end tangents of the curve, if they are near enough.
    fn biarc(&self, curve: &[Vector2<f64>; 4]) -> Option<(Vector2<f64>, [Edge; 2])> {
        let [p, .., q] = *curve;
        let t = tangent([curve[0], curve[1], curve[2], curve[3]])?;
        let u = -tangent([curve[3], curve[2], curve[1], curve[0]])?;
        // arcs of equal tangent lengths d: |v|² − 2 d v·(t + u) − 2 d² (1 − t·u) = 0
        let v = q - p;
        let sum = t + u;
        let (a, b, c) = (2.0 * (1.0 - t.dot(&u)), v.dot(&sum), v.norm_squared());
        // curves that turn by more than a right angle are halved first
        if t.dot(&u) <= 0.0 || b <= 0.0 {
            return None;
        }
        let d = c / (b + (b * b + a * c).sqrt());
        let joint = (p + q + (t - u) * d) * 0.5;
        let edges = [self.arc(p, t, joint)?, self.arc(q, -u, joint).map(Edge::reversed)?];
        let near = |x: Vector2<f64>| {
            let off = [(p, joint, edges[0]), (joint, q, edges[1])].map(|(a, b, edge)| distance(edge, a, b, x));
            // between the nine places it may be a little more
            off[0].min(off[1]) <= 0.75 * self.tolerance
        };
        // the same places from either end: a curve that is drawn both ways, once for each of its sides, becomes the same arcs
        let [start, end] = [*curve, [curve[3], curve[2], curve[1], curve[0]]];
        let [[.., middle], _] = halves(*curve);
        let is_near =
            near(middle) && [0.06, 0.17, 0.29, 0.4].iter().all(|&s| near(point(&start, s)) && near(point(&end, s)));
        is_near.then_some((joint, edges))
    }

    /// The arc from `p` in direction `t` to `q`; `None` where it is neither short of half a circle nor straight.
    fn arc(&self, p: Vector2<f64>, t: Vector2<f64>, q: Vector2<f64>) -> Option<Edge> {
        let chord = q - p;
        if chord.dot(&t) <= 0.0 {
            return None;
        }
        let height = t.perp(&chord); // chord · normal
        let square = chord.norm_squared();
        if square > 2.0 * FLAT * self.size * height.abs() {
            return Some(Edge::Line);
        }
        let radius = 0.5 * square / height;
        let center = p + Vector2::new(-t.y, t.x) * radius;
        let oval = Oval { center, semi_axes: [radius.abs(); 2], angle: 0.0 };
        Some(Edge::Arc { oval, counter_clockwise: radius > 0.0 })
    }
}

impl Edge {
    /// The same edge, drawn the other way.
    fn reversed(self) -> Edge {
        match self {
            Edge::Line => Edge::Line,
            Edge::Arc { oval, counter_clockwise } => Edge::Arc { oval, counter_clockwise: !counter_clockwise },
        }
    }
}

/// The distance of a point `x` from an edge from `a` to `b`.
fn distance(edge: Edge, a: Vector2<f64>, b: Vector2<f64>, x: Vector2<f64>) -> f64 {
    match edge {
        Edge::Arc { oval, counter_clockwise } => Arc::new(oval.center, a, b, counter_clockwise)
            .map_or(f64::INFINITY, |arc| (arc.closest(&x).point - x).norm()),
        Edge::Line => {
            let chord = b - a;
            let part = ((x - a).dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
            (a + chord * part - x).norm()
        }
    }
}

/// Direction of a curve at its first point.
fn tangent(curve: [Vector2<f64>; 4]) -> Option<Vector2<f64>> {
    let [p, rest @ ..] = curve;
    let to = rest.into_iter().find(|c| *c != p)?;
    let d = to - p;
    let length = libm::hypot(d.x, d.y);
    (length > 0.0 && length.is_finite()).then(|| d / length)
}

fn point(c: &[Vector2<f64>; 4], s: f64) -> Vector2<f64> {
    let r = 1.0 - s;
    c[0] * (r * r * r) + c[1] * (3.0 * r * r * s) + c[2] * (3.0 * r * s * s) + c[3] * (s * s * s)
}

/// The two halves of a cubic curve (de Casteljau).
fn halves([a, b, c, d]: [Vector2<f64>; 4]) -> [[Vector2<f64>; 4]; 2] {
    let mid = |p: Vector2<f64>, q: Vector2<f64>| (p + q) * 0.5;
    let (ab, bc, cd) = (mid(a, b), mid(b, c), mid(c, d));
    let (abc, bcd) = (mid(ab, bc), mid(bc, cd));
    let middle = mid(abc, bcd);
    [[a, ab, abc, middle], [middle, bcd, cd, d]]
}

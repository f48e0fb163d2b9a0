//! Whether a chord joins two points of the same strand of a curve: others may run beside it, with the same tangents.
use super::{Chords, ImplicitFormula, Interval, Parametric, is_straight, tangent};
use nalgebra::Vector2;

/// How often a chord is halved, and most parts of it that may be left: where bounds on the derivatives do not tell whether the curve goes
/// from one end of a part to the other then, the part must be straight. One that leads to another strand is not, unless this is nearer than
/// a millionth of the chord.
const HALVINGS: u32 = 20;
const MOST_PARTS: usize = 512;

/// The least slope to which the curve is confined: where it runs along the chord, its slope at the ends is rounding.
const FLAT: f64 = 1.0 / 1_048_576.0;

/// A part of a chord: parameters of its ends, and the points of the curve and its tangents there.
#[derive(Clone, Copy, Debug)]
struct Part {
    range: [f64; 2],
    ends: [[Vector2<f64>; 2]; 2],
}

impl Part {
    /// Whether the curve is known to go from one end to the other, as a graph over the line between them.
    ///
    /// It is, if in the rectangle around this line, of half height `σ` times half its length, the curve through every point is a graph of
    /// slope `σ` or less, all traversed in the same sense: those through the ends do not leave the rectangle before its middle, and there
    /// they meet, as `f` rises across the line.
    fn is_proved<F: ImplicitFormula>(&self, formula: &F) -> bool {
        let [[p, t], [q, u]] = self.ends;
        let half = 0.5 * (q - p).norm();
        let along = (q - p) / (2.0 * half);
        let across = Vector2::new(along.y, -along.x);
        let slope = |t: Vector2<f64>| (t.dot(&across) / t.dot(&along)).abs();
        let most = (2.0 * slope(t).max(slope(u))).max(FLAT);
        let middle = (p + q) * 0.5;
        let sides = (along.abs() + across.abs() * most) * half;
        let over = [0, 1].map(|i| Interval::new(middle[i] - sides[i], middle[i] + sides[i]));
        // the gradient in the middle, and second derivatives; or the gradient over the rectangle
        let gradient = Vector2::from(formula.gradient(middle.into()));
        let [xx, xy, yy] = formula.hessian_over(over);
        let second = |a: Vector2<f64>, b: Vector2<f64>| {
            (xx * (a.x * b.x) + xy * (a.x * b.y + a.y * b.x) + yy * (a.y * b.y)).magnitude() * half
        };
        let turn = second(along, across);
        let rate = gradient.dot(&along).abs() + second(along, along) + turn * most;
        if rate <= most * (gradient.dot(&across) - turn - second(across, across) * most) {
            return true;
        }
        let [fx, fy] = formula.gradient_over(over);
        let rate = (fx * along.x + fy * along.y).magnitude();
        rate <= most * (fx * across.x + fy * across.y).low
    }

    /// Whether a formula has any bound on its derivatives in the middle.
    fn is_bounded<F: ImplicitFormula>(&self, formula: &F) -> bool {
        let middle = (self.ends[0][0] + self.ends[1][0]) * 0.5;
        let there = [middle.x, middle.y].map(Interval::from);
        let is_finite = |over: &[Interval]| over.iter().all(|x| x.magnitude().is_finite());
        is_finite(&formula.hessian_over(there)) || is_finite(&formula.gradient_over(there))
    }
}

/// Whether the curve goes from one end of a chord to the other, as far as bounds on the derivatives of `f` tell, and its points between.
pub(super) fn is_followed<F: ImplicitFormula>(formula: &F, vertices: [Vector2<f64>; 2]) -> bool {
    let chord = Chords { formula, vertices: &vertices };
    let at = |u: f64| {
        let [p, _] = chord.at(u);
        Some([p, tangent(formula, p)?])
    };
    let part = |range: [f64; 2]| {
        let [Some(from), Some(to)] = range.map(at) else { return None };
        Some(Part { range, ends: [from, to] })
    };
    let Some(whole) = part([0.0, 1.0]) else { return false };
    let mut open = vec![whole];
    for _ in 0..HALVINGS {
        open.retain(|part| !part.is_proved(formula) && part.is_bounded(formula));
        if open.is_empty() || open.len() > MOST_PARTS {
            break;
        }
        let halves = open.iter().flat_map(|part| {
            let [low, high] = part.range;
            let middle = 0.5 * (low + high);
            [[low, middle], [middle, high]]
        });
        let Some(halves) = halves.map(part).collect() else { return false };
        open = halves;
    }
    open.iter().all(|part| is_straight(part.ends[0], part.ends[1]))
}

//! Whether a curve is all there is in its box.
use super::{ImplicitFormula, Interval};
use crate::{BoxTree, Error, ImplicitRule, piece::Extent, shapes::curve::ArcLength};
use nalgebra::Vector2;

/// Parts of a side of the box in which other zeros of `f` are looked for, and how often these are halved: where `f` is still not known to
/// differ from 0 then, it is taken to vanish.
const GRID: u32 = 48;
const HALVINGS: u32 = 10;
/// Most parts for which more than the sign in the middle is examined.
const MOST_PARTS: u32 = 1 << 18;

/// Fails unless the traced curve is the only one: elsewhere in the box `f` has no zero, and has the right sign.
pub(super) fn alone<F: ImplicitFormula>(formula: &F, region: &Extent, table: &ArcLength) -> Result<(), Error> {
    let chords = Tabulated::new(table);
    let half = (region.max - region.min) * (0.5 / f64::from(GRID));
    let part = |k: u32| Vector2::new(f64::from(k % GRID), f64::from(k / GRID)) * 2.0 + Vector2::repeat(1.0);
    // their middles, how often they were halved, and whether they are so near to the curve that `f` may vanish
    let mut open: Vec<(Vector2<f64>, u32, bool)> =
        (0..GRID * GRID).map(|k| (region.min + half.component_mul(&part(k)), 0, false)).collect();
    let mut looked_at = 0;
    while let Some((middle, halvings, may_vanish)) = open.pop() {
        looked_at += 1;
        let half = half / f64::from(1 << halvings);
        let value = formula.value(middle.into());
        // where nothing is known, or `f` changes too fast everywhere, the sign in the middle must suffice
        let bound = change(formula, middle, half);
        let is_known = bound == f64::INFINITY
            || value.is_nan()
            || looked_at > MOST_PARTS
            || value.abs() > bound
            || !formula.value_over(around(middle, half)).contains(0.0);
        let fails = if is_known {
            chords.surrounds(&middle) != (value < 0.0) && !chords.is_beside(&middle, 0.0)
        } else if chords.is_beside(&middle, half.norm()) {
            false
        } else {
            let may_vanish = may_vanish || chords.is_near(&middle, half.norm());
            if halvings < HALVINGS {
                let quarters = [[-0.5, -0.5], [0.5, -0.5], [-0.5, 0.5], [0.5, 0.5]].map(Vector2::from);
                open.extend(quarters.map(|q| (middle + half.component_mul(&q), halvings + 1, may_vanish)));
            }
            halvings == HALVINGS && !may_vanish
        };
        if fails {
            return Err(Error::Curve { must: ImplicitRule::Alone, at: middle.into() });
        }
    }
    Ok(())
}

/// The box of half sides `half` around a point.
fn around(middle: Vector2<f64>, half: Vector2<f64>) -> [Interval; 2] {
    [0, 1].map(|i| Interval::new(middle[i] - half[i], middle[i] + half[i]))
}

/// A bound on how much `f` differs in a box from its value in the middle, by the mean value theorem: with the gradient over the box, or with
/// that in the middle and second derivatives.
fn change<F: ImplicitFormula>(formula: &F, middle: Vector2<f64>, half: Vector2<f64>) -> f64 {
    let over = around(middle, half);
    let [fx, fy] = formula.gradient_over(over).map(Interval::magnitude);
    let [gx, gy] = formula.gradient(middle.into()).map(f64::abs);
    let [fxx, fxy, fyy] = formula.hessian_over(over).map(Interval::magnitude);
    let bend = 0.5 * (fxx * half.x * half.x + fyy * half.y * half.y) + fxy * half.x * half.y;
    (fx * half.x + fy * half.y).min(gx * half.x + gy * half.y + bend)
}

/// The chords between the points tabulated for the length of a curve.
struct Tabulated {
    points: Vec<Vector2<f64>>,
    /// Boxes around them, enlarged by their lengths.
    tree: BoxTree,
    /// The length of the longest.
    longest: f64,
}

impl Tabulated {
    fn new(table: &ArcLength) -> Self {
        let points: Vec<Vector2<f64>> = table.points().collect();
        let lengths = || points.windows(2).map(|w| (w[1] - w[0]).norm());
        let boxes: Vec<Extent> = (points.windows(2).zip(lengths()))
            .map(|(w, length)| {
                let (Extent { min, max }, room) = (Extent::of([w[0], w[1]]), Vector2::repeat(length));
                Extent { min: min - room, max: max + room }
            })
            .collect();
        let longest = lengths().fold(0.0, f64::max);
        Tabulated { tree: BoxTree::in_order(&boxes), longest, points }
    }

    fn chord(&self, k: usize) -> [Vector2<f64>; 2] {
        [self.points[k], self.points[k + 1]]
    }

    /// Whether a point lies inside the curve, from the crossings of the half-line to its right.
    fn surrounds(&self, p: &Vector2<f64>) -> bool {
        let mut is_within = false;
        let may_cross = |e: &Extent| e.min.y <= p.y && p.y <= e.max.y && p.x <= e.max.x;
        self.tree.search(may_cross, |k| {
            let [a, b] = self.chord(k);
            let side = (b - a).perp(&(p - a));
            is_within ^= (a.y <= p.y) != (b.y <= p.y) && (side > 0.0) == (a.y < b.y);
        });
        is_within
    }

    /// Whether within a distance \[L\] of a point, something is as near to a chord, along each axis, as that chord is long, and this is not
    /// less than the distance.
    fn is_beside(&self, p: &Vector2<f64>, distance: f64) -> bool {
        let mut is_beside = false;
        self.tree.search(
            |e| e.distance(p) <= distance,
            |k| {
                let [a, b] = self.chord(k);
                is_beside |= (b - a).norm() >= distance;
            },
        );
        is_beside
    }

    /// Whether within a distance \[L\] of a point, something is as near to a tabulated point as the longest chord is long.
    fn is_near(&self, p: &Vector2<f64>, distance: f64) -> bool {
        self.tree.nearest(p, self.longest + distance, |k| (self.points[k] - p).norm()).is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{random, shapes::curve::Parametric};

    /// `(1 + cos(7u)/4) (cos u, sin u)`
    struct Clover;
    impl Parametric for Clover {
        fn at(&self, u: f64) -> [Vector2<f64>; 2] {
            let ((sin, cos), (wave, crest)) = (libm::sincos(u), libm::sincos(7.0 * u));
            let (r, rate) = (1.0 + 0.25 * crest, -1.75 * wave);
            [Vector2::new(r * cos, r * sin), Vector2::new(rate * cos - r * sin, rate * sin + r * cos)]
        }
    }

    #[test]
    fn the_tree_of_chords_tells_what_asking_each_of_them_tells() {
        let turn = |k: i32| core::f64::consts::TAU * f64::from(k) / 64.0;
        let chords = Tabulated::new(&ArcLength::new(&Clover, (0..=64).map(turn)));
        let distances = |p: Vector2<f64>| chords.points.iter().map(move |q| (q - p).norm());
        let mut random = random::signed(5);
        for _ in 0..20_000 {
            let p = Vector2::new(1.5 * random(), 1.5 * random());
            let radius = 1.0 + 0.25 * libm::cos(7.0 * libm::atan2(p.y, p.x));
            // a chord is nowhere so far from the curve
            if (p.norm() - radius).abs() > 0.01 {
                assert_eq!(chords.surrounds(&p), p.norm() < radius, "{p}");
            }
            let nearest = distances(p).fold(f64::INFINITY, f64::min);
            assert_eq!(chords.is_near(&p, 0.05), nearest < chords.longest + 0.05, "{p}");
            assert!(!chords.is_beside(&p, 0.0) || nearest < 2.5 * chords.longest, "{p}");
        }
    }
}

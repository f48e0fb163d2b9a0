//! The sides that orbits of the equilateral triangle hit in turn, found by enumeration.
//!
//! For one velocity the starts on a side that follow a given sequence form an interval, since hits map sides to sides piecewise
//! affinely. So for each velocity of a sample all sequences are found, with the lengths of their intervals, exactly; the share of a
//! sequence is the mean over velocities drawn by the canonical measure.
use crate::{
    law::{UNIFORM, no_slip},
    random::Stream,
};
use billiards::observe::{Mean, Moments};
use nalgebra::{Matrix3, Vector2, Vector3};
use std::collections::BTreeMap;

/// A sequence of sides, up to renaming them, in the tree of all.
#[derive(Clone, Debug)]
pub struct Node {
    /// Sides in the order of hits, named in the order of first appearance: starts with `12`.
    pub word: String,
    /// The share of the reduced phase space that follows it, by the canonical measure; 0 where no orbit does.
    pub share: f64,
    /// One standard error of the share.
    pub standard_error: f64,
    /// Whether any orbit follows it.
    pub occurs: bool,
}

/// All sequences of up to `length` hits that occur, each with its two continuations whether they occur or not; sorted by
/// length, then by name. `velocities` is the size of the sample.
pub fn tree(length: usize, velocities: usize) -> Vec<Node> {
    let walls = Walls::new();
    let mut shares: BTreeMap<String, Moments> = BTreeMap::new();
    let mut of_one = BTreeMap::new();
    for sample in 0..velocities {
        let [v0, vt] = Stream::new(240, sample).in_disk();
        let vn = libm::sqrt(1.0 - v0 * v0 - vt * vt);
        let v = walls.leaving(0, v0, vt, vn);
        of_one.clear();
        walls.follow(&mut vec![0], v, [0.0, 1.0], (0.0, 1.0), length, &mut of_one);
        // words that do not occur with this velocity: a share of 0 for it
        for (word, mean) in &mut shares {
            if !of_one.contains_key(word) {
                mean.add(0.0);
            }
        }
        for (word, share) in &of_one {
            let mean = shares.entry(word.clone()).or_insert_with(|| (0..sample).map(|_| 0.0).collect());
            mean.add(*share);
        }
    }
    let mut nodes: Vec<Node> = shares
        .iter()
        .map(|(word, shares)| {
            let Mean { mean: share, standard_error, .. } = shares.mean();
            Node { word: word.clone(), share, standard_error, occurs: true }
        })
        .collect();
    for word in shares.keys().filter(|word| word.len() < length) {
        for next in ['1', '2', '3'] {
            let longer = format!("{word}{next}");
            if !word.ends_with(next) && named(&longer) && !shares.contains_key(&longer) {
                nodes.push(Node { word: longer, share: 0.0, standard_error: 0.0, occurs: false });
            }
        }
    }
    nodes.sort_by(|a, b| (a.word.len(), &a.word).cmp(&(b.word.len(), &b.word)));
    nodes
}

/// A shorter interval of starts counts as rounding. An image is off by an ulp over `v·ν`, which is hardly ever below 10⁻³ in a sample,
/// and the next one magnifies this by as much again.
const EMPTY: f64 = 1e-9;

/// Whether sides are named in the order of first appearance.
fn named(word: &str) -> bool {
    word.find('3').is_none_or(|three| word.find('2').is_some_and(|two| two < three))
}

/// The sides 0, 1, 2 of the triangle of side 1, counter-clockwise, with the law of each.
struct Walls {
    corners: [Vector2<f64>; 3],
    laws: [Matrix3<f64>; 3],
}

impl Walls {
    fn new() -> Walls {
        let height = 0.5 * libm::sqrt(3.0);
        let corners = [Vector2::new(0.0, 0.0), Vector2::new(1.0, 0.0), Vector2::new(0.5, height)];
        let normal = |side: usize| {
            let along = corners[(side + 1) % 3] - corners[side];
            [-along.y, along.x]
        };
        Walls { corners, laws: [0, 1, 2].map(|side| no_slip(UNIFORM, normal(side))) }
    }

    /// The velocity with the given components at a side.
    fn leaving(&self, side: usize, v0: f64, vt: f64, vn: f64) -> Vector3<f64> {
        let along = self.corners[(side + 1) % 3] - self.corners[side];
        // ν = J along, t = J ν = −along
        let v = Vector2::new(-along.y, along.x) * vn - along * vt;
        Vector3::new(v0, v.x, v.y)
    }

    /// Follows the starts of an interval. `sides` are those hit so far; the interval `at` of the present side, whose ends may come in
    /// either order, is the image of the interval `from` of starts.
    fn follow(
        &self,
        sides: &mut Vec<usize>,
        v: Vector3<f64>,
        at: [f64; 2],
        from: (f64, f64),
        length: usize,
        shares: &mut BTreeMap<String, f64>,
    ) {
        let side = sides[sides.len() - 1];
        if sides.len() > 1 {
            *shares.entry(word(sides.iter().copied())).or_insert(0.0) += (from.1 - from.0).abs();
        }
        if sides.len() == length {
            return;
        }
        let (a, b, c) = (self.corners[side], self.corners[(side + 1) % 3], self.corners[(side + 2) % 3]);
        let u = Vector2::new(v.y, v.z);
        // where a path along u that ends in the opposite corner starts
        let along = b - a;
        let split = (c - a).perp(&u) / along.perp(&u);
        for (next, low, high) in [((side + 2) % 3, f64::NEG_INFINITY, split), ((side + 1) % 3, split, f64::INFINITY)] {
            // the part of the interval that goes to this side
            let (first, last) = (at[0].clamp(low, high), at[1].clamp(low, high));
            let origin = |s: f64| from.0 + (s - at[0]) / (at[1] - at[0]) * (from.1 - from.0);
            let origins = (origin(first), origin(last));
            if (origins.1 - origins.0).abs() <= EMPTY {
                continue;
            }
            let (start, edge) = (self.corners[next], self.corners[(next + 1) % 3] - self.corners[next]);
            let image = |s: f64| (a + along * s - start).perp(&u) / edge.perp(&u);
            sides.push(next);
            self.follow(sides, self.laws[next] * v, [image(first), image(last)], origins, length, shares);
            sides.pop();
        }
    }
}

/// Sides named 1, 2, 3 … in the order of first appearance.
pub fn word(sides: impl IntoIterator<Item = usize>) -> String {
    let mut seen: Vec<usize> = vec![];
    let name = |side: usize| {
        let place = seen.iter().position(|s| *s == side).unwrap_or_else(|| {
            seen.push(side);
            seen.len() - 1
        });
        (place + 1).to_string()
    };
    sides.into_iter().map(name).collect()
}

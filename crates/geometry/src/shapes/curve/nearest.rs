//! The closest point of a curve, from a table of its points.
use super::{Parametric, rising_root};
use crate::piece::Extent;
use nalgebra::Vector2;

/// A point of a table: its parameter, and the result of [`Parametric::at`] there.
pub(crate) type Known = (f64, [Vector2<f64>; 2]);

/// Number of neighbours in a block.
const BLOCK: usize = 16;

/// Boxes around the points of a table, so that most points need not be examined.
#[derive(Clone, Debug)]
pub(crate) struct Blocks(Vec<Block>);

/// Consecutive points of a table, with the first of the next block.
#[derive(Clone, Copy, Debug)]
struct Block {
    first: usize,
    /// One after the last.
    end: usize,
    extent: Extent,
    /// The longest chord between two of them.
    chord: f64,
}

impl Block {
    /// A lower bound of the distance from its points.
    fn distance(&self, point: &Vector2<f64>) -> f64 {
        self.extent.distance(point) * (1.0 - 8.0 * f64::EPSILON)
    }
}

impl Blocks {
    /// For a table with these points, in order.
    pub(crate) fn new(points: impl Iterator<Item = Vector2<f64>>) -> Blocks {
        let points: Vec<_> = points.collect();
        let starts = (0..points.len()).step_by(BLOCK);
        Blocks(
            starts
                .map(|first| {
                    let end = (first + BLOCK).min(points.len());
                    let own = &points[first..points.len().min(end + 1)];
                    let chord = own.windows(2).map(|w| (w[1] - w[0]).norm()).fold(0.0, f64::max);
                    Block { first, end, extent: Extent::of(own.iter().copied()), chord }
                })
                .collect(),
        )
    }

    /// For a table all of whose points are examined.
    pub(crate) fn one(points: usize) -> Blocks {
        let extent = Extent { min: Vector2::repeat(f64::NEG_INFINITY), max: Vector2::repeat(f64::INFINITY) };
        Blocks(vec![Block { first: 0, end: points, extent, chord: f64::INFINITY }])
    }

    /// The parameter of the point of a curve that is closest to `point`. `node` gives the points of the table.
    ///
    /// Candidates are the nodes, and the roots between two nodes at which `(x(u) − point)·x'(u)` rises. The nodes must be so dense
    /// that there is at most one such root between neighbours, or that the distances at several are equal to rounding (near a centre
    /// of curvature).
    pub(crate) fn closest(&self, curve: &impl Parametric, node: impl Fn(usize) -> Known, point: &Vector2<f64>) -> f64 {
        let distance = |p: Vector2<f64>| libm::hypot(p.x - point.x, p.y - point.y);
        let slope = |[p, d]: [Vector2<f64>; 2]| (p - point).dot(&d);
        // the nearest block first: it rules out most others
        let mut bound = f64::INFINITY;
        if self.0.len() > 1 {
            let nearest = self.0.iter().min_by(|a, b| a.distance(point).total_cmp(&b.distance(point)));
            let places = nearest.map_or(0..0, |block| block.first..block.end);
            bound = places.map(|k| distance(node(k).1[0])).fold(f64::INFINITY, f64::min);
        }
        let (mut best, mut parameter) = (f64::INFINITY, f64::NAN);
        for block in self.0.iter().filter(|block| block.distance(point) <= bound) {
            for (u, at) in (block.first..block.end).map(&node) {
                if distance(at[0]) < best {
                    (best, parameter) = (distance(at[0]), u);
                }
            }
        }
        // prefer a root to a neighbouring node at the same distance within rounding, since the distance determines the place along
        // the curve only to √ε
        best *= 1.0 + 4.0 * f64::EPSILON;
        let count = self.0.last().map_or(0, |block| block.end);
        for block in &self.0 {
            // twice the chord is more than the length of the curve between the nodes
            if block.distance(point) - 2.0 * block.chord > best {
                continue;
            }
            let (mut before, mut from) = node(block.first);
            for (u, at) in (block.first + 1..(block.end + 1).min(count)).map(&node) {
                if slope(from) < 0.0
                    && slope(at) >= 0.0
                    && distance(at[0]).min(distance(from[0])) - 2.0 * (at[0] - from[0]).norm() <= best
                {
                    let root = rising_root(
                        |u| {
                            let at = curve.at(u);
                            [slope(at), at[1].norm_squared()]
                        },
                        [before, u],
                    );
                    let there = distance(curve.at(root)[0]);
                    if there <= best {
                        (best, parameter) = (there, root);
                    }
                }
                (before, from) = (u, at);
            }
        }
        parameter
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random;

    /// `(u, u²/2)`
    struct Parabola;
    impl Parametric for Parabola {
        fn at(&self, u: f64) -> [Vector2<f64>; 2] {
            [Vector2::new(u, 0.5 * u * u), Vector2::new(1.0, u)]
        }
    }

    #[test]
    fn the_closest_point_next_to_a_node_is_as_exact_as_any() {
        let node = |k: usize| {
            let u = k as f64 / 8.0 - 1.0;
            (u, Parabola.at(u))
        };
        let blocks = Blocks::new((0..=16).map(|k| node(k).1[0]));
        for k in 0..4000 {
            // straight above the point at u, which is so near the node 3/8 that the distance cannot tell them apart
            let u = 0.375 + f64::from(k % 200 - 100) * 1e-10;
            let [foot, along] = Parabola.at(u);
            let above = foot + Vector2::new(-along.y, along.x) * (0.1 + 0.013 * f64::from(k / 200));
            let found = blocks.closest(&Parabola, node, &above);
            assert!((found - u).abs() <= 4.0 * f64::EPSILON, "{:e} off", found - u);
        }
    }

    /// `(1 + a cos ku) (cos u, sin u)`
    struct Clover;
    impl Parametric for Clover {
        fn at(&self, u: f64) -> [Vector2<f64>; 2] {
            let ((sin, cos), (wave, crest)) = (libm::sincos(u), libm::sincos(7.0 * u));
            let (r, rate) = (1.0 + 0.3 * crest, -2.1 * wave);
            [Vector2::new(r * cos, r * sin), Vector2::new(rate * cos - r * sin, rate * sin + r * cos)]
        }
    }

    #[test]
    fn what_blocks_leave_out_is_no_closer() {
        let node = |k: usize| {
            let u = core::f64::consts::TAU * k as f64 / 1000.0;
            (u, Clover.at(u))
        };
        let points = || (0..=1000).map(|k| node(k).1[0]);
        let (blocks, all) = (Blocks::new(points()), Blocks::one(1001));
        let mut random = random::signed(3);
        for _ in 0..10_000 {
            let point = Vector2::new(1.5 * random(), 1.5 * random());
            assert_eq!(blocks.closest(&Clover, node, &point), all.closest(&Clover, node, &point), "{point:?}");
        }
    }
}

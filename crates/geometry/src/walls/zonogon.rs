//! Centrally symmetric convex polygons: parallelogram, hexagon, every regular polygon with an even number of sides.
use super::{CORNER, WallHit, Walls, center::Center, normal::most_unit, sooner};
use crate::{Error, plane::slack, shapes::Segment};
use lanes::{Lane, Mask, dot};

/// A pair of opposite sides.
#[derive(Clone, Copy, Debug)]
struct Pair {
    /// Outward unit normal of the first side; the second one's is its opposite.
    normal: [f64; 2],
    /// The normal given to the law, with a length nearer to 1.
    unit: [f64; 2],
    /// Distance of each side from the centre.
    distance: f64,
    /// Tangential coordinate of the first side's middle along (−n₂, n₁), and half its length less the corner margin.
    middle: f64,
    half: f64,
    pieces: [f64; 2],
}

/// The convex polygon with `K` pairs of opposite sides of equal length.
///
/// Only one side of each pair can be hit, the one that the particle moves towards, so this takes half the work of a general
/// polygon.
#[derive(Clone, Debug)]
pub struct Zonogon<const K: usize> {
    center: Center<2>,
    /// Square of a distance from the centre within which there are no corners: one comparison shows that most points are none.
    clear: f64,
    pairs: [Pair; K],
}

impl<const K: usize> Zonogon<K> {
    /// The polygon with the given sides, counter-clockwise, where it is convex and centrally symmetric to within
    /// rounding (16 ulp of its size); piece `i` is `first + i`.
    ///
    /// # Errors
    /// [`Error::NotConvex`] where it is not.
    pub fn new(sides: &[Segment], first: usize) -> Result<Self, Error> {
        Zonogon::numbered(sides, &(first..first + sides.len()).collect::<Vec<_>>())
    }

    /// The same with the number of each side's piece.
    pub(crate) fn numbered(sides: &[Segment], numbers: &[usize]) -> Result<Self, Error> {
        if sides.len() != 2 * K || K < 2 {
            return Err(Error::NotConvex);
        }
        let vertex = |i: usize| sides[i % (2 * K)].start();
        let mut center = [0.0; 2];
        for i in 0..2 * K {
            center[0] += vertex(i)[0];
            center[1] += vertex(i)[1];
        }
        center = center.map(|c| c / (2 * K) as f64);
        let size = (0..2 * K).flat_map(vertex).fold(0.0, |m: f64, c| m.max(c.abs()));
        let slack = slack([size]);
        let near = |a: f64, b: f64| (a - b).abs() <= slack;
        for i in 0..K {
            let (p, q) = (vertex(i), vertex(i + K));
            if !(near(p[0] - center[0], center[0] - q[0]) && near(p[1] - center[1], center[1] - q[1])) {
                return Err(Error::NotConvex);
            }
        }
        if !super::convex::turns_left(sides) {
            return Err(Error::NotConvex);
        }
        let away = |p: [f64; 2]| [p[0] - center[0], p[1] - center[1]];
        let nearest = (0..2 * K).map(vertex).map(away).map(|p| dot(&p, &p)).fold(f64::INFINITY, f64::min);
        // a point counts as a corner within `CORNER` of it, and is itself off by less than twice that
        let clear = (libm::sqrt(nearest) - 3.0 * CORNER * size).max(0.0);
        let clear = clear * clear;
        let pairs = core::array::from_fn(|i| {
            let inward = sides[i].inward_normal();
            let n = [-inward[0], -inward[1]];
            let (a, b) = (vertex(i), vertex(i + 1));
            let (a, b) = (away(a), away(b));
            let along = |p: [f64; 2]| p[1] * n[0] - p[0] * n[1];
            Pair {
                normal: n,
                unit: most_unit(n),
                distance: 0.5 * (dot(&a, &n) + dot(&b, &n)),
                middle: 0.5 * (along(a) + along(b)),
                half: 0.5 * (along(b) - along(a)).abs() - CORNER * size,
                pieces: [numbers[i] as f64, numbers[i + K] as f64],
            }
        });
        Ok(Zonogon { center: Center::new(center), clear, pairs })
    }
}

impl<const K: usize> Walls<2> for Zonogon<K> {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let zero = v[0].same(0.0);
        let one = zero.same(1.0);
        let y = self.center.sees(x);
        let (mut num, mut den) = (zero.same(f64::INFINITY), one);
        let (mut n, mut middle, mut half, mut piece) = ([zero; 2], zero, zero, zero);
        for (i, side) in self.pairs.iter().enumerate() {
            let speed = v[0] * side.normal[0] + v[1] * side.normal[1];
            let height = y[0] * side.normal[0] + y[1] * side.normal[1];
            // the side ahead: the first one, or its opposite
            let [height, m1, m2] = speed.towards([height, zero.same(side.unit[0]), zero.same(side.unit[1])]);
            let distance = zero.same(side.distance) - height;
            let number = zero.lt(speed).select(zero.same(side.pieces[0]), zero.same(side.pieces[1]));
            let (speed, along, most) = (speed.abs(), zero.same(side.middle), zero.same(side.half));
            if i == 0 {
                [num] = zero.lt(speed).choose([distance], [num]);
                [den, n[0], n[1]] = [speed, m1, m2];
                [middle, half, piece] = [along, most, number];
                continue;
            }
            [num, den, n[0], n[1], middle, half, piece] = sooner([distance.max(zero), speed], [num, den])
                .choose([distance, speed, m1, m2, along, most, number], [num, den, n[0], n[1], middle, half, piece]);
        }
        let time = num.above_zero() / den;
        let p = [y[0] + time * v[0], y[1] + time * v[1]];
        let mut corner = zero.never();
        if zero.same(self.clear).lt(dot(&p, &p)).any() {
            corner = half.lt((p[1] * n[0] - p[0] * n[1] - middle).abs());
        }
        WallHit { time, point: self.center.seen(&p), normal: [-n[0], -n[1]], inverse: one, piece, corner }
    }
}

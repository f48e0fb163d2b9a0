//! The strip between two parallel lines in any direction.
use super::{Chord, Homogeneous, WallHit, Walls};
use crate::{Error, Figure};
use lanes::{Double, Lane, Mask, dot, two_sum};

/// The region between two parallel lines in the plane; along an axis, a [`Slab`](super::Slab) is faster.
#[derive(Clone, Debug)]
pub struct Strip {
    /// Points of the first and of the second wall, opposite to one another.
    through: [[f64; 2]; 2],
    /// Unit normal of the first wall, towards the second.
    normal: [f64; 2],
    width: f64,
    pieces: [f64; 2],
}

impl Strip {
    /// The strip between two lines in opposite senses of traversal, with their numbers.
    ///
    /// # Errors
    /// [`Error::NotConvex`] unless the figures are such lines, each with the other on its left.
    pub fn new(lines: [Figure; 2], pieces: [usize; 2]) -> Result<Self, Error> {
        let [Figure::Line { through: p, direction }, Figure::Line { through: q, direction: back }] = lines else {
            return Err(Error::NotConvex);
        };
        let normal = [-direction.y, direction.x];
        let apart = [0, 1].map(|i| two_sum(q[i], -p[i])).map(|(high, low)| Double { high, low });
        let width = across(apart, normal).over(square(normal).root()).value();
        if direction != -back || !(width > 0.0 && width.is_finite()) {
            return Err(Error::NotConvex);
        }
        let opposite = [0, 1].map(|i| Double::product(width, normal[i]).plus(Double::new(p[i])).value());
        Ok(Strip { through: [p.into(), opposite], normal, width, pieces: pieces.map(|p| p as f64) })
    }

    /// A point of the second wall or of the first.
    #[inline(always)]
    fn through<F: Lane>(&self, second: F::Mask, zero: F) -> [F; 2] {
        let [[p1, p2], [q1, q2]] = self.through;
        [second.select(zero.same(q1), zero.same(p1)), second.select(zero.same(q2), zero.same(p2))]
    }
}

/// `a·n`
fn across([a1, a2]: [Double; 2], [n1, n2]: [f64; 2]) -> Double {
    a1.times(Double::new(n1)).plus(a2.times(Double::new(n2)))
}

/// `|n|²`
fn square(n: [f64; 2]) -> Double {
    across(n.map(Double::new), n)
}

impl Walls<2> for Strip {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let zero = v[0].same(0.0);
        let n = [zero.same(self.normal[0]), zero.same(self.normal[1])];
        let speed = dot(v, &n);
        let second = zero.lt(speed);
        let wall = self.through(second, zero);
        let distance = dot(&[wall[0] - x[0], wall[1] - x[1]], &n);
        // a start beyond the wall is due to rounding: it hits at time 0
        let time = second.select(distance, -distance).max(zero) / speed.abs();
        let p = [x[0] + time * v[0], x[1] + time * v[1]];
        let off = dot(&[wall[0] - p[0], wall[1] - p[1]], &n);
        let inward = (-zero.same(1.0)).copysign(-speed);
        WallHit {
            // avoids 0/0 on the wall itself without a speed towards it
            time: zero.lt(speed.abs()).select(time, zero.same(f64::INFINITY)),
            point: [p[0] + off * n[0], p[1] + off * n[1]],
            normal: [inward * n[0], inward * n[1]],
            inverse: zero.same(1.0),
            piece: second.select(zero.same(self.pieces[1]), zero.same(self.pieces[0])),
            corner: zero.never(),
        }
    }
}

/// A place is the side, −1 for the first and 1 for the second wall, and the coordinate along the walls with the first one on the left.
impl Homogeneous for Strip {
    const ROUND: bool = false;

    #[inline(always)]
    fn place<F: Lane>(&self, hit: &WallHit<F, 2>) -> [F; 2] {
        let zero = hit.time.same(0.0);
        let n = [zero.same(self.normal[0]), zero.same(self.normal[1])];
        let inward = dot(&hit.normal, &n);
        let wall = self.through(inward.lt(zero), zero);
        let along = (hit.point[0] - wall[0]) * n[1] - (hit.point[1] - wall[1]) * n[0];
        [-zero.same(1.0).copysign(inward), along]
    }
    /// The rounded normal has not quite length 1: what it gave to a velocity in the plane, from which a run in parts goes on, is taken
    /// back here.
    fn arrival(&self, _: &[f64; 2], v: &[f64; 2], &[n1, n2]: &[f64; 2]) -> [Double; 2] {
        [[n1, n2], [-n2, n1]].map(|axis| across(v.map(Double::new), axis).over(square([n1, n2])))
    }
    #[inline(always)]
    fn chord<F: Lane>(&self, place: &[F; 2], normal: F, tangential: F) -> Chord<F> {
        self.chord_of(normal.same(self.width) / normal, place, normal, tangential)
    }
    #[inline(always)]
    fn chord_of<F: Lane>(&self, time: F, place: &[F; 2], _: F, tangential: F) -> Chord<F> {
        let [side, along] = *place;
        // on the first wall t = J n points backwards
        Chord { time, place: [-side, along + time * (tangential * side)], tangential: -tangential }
    }
    #[inline(always)]
    fn landing<F: Lane>(&self, chord: &Chord<F>) -> WallHit<F, 2> {
        let [side, along] = chord.place;
        let zero = side.same(0.0);
        let [n1, n2] = [zero.same(self.normal[0]), zero.same(self.normal[1])];
        let second = zero.lt(side);
        let wall = self.through(second, zero);
        WallHit {
            time: chord.time,
            point: [wall[0] + along * n2, wall[1] - along * n1],
            normal: [-side * n1, -side * n2],
            inverse: zero.same(1.0),
            piece: second.select(zero.same(self.pieces[1]), zero.same(self.pieces[0])),
            corner: zero.never(),
        }
    }
}

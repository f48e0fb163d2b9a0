//! Straight walls that coincide.
use super::stretch::{Stretch, doubles as doubles_of};
use crate::plane::{SAME_DIRECTION, cross, direction, from, slack};
use core::f64::consts::PI;
use lanes::dot;
use nalgebra::Vector2;

/// A straight piece, to be compared with others of its direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    number: usize,
    /// Its ends; for an infinite one, the same point of it twice.
    ends: [[f64; 2]; 2],
    /// For each of them, whether the piece ends there or goes on for ever.
    finite: [bool; 2],
    /// Unit vector in the sense of traversal.
    along: [f64; 2],
    length: f64,
    /// Rounding of its coordinates.
    slack: f64,
    /// The angle of its line (radians), and whether the piece runs in that direction or against it.
    angle: f64,
    forward: bool,
    /// How far to the left of the origin it lies, along a direction near its own.
    height: f64,
}

impl Side {
    /// The segment with this number.
    pub(super) fn segment(number: usize, ends: [Vector2<f64>; 2]) -> Option<Side> {
        let ends = ends.map(<[f64; 2]>::from);
        let (along, length) = direction(ends[0], ends[1])?;
        Some(Side::new(number, ends, [true; 2], along, length))
    }

    /// The line or ray with this number through a point, along a unit vector in the sense of traversal; whether it begins or ends there.
    pub(super) fn infinite(number: usize, through: Vector2<f64>, along: Vector2<f64>, finite: [bool; 2]) -> Side {
        Side::new(number, [through.into(); 2], finite, along.into(), f64::INFINITY)
    }

    fn new(number: usize, ends: [[f64; 2]; 2], finite: [bool; 2], along: [f64; 2], length: f64) -> Side {
        let forward = along[1] > 0.0 || (along[1] == 0.0 && along[0] > 0.0);
        let [x, y] = if forward { along } else { along.map(|x| -x) };
        let (slack, angle) = (slack(ends.into_iter().flatten()), libm::atan2(y + 0.0, x));
        Side { number, ends, finite, along, length, slack, angle, forward, height: 0.0 }
    }

    /// The same with the angle less half a turn.
    fn turned(self) -> Side {
        Side { angle: self.angle - PI, forward: !self.forward, ..self }
    }

    /// Its beginning and end along a direction near its own.
    fn stretch(&self, d: [f64; 2]) -> Stretch {
        let far = if dot(&self.along, &d) > 0.0 { f64::INFINITY } else { -f64::INFINITY };
        let [a, b] = self.ends.map(|end| dot(&end, &d));
        let [a, b] = [if self.finite[0] { a } else { -far }, if self.finite[1] { b } else { far }];
        Stretch::new(self.number, self.forward, [a.min(b), a.max(b)])
    }

    /// Whether both are rays from one point with the table between them, if ever so little of it: a wedge, not a wall.
    fn is_wedge(&self, other: &Side) -> bool {
        let [leaving, arriving] = match [self.finite, other.finite] {
            [[true, false], [false, true]] => [self, other],
            [[false, true], [true, false]] => [other, self],
            _ => return false,
        };
        leaving.ends == arriving.ends && cross(arriving.along, leaving.along) > 0.0
    }

    /// Whether both lie on one line, up to rounding of vertices, and have more than a point in common.
    fn coincides(&self, other: &Side, overlap: f64) -> bool {
        let rounding = 0.25 * self.slack.max(other.slack);
        let (short, long) = if self.length < other.length { (self, other) } else { (other, self) };
        let off = |end: &[f64; 2]| cross(long.along, from(long.ends[0], *end)).abs() <= rounding;
        // infinite pieces must stay together for ever
        let parallel = short.length < f64::INFINITY || cross(short.along, long.along).abs() <= 4.0 * f64::EPSILON;
        let is_long = overlap > self.slack.max(other.slack);
        is_long && parallel && short.ends.iter().all(off) && !self.is_wedge(other)
    }
}

/// The numbers of the straight pieces that coincide, at least in part, with another one that has the table on the other side.
pub(super) fn doubles(mut sides: Vec<Side>) -> Vec<usize> {
    // a line is the same after half a turn
    let last: Vec<Side> = sides.iter().filter(|s| s.angle > PI - SAME_DIRECTION).map(|s| s.turned()).collect();
    sides.extend(last);
    sides.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    let mut found = vec![];
    for parallel in sides.chunk_by_mut(|a, b| b.angle - a.angle <= SAME_DIRECTION) {
        let [first, _, ..] = parallel else { continue };
        let d = if first.forward { first.along } else { first.along.map(|x| -x) };
        for side in parallel.iter_mut() {
            side.height = 0.5 * (cross(d, side.ends[0]) + cross(d, side.ends[1]));
        }
        parallel.sort_by(|a, b| a.height.total_cmp(&b.height));
        // the lines of two pieces that coincide differ by the angle between their directions times the distance between the pieces
        let near = |a: &Side, b: &Side| {
            let size = [a, b].iter().flat_map(|s| s.ends.as_flattened()).fold(0.0, |m: f64, x| m.max(x.abs()));
            b.height - a.height <= 4.0 * SAME_DIRECTION * size
        };
        for line in parallel.chunk_by(|a, b| near(a, b)).filter(|line| line.len() > 1) {
            let stretches = line.iter().enumerate().map(|(place, side)| (side.stretch(d), place)).collect();
            found.extend(doubles_of(stretches, |i, j, overlap| line[i].coincides(&line[j], overlap)));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sorted(mut found: Vec<usize>) -> Vec<usize> {
        found.sort_unstable();
        found.dedup();
        found
    }
    fn found(sides: &[[[f64; 2]; 2]]) -> Vec<usize> {
        let side = |(number, ends): (usize, &[[f64; 2]; 2])| Side::segment(number, ends.map(Vector2::from));
        sorted(doubles(sides.iter().enumerate().filter_map(side).collect()))
    }

    #[test]
    fn those_that_coincide_are_found_however_short_and_those_that_do_not_are_not() {
        let at = |s: f64| [1.0 + 0.6 * s, 0.3 + 0.8 * s];
        for h in [0.5, 1e-1, 1e-3, 1e-6] {
            assert_eq!(found(&[[at(0.0), at(1.0)], [at(0.4 + h), at(0.4)]]), [0, 1], "{h}");
        }
        assert_eq!(found(&[[at(0.0), at(1.0)], [at(0.4), at(0.6)]]), [] as [usize; 0]); // of one side
        assert_eq!(found(&[[at(0.0), at(1.0)], [at(2.0), at(1.0)]]), [] as [usize; 0]); // end to end
        // on both sides of the vertical
        let (x, y) = (0.3, 0.1 + 0.2);
        assert_eq!(found(&[[[y, 1.0], [x, 0.4]], [[x, 0.0], [y, 1.0]]]), [0, 1]);
        // a thin wedge
        for x in [1e-5, 1e-11] {
            assert_eq!(found(&[[[0.0, 0.0], [4.0 * x, 1.0]], [[x, 1.0], [0.0, 0.0]]]), [] as [usize; 0]);
        }
        // a line many times over, both ways
        let many: Vec<_> =
            (0..20_000).map(|k| if k % 2 == 0 { [at(0.0), at(1.0)] } else { [at(1.0), at(0.0)] }).collect();
        assert_eq!(found(&many).len(), many.len());
    }

    #[test]
    fn infinite_ones_coincide_with_what_lies_on_their_line() {
        let at = |s: f64| Vector2::new(1.0 + 0.6 * s, 0.3 + 0.8 * s);
        let found = |sides: [Side; 2]| sorted(doubles(sides.into()));
        let infinite =
            |number, s: f64, sign: f64, finite| Side::infinite(number, at(s), Vector2::new(0.6, 0.8) * sign, finite);
        let (line, from, to) = ([false, false], [true, false], [false, true]);
        assert_eq!(found([infinite(0, 0.0, 1.0, line), infinite(1, 3.0, -1.0, line)]), [0, 1]);
        assert_eq!(found([infinite(0, 0.0, 1.0, line), Side::segment(1, [at(7.5), at(7.25)]).unwrap()]), [0, 1]);
        assert_eq!(found([infinite(0, 0.0, 1.0, line), infinite(1, 1e3, -1.0, to)]), [0, 1]);
        // two rays that overlap, and two that start at one point in opposite directions
        assert_eq!(found([infinite(0, 0.0, 1.0, from), infinite(1, 2.0, -1.0, to)]), [0, 1]);
        assert_eq!(found([infinite(0, 0.0, 1.0, from), infinite(1, 0.0, -1.0, from)]), [] as [usize; 0]);
        assert_eq!(found([infinite(0, 0.0, 1.0, line), infinite(1, 0.0, 1.0, line)]), [] as [usize; 0]); // of one side
        // a wedge as thin as it gets
        let askew = Side::infinite(1, at(0.0), -Vector2::new(0.6 + 1e-14, 0.8), to);
        assert_eq!(found([infinite(0, 0.0, 1.0, from), askew]), [] as [usize; 0]);
        // and one that only its exact directions tell from a wall with two sides: with the table between its rays or around them
        let ray = |number, x: f64, finite| {
            let sign = if finite == from { 1.0 } else { -1.0 };
            Side::infinite(number, Vector2::zeros(), Vector2::new(x, 1.0) * sign, finite)
        };
        for x in [1e-150, 1e-16, 4e-16] {
            assert_eq!(found([ray(0, x, from), ray(1, -x, to)]), [] as [usize; 0], "{x:e}");
            assert_eq!(found([ray(0, -x, from), ray(1, x, to)]), [0, 1], "{x:e}");
        }
        assert_eq!(found([ray(0, 0.0, from), ray(1, 0.0, to)]), [0, 1]);
    }
}

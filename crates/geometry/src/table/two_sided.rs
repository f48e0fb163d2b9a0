//! Straight walls that coincide, one with the table on this side and one with it on the other.
use crate::plane::{cross, direction, dot, from, slack};
use core::f64::consts::PI;
use nalgebra::Vector2;

/// Directions that differ by less than this (radians) are compared: rounding of vertices turns short pieces by more than an ulp.
const SAME_DIRECTION: f64 = 1e-9;

/// A straight piece among others of its direction.
#[derive(Clone, Copy, Debug)]
struct Side {
    number: usize,
    ends: [[f64; 2]; 2],
    /// Unit vector from the first end to the second one.
    along: [f64; 2],
    length: f64,
    /// Rounding of its coordinates.
    slack: f64,
    /// The angle of its line (radians), and whether it runs that way or back.
    angle: f64,
    forward: bool,
    /// How far to the left of the origin it lies and where it begins and ends, seen along a direction that is near its own.
    height: f64,
    from: f64,
    to: f64,
    /// Whether it is known to coincide with another one.
    is_double: bool,
}

impl Side {
    fn of(number: usize, [a, b]: [Vector2<f64>; 2]) -> Option<Side> {
        let (along, length) = direction(a.into(), b.into())?;
        let forward = along[1] > 0.0 || (along[1] == 0.0 && along[0] > 0.0);
        let [x, y] = if forward { along } else { along.map(|x| -x) };
        let (slack, angle) = (slack([a.x, a.y, b.x, b.y]), libm::atan2(y + 0.0, x));
        let ends = [a.into(), b.into()];
        let (height, from, to) = (0.0, 0.0, 0.0);
        Some(Side { number, ends, along, length, slack, angle, forward, height, from, to, is_double: false })
    }

    /// The same, told by the angle less half a turn.
    fn turned(self) -> Side {
        Side { angle: self.angle - PI, forward: !self.forward, ..self }
    }

    fn seen_along(&mut self, d: [f64; 2]) {
        let [p, q] = self.ends.map(|end| dot(end, d));
        (self.from, self.to) = (p.min(q), p.max(q));
        self.height = 0.5 * (cross(d, self.ends[0]) + cross(d, self.ends[1]));
    }

    /// Whether both lie on one line, but for rounding of vertices, have a stretch of it in common, and the table on different sides.
    fn coincides(&self, other: &Side) -> bool {
        let rounding = 0.25 * self.slack.max(other.slack);
        let (short, long) = if self.length < other.length { (self, other) } else { (other, self) };
        let off = |end: &[f64; 2]| cross(long.along, from(long.ends[0], *end)).abs() <= rounding;
        self.forward != other.forward
            && self.to.min(other.to) - self.from.max(other.from) > self.slack.max(other.slack)
            && short.ends.iter().all(off)
    }
}

/// The numbers of those straight pieces that coincide with another one, or in part, which has the table on the other side.
///
/// `n log n` operations for pieces in general position.
pub(super) fn two_sided(segments: impl Iterator<Item = (usize, [Vector2<f64>; 2])>) -> Vec<usize> {
    let mut sides: Vec<Side> = segments.filter_map(|(number, ends)| Side::of(number, ends)).collect();
    // a line is the same half a turn later
    let last: Vec<Side> = sides.iter().filter(|s| s.angle > PI - SAME_DIRECTION).map(|s| s.turned()).collect();
    sides.extend(last);
    sides.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    let mut found = vec![];
    for parallel in sides.chunk_by_mut(|a, b| b.angle - a.angle <= SAME_DIRECTION) {
        let [first, _, ..] = parallel else { continue };
        let d = if first.forward { first.along } else { first.along.map(|x| -x) };
        for side in parallel.iter_mut() {
            side.seen_along(d);
        }
        parallel.sort_by(|a, b| a.height.total_cmp(&b.height));
        // the lines of two that coincide are as far apart as their directions are, times how far they lie apart
        let near = |a: &Side, b: &Side| {
            let size = [a, b].iter().flat_map(|s| s.ends.as_flattened()).fold(0.0, |m: f64, x| m.max(x.abs()));
            b.height - a.height <= 4.0 * SAME_DIRECTION * size
        };
        for line in parallel.chunk_by_mut(|a, b| near(a, b)) {
            line.sort_by(|a, b| a.from.total_cmp(&b.from));
            doubles(line, &mut found);
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// The same of sides about one line, in the order in which they begin.
fn doubles(line: &mut [Side], found: &mut Vec<usize>) {
    // those that reach so far; of those that are found, the farthest one each way will do
    let mut open: Vec<usize> = vec![];
    for k in 0..line.len() {
        open.retain(|&other| line[other].to > line[k].from);
        for &other in &open {
            if !(line[k].is_double && line[other].is_double) && line[k].coincides(&line[other]) {
                (line[k].is_double, line[other].is_double) = (true, true);
                found.extend([line[k].number, line[other].number]);
            }
        }
        open.push(k);
        for forward in [true, false] {
            let of_these = |&&i: &&usize| line[i].is_double && line[i].forward == forward;
            let farthest = open.iter().filter(of_these).copied().max_by(|&i, &j| line[i].to.total_cmp(&line[j].to));
            open.retain(|i| !of_these(&i) || Some(*i) == farthest);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(sides: &[[[f64; 2]; 2]]) -> Vec<usize> {
        two_sided(sides.iter().map(|ends| ends.map(Vector2::from)).enumerate())
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
}

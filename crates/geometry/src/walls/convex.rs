//! Convex polygons: an intersection of half-planes.
use super::{CORNER, WallHit, Walls, normal::most_unit, sooner};
use crate::{Error, shapes::Segment};
use lanes::{Lane, Mask};

#[derive(Clone, Copy, Debug)]
struct Side {
    /// Outward unit normal.
    normal: [f64; 2],
    /// The normal given to the law, with a length nearer to 1.
    unit: [f64; 2],
    /// `n·p` on the side.
    distance: f64,
    /// Tangential coordinates along (−n₂, n₁) of its start and its end, less the corner margin.
    start: f64,
    end: f64,
    piece: f64,
}

/// A convex polygon.
///
/// Its sides are taken as whole lines, so no path can slip out at a vertex.
#[derive(Clone, Debug)]
pub struct ConvexPolygon {
    sides: Vec<Side>,
}

/// Whether a closed chain of sides turns left at every vertex, and once round in total.
pub(crate) fn turns_left(sides: &[Segment]) -> bool {
    let normals: Vec<[f64; 2]> = sides.iter().map(Segment::inward_normal).collect();
    let turns = |i: usize| {
        let (a, b) = (normals[i], normals[(i + 1) % normals.len()]);
        (a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])
    };
    let total: f64 = (0..normals.len()).map(turns).map(|(sin, cos)| libm::atan2(sin, cos)).sum();
    // once round is 2π = 6.3, twice 4π
    (0..normals.len()).map(turns).all(|(sin, _)| sin > 0.0) && total < 7.0
}

impl ConvexPolygon {
    /// The polygon with the given sides, counter-clockwise; piece `i` is `first + i`.
    ///
    /// # Errors
    /// [`Error::NotConvex`] where it is not strictly convex.
    pub fn new(sides: &[Segment], first: usize) -> Result<Self, Error> {
        ConvexPolygon::numbered(sides, &(first..first + sides.len()).collect::<Vec<_>>())
    }

    /// The same polygon with the number of each side's piece.
    pub(crate) fn numbered(sides: &[Segment], numbers: &[usize]) -> Result<Self, Error> {
        if sides.len() < 3 || !turns_left(sides) {
            return Err(Error::NotConvex);
        }
        let margin = CORNER * sides.iter().flat_map(Segment::start).fold(0.0, |m: f64, c| m.max(c.abs()));
        let side =
            |(s, number): (&Segment, &usize)| Side::new(s.inward_normal(), [s.start(), s.end()], margin, *number);
        Ok(ConvexPolygon { sides: sides.iter().zip(numbers).map(side).collect() })
    }
}

impl Side {
    /// The side with an inward unit normal, between two vertices.
    fn new(inward: [f64; 2], [a, b]: [[f64; 2]; 2], margin: f64, piece: usize) -> Side {
        let n = inward.map(|n| -n);
        let along = |p: [f64; 2]| p[1] * n[0] - p[0] * n[1];
        let distance = |p: [f64; 2]| p[0] * n[0] + p[1] * n[1];
        Side {
            normal: n,
            unit: most_unit(n),
            distance: 0.5 * (distance(a) + distance(b)),
            start: along(a) + margin,
            end: along(b) - margin,
            piece: piece as f64,
        }
    }
}

impl Walls<2> for ConvexPolygon {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let zero = v[0].same(0.0);
        let (mut num, mut den) = (zero.same(f64::INFINITY), zero.same(1.0));
        let (mut n, mut start, mut end, mut piece) = ([zero; 2], zero, zero, zero);
        for (i, side) in self.sides.iter().enumerate() {
            let speed = v[0] * side.normal[0] + v[1] * side.normal[1];
            let distance = zero.same(side.distance) - (x[0] * side.normal[0] + x[1] * side.normal[1]);
            let sooner =
                if i == 0 { zero.lt(speed) } else { sooner([distance.max(zero), speed], [num.max(zero), den]) };
            [num, den, n[0], n[1], start, end, piece] = sooner.choose(
                [
                    distance,
                    speed,
                    zero.same(side.unit[0]),
                    zero.same(side.unit[1]),
                    zero.same(side.start),
                    zero.same(side.end),
                    zero.same(side.piece),
                ],
                [num, den, n[0], n[1], start, end, piece],
            );
        }
        let time = num.above_zero() / den;
        let point = [x[0] + time * v[0], x[1] + time * v[1]];
        let along = point[1] * n[0] - point[0] * n[1];
        WallHit {
            time,
            point,
            normal: [-n[0], -n[1]],
            inverse: zero.same(1.0),
            piece,
            corner: along.lt(start) | end.lt(along),
        }
    }
}

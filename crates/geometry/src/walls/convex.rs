//! Convex polygons: an intersection of half-planes.
use super::{CORNER, WallHit, Walls};
use crate::{Error, shapes::Segment};
use lanes::{Lane, Mask};

#[derive(Clone, Copy, Debug)]
struct Side {
    /// Outward unit normal.
    normal: [f64; 2],
    /// `n·p` on the side.
    distance: f64,
    /// Tangential coordinate of the middle along (−n₂, n₁), and half the length less the corner margin.
    middle: f64,
    half: f64,
    piece: f64,
}

/// A convex polygon. Its sides are taken as whole lines, so no path can slip out at a vertex.
#[derive(Clone, Debug)]
pub struct ConvexPolygon {
    sides: Vec<Side>,
}

/// Whether a closed chain of sides turns left at every vertex, once round in all.
pub(crate) fn turns_left(sides: &[Segment]) -> bool {
    let normals: Vec<[f64; 2]> = sides.iter().map(Segment::inward_normal).collect();
    let turns = |i: usize| {
        let (a, b) = (normals[i], normals[(i + 1) % normals.len()]);
        (a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])
    };
    let total: f64 = (0..normals.len()).map(turns).map(|(sin, cos)| libm::atan2(sin, cos)).sum();
    (0..normals.len()).map(turns).all(|(sin, _)| sin > 0.0) && total < 7.0
}

impl ConvexPolygon {
    /// The polygon with the given sides, counter-clockwise; piece `i` is `first + i`.
    ///
    /// # Errors
    /// [`Error::NotConvex`] where it is not strictly convex.
    pub fn new(sides: &[Segment], first: usize) -> Result<Self, Error> {
        if sides.len() < 3 || !turns_left(sides) {
            return Err(Error::NotConvex);
        }
        let size = sides.iter().flat_map(Segment::start).fold(0.0, |m: f64, c| m.max(c.abs()));
        let side = |(i, s): (usize, &Segment)| {
            let n = s.inward_normal().map(|n| -n);
            let along = |p: [f64; 2]| p[1] * n[0] - p[0] * n[1];
            let (a, b) = (s.start(), s.end());
            Side {
                normal: n,
                distance: 0.5 * ((a[0] + b[0]) * n[0] + (a[1] + b[1]) * n[1]),
                middle: 0.5 * (along(a) + along(b)),
                half: 0.5 * (along(b) - along(a)) - CORNER * size,
                piece: (first + i) as f64,
            }
        };
        Ok(ConvexPolygon { sides: sides.iter().enumerate().map(side).collect() })
    }
}

impl Walls<2> for ConvexPolygon {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let zero = v[0].same(0.0);
        let (mut num, mut den) = (zero.same(f64::INFINITY), zero.same(1.0));
        let (mut n, mut middle, mut half, mut wall, mut piece) = ([zero; 2], zero, zero, zero, zero);
        for side in &self.sides {
            let speed = v[0] * side.normal[0] + v[1] * side.normal[1];
            let distance = (zero.same(side.distance) - (x[0] * side.normal[0] + x[1] * side.normal[1])).max(zero);
            let sooner = (distance * den).lt(num * speed) & zero.lt(speed);
            num = sooner.select(distance, num);
            den = sooner.select(speed, den);
            n = [sooner.select(zero.same(side.normal[0]), n[0]), sooner.select(zero.same(side.normal[1]), n[1])];
            middle = sooner.select(zero.same(side.middle), middle);
            half = sooner.select(zero.same(side.half), half);
            wall = sooner.select(zero.same(side.distance), wall);
            piece = sooner.select(zero.same(side.piece), piece);
        }
        let time = num / den;
        let p = [x[0] + time * v[0], x[1] + time * v[1]];
        // project onto the side
        let off = wall - (p[0] * n[0] + p[1] * n[1]);
        let point = [p[0] + off * n[0], p[1] + off * n[1]];
        let along = point[1] * n[0] - point[0] * n[1] - middle;
        WallHit {
            time,
            point,
            normal: [-n[0], -n[1]],
            inverse: zero.same(1.0),
            inverse_square: zero.same(1.0),
            piece,
            corner: half.lt(along.abs()),
        }
    }
}

//! The wedge between two rays from one point.
use super::{CORNER, WallHit, Walls, normal::of_known_length, sooner};
use crate::{Error, Figure};
use lanes::{Lane, Mask};

/// The convex region between two rays.
///
/// Its sides are taken as whole lines, so no path can slip out at the apex. An orbit that stays for ever between two
/// walls hits each of them half of the time, so their normals have lengths that are known to nineteen digits;
/// otherwise invariants would drift.
#[derive(Clone, Debug)]
pub struct Wedge {
    apex: [f64; 2],
    sides: [Side; 2],
    /// Within this distance of the apex, due to its rounding, a hit is a corner.
    margin: f64,
}

#[derive(Clone, Copy, Debug)]
struct Side {
    /// Outward normal, of any length, and the inverse of its length.
    normal: [f64; 2],
    inverse: f64,
    piece: f64,
}

impl Wedge {
    /// The region on the table's side of two rays that share their end: first the one that arrives there, then the
    /// one that leaves it, in the sense of traversal; with their numbers.
    ///
    /// # Errors
    /// [`Error::NotConvex`] where the figures are not such rays, or the angle between them is not less than π.
    pub fn new(rays: [Figure; 2], pieces: [usize; 2]) -> Result<Self, Error> {
        let [
            Figure::Ray { from: apex, direction: arriving, left: false },
            Figure::Ray { from, direction: leaving, left: true },
        ] = rays
        else {
            return Err(Error::NotConvex);
        };
        if apex != from || leaving.perp(&arriving) <= 0.0 {
            return Err(Error::NotConvex);
        }
        let side = |outward: [f64; 2], piece: usize| {
            let (normal, inverse) = of_known_length(outward);
            Side { normal, inverse, piece: piece as f64 }
        };
        Ok(Wedge {
            apex: apex.into(),
            sides: [side([-arriving.y, arriving.x], pieces[0]), side([leaving.y, -leaving.x], pieces[1])],
            margin: CORNER * apex.amax(),
        })
    }
}

impl Walls<2> for Wedge {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let zero = v[0].same(0.0);
        let y = [x[0] - self.apex[0], x[1] - self.apex[1]];
        let (mut num, mut den) = (zero.same(f64::INFINITY), zero.same(1.0));
        let (mut n, mut inverse, mut piece) = ([zero; 2], zero, zero);
        for side in &self.sides {
            let speed = v[0] * side.normal[0] + v[1] * side.normal[1];
            let distance = (-(y[0] * side.normal[0] + y[1] * side.normal[1])).max(zero);
            [num, den, n[0], n[1], inverse, piece] = sooner([distance, speed], [num, den]).choose(
                [
                    distance,
                    speed,
                    zero.same(side.normal[0]),
                    zero.same(side.normal[1]),
                    zero.same(side.inverse),
                    zero.same(side.piece),
                ],
                [num, den, n[0], n[1], inverse, piece],
            );
        }
        let time = num / den;
        let p = [y[0] + time * v[0], y[1] + time * v[1]];
        // a path may come from any distance
        let margin = (x[0].abs() + x[1].abs()) * CORNER + self.margin;
        WallHit {
            time,
            point: [p[0] + self.apex[0], p[1] + self.apex[1]],
            normal: [-n[0], -n[1]],
            inverse,
            piece,
            corner: p[0].abs().max(p[1].abs()).lt(margin),
        }
    }
}

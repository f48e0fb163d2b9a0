//! Walls: what the engine's loop asks, in lanes of any width.
//!
//! A [`Table`](crate::Table) describes; walls answer. The best walls for a table are found by
//! [`Table::with_walls`](crate::Table::with_walls): composite convex pieces that answer in one go (slab, cuboid,
//! zonogon, convex polygon, capsule, sphere), scatterers, pairs of those, or a list of pieces.
mod around;
mod by_lane;
mod capsule;
mod convex;
mod cuboid;
mod few;
mod homogeneous;
mod list;
mod periodic;
mod pieces;
mod rotated;
mod scatterer;
mod slab;
mod sphere;
mod zonogon;

pub use around::Around;
pub use by_lane::ByLane;
pub use capsule::Capsule;
pub use convex::ConvexPolygon;
pub use cuboid::Cuboid;
pub use few::Few;
pub use homogeneous::{Chord, Homogeneous};
pub use list::List;
pub use periodic::Periodic;
pub use pieces::Pieces;
pub use rotated::Rotated;
pub use scatterer::Scatterer;
pub use slab::Slab;
pub use sphere::Sphere;
pub use zonogon::Zonogon;

use crate::{Hit, Line};
use lanes::{Double, Lane, Mask, two_prod};

/// The first hit, in lanes.
#[derive(Clone, Copy, Debug)]
pub struct WallHit<F: Lane, const N: usize> {
    /// Time of flight; infinite where there is no hit, and then nothing else means anything.
    pub time: F,
    /// The point hit, on the wall.
    pub point: [F; N],
    /// A normal into the table. Its length is whatever the wall has at hand: see the next two.
    pub normal: [F; N],
    /// `1/|normal|`, to about 2 ulp.
    pub inverse: F,
    /// `1/|normal|²`, to about 2 ulp: reflecting with it is exact for a normal of any length.
    pub inverse_square: F,
    /// Number of the piece.
    pub piece: F,
    /// Whether the hit is a corner, within rounding.
    pub corner: F::Mask,
}

impl<F: Lane, const N: usize> WallHit<F, N> {
    /// The unit normal into the table.
    #[inline(always)]
    pub fn unit_normal(&self) -> [F; N] {
        self.normal.map(|n| n * self.inverse)
    }

    /// No hit, in lanes like those of `x`.
    #[inline(always)]
    pub fn never(x: [F; N]) -> Self {
        let one = x[0].same(1.0);
        WallHit {
            time: x[0].same(f64::INFINITY),
            point: x,
            normal: x,
            inverse: one,
            inverse_square: one,
            piece: x[0].same(0.0),
            corner: one.lt(one),
        }
    }

    /// This one, or `other` where `second`.
    #[inline(always)]
    #[must_use]
    pub fn or(mut self, second: F::Mask, other: &Self) -> Self {
        self.time = second.select(other.time, self.time);
        for i in 0..N {
            self.point[i] = second.select(other.point[i], self.point[i]);
            self.normal[i] = second.select(other.normal[i], self.normal[i]);
        }
        self.inverse = second.select(other.inverse, self.inverse);
        self.inverse_square = second.select(other.inverse_square, self.inverse_square);
        self.piece = second.select(other.piece, self.piece);
        self.corner = (second & other.corner) | (!second & self.corner);
        self
    }
}

/// What a billiard's particle can hit, as the engine's loop asks it: for one orbit or for many side by side.
///
/// The same code runs in every lane width, so an ensemble has the bits of its single orbits.
pub trait Walls<const N: usize>: Sync {
    /// The first hit of the paths `x + t v`, `t ≥ 0`.
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N>;

    /// The first hit of one path.
    fn hit(&self, path: &Line<N>) -> Option<Hit<N>> {
        let hit = self.first_hit::<f64>(&path.point.into(), &path.velocity.into());
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a piece number is a small integer")]
        (hit.time < f64::INFINITY).then(|| Hit {
            time: hit.time,
            point: hit.point.into(),
            normal: hit.unit_normal().into(),
            piece: hit.piece as usize,
            corner: hit.corner,
        })
    }
}

/// A computation for walls of any type; see [`Table::with_walls`](crate::Table::with_walls).
pub trait WithWalls<const N: usize> {
    /// What it returns.
    type Output;
    /// Runs it.
    fn run<W: Walls<N>>(self, walls: &W) -> Self::Output;
    /// Runs it on walls in the plane that know a shorter way from hit to hit.
    fn run_homogeneous<W: Homogeneous + Walls<N>>(self, walls: &W) -> Self::Output
    where
        Self: Sized,
    {
        self.run(walls)
    }
}

/// Within how many units of rounding of the table's size a point counts as a corner.
///
/// A landing point is right to about 2 ulp of the size along the wall; 8 covers it with a factor of four.
pub(crate) const CORNER: f64 = 8.0 * f64::EPSILON;

/// The neighbour of a unit normal, or the normal itself, whose length is nearest to 1.
///
/// A reflection in a normal whose length is off by a rounding changes the energy by the same part in every collision with
/// that wall. A normal in another last digit is as good a normal, and on average two fifths of the error are gone.
pub(crate) fn most_unit(normal: [f64; 2]) -> [f64; 2] {
    let defect = |n: [f64; 2]| {
        let mut sum = Double::new(-1.0);
        for x in n {
            let (square, rest) = two_prod(x, x);
            sum.add(square);
            sum.add(rest);
        }
        sum.value().abs()
    };
    let near = |x: f64| if x == 0.0 { [x; 3] } else { [x, x.next_down(), x.next_up()] };
    let mut best = normal;
    for a in near(normal[0]) {
        for b in near(normal[1]) {
            if defect([a, b]) < defect(best) {
                best = [a, b];
            }
        }
    }
    best
}

/// `a · b`
#[inline(always)]
pub(crate) fn dot<F: Lane, const N: usize>(a: &[F; N], b: &[F; N]) -> F {
    let mut sum = a[0] * b[0];
    for i in 1..N {
        sum = sum + a[i] * b[i];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_unit_normal_is_a_neighbour_that_is_nearer_to_length_1() {
        let defect = |n: [f64; 2]| {
            let mut sum = Double::new(-1.0);
            for x in n {
                let (square, rest) = two_prod(x, x);
                sum.add(square);
                sum.add(rest);
            }
            sum.value().abs()
        };
        let (mut before, mut after) = (0.0, 0.0);
        for k in 0..100 {
            let angle = 0.0628 * f64::from(k) + 0.01;
            let normal = [libm::cos(angle), libm::sin(angle)];
            let unit = most_unit(normal);
            assert!(defect(unit) <= defect(normal));
            for i in 0..2 {
                assert!(normal[i].next_down() <= unit[i] && unit[i] <= normal[i].next_up());
            }
            before += defect(normal);
            after += defect(unit);
        }
        // nine choices in place of one leave three fifths
        assert!(after < 0.65 * before, "{after:e} of {before:e}");
    }
}

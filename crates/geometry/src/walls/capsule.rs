//! The capsule: all points within `r` of a segment. As a table, the stadium.
use super::{WallHit, Walls};
use crate::Error;
use lanes::{Lane, Mask};
use nalgebra::Vector2;

/// The stadium of half-length `h` along the first axis and radius `r` about a centre.
#[derive(Clone, Debug)]
pub struct Capsule {
    /// First coordinate of the centres of the left and the right cap, and their common second coordinate.
    left: f64,
    right: f64,
    middle: f64,
    /// First coordinate of the centre, and half the distance of the caps.
    center: f64,
    half_length: f64,
    radius: f64,
    square: f64,
    inverse: f64,
    inverse_square: f64,
    /// Numbers of: lower side, right cap, upper side, left cap.
    pieces: [f64; 4],
}

impl Capsule {
    /// The stadium about `center`; pieces: lower side, right cap, upper side, left cap.
    ///
    /// # Errors
    /// [`Error::Parameter`] or [`Error::Radius`] for sizes that are not positive and finite.
    pub fn new(center: Vector2<f64>, half_length: f64, radius: f64, pieces: [usize; 4]) -> Result<Self, Error> {
        if !(half_length > 0.0 && half_length.is_finite()) {
            return Err(Error::Parameter { name: "half_length", must: "positive and finite", value: half_length });
        }
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(Error::Radius { radius });
        }
        let square = radius * radius;
        Ok(Capsule {
            left: center.x - half_length,
            right: center.x + half_length,
            middle: center.y,
            center: center.x,
            half_length,
            radius,
            square,
            inverse: 1.0 / radius,
            inverse_square: 1.0 / square,
            pieces: pieces.map(|p| p as f64),
        })
    }
}

impl Walls<2> for Capsule {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let zero = v[0].same(0.0);
        let one = zero.same(1.0);
        let y = x[1] - self.middle;
        // where the path meets the line of the side ahead, times |v₂|: no division yet
        let up = zero.lt(v[1]);
        let speed = v[1].abs();
        let distance = (zero.same(self.radius) - up.select(y, -y)).max(zero);
        let meet = (x[0] - self.center) * speed + distance * v[0];
        let flat = meet.abs().lt(speed * self.half_length);
        // otherwise the cap on that side; both are prepared, since knowing the side takes as long
        let right = zero.lt(meet);
        let a = v[0] * v[0] + v[1] * v[1];
        let quadratic = |cap: f64| {
            let q1 = x[0] - cap;
            let b = q1 * v[0] + y * v[1];
            let c = (q1 * q1 + y * y) - self.square;
            (q1, b, c, b * b - a * c)
        };
        let (at_left, at_right) = (quadratic(self.left), quadratic(self.right));
        let q1 = right.select(at_right.0, at_left.0);
        let b = right.select(at_right.1, at_left.1);
        let c = right.select(at_right.2, at_left.2);
        let root = right.select(at_right.3, at_left.3).max(zero).sqrt();
        let cap = right.select(zero.same(self.right), zero.same(self.left));
        let q = b.abs() + root;
        let leaving = zero.lt(b);
        let num = flat.select(distance, leaving.select((-c).max(zero), q));
        let den = flat.select(speed, leaving.select(q, a));
        let time = num / den;
        let (l1, l2) = (q1 + time * v[0], y + time * v[1]);
        // |l|² is r² up to rounding on a cap: one Newton step each
        let ratio = (l1 * l1 + l2 * l2) * self.inverse_square;
        let scale = ratio * -0.5 + 1.5;
        let side = zero.same(self.radius).copysign(v[1]);
        let [lower, head, upper, tail] = self.pieces.map(|p| zero.same(p));
        WallHit {
            time,
            point: [flat.select(l1, l1 * scale) + cap, flat.select(side, l2 * scale) + self.middle],
            normal: [flat.select(zero, -l1), flat.select(-one.copysign(v[1]), -l2)],
            inverse: flat.select(one, scale * self.inverse),
            inverse_square: flat.select(one, (one.same(2.0) - ratio) * self.inverse_square),
            piece: flat.select(up.select(upper, lower), right.select(head, tail)),
            corner: zero.lt(zero),
        }
    }
}

//! The capsule: all points within `r` of a segment. As a table, the stadium.
use super::{WallHit, Walls, center::Center};
use crate::{
    Error,
    plane::{finite, is_radius},
};
use lanes::{Lane, Mask, dot};
use nalgebra::Vector2;

/// The stadium of half-length `h` along the first axis and radius `r` about a centre.
#[derive(Clone, Debug)]
pub struct Capsule {
    center: Center<2>,
    /// Half the distance between the centres of the caps.
    half_length: f64,
    radius: f64,
    square: f64,
    inverse: f64,
    /// `1/(2 r²)`
    half: f64,
    /// Numbers of: lower side, right cap, upper side, left cap.
    pieces: [f64; 4],
}

impl Capsule {
    /// The stadium about `center`; pieces: lower side, right cap, upper side, left cap.
    ///
    /// # Errors
    /// [`Error::Parameter`] or [`Error::Radius`] for sizes that are not positive and finite, or a centre that is not finite;
    /// [`Error::Length`] unless the radius is between 10⁻¹⁵⁰ and 10¹⁵⁰.
    pub fn new(center: Vector2<f64>, half_length: f64, radius: f64, pieces: [usize; 4]) -> Result<Self, Error> {
        finite("center", &center)?;
        if !(half_length > 0.0 && half_length.is_finite()) {
            return Err(Error::Parameter { name: "half_length", must: "positive and finite", value: half_length });
        }
        is_radius(radius)?;
        let square = radius * radius;
        Ok(Capsule {
            center: Center::new(center.into()),
            half_length,
            radius,
            square,
            inverse: 1.0 / radius,
            half: 0.5 / square,
            pieces: pieces.map(|p| p as f64),
        })
    }
}

impl Capsule {
    /// Its centre.
    pub(super) fn center(&self) -> &Center<2> {
        &self.center
    }

    /// The first hit of a path, both seen from the centre.
    #[inline(always)]
    pub(super) fn first_hit_from_center<F: Lane>(&self, y: [F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let zero = v[0].same(0.0);
        let one = zero.same(1.0);
        let [lower, head, upper, tail] = self.pieces.map(|p| zero.same(p));
        // where the path meets the line of the side ahead, times |v₂|: no division yet
        let up = zero.lt(v[1]);
        let speed = v[1].abs();
        let radius = zero.same(self.radius);
        let distance = up.select(radius - y[1], radius + y[1]);
        let meet = y[0] * speed + distance * v[0];
        let flat = meet.abs().lt(speed * self.half_length);
        let (mut num, mut den) = (distance.max(zero), speed);
        // otherwise the cap on that side
        let cap = zero.same(self.half_length).copysign(meet);
        let q = [y[0] - cap, y[1]];
        let mut l = q;
        if (!flat).any() {
            let (a, b, c) = (dot(v, v), dot(&q, v), dot(&q, &q) - self.square);
            // b² − a c = |v|² r² − |q ∧ v|²; below 0 by rounding only
            let moment = q[0] * v[1] - q[1] * v[0];
            let discriminant = a * self.square - moment * moment;
            let root = discriminant.abs().sqrt();
            // computed from the cap's centre: the division finishes before the square root, and the next flight does not wait for the
            // time
            let inverse = one / a;
            l = [(moment * v[1] + root * v[0]) * inverse, (root * v[1] - moment * v[0]) * inverse];
            // the later root, without cancellation, except where `b` and the square root are so small that rounding spoils `c` as a
            // product of the roots
            let as_product = zero.lt(b) & !discriminant.lt(-(a * c));
            let [n, d, _] = as_product.choose([-c, b.abs() + root, zero], [root - b, a, one]);
            [num, den, _] = flat.choose([num, den, zero], [n.max(zero), d, one]);
        }
        let time = num / den;
        // |l|² is r² up to rounding on a cap: one Newton step each
        let change = ((zero.same(self.square) - l[0] * l[0]) - l[1] * l[1]) * self.half;
        let [p1, p2, n1, n2, inverse, piece] = flat.choose(
            [
                q[0] + time * v[0] + cap,
                radius.copysign(v[1]),
                zero,
                (-one).copysign(-v[1]),
                one,
                up.select(upper, lower),
            ],
            [
                l[0] + l[0] * change + cap,
                l[1] + l[1] * change,
                -l[0],
                -l[1],
                change * self.inverse + self.inverse,
                zero.lt(meet).select(head, tail),
            ],
        );
        WallHit { time, point: [p1, p2], normal: [n1, n2], inverse, piece, corner: zero.never() }
    }
}

impl Walls<2> for Capsule {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let mut hit = self.first_hit_from_center(self.center.sees(x), v);
        hit.point = self.center.seen(&hit.point);
        hit
    }
}

//! The capsule: all points within `r` of a segment. As a table, the stadium.
use super::{WallHit, Walls};
use crate::{
    Error,
    plane::{cross, dot},
};
use lanes::{Lane, Mask};
use nalgebra::Vector2;

/// The stadium of half-length `h` along a unit vector `u` and radius `r` about a centre.
#[derive(Clone, Debug)]
pub struct Capsule {
    center: [f64; 2],
    axis: [f64; 2],
    half_length: f64,
    radius: f64,
    square: f64,
    inverse: f64,
    inverse_square: f64,
    /// Numbers of: right side (at −r on the left of `u`), cap at +h, left side, cap at −h.
    pieces: [f64; 4],
}

impl Capsule {
    /// The stadium about `center` along `axis` (any length but 0); pieces: the side on the right of the axis, the cap
    /// at its head, the side on the left, the cap at its tail.
    ///
    /// # Errors
    /// [`Error::Parameter`] or [`Error::Radius`] for sizes that are not positive and finite.
    pub fn new(
        center: Vector2<f64>,
        axis: Vector2<f64>,
        half_length: f64,
        radius: f64,
        pieces: [usize; 4],
    ) -> Result<Self, Error> {
        let length = libm::hypot(axis.x, axis.y);
        if !(length > 0.0 && length.is_finite()) {
            return Err(Error::ZeroLength);
        }
        if !(half_length > 0.0 && half_length.is_finite()) {
            return Err(Error::Parameter { name: "half_length", must: "positive and finite", value: half_length });
        }
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(Error::Radius { radius });
        }
        let square = radius * radius;
        Ok(Capsule {
            center: center.into(),
            axis: [axis.x / length, axis.y / length],
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
        let u = self.axis.map(|a| zero.same(a));
        let y = [x[0] - self.center[0], x[1] - self.center[1]];
        // along the axis and to its left
        let (px, py) = (dot(u, y), cross(u, y));
        let (vx, vy) = (dot(u, *v), cross(u, *v));
        // where the path meets the line of the side ahead, times |vy|: no division yet
        let speed = vy.abs();
        let left = zero.lt(vy);
        let distance = (zero.same(self.radius) - left.select(py, -py)).max(zero);
        let meet = px * speed + distance * vx;
        let flat = meet.abs().lt(speed * self.half_length);
        // otherwise the cap on that side
        let head = zero.same(self.half_length).copysign(meet);
        let qx = px - head;
        let (a, b) = (vx * vx + vy * vy, qx * vx + py * vy);
        let c = qx * qx + py * py - self.square;
        let root = (b * b - a * c).max(zero).sqrt();
        let q = b.abs() + root;
        let leaving = zero.lt(b);
        let num = flat.select(distance, leaving.select((-c).max(zero), q));
        let den = flat.select(speed, leaving.select(q, a));
        let time = num / den;
        // land, in the capsule's frame
        let (lx, ly) = (qx + time * vx, py + time * vy);
        let scale = ((lx * lx + ly * ly) * self.inverse_square) * -0.5 + 1.5;
        let side = zero.same(self.radius).copysign(vy);
        let (lx, ly) = (flat.select(lx, lx * scale), flat.select(side, ly * scale));
        let nx = flat.select(zero, lx * -self.inverse);
        let ny = flat.select(zero.same(-1.0).copysign(-vy), ly * -self.inverse);
        let at = lx + head;
        let [right_side, head_cap, left_side, tail_cap] = self.pieces.map(|p| zero.same(p));
        let piece = flat.select(left.select(left_side, right_side), zero.lt(head).select(head_cap, tail_cap));
        WallHit {
            time,
            point: [u[0] * at - u[1] * ly + self.center[0], u[1] * at + u[0] * ly + self.center[1]],
            normal: [u[0] * nx - u[1] * ny, u[1] * nx + u[0] * ny],
            piece,
            corner: zero.lt(zero),
        }
    }
}

//! The inside of a cylinder with flat ends.
use super::{CORNER, WallHit, Walls, sooner};
use crate::{
    Error,
    chord::is_chord,
    plane::{finite, is_radius},
};
use lanes::{Lane, Mask, dot};
use nalgebra::Vector3;

/// All points of space within `r` of a line and within `h` of a plane across it, as a table.
#[derive(Clone, Debug)]
pub struct Cylinder {
    center: [f64; 3],
    axis: [f64; 3],
    square: f64,
    inverse: f64,
    /// `1/(2 r²)`
    half: f64,
    half_height: f64,
    /// A point of the lateral surface farther from the middle than this is on a rim, as is a point of an end whose squared distance from
    /// the axis is greater than the next field.
    inner_height: f64,
    inner_square: f64,
    piece: f64,
}

impl Cylinder {
    /// The cylinder about `center` \[L\] along a unit vector, with a positive radius \[L\] and height `2 h` \[L\].
    ///
    /// # Errors
    /// [`Error::Radius`] or [`Error::Parameter`] unless radius and half the height are positive and finite and the centre finite,
    /// [`Error::Length`] unless the radius is between 10⁻¹⁵⁰ and 10¹⁵⁰, [`Error::ZeroLength`] for an axis whose length is not 1 within
    /// 8 ulp.
    pub fn new(
        center: Vector3<f64>,
        axis: Vector3<f64>,
        radius: f64,
        half_height: f64,
        piece: usize,
    ) -> Result<Self, Error> {
        finite("center", &center)?;
        is_radius(radius)?;
        if !(half_height > 0.0 && half_height.is_finite()) {
            return Err(Error::Parameter { name: "height", must: "positive and finite", value: 2.0 * half_height });
        }
        if !((axis.norm_squared() - 1.0).abs() <= 8.0 * f64::EPSILON) {
            return Err(Error::ZeroLength);
        }
        let margin = CORNER * (center.amax() + radius + half_height);
        let (square, inner) = (radius * radius, (radius - margin).max(0.0));
        Ok(Cylinder {
            center: center.into(),
            axis: axis.into(),
            square,
            inverse: 1.0 / radius,
            half: 0.5 / square,
            half_height,
            inner_height: half_height - margin,
            inner_square: inner * inner,
            piece: piece as f64,
        })
    }
}

/// A vector's component along a unit vector, and the part perpendicular to it.
#[inline(always)]
fn split<F: Lane>(of: &[F; 3], axis: &[F; 3]) -> (F, [F; 3]) {
    let along = dot(of, axis);
    let mut across = *of;
    for i in 0..3 {
        across[i] = of[i] - along * axis[i];
    }
    (along, across)
}

impl Walls<3> for Cylinder {
    /// The ends of a cylinder that does not lie along a coordinate axis have a normal of rounded length.
    fn rounds_normals(&self) -> bool {
        self.axis.iter().all(|a| a.abs() != 1.0)
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 3], v: &[F; 3]) -> WallHit<F, 3> {
        let zero = v[0].same(0.0);
        let one = zero.same(1.0);
        let (mut axis, mut y) = (*v, *x);
        for i in 0..3 {
            axis[i] = zero.same(self.axis[i]);
            y[i] = y[i] - self.center[i];
        }
        let ((height, w), (rise, u)) = (split(&y, &axis), split(v, &axis));
        // the lateral surface, seen along the axis: the later root of |w + t u|² = r², without cancellation
        let (a, b, c) = (dot(&u, &u), dot(&w, &u), dot(&w, &w) - self.square);
        // b² − a c = |u|² r² − |w ∧ u|²
        let mut discriminant = a * self.square;
        for [i, j] in [[1, 0], [2, 0], [2, 1]] {
            let moment = w[j] * u[i] - w[i] * u[j];
            discriminant = discriminant - moment * moment;
        }
        let root = is_chord([a, b, c], self.square).select(-b, discriminant.max(zero).sqrt());
        // where `b` and the square root are small, rounding spoils `c` as a product of the roots
        let as_product = zero.lt(b) & !discriminant.lt(-(a * c));
        let moves = zero.lt(a);
        let round = [
            moves.select(as_product.select(-c, root - b).max(zero), zero.same(f64::INFINITY)),
            moves.select(as_product.select(b + root, a), one),
        ];
        // the end ahead
        let end = zero.same(self.half_height).copysign(rise);
        let flat = [((end - height) * one.copysign(rise)).max(zero), rise.abs()];
        let at_end = sooner(flat, round);
        let [num, den] = at_end.choose(flat, round);
        let time = num / den;
        let mut at = y;
        for i in 0..3 {
            at[i] = y[i] + time * v[i];
        }
        let (level, out) = split(&at, &axis);
        // on the lateral surface |out|² is r² up to rounding: one Newton step each for the point and 1/|out|
        let off = dot(&out, &out);
        let change = (zero.same(self.square) - off) * self.half;
        let (lift, grow) = (at_end.select(end - level, zero), at_end.select(zero, change));
        let (mut point, mut normal) = (at, out);
        for i in 0..3 {
            point[i] = at[i] + (lift * axis[i] + grow * out[i]) + self.center[i];
            normal[i] = at_end.select(axis[i] * (-one).copysign(-rise), -out[i]);
        }
        let rim = at_end.either(zero.same(self.inner_square).lt(off), zero.same(self.inner_height).lt(level.abs()));
        WallHit {
            time,
            point,
            normal,
            inverse: at_end.select(one, change * self.inverse + self.inverse),
            piece: zero.same(self.piece),
            corner: rim,
        }
    }
}

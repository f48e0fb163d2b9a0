//! The lateral surfaces of cones, from within.
use super::round::{across, along, seen};
use crate::crossing::Candidate;
use lanes::{Lane, Mask, dot};
use nalgebra::Vector3;

/// All points whose direction from an apex is within an angle of an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nappe {
    pub(super) apex: [f64; 3],
    /// A unit vector from there into the cone.
    pub(super) axis: [f64; 3],
    /// The tangent of the angle, and its cosine.
    pub(super) slope: f64,
    pub(super) cosine: f64,
}

impl Nappe {
    pub(super) fn new(apex: Vector3<f64>, axis: Vector3<f64>, slope: f64) -> Nappe {
        Nappe { apex: apex.into(), axis: axis.into(), slope, cosine: 1.0 / libm::sqrt(1.0 + slope * slope) }
    }

    /// How far outside a point lies \[L\].
    #[inline(always)]
    pub(super) fn off<F: Lane>(&self, point: &[F; 3]) -> F {
        let w = seen(point, &self.apex);
        let out = across(&w, &self.axis);
        (dot(&out, &out).sqrt() - along(&w, &self.axis) * self.slope) * self.cosine
    }

    /// Where a path that starts inside, up to rounding, goes out.
    ///
    /// With the height `g` below the apex, and `w` and `u` the components of position and velocity perpendicular to the axis, it is
    /// inside while `a t² + 2 b t + c ≤ 0`: up to the first root ahead. It has none if the path is as steep as the cone and goes
    /// down; if it goes up, its line always meets both halves of the double cone.
    #[inline(always)]
    pub(super) fn leaves<F: Lane>(&self, x: &[F; 3], v: &[F; 3]) -> Candidate<F> {
        let zero = v[0].same(0.0);
        let y = seen(x, &self.apex);
        let (g, fall) = (along(&y, &self.axis), along(v, &self.axis));
        let (w, u) = (across(&y, &self.axis), across(v, &self.axis));
        let square = self.slope * self.slope;
        let a = dot(&u, &u) - fall * fall * square;
        let b = dot(&w, &u) - g * fall * square;
        let c = dot(&w, &w) - g * g * square;
        // b² − a c = tan² |g u − fall w|² − |w ∧ u|²
        let mut discriminant = zero;
        for i in 0..3 {
            let drift = g * u[i] - fall * w[i];
            discriminant = discriminant + drift * drift;
        }
        discriminant = discriminant * square;
        for [i, j] in [[1, 0], [2, 0], [2, 1]] {
            let moment = w[j] * u[i] - w[i] * u[j];
            discriminant = discriminant - moment * moment;
        }
        let root = discriminant.max(zero).sqrt();
        let outwards = zero.lt(b);
        let [num, den] = outwards.choose([-c, b + root], [root - b, a]);
        Candidate { really: zero.lt(a) | outwards, num, den }
    }
}

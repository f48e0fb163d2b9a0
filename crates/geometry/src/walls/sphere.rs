//! The inside of a sphere: disk table and ball table.
use super::{Chord, Homogeneous, WallHit, Walls, dot};
use crate::Error;
use lanes::{Double, Lane, Mask, two_prod, two_sum};
use nalgebra::SVector;

/// The ball of radius `r` about `c` in ℝᴺ, with the particle inside.
#[derive(Clone, Debug)]
pub struct Sphere<const N: usize> {
    center: [f64; N],
    radius: f64,
    square: f64,
    inverse: f64,
    /// `1/(2 r²)`
    half: f64,
    piece: f64,
}

impl<const N: usize> Sphere<N> {
    /// The ball about `center` \[L\] with a positive radius \[L\].
    ///
    /// # Errors
    /// [`Error::Radius`] unless the radius is positive and finite.
    pub fn new(center: SVector<f64, N>, radius: f64, piece: usize) -> Result<Self, Error> {
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(Error::Radius { radius });
        }
        let square = radius * radius;
        Ok(Sphere {
            center: center.into(),
            radius,
            square,
            inverse: 1.0 / radius,
            half: 0.5 / square,
            piece: piece as f64,
        })
    }
}

impl<const N: usize> Walls<N> for Sphere<N> {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let mut y = *x;
        for i in 0..N {
            y[i] = y[i] - self.center[i];
        }
        let zero = v[0].same(0.0);
        let (a, b, c) = (dot(v, v), dot(&y, v), dot(&y, &y) - self.square);
        // the later root of |y + t v|² = r², without cancellation
        let root = (b * b - a * c).max(zero).sqrt();
        let q = b.abs() + root;
        let leaving = zero.lt(b);
        let num = leaving.select(-c, q);
        let time = num.max(zero) / leaving.select(q, a);
        let mut lacks = zero.same(self.square);
        for i in 0..N {
            y[i] = y[i] + time * v[i];
            lacks = lacks - y[i] * y[i];
        }
        // |y|² is r² up to rounding: one Newton step each for y on the sphere and 1/|y|
        let change = lacks * self.half;
        let mut point = y;
        for i in 0..N {
            point[i] = y[i] + y[i] * change + self.center[i];
        }
        WallHit {
            time,
            point,
            normal: y.map(|y| -y),
            inverse: change * self.inverse + self.inverse,
            piece: zero.same(self.piece),
            corner: zero.lt(zero),
        }
    }
}

/// A place is the unit vector from the centre.
impl Homogeneous for Sphere<2> {
    #[inline(always)]
    fn place<F: Lane>(&self, hit: &WallHit<F, 2>) -> [F; 2] {
        hit.normal.map(|n| -n * hit.inverse)
    }
    /// The angular momentum `y ∧ v` is that of the start: `v·t = −(y ∧ v)/r` and `v·n = −√(|v|² − (v·t)²)`, in twice the
    /// digits up to their last rounding.
    #[inline(always)]
    fn arrival<F: Lane>(&self, x: &[F; 2], v: &[F; 2], _: &WallHit<F, 2>) -> [F; 2] {
        let zero = v[0].same(0.0);
        let product = |a: F, b: F| {
            let (product, rest) = two_prod(a, b);
            [product, rest]
        };
        let sum = |parts: &[[F; 2]]| {
            let mut sum = Double::new(zero);
            for part in parts.as_flattened() {
                sum.add(*part);
            }
            sum
        };
        let [y1, y2] = [0, 1].map(|i| two_sum(x[i], zero.same(-self.center[i])));
        let moment = sum(&[product(y1.0, -v[1]), product(y2.0, v[0]), [y1.1 * -v[1], y2.1 * v[0]]]);
        let tangential = moment.high / zero.same(self.radius);
        let rest = sum(&[[moment.high, moment.low], product(-tangential, zero.same(self.radius))]).value();
        let low = rest / zero.same(self.radius);
        let square = sum(&[
            product(v[0], v[0]),
            product(v[1], v[1]),
            product(-tangential, tangential),
            [tangential * (low * -2.0), zero],
        ]);
        let normal = square.high.max(zero).sqrt();
        let rest = sum(&[[square.high, square.low], product(-normal, normal)]).value();
        let grazing = !zero.lt(normal);
        let normal = normal + grazing.select(zero, rest / grazing.select(zero.same(1.0), normal + normal));
        [-normal, tangential + low]
    }
    /// The chord of `u = −tangential + i normal` turns the place by `u²/|u|²` and takes the time `2 r normal/|u|²`.
    ///
    /// The place is multiplied by `u` twice, and not by the rounded `u²/|u|²`, which would be off by the same angle in
    /// every chord alike; what is left of the rounding differs from place to place and averages out.
    #[inline(always)]
    fn chord<F: Lane>(&self, place: &[F; 2], normal: F, tangential: F) -> Chord<F> {
        let inverse = normal.same(1.0) / (tangential * tangential + normal * normal);
        let turned = |[e1, e2]: [F; 2]| [-(e1 * tangential) - e2 * normal, e1 * normal - e2 * tangential];
        let [e1, e2] = turned(turned(*place)).map(|e| e * inverse);
        // one Newton step keeps the length at 1
        let scale = (e1 * e1 + e2 * e2) * -0.5 + 1.5;
        let time = (normal + normal) * self.radius * inverse;
        Chord { time, place: [e1 * scale, e2 * scale], tangential }
    }
    #[inline(always)]
    fn landing<F: Lane>(&self, chord: &Chord<F>) -> WallHit<F, 2> {
        let [e1, e2] = chord.place;
        let one = e1.same(1.0);
        WallHit {
            time: chord.time,
            point: [e1 * self.radius + self.center[0], e2 * self.radius + self.center[1]],
            normal: [-e1, -e2],
            inverse: one,
            piece: one.same(self.piece),
            corner: one.lt(one),
        }
    }
}

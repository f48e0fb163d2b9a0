//! The inside of a sphere: disk table and ball table.
use super::{Chord, Homogeneous, Swing, WallHit, Walls};
use crate::{
    Error,
    chord::is_chord,
    plane::{finite, is_radius},
};
use lanes::{Double, Lane, Mask, dot, two_sum};
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
    /// [`Error::Radius`] unless the radius is positive and finite, [`Error::Length`] unless it is between 10⁻¹⁵⁰ and 10¹⁵⁰,
    /// [`Error::Parameter`] for a centre that is not finite.
    pub fn new(center: SVector<f64, N>, radius: f64, piece: usize) -> Result<Self, Error> {
        finite("center", &center)?;
        is_radius(radius)?;
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
        let c = is_chord([a, b, c], self.square).select(zero, c);
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
        let (mut point, mut normal) = (y, y);
        for i in 0..N {
            point[i] = y[i] + y[i] * change + self.center[i];
            normal[i] = -y[i];
        }
        WallHit {
            time,
            point,
            normal,
            inverse: change * self.inverse + self.inverse,
            piece: zero.same(self.piece),
            corner: zero.never(),
        }
    }
}

/// Here a place is the unit vector from the centre.
impl Homogeneous for Sphere<2> {
    const ROUND: bool = true;

    #[inline(always)]
    fn place<F: Lane>(&self, hit: &WallHit<F, 2>) -> [F; 2] {
        hit.normal.map(|n| -n * hit.inverse)
    }
    /// The angular momentum `y ∧ v` is the same as at the start: `v·t = −(y ∧ v)/r` and `v·n = −√(|v|² − (v·t)²)`, or at the end of a
    /// flat chord from the circle `v·n = y·v/r`, as at its start.
    fn arrival(&self, x: &[f64; 2], v: &[f64; 2], _: &[f64; 2]) -> [Double; 2] {
        let [v1, v2] = v.map(Double::new);
        let [y1, y2] = [0, 1].map(|i| {
            let (high, low) = two_sum(x[i], -self.center[i]);
            Double { high, low }
        });
        let moment = y2.times(v1).plus(-y1.times(v2));
        let tangential = moment.over(Double::new(self.radius));
        let (square, rise) = (v1.times(v1).plus(v2.times(v2)), y1.times(v1).plus(y2.times(v2)));
        let off = y1.times(y1).plus(y2.times(y2)).plus(Double::new(-self.square));
        if is_chord([square, rise, off].map(|x| x.high), self.square) {
            return [rise.over(Double::new(self.radius)), tangential];
        }
        [-square.plus(-tangential.times(tangential)).root(), tangential]
    }
    /// The time is `2 r normal/|u|²`.
    #[inline(always)]
    fn chord<F: Lane>(&self, place: &[F; 2], normal: F, tangential: F) -> Chord<F> {
        let swing = Swing::new(normal, tangential);
        let time = (normal + normal) * self.radius * swing.inverse;
        Chord { time, place: swing.apply(place), tangential }
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
            corner: one.never(),
        }
    }
}

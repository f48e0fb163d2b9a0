//! Where a particle is and how it moves, whatever the method and the dimension.

use super::real::{DoubleDouble, Real};

/// Position, velocity and scaled spin. In the plane the third components are 0, and the spin is `spin[0]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<R> {
    /// Position of the centre.
    pub position: [R; 3],
    /// Velocity of the centre.
    pub velocity: [R; 3],
    /// Scaled spin `γ R ω`.
    pub spin: [R; 3],
}

impl<R: Real> State<R> {
    /// The same in another precision.
    pub fn to<Q: Real>(&self, into: impl Fn(R) -> Q + Copy) -> State<Q> {
        State { position: self.position.map(into), velocity: self.velocity.map(into), spin: self.spin.map(into) }
    }

    /// A state of `n` dimensions and `s` components of spin.
    pub fn from_parts<const N: usize, const S: usize>(x: &[R; N], v: &[R; N], w: &[R; S]) -> Self {
        let zero = R::of(0.0);
        State {
            position: core::array::from_fn(|i| x.get(i).copied().unwrap_or(zero)),
            velocity: core::array::from_fn(|i| v.get(i).copied().unwrap_or(zero)),
            spin: core::array::from_fn(|i| w.get(i).copied().unwrap_or(zero)),
        }
    }
}

/// The first components of a vector.
pub fn first<const N: usize>(x: &[f64; 3]) -> [f64; N] {
    core::array::from_fn(|i| x[i])
}

impl State<f64> {
    /// `|v|² + |w|²` in double-double precision.
    fn square(&self) -> DoubleDouble {
        let squares = self.velocity.iter().chain(&self.spin).map(|x| DoubleDouble::of(*x) * DoubleDouble::of(*x));
        squares.fold(DoubleDouble::of(0.0), |sum, square| sum + square)
    }

    /// The speed, spin included.
    pub fn speed(&self) -> f64 {
        self.square().sqrt().value()
    }

    /// The relative deviation of the energy from that of another state.
    pub fn energy_drift(&self, start: &State<f64>) -> f64 {
        ((self.square() - start.square()) / start.square()).value().abs()
    }

    /// The error of this state against the right one: the largest component of the difference, positions relative to
    /// `size`, velocities relative to the speed. Infinite where anything is NaN.
    pub fn error(&self, right: &State<DoubleDouble>, size: f64) -> f64 {
        let speed = self.speed();
        let off = |a: &[f64; 3], b: &[DoubleDouble; 3], unit: f64| {
            (0..3).map(|i| ((DoubleDouble::of(a[i]) - b[i]).value() / unit).abs()).fold(0.0, worse)
        };
        let parts = [
            off(&self.position, &right.position, size),
            off(&self.velocity, &right.velocity, speed),
            off(&self.spin, &right.spin, speed),
        ];
        parts.into_iter().fold(0.0, worse)
    }
}

/// The larger of two errors; infinite if one is NaN.
pub fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

//! The covariance of the errors of an orbit.
use super::{along, dot, norm, plus};
use crate::start::Start;

/// Rounding moves a coordinate by this fraction of its size in a flight or a collision, rms (`examples/exactness.rs` measures it).
const ROUNDING: f64 = 0.5 * f64::EPSILON;

/// The covariance `P = F Fᵀ` of the errors, by the columns of `F`, each an error that is independent of the others.
///
/// `P` itself would be lost in rounding where errors are focused: of an orbit that passes a focus of an ellipse at a distance of 10⁻⁶, the
/// variances across and along the path differ by more than 10¹⁶, and a variance that is computed as their difference may be negative.
#[derive(Clone, Debug)]
pub(super) struct Spread<const N: usize, const S: usize>(Vec<Start<N, S>>);

impl<const N: usize, const S: usize> Spread<N, S> {
    /// That of an exact state.
    pub(super) fn none() -> Self {
        Spread(Vec::new())
    }

    /// That of a start whose numbers are rounded.
    pub(super) fn new(start: &Start<N, S>) -> Self {
        let mut spread = Spread::none();
        spread.round(norm(&start.position), [norm(&start.velocity), start.speed()], 1.0);
        spread
    }

    /// Adds `weight` times the square of the rounding of coordinates, velocity and spin of these sizes.
    pub(super) fn round(&mut self, length: f64, [velocity, spin]: [f64; 2], weight: f64) {
        let root = ROUNDING * libm::sqrt(weight);
        for i in 0..Start::<N, S>::COORDINATES {
            let of = match i {
                _ if i < N => length,
                _ if i < N + N => velocity,
                _ => spin,
            };
            let mut column = Start::ZERO;
            column.set(i, root * of);
            self.0.push(column);
        }
        self.compress();
    }

    /// `(1 + 1/n) P`
    pub(super) fn widen(&mut self, n: f64) {
        self.scale(libm::sqrt(1.0 + 1.0 / n));
    }

    /// `M P Mᵀ`
    pub(super) fn carry(&mut self, derivative: impl Fn(&Start<N, S>) -> Start<N, S>) {
        for column in &mut self.0 {
            *column = derivative(column);
        }
    }

    /// The root of the mean square error, relative.
    pub(super) fn error(&self, at: &Start<N, S>, size: f64) -> f64 {
        let [mut place, mut motion] = [0.0, 0.0];
        for Start { position, velocity, spin } in &self.0 {
            place += dot(position, position);
            motion += dot(velocity, velocity) + dot(spin, spin);
        }
        relative(libm::sqrt(place), libm::sqrt(motion), at, size)
    }

    /// `P ← (1 + c) P + (1 + 1/c) j jᵀ`, the least bound for the sum of the error and a jump `j` of `c` times its size.
    pub(super) fn jump(&mut self, by: &Start<N, S>, c: f64) {
        if c == 0.0 {
            return;
        }
        self.scale(libm::sqrt(1.0 + c));
        self.0.push(Start::ZERO.plus(libm::sqrt(1.0 + 1.0 / c), by));
        self.compress();
    }

    /// Multiplies all errors.
    fn scale(&mut self, factor: f64) {
        for column in &mut self.0 {
            *column = Start::ZERO.plus(factor, column);
        }
    }

    /// Makes `F` triangular, with as many columns as there are coordinates, by reflections `F ← F (I − 2 u uᵀ/|u|²)`, which leave `F Fᵀ` as
    /// it is: each reflects the rest of a row into its first component (Householder).
    fn compress(&mut self) {
        for i in 0..Start::<N, S>::COORDINATES {
            let columns = self.0.get_mut(i..).unwrap_or_default();
            let mut u: Vec<f64> = columns.iter().map(|column| column.get(i)).collect();
            let length = libm::sqrt(u.iter().map(|x| x * x).sum());
            if length == 0.0 {
                continue;
            }
            let half = length * (length + u[0].abs());
            u[0] += length.copysign(u[0]);
            let along = columns.iter().zip(&u).fold(Start::ZERO, |sum, (column, u)| sum.plus(u / half, column));
            for (column, u) in columns.iter_mut().zip(&u) {
                *column = column.plus(-u, &along);
            }
        }
        self.0.truncate(Start::<N, S>::COORDINATES);
    }

    /// Errors that displace a path of some velocity sideways after some time: `N − 1` of them on the border of the ellipse of
    /// displacements, `Pg / √(gᵀPg)` for the largest `g·d = u·(dx + t dv)` along an axis `u` across the path, then the same for what is
    /// left of `P` without it.
    pub(super) fn across(&self, velocity: &[f64; N], time: f64) -> Vec<Start<N, S>> {
        let mut axes = along(&velocity.map(|v| v / norm(velocity)));
        let displaced = |d: &Start<N, S>, u: &[f64; N]| dot(u, &plus(&d.position, time, &d.velocity));
        let mut found: Vec<Start<N, S>> = Vec::new();
        while !axes.is_empty() {
            let left = axes.iter().map(|u| {
                let all = self.0.iter().fold(Start::ZERO, |sum, column| sum.plus(displaced(column, u), column));
                found.iter().fold(all, |left, f| left.plus(-displaced(f, u), f))
            });
            let left = left.zip(&axes).map(|(d, u)| (displaced(&d, u), d)).enumerate();
            let Some((axis, (square, d))) = left.max_by(|(_, (a, _)), (_, (b, _))| a.total_cmp(b)) else { break };
            // where rounding is all that is left, there is one direction fewer
            if !(square > 0.0) {
                break;
            }
            axes.swap_remove(axis);
            found.push(Start::ZERO.plus(1.0 / libm::sqrt(square), &d));
        }
        found
    }
}

/// An error of the place in units of the table's size or one of the motion in units of the speed, whichever is larger.
pub(super) fn relative<const N: usize, const S: usize>(place: f64, motion: f64, at: &Start<N, S>, size: f64) -> f64 {
    let [place, motion] = [place / size, motion / at.speed()];
    if place.is_nan() || motion.is_nan() { f64::NAN } else { place.max(motion) }
}

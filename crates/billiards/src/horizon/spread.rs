//! The covariance of the errors of an orbit.
use super::{along, dot, norm, plus};
use crate::start::Start;

/// Rounding moves a coordinate by this fraction of its size in a flight or a collision, rms (`examples/exactness.rs` measures it).
const ROUNDING: f64 = 0.5 * f64::EPSILON;

/// The covariance of the errors, by columns.
#[derive(Clone, Debug)]
pub(super) struct Spread<const N: usize, const S: usize>(Vec<Start<N, S>>);

impl<const N: usize, const S: usize> Spread<N, S> {
    /// That of an exact state.
    pub(super) fn none() -> Self {
        Spread(vec![Start::ZERO; Start::<N, S>::COORDINATES])
    }

    /// That of a start whose numbers are rounded.
    pub(super) fn new(start: &Start<N, S>) -> Self {
        let mut spread = Spread::none();
        spread.round(norm(&start.position), [norm(&start.velocity), start.speed()], 1.0);
        spread
    }

    /// Adds `weight` times the square of the rounding of coordinates, velocity and spin of these sizes.
    pub(super) fn round(&mut self, length: f64, [velocity, spin]: [f64; 2], weight: f64) {
        for (i, column) in self.0.iter_mut().enumerate() {
            let of = match i {
                _ if i < N => length,
                _ if i < N + N => velocity,
                _ => spin,
            };
            let size = ROUNDING * of;
            column.set(i, column.get(i) + weight * size * size);
        }
    }

    /// `(1 + 1/n) P`
    pub(super) fn widen(&mut self, n: f64) {
        for column in &mut self.0 {
            for i in 0..Start::<N, S>::COORDINATES {
                column.set(i, column.get(i) * (1.0 + 1.0 / n));
            }
        }
    }

    /// `M P Mᵀ`
    pub(super) fn carry(&mut self, derivative: impl Fn(&Start<N, S>) -> Start<N, S>) {
        for _ in 0..2 {
            let moved: Vec<_> = self.0.iter().map(&derivative).collect();
            for (i, column) in self.0.iter_mut().enumerate() {
                for (k, row) in moved.iter().enumerate() {
                    column.set(k, row.get(i));
                }
            }
        }
    }

    /// The root of the mean square error, relative.
    pub(super) fn error(&self, at: &Start<N, S>, size: f64) -> f64 {
        let [mut place, mut motion] = [0.0, 0.0];
        for (i, column) in self.0.iter().enumerate() {
            if i < N {
                place += column.get(i);
            } else {
                motion += column.get(i);
            }
        }
        relative(libm::sqrt(place), libm::sqrt(motion), at, size)
    }

    /// `P ← (1 + c) P + (1 + 1/c) j jᵀ`, the least bound for the sum of the error and a jump `j` of `c` times its size.
    pub(super) fn jump(&mut self, by: &Start<N, S>, c: f64) {
        if c == 0.0 {
            return;
        }
        for (i, column) in self.0.iter_mut().enumerate() {
            for k in 0..Start::<N, S>::COORDINATES {
                column.set(k, (1.0 + c) * column.get(k) + (1.0 + 1.0 / c) * by.get(i) * by.get(k));
            }
        }
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
                let g = Start { position: *u, velocity: u.map(|u| time * u), spin: [0.0; S] };
                let all = self.0.iter().enumerate().fold(Start::ZERO, |sum, (i, column)| sum.plus(g.get(i), column));
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

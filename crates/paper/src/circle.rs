//! The no-slip circle in closed form: a hit maps `(v₀, τ, n)` to `(−c v₀ + s τ, s v₀ + c τ, n)`, a flight keeps it.
//!
//! `τ = v·t` and `n = v·ν` right after a hit; `c = cos β`, `s = sin β`. Two hits are the identity, so two chords alternate, at the
//! angles `θ = atan2(τ, n)` from the normal.
use crate::{
    law::{cos_beta, sin_beta},
    motion::{Bounce, State},
};

/// The tangential velocity `τ` after the next hit.
pub(crate) fn next_tangential(gamma_squared: f64, v0: f64, tau: f64) -> f64 {
    sin_beta(gamma_squared) * v0 + cos_beta(gamma_squared) * tau
}

/// The state right after a hit at the polar angle `phi`, on the circle of the given radius about the origin.
pub(crate) fn state(radius: f64, phi: f64, v0: f64, tau: f64, n: f64) -> State {
    let (sin, cos) = libm::sincos(phi);
    // ν = −(cos, sin), t = J ν = (sin, −cos)
    State { x: [0.0, radius * cos, radius * sin], v: [v0, tau * sin - n * cos, -tau * cos - n * sin] }
}

/// The distance from the centre of the line of the flight that follows a hit.
pub(crate) fn caustic(bounce: &Bounce) -> f64 {
    let State { x: [_, x1, x2], v: [_, v1, v2] } = bounce.state;
    (x1 * v2 - x2 * v1).abs() / libm::hypot(v1, v2)
}

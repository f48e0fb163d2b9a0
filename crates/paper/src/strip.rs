//! The no-slip strip in closed form.
//!
//! Seen along `x₂`, the contact points of each wall lie on a line; the two lines have slopes `dx₁/dx₀ = ±1/γ`, that is, they cross at a
//! point `O` under the angle β about the `x₁` axis. A flight is a segment of constant length ℓ with an end on each: a ladder that slides
//! on two lines.
use crate::motion::{Bounce, State};

/// A point or vector seen along `x₂`: `(x₀, x₁)`.
pub type Seen = [f64; 2];

/// `(x₀, x₁)` of a collision.
pub(crate) fn seen(bounce: &Bounce) -> Seen {
    [bounce.state.x[0], bounce.state.x[1]]
}

/// Unit direction of the line of contact points of a wall: `(γ, 1)/√(1+γ²)` on the lower one, `(γ, −1)/√(1+γ²)` on the upper one.
pub fn contact_direction(gamma_squared: f64, piece: usize) -> Seen {
    let length = libm::sqrt(1.0 + gamma_squared);
    let sign = if piece == 0 { 1.0 } else { -1.0 };
    [libm::sqrt(gamma_squared) / length, sign / length]
}

/// The crossing `O` of the lines of contact points through two collisions, one on each wall.
pub(crate) fn centre(gamma_squared: f64, a: &Bounce, b: &Bounce) -> Seen {
    let lines = [a, b].map(|bounce| (seen(bounce), contact_direction(gamma_squared, bounce.piece)));
    crossing(lines)
}

/// Where two lines cross, each given by a point and a direction.
pub fn crossing([(p, d), (q, e)]: [(Seen, Seen); 2]) -> Seen {
    // p + t d on the line through q: (p − q + t d) × e = 0
    let t = cross([q[0] - p[0], q[1] - p[1]], e) / cross(d, e);
    [p[0] + t * d[0], p[1] + t * d[1]]
}

/// `a₀ b₁ − a₁ b₀`
pub(crate) fn cross(a: Seen, b: Seen) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// `ℓ = √(|ẋ|²/ẋ₂² − 1)`: the length of a flight seen along `x₂`, in a strip of width 1.
pub(crate) fn ladder(start: &State) -> f64 {
    let [v0, v1, v2] = start.v;
    libm::hypot(v0, v1) / v2.abs()
}

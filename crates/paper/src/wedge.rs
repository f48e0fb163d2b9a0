//! The no-slip wedge in closed form, for every opening angle `θ` and every `γ`.
//!
//! Fold the wedge along its bisector: with `M` the mirror `(x₀, x₁) → (−x₀, −x₁)` each hit is the same map `H = M C`, and `H` is the
//! rotation by `−2δ` about the axis `b`. So the velocities after the hits of one wall turn about `b`, by `α = 2π − 4δ` per two
//! hits, and everything else follows.
use crate::law::UNIFORM;

/// `δ = arccos( cos(θ/2) / √(1+γ²) )`: a hit turns the folded velocity by `−2δ`.
pub fn delta(theta: f64, gamma_squared: f64) -> f64 {
    libm::acos(libm::cos(0.5 * theta) / libm::sqrt(1.0 + gamma_squared))
}

/// The opening angle whose `δ` is given: `cos(θ/2) = √(1+γ²) cos δ`; `None` if there is none in (0, π).
pub fn opening(delta: f64, gamma_squared: f64) -> Option<f64> {
    let cos = libm::sqrt(1.0 + gamma_squared) * libm::cos(delta);
    (cos > 0.0 && cos < 1.0).then(|| 2.0 * libm::acos(cos))
}

/// The axis of periodicity `b ∝ (sin(θ/2)/γ, 1, 0)`, of length 1: orbits with this velocity have period two.
pub fn axis(theta: f64, gamma_squared: f64) -> [f64; 3] {
    let spin = libm::sin(0.5 * theta) / libm::sqrt(gamma_squared);
    let length = libm::sqrt(1.0 + spin * spin);
    [spin / length, 1.0 / length, 0.0]
}

/// `cos ρ` of the circle about `b` that touches the velocities of direct escape: `sin(θ/2) √((1+γ²)/(γ² + sin²(θ/2)))`.
pub fn cos_inradius(theta: f64, gamma_squared: f64) -> f64 {
    let sin = libm::sin(0.5 * theta);
    sin * libm::sqrt((1.0 + gamma_squared) / (gamma_squared + sin * sin))
}

/// The area of each of the two regions of velocities that never escape: a cap if `q` is `None`, else the regular
/// spherical q-gon with the same inradius, where `δ = π p/q` in lowest terms.
pub fn non_escape_area(theta: f64, gamma_squared: f64, q: Option<u32>) -> f64 {
    use core::f64::consts::{PI, TAU};
    let cos = cos_inradius(theta, gamma_squared);
    match q {
        None => TAU * (1.0 - cos),
        Some(q) => {
            let q = f64::from(q);
            let angle = 2.0 * libm::acos(cos * libm::sin(PI / q));
            q * angle - (q - 2.0) * PI
        }
    }
}

/// The opening angle of the paper's Corollary 2.1 with `α = 2π/n`: `arccos(1/2 − (3/2) cos(π/n))`, for `γ² = 1/2`.
pub fn opening_of_period(n: u32) -> Option<f64> {
    use core::f64::consts::PI;
    let n = f64::from(n);
    // cos(α/2) = (γ² − cos θ)/(1 + γ²) with α = 2π/n
    let cos = UNIFORM - (1.0 + UNIFORM) * libm::cos(PI / n);
    (cos > -1.0 && cos < 1.0).then(|| libm::acos(cos))
}

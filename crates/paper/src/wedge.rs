//! The no-slip wedge in closed form, for every opening angle `θ` and every `γ`.
//!
//! Fold the wedge along its bisector: with `M` the mirror `(x₀, x₁) → (−x₀, −x₁)` each hit is the same map `H = M C`, and `H` is the
//! rotation by `−2δ` about the axis `b`. So the velocities after the hits of one wall turn about `b`, by `α = 2π − 4δ` per two
//! hits, and everything else follows.
use crate::{
    law::{UNIFORM, no_slip},
    motion::{self, Billiard, State},
    random::Stream,
};
use billiards::geometry::tables;
use core::f64::consts::{PI, TAU};
use nalgebra::{Matrix3, Vector3};

/// `δ = arccos( cos(θ/2) / √(1+γ²) )`: a hit turns the folded velocity by `−2δ`.
pub fn delta(theta: f64, gamma_squared: f64) -> f64 {
    libm::acos(libm::cos(0.5 * theta) / libm::sqrt(1.0 + gamma_squared))
}

/// The opening angle whose `δ` is given: `cos(θ/2) = √(1+γ²) cos δ`; `None` if there is none in (0, π).
pub fn opening(delta: f64, gamma_squared: f64) -> Option<f64> {
    let cos = libm::sqrt(1.0 + gamma_squared) * libm::cos(delta);
    (cos > 0.0 && cos < 1.0).then(|| 2.0 * libm::acos(cos))
}

/// The opening angle for which two hits turn velocities by `α`, for a uniform disk: `arccos(1/2 − (3/2) cos(α/2))`; `None` if there is
/// none in (0, π).
pub fn opening_of_turn(alpha: f64) -> Option<f64> {
    let cos = UNIFORM - (1.0 + UNIFORM) * libm::cos(0.5 * alpha);
    (cos > -1.0 && cos < 1.0).then(|| libm::acos(cos))
}

/// The axis of periodicity `b ∝ (sin(θ/2)/γ, 1, 0)`, of length 1: orbits with this velocity have period two.
pub fn axis(theta: f64, gamma_squared: f64) -> [f64; 3] {
    let spin = libm::sin(0.5 * theta) / libm::sqrt(gamma_squared);
    let length = libm::hypot(spin, 1.0);
    [spin / length, 1.0 / length, 0.0]
}

/// The radius ρ of the circle about `b` that touches the velocities of direct escape: `tan ρ = γ cos(θ/2) / (√(1+γ²) sin(θ/2))`.
pub fn inradius(theta: f64, gamma_squared: f64) -> f64 {
    let (sin, cos) = libm::sincos(0.5 * theta);
    libm::atan2(libm::sqrt(gamma_squared) * cos, libm::sqrt(1.0 + gamma_squared) * sin)
}

/// The area of each of the two regions of velocities that never escape: the cap of radius ρ if `q` is `None`, else the regular
/// spherical q-gon with that inradius, where `δ = π p/q` in lowest terms.
pub fn non_escape_area(theta: f64, gamma_squared: f64, q: Option<u32>) -> f64 {
    let rho = inradius(theta, gamma_squared);
    match q {
        None => 2.0 * TAU * libm::sin(0.5 * rho) * libm::sin(0.5 * rho),
        Some(q) => {
            // 2q right triangles with the legs ρ and h, tan h = sin ρ tan(π/q), of excess 2 atan(tan(ρ/2) tan(h/2))
            let q = f64::from(q);
            let half = libm::atan(libm::sin(rho) * libm::tan(PI / q));
            4.0 * q * libm::atan(libm::tan(0.5 * rho) * libm::tan(0.5 * half))
        }
    }
}

/// Inward normals of the walls: right, left.
pub(crate) fn normals(theta: f64) -> [[f64; 2]; 2] {
    let (sin, cos) = libm::sincos(0.5 * theta);
    [[-cos, sin], [cos, sin]]
}

/// The velocity map of a hit of the left wall and one of the right wall, in this order.
pub(crate) fn two_hits(theta: f64, gamma_squared: f64) -> Matrix3<f64> {
    let [right, left] = normals(theta).map(|normal| no_slip(gamma_squared, normal));
    right * left
}

/// The wedge as a billiard.
pub(crate) fn billiard(theta: f64, gamma_squared: f64) -> Billiard {
    motion::no_slip(tables::wedge(theta), gamma_squared)
}

/// The velocity at the angle `r` from the axis, in the direction `azimuth` around it.
pub(crate) fn near_axis(theta: f64, gamma_squared: f64, r: f64, azimuth: f64) -> [f64; 3] {
    let b = Vector3::from(axis(theta, gamma_squared));
    let up = Vector3::z();
    let across = b.cross(&up);
    (b * libm::cos(r) + (across * libm::cos(azimuth) + up * libm::sin(azimuth)) * libm::sin(r)).into()
}

/// A start on the bisector whose velocity is uniform in the cap about the axis that has `part` of the radius of the largest
/// one without escape.
pub(crate) fn bounded_start(theta: f64, gamma_squared: f64, part: f64, stream: &mut Stream) -> State {
    let most = part * inradius(theta, gamma_squared);
    let r = libm::acos(stream.between(libm::cos(most), 1.0));
    State { x: [0.0, 0.0, 1.0], v: near_axis(theta, gamma_squared, r, stream.between(0.0, TAU)) }
}

/// The reduced period of all bounded orbits where `δ = πp/q` in lowest terms: q if q is even, else 2q.
pub(crate) fn period(q: u32) -> usize {
    if q.is_multiple_of(2) { q as usize } else { 2 * q as usize }
}

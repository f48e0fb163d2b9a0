//! Negative controls: laws that look right and do not preserve the canonical measure.
//!
//! In both, the one rough direction of a surface in space depends on the *velocity*. Energy and momenta are conserved, the impulse acts
//! at the contact, and the second law is even reversible; but neither is linear in the velocity, which is the hypothesis that
//! preservation of the measure needs. A check that passes them is worthless.
//!
//! `ψ` is the angle of the tangential contact velocity `uₜ` ([`slip_angle`]), `φ` that of the rough direction. The statements hold for a
//! ball, where reversing the part of `uₜ` along `φ` turns `ψ` into `2φ + π − ψ` and keeps `|uₜ|`.

use crate::{CollisionLaw, Contact, Delassus, Roughness, reflect};
use nalgebra::{SVector, Vector3};
use std::f64::consts::PI;

/// The rough direction follows the velocity: `φ = 0.35 ψ + 0.2`.
///
/// Not reversible; multiplies the measure by `|0.7 − 1| = 0.3` at each collision.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Chasing;

impl CollisionLaw<3> for Chasing {
    fn impulse(&self, contact: &Contact<3>, delassus: &Delassus<3>, u: &SVector<f64, 3>) -> SVector<f64, 3> {
        rough_along(|psi| 0.35 * psi + 0.2, contact, delassus, u)
    }
}

/// The rough direction follows the velocity so as to send `ψ` to `ψ' = h⁻¹(−h(ψ))`, `h = ψ + 0.3 cos ψ`.
///
/// Reversible, `C C v = v`; multiplies the measure by `h'(ψ)/h'(ψ')`, anything between 0.54 and 1.86.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ReversiblyChasing;

impl ReversiblyChasing {
    /// The angle `ψ'` of the tangential contact velocity after the collision.
    pub fn image(psi: f64) -> f64 {
        let target = -Self::h(psi);
        let mut x = target;
        for _ in 0..60 {
            x -= (Self::h(x) - target) / Self::h_prime(x); // Newton; h is monotone and nearly linear
        }
        x
    }

    /// The factor `h'(ψ)/h'(ψ')` by which the measure is multiplied.
    pub fn measure_ratio(psi: f64) -> f64 {
        Self::h_prime(psi) / Self::h_prime(Self::image(psi))
    }

    fn h(psi: f64) -> f64 {
        psi + 0.3 * libm::cos(psi)
    }

    fn h_prime(psi: f64) -> f64 {
        1.0 - 0.3 * libm::sin(psi)
    }
}

impl CollisionLaw<3> for ReversiblyChasing {
    fn impulse(&self, contact: &Contact<3>, delassus: &Delassus<3>, u: &SVector<f64, 3>) -> SVector<f64, 3> {
        rough_along(|psi| 0.5 * (psi + Self::image(psi) - PI), contact, delassus, u)
    }
}

/// The angle `ψ` of the tangential part of `u`, in the frame of the contact plane that the controls use.
pub fn slip_angle(contact: &Contact<3>, u: &SVector<f64, 3>) -> f64 {
    let [t1, t2] = frame(contact);
    libm::atan2(t2.dot(u), t1.dot(u))
}

/// An orthonormal frame of the contact plane.
fn frame(contact: &Contact<3>) -> [Vector3<f64>; 2] {
    let normal = contact.normal.as_ref();
    let across = if normal.x.abs() < 0.5 { Vector3::x() } else { Vector3::y() };
    let t1 = normal.cross(&across).normalize();
    [t1, normal.cross(&t1)]
}

/// The reflection with the rough direction at angle `phi(ψ)`.
fn rough_along(
    phi: impl Fn(f64) -> f64,
    contact: &Contact<3>,
    delassus: &Delassus<3>,
    u: &SVector<f64, 3>,
) -> SVector<f64, 3> {
    let [t1, t2] = frame(contact);
    let angle = phi(slip_angle(contact, u));
    let direction = t1 * libm::cos(angle) + t2 * libm::sin(angle);
    reflect(&Roughness::of_span(&contact.normal, &[direction]), contact, delassus, u)
}

//! A ball against a fixed wall: the few numbers that an engine for one disk needs, without bodies or matrices.

use crate::{CollisionLaw, Twist, bodies::Ball};
use nalgebra::{SVector, Vector3};

/// The collision map of a disk and a fixed wall, in the velocities `v₀ = γ R θ̇`, `vₜ = v·t`, `vₙ = v·ν` \[L T⁻¹\].
///
/// `t = J ν`, with `J(x, y) = (−y, x)` and `ν` into the table; the kinetic energy is `(m/2)(v₀² + vₜ² + vₙ²)`. For a law that is the same
/// at every contact this is one constant block-diagonal matrix: a block for spin and tangent, and one entry for the normal. The traits of
/// [`approx`] compare maps within rounding, coefficient by coefficient:
///
/// ```
/// use approx::assert_abs_diff_eq;
/// use collision_laws::{DiskLaw, DiskMap, laws::{NoSlip, Specular}};
///
/// // with almost all mass in its centre a disk leaves a rough wall as a smooth one, but turns its spin around
/// let (rough, smooth) = (NoSlip.disk_map(1e-9), Specular.disk_map(1e-9));
/// assert_abs_diff_eq!(rough, DiskMap { spin_spin: -1.0, ..smooth }, epsilon = 2e-9);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiskMap {
    /// Coefficient of `v₀` in `v₀⁺`.
    pub spin_spin: f64,
    /// Coefficient of `vₜ` in `v₀⁺`.
    pub spin_tangent: f64,
    /// Coefficient of `v₀` in `vₜ⁺`.
    pub tangent_spin: f64,
    /// Coefficient of `vₜ` in `vₜ⁺`.
    pub tangent_tangent: f64,
    /// Coefficient of `vₙ` in `vₙ⁺`: −1 for a strict law.
    pub normal: f64,
}

impl DiskMap {
    /// The velocities `(v₀, vₜ, vₙ)` after the collision.
    #[inline]
    #[must_use]
    pub fn apply(&self, spin: f64, tangent: f64, normal: f64) -> (f64, f64, f64) {
        (
            self.spin_spin * spin + self.spin_tangent * tangent,
            self.tangent_spin * spin + self.tangent_tangent * tangent,
            self.normal * normal,
        )
    }
}

/// A law in the plane that has one [`DiskMap`] for all contacts of a disk with a fixed wall.
///
/// With `c = cos β = (1−γ²)/(1+γ²)` and `s = sin β = 2γ/(1+γ²)` no-slip is `v₀⁺ = −c v₀ + s vₜ`, `vₜ⁺ = s v₀ + c vₜ`.
/// Source: Cox and Feres, *No-slip billiards in dimension two*, equation (2.1), where `γ² = 1/2`.
///
/// ```
/// use collision_laws::{DiskLaw, laws::NoSlip};
///
/// let hoop = NoSlip.disk_map(1.0); // all mass on the rim: spin and tangential velocity change places
/// assert_eq!(hoop.apply(0.25, 0.5, -1.0), (0.5, 0.25, 1.0));
/// ```
pub trait DiskLaw: CollisionLaw<2> {
    /// The map for a disk with mass distribution parameter `gamma` = γ ≥ 0; γ = 0 is the limit of a disk with all its mass at the centre,
    /// which spins and leaves a rough wall as it would leave a smooth one. It differs from a [`Point`](crate::bodies::Point), which
    /// no-slip throws straight back.
    fn disk_map(&self, gamma: f64) -> DiskMap;
}

impl Ball<2> {
    /// The scaled spin `v₀ = γ R θ̇` \[L T⁻¹\] of a velocity.
    #[inline]
    pub fn scaled_spin(&self, v: &Twist<2>) -> f64 {
        self.gamma() * self.radius() * v.angular_velocity()
    }

    /// The velocity with centre moving at `linear` and scaled spin `v0` = γ R θ̇.
    #[inline]
    pub fn with_scaled_spin(&self, linear: SVector<f64, 2>, v0: f64) -> Twist<2> {
        Twist::planar(linear, v0 / (self.gamma() * self.radius()))
    }
}

impl Ball<3> {
    /// The scaled spin `W = γ R ω` \[L T⁻¹\], an axial vector in the space frame; the energy is `(m/2)(|v|² + |W|²)`.
    #[inline]
    pub fn scaled_spin(&self, v: &Twist<3>) -> Vector3<f64> {
        v.angular_velocity() * (self.gamma() * self.radius())
    }

    /// The velocity with centre moving at `linear` and scaled spin `w` = γ R ω.
    #[inline]
    pub fn with_scaled_spin(&self, linear: Vector3<f64>, w: Vector3<f64>) -> Twist<3> {
        Twist::spatial(linear, w / (self.gamma() * self.radius()))
    }
}

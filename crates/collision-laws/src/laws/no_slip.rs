//! The no-slip collision, the law of rough bodies.

use crate::{Contact, DiskLaw, DiskMap, Roughness, StrictLaw};

/// Perfectly rough contact: the contact velocity is reversed, `u⁺ = −u`.
///
/// `p = −2 K⁻¹ u`; `u` \[L T⁻¹\], `p` \[M L T⁻¹\], `K` \[M⁻¹\]. Roughness rank N−1.
///
/// A point without spin is thrown straight back, `v⁺ = −v`: its contact velocity is its own velocity, which reverses. The limit γ → 0 of
/// a spinning disk ([`disk_map`](DiskLaw::disk_map) at 0) is different: so little inertia takes up the whole slip, and the disk leaves as
/// from a smooth wall. Both are called points; the first has no spin, the second has all its mass at the centre and a rim without
/// inertia.
///
/// Source: Broomhead and Gutkin (1993); Cox and Feres, *No-slip billiards in dimension two*, equation (2.1), for a uniform
/// disk against a fixed wall.
///
/// ```
/// use approx::assert_relative_eq;
/// use collision_laws::{Contact, Fixed, Pair, Twist, bodies::Ball, laws::NoSlip};
/// use nalgebra::{Vector3};
///
/// let contact = Contact::new(Vector3::zeros(), Vector3::new(0.0, 0.0, 1.0), 0)?;
/// let ball = Ball::<3>::uniform(1.0, 0.5)?;
/// let pair = Pair::new(contact, (ball, Vector3::new(0.0, 0.0, -0.5)), (Fixed, Vector3::zeros()));
/// let before = (Twist::spatial(Vector3::new(1.0, 2.0, -3.0), Vector3::new(4.0, 5.0, 6.0)), ());
/// let once = pair.collide(&NoSlip, &before);
/// let twice = pair.collide(&NoSlip, &once.velocities);
/// assert_relative_eq!(pair.contact_velocity(&once.velocities), -once.u_minus, max_relative = 1e-15);
/// assert_relative_eq!(twice.velocities.0, before.0, max_relative = 1e-15); // applied twice, it changes nothing
/// # Ok::<(), collision_laws::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NoSlip;

impl<const N: usize> StrictLaw<N> for NoSlip {
    #[inline]
    fn roughness(&self, _: &Contact<N>) -> Roughness<N> {
        Roughness::Rough
    }
}

impl DiskLaw for NoSlip {
    fn disk_map(&self, gamma: f64) -> DiskMap {
        let square = gamma * gamma;
        let (cos, sin) = if square < f64::INFINITY {
            ((1.0 - square) / (1.0 + square), 2.0 * gamma / (1.0 + square))
        } else {
            (-1.0, 2.0 / gamma)
        };
        DiskMap { spin_spin: -cos, spin_tangent: sin, tangent_spin: sin, tangent_tangent: cos, normal: -1.0 }
    }
}

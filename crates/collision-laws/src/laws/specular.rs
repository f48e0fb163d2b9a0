//! Specular reflection, the law of standard billiards.

use crate::{Contact, DiskLaw, DiskMap, Roughness, StrictLaw};

/// Smooth contact: only the normal component of the contact velocity reverses.
///
/// `p = −2 ν (ν·u)/(ν·Kν)`; `u` \[L T⁻¹\], `p` \[M L T⁻¹\], `K` \[M⁻¹\]. Roughness rank 0.
///
/// A ball keeps its spin; a body whose arm is not along the normal does not:
///
/// ```
/// use collision_laws::{Contact, Fixed, Pair, Twist, bodies::Planar, laws::Specular};
/// use nalgebra::Vector2;
///
/// let contact = Contact::new(Vector2::zeros(), Vector2::new(0.0, 1.0), 0)?;
/// let stick = Planar::new(1.0, 1.0)?; // falls flat onto its right end
/// let pair = Pair::new(contact, (stick, Vector2::new(1.0, 0.0)), (Fixed, Vector2::zeros()));
/// let (after, ()) = pair.collide(&Specular, &(Twist::planar(Vector2::new(0.0, -1.0), 0.0), ())).velocities;
/// assert_eq!(after, Twist::planar(Vector2::zeros(), 1.0)); // all energy goes into the spin
/// # Ok::<(), collision_laws::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Specular;

impl<const N: usize> StrictLaw<N> for Specular {
    #[inline]
    fn roughness(&self, _: &Contact<N>) -> Roughness<N> {
        Roughness::Smooth
    }
}

impl DiskLaw for Specular {
    fn disk_map(&self, _: f64) -> DiskMap {
        DiskMap { spin_spin: 1.0, spin_tangent: 0.0, tangent_spin: 0.0, tangent_tangent: 1.0, normal: -1.0 }
    }
}

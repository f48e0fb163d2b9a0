//! Restitution: the nearest relatives of the strict laws that lose energy.

use super::{NoSlip, Specular};
use crate::{CollisionLaw, Contact, Delassus, DiskLaw, DiskMap, Error, Roughness, reflect};
use nalgebra::SVector;

/// Normal and tangential restitution: **not** a strict law.
///
/// Split `u` into `K p₀`, `p₀ = ν (ν·u)/(ν·Kν)`, and the rest `K p₁`, which is orthogonal to it in the metric `K⁻¹` of contact
/// velocities. The law is `p = −(1+eₙ) p₀ − (1+eₜ) p₁`, so that `u⁺ = −eₙ K p₀ − eₜ K p₁`, in particular `ν·u⁺ = −eₙ ν·u`, and the
/// energy lost is `½(1−eₙ²) p₀·K p₀ + ½(1−eₜ²) p₁·K p₁ ≥ 0`.
///
/// Momenta are conserved and the impulse acts at the contact alone. Energy and time-reversal (involution) hold, and the
/// invariant measure is kept, only where both coefficients have modulus 1: `(1, −1)` is [`Specular`], `(1, 1)` is [`NoSlip`].
///
/// ```
/// use collision_laws::{Contact, Fixed, Pair, bodies::Point, laws::Restitution};
/// use nalgebra::Vector2;
///
/// let contact = Contact::new(Vector2::zeros(), Vector2::new(0.0, 1.0), 0)?;
/// let pair = Pair::new(contact, (Point::new(1.0)?, Vector2::zeros()), (Fixed, Vector2::zeros()));
/// let after = pair.collide(&Restitution::new(0.5, -1.0)?, &(Vector2::new(1.0, -2.0), ())).velocities.0;
/// assert_eq!(after, Vector2::new(1.0, 1.0));
/// # Ok::<(), collision_laws::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Restitution {
    normal: f64,
    tangential: f64,
}

impl Restitution {
    /// The law with coefficients `eₙ ∈ [0, 1]` and `eₜ ∈ [−1, 1]`.
    ///
    /// # Errors
    /// [`Error::RestitutionOutOfRange`].
    pub fn new(normal: f64, tangential: f64) -> Result<Self, Error> {
        for (which, least, value) in [("normal", 0.0, normal), ("tangential", -1.0, tangential)] {
            if !(least..=1.0).contains(&value) {
                return Err(Error::RestitutionOutOfRange { which, least, value });
            }
        }
        Ok(Self { normal, tangential })
    }

    /// The coefficient of normal restitution `eₙ`.
    #[inline]
    pub fn normal(&self) -> f64 {
        self.normal
    }

    /// The coefficient of tangential restitution `eₜ`.
    #[inline]
    pub fn tangential(&self) -> f64 {
        self.tangential
    }

    /// Whether the impulse has a part besides the normal one: at `eₜ = −1` it has none.
    fn pushes_tangentially(&self) -> bool {
        self.tangential > -1.0
    }

    /// The weights of the no-slip impulse and of the specular impulse in the impulse of the law, which is their weighted sum.
    fn shares(&self) -> (f64, f64) {
        (0.5 * (1.0 + self.tangential), 0.5 * (self.normal - self.tangential))
    }
}

impl<const N: usize> CollisionLaw<N> for Restitution {
    #[inline]
    fn impulse(&self, contact: &Contact<N>, delassus: &Delassus<N>, u: &SVector<f64, N>) -> SVector<f64, N> {
        let (rough, smooth) = self.shares();
        if !self.pushes_tangentially() {
            return reflect(&Roughness::Smooth, contact, delassus, u) * smooth; // K need have no inverse
        }
        reflect(&Roughness::Rough, contact, delassus, u) * rough
            + reflect(&Roughness::Smooth, contact, delassus, u) * smooth
    }

    #[inline]
    fn reflections(&self, _: &Contact<N>) -> Vec<(f64, Roughness<N>)> {
        let (rough, smooth) = self.shares();
        if !self.pushes_tangentially() {
            return vec![(smooth, Roughness::Smooth)];
        }
        vec![(rough, Roughness::Rough), (smooth, Roughness::Smooth)]
    }

    #[inline]
    fn pushes(&self, _: &Contact<N>) -> Roughness<N> {
        if self.pushes_tangentially() { Roughness::Rough } else { Roughness::Smooth }
    }

    #[inline]
    fn is_strict(&self) -> bool {
        self.normal == 1.0 && self.tangential.abs() == 1.0
    }
}

impl DiskLaw for Restitution {
    fn disk_map(&self, gamma: f64) -> DiskMap {
        let (rough, smooth) = (NoSlip.disk_map(gamma), Specular.disk_map(gamma));
        let (share, _) = self.shares();
        let between = |a: f64, b: f64| share * a + (1.0 - share) * b;
        DiskMap {
            spin_spin: between(rough.spin_spin, smooth.spin_spin),
            spin_tangent: between(rough.spin_tangent, smooth.spin_tangent),
            tangent_spin: between(rough.tangent_spin, smooth.tangent_spin),
            tangent_tangent: between(rough.tangent_tangent, smooth.tangent_tangent),
            normal: -self.normal,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix2, Vector2};

    #[test]
    fn the_coefficients_are_those_that_were_given() {
        let law = Restitution::new(0.75, -0.5).unwrap();
        assert_eq!([law.normal(), law.tangential()], [0.75, -0.5]);
    }

    #[test]
    fn the_impulse_is_the_sum_of_the_reflections_that_the_law_names() {
        let contact = Contact::new([0.0; 2].into(), [0.6, 0.8].into(), 0).unwrap();
        let (k, u) = (Delassus::Dense(Matrix2::new(2.0, 0.5, 0.5, 1.5)), Vector2::new(0.3, -1.2));
        for (normal, tangential) in [(0.75, -0.5), (0.5, -1.0), (1.0, 1.0)] {
            let law = Restitution::new(normal, tangential).unwrap();
            let parts = CollisionLaw::<2>::reflections(&law, &contact);
            let sum: Vector2<f64> = parts.iter().map(|(weight, of)| reflect(of, &contact, &k, &u) * *weight).sum();
            assert_eq!(sum, law.impulse(&contact, &k, &u), "{normal}, {tangential}");
        }
    }

    #[test]
    fn coefficients_outside_their_range_are_refused() {
        assert!(matches!(Restitution::new(1.5, 0.0), Err(Error::RestitutionOutOfRange { which: "normal", .. })));
        assert!(matches!(Restitution::new(f64::NAN, 0.0), Err(Error::RestitutionOutOfRange { .. })));
        assert!(matches!(Restitution::new(1.0, -1.5), Err(Error::RestitutionOutOfRange { which: "tangential", .. })));
    }
}

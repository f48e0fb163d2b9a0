//! Different laws on different pieces of one table.

use crate::{CollisionLaw, Contact, Delassus, Roughness};
use nalgebra::SVector;

/// A law per surface label, itself a law.
///
/// `L` is one type: name it where the laws are alike, or use [`AnyLaw`](crate::AnyLaw) or `Box<dyn StrictLaw<N>>`.
///
/// ```
/// use collision_laws::{AnyLaw, laws::{NoSlip, PerSurface, Specular}};
///
/// let rough_cushion: PerSurface<AnyLaw<2>> = PerSurface::new(AnyLaw::new(Specular)).with(3, AnyLaw::new(NoSlip));
/// # let _ = rough_cushion;
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PerSurface<L> {
    elsewhere: L,
    own: Vec<Option<L>>,
}

impl<L> PerSurface<L> {
    /// The same law on every surface, until [`with`](Self::with) says otherwise.
    pub fn new(elsewhere: L) -> Self {
        Self { elsewhere, own: Vec::new() }
    }

    /// Gives the surface with this label a law of its own. Labels count from 0; space is used up to the largest.
    #[must_use]
    pub fn with(mut self, surface: usize, law: L) -> Self {
        if self.own.len() <= surface {
            self.own.resize_with(surface + 1, || None);
        }
        self.own[surface] = Some(law);
        self
    }

    /// The law on the surface with this label.
    #[inline]
    pub fn on(&self, surface: usize) -> &L {
        self.own.get(surface).and_then(Option::as_ref).unwrap_or(&self.elsewhere)
    }
}

impl<const N: usize, L: CollisionLaw<N>> CollisionLaw<N> for PerSurface<L> {
    #[inline]
    fn impulse(&self, contact: &Contact<N>, delassus: &Delassus<N>, u: &SVector<f64, N>) -> SVector<f64, N> {
        self.on(contact.surface).impulse(contact, delassus, u)
    }

    #[inline]
    fn missing_impulse(
        &self,
        contact: &Contact<N>,
        delassus: &Delassus<N>,
        u_minus: &SVector<f64, N>,
        u_plus: &SVector<f64, N>,
    ) -> SVector<f64, N> {
        self.on(contact.surface).missing_impulse(contact, delassus, u_minus, u_plus)
    }

    #[inline]
    fn pushes(&self, contact: &Contact<N>) -> Roughness<N> {
        self.on(contact.surface).pushes(contact)
    }
}

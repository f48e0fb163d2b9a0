//! Different laws on different pieces of one table.

use crate::{CollisionLaw, Contact, Delassus, Roughness};
use nalgebra::SVector;

/// A law per surface label, itself a law.
///
/// `L` is a single type: that of the laws if they are alike, else [`AnyLaw`](crate::AnyLaw) or `Box<dyn StrictLaw<N>>`.
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
    /// By their labels, in order.
    own: Vec<(usize, L)>,
}

impl<L> PerSurface<L> {
    /// The same law on every surface, until [`with`](Self::with) says otherwise.
    pub fn new(elsewhere: L) -> Self {
        Self { elsewhere, own: Vec::new() }
    }

    /// Gives the surface with this label a law of its own, in place of any before.
    #[must_use]
    pub fn with(mut self, surface: usize, law: L) -> Self {
        match self.place(surface) {
            Ok(known) => self.own[known].1 = law,
            Err(place) => self.own.insert(place, (surface, law)),
        }
        self
    }

    /// Where the law of a surface is in the list, or where it would be.
    #[inline]
    fn place(&self, surface: usize) -> Result<usize, usize> {
        self.own.binary_search_by_key(&surface, |(label, _)| *label)
    }

    /// The law on the surface with this label.
    #[inline]
    pub fn on(&self, surface: usize) -> &L {
        self.place(surface).map_or(&self.elsewhere, |place| &self.own[place].1)
    }
}

impl<const N: usize, L: CollisionLaw<N>> CollisionLaw<N> for PerSurface<L> {
    #[inline]
    fn impulse(&self, contact: &Contact<N>, delassus: &Delassus<N>, u: &SVector<f64, N>) -> SVector<f64, N> {
        self.on(contact.surface).impulse(contact, delassus, u)
    }

    #[inline]
    fn reflections(&self, contact: &Contact<N>) -> Vec<(f64, Roughness<N>)> {
        self.on(contact.surface).reflections(contact)
    }

    #[inline]
    fn pushes(&self, contact: &Contact<N>) -> Roughness<N> {
        self.on(contact.surface).pushes(contact)
    }

    fn is_strict(&self) -> bool {
        self.elsewhere.is_strict() && self.own.iter().all(|(_, law)| law.is_strict())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_label_may_be_any_number_and_the_last_law_counts() {
        let laws = PerSurface::new('-').with(usize::MAX, 'a').with(3, 'b').with(1 << 30, 'c').with(0, 'd').with(3, 'e');
        assert_eq!([usize::MAX, 3, 1 << 30, 0, 1, 4].map(|surface| *laws.on(surface)), ['a', 'e', 'c', 'd', '-', '-']);
        let again = PerSurface::new('-').with(0, 'd').with(3, 'e').with(1 << 30, 'c').with(usize::MAX, 'a');
        assert_eq!(laws, again);
    }
}

//! Any field of strict laws over the boundary.

use crate::{Contact, Roughness, StrictLaw};
use std::fmt;

/// The rough directions as a function of the contact: a section of the bundle of Grassmannians over the boundary.
///
/// Every such field preserves the canonical billiard measure, parallel or not, as long as it is measurable.
///
/// ```
/// use collision_laws::{Contact, Roughness, StrictLaw, laws::Field};
/// use nalgebra::Vector2;
///
/// // Rough on the right half of the boundary, smooth on the left.
/// let law = Field::new(|contact: &Contact<2>| {
///     if contact.point.x > 0.0 { Roughness::Rough } else { Roughness::Smooth }
/// });
/// let right = Contact::new(Vector2::new(1.0, 0.0), Vector2::new(-1.0, 0.0), 0)?;
/// assert_eq!(law.roughness(&right).rank(), 1);
/// # Ok::<(), collision_laws::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Field<F>(F);

impl<F> Field<F> {
    /// The law with the rough directions `roughness(contact)`.
    pub fn new<const N: usize>(roughness: F) -> Self
    where
        F: Fn(&Contact<N>) -> Roughness<N>,
    {
        Self(roughness)
    }
}

impl<const N: usize, F: Fn(&Contact<N>) -> Roughness<N>> StrictLaw<N> for Field<F> {
    #[inline]
    fn roughness(&self, contact: &Contact<N>) -> Roughness<N> {
        (self.0)(contact)
    }
}

impl<F> fmt::Debug for Field<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Field")
    }
}

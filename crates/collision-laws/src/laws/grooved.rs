//! A grooved wall: one rough direction that varies over the boundary.

use crate::{Contact, Roughness, StrictLaw};
use nalgebra::SVector;
use std::fmt;

/// One rough direction as a function of the contact, projected into the contact plane: k = 1.
///
/// The surface grips along the direction (across its grooves) and slides perpendicular to it. Where the direction is along the
/// normal the wall is smooth.
///
/// ```
/// use collision_laws::{Contact, laws::Grooved};
/// use nalgebra::Vector3;
///
/// // Concentric grooves on a plane about the origin: rough along the radius.
/// let record = Grooved::new(|contact: &Contact<3>| contact.point);
/// # let _ = record;
/// ```
#[derive(Clone, Copy)]
pub struct Grooved<F>(F);

impl<F> Grooved<F> {
    /// The law with the rough direction `direction(contact)`, of any length.
    pub fn new<const N: usize>(direction: F) -> Self
    where
        F: Fn(&Contact<N>) -> SVector<f64, N>,
    {
        Self(direction)
    }
}

impl<const N: usize, F: Fn(&Contact<N>) -> SVector<f64, N>> StrictLaw<N> for Grooved<F> {
    #[inline]
    fn roughness(&self, contact: &Contact<N>) -> Roughness<N> {
        Roughness::of_span(&contact.normal, &[(self.0)(contact)])
    }
}

impl<F> fmt::Debug for Grooved<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Grooved")
    }
}

//! Fixed rough directions, the same all over space.

use crate::{Contact, Error, Roughness, StrictLaw, roughness::can_be_rough};
use nalgebra::SVector;

/// k rough directions fixed in space, projected into the contact plane at each hit: the constant points of `Gr(k, N−1)`.
///
/// Where a combination of the directions is the normal, the rank falls by one. In 3D one direction makes a surface combed
/// that way: it grips along the direction and slides across it.
///
/// ```
/// use collision_laws::{Contact, StrictLaw, laws::RoughPlane};
/// use nalgebra::Vector3;
///
/// let combed = RoughPlane::new(&[Vector3::new(1.0, 0.0, 0.0)])?;
/// let rank_on = |normal| Contact::new(Vector3::zeros(), normal, 0).map(|contact| combed.roughness(&contact).rank());
/// assert_eq!(rank_on(Vector3::new(0.0, 0.0, 1.0))?, 1);
/// assert_eq!(rank_on(Vector3::new(1.0, 0.0, 0.0))?, 0); // smooth where the direction is the normal
/// # Ok::<(), collision_laws::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughPlane<const N: usize> {
    directions: [SVector<f64, N>; N],
    rank: usize,
}

impl<const N: usize> RoughPlane<N> {
    /// The law with the given rough directions, of any length.
    ///
    /// # Errors
    /// [`Error::TooManyRoughDirections`] if there are more than N−1, [`Error::NotFinite`]. [`at`](Self::at) tells whether they are
    /// independent in a contact plane.
    pub fn new(directions: &[SVector<f64, N>]) -> Result<Self, Error> {
        can_be_rough(directions)?;
        let mut kept = [SVector::zeros(); N];
        kept[..directions.len()].copy_from_slice(directions);
        Ok(Self { directions: kept, rank: directions.len() })
    }

    /// The directions, as they were given.
    pub fn directions(&self) -> &[SVector<f64, N>] {
        &self.directions[..self.rank]
    }

    /// The rough directions at one contact, all of them.
    ///
    /// # Errors
    /// [`Error::RoughDirectionAlongNormal`] or [`Error::DependentRoughDirections`] where the rank falls.
    pub fn at(&self, contact: &Contact<N>) -> Result<Roughness<N>, Error> {
        Roughness::spanned_by(&contact.normal, self.directions())
    }
}

impl<const N: usize> StrictLaw<N> for RoughPlane<N> {
    #[inline]
    fn roughness(&self, contact: &Contact<N>) -> Roughness<N> {
        Roughness::of_span(&contact.normal, self.directions())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn bad_directions_are_those_that_span_no_roughness_whatever_the_normal() {
        let x = Vector3::x();
        for (bad, error) in [
            (vec![x, x, x], Error::TooManyRoughDirections { given: 3, most: 2 }),
            (vec![x, x * f64::INFINITY], Error::NotFinite { quantity: "a rough direction" }),
        ] {
            assert_eq!(RoughPlane::new(&bad), Err(error.clone()));
            assert_eq!(Roughness::spanned_by(&Vector3::z_axis(), &bad), Err(error));
        }
    }
}

//! The contact: all that a law may know of where and how two bodies touch.

use crate::Error;
use nalgebra::{SVector, Unit};

/// A point where two bodies touch, with the normal of their common contact plane.
///
/// `ν` points from the second body (the wall) into the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact<const N: usize> {
    /// The contact point `Q` in space \[L\].
    pub point: SVector<f64, N>,
    /// The unit normal `ν` of the contact plane, from body 2 into body 1.
    pub normal: Unit<SVector<f64, N>>,
    /// A label for the piece of surface that was hit; laws may differ from label to label.
    pub surface: usize,
}

impl<const N: usize> Contact<N> {
    /// A contact at `point` whose normal has the direction of `normal`, of any length.
    ///
    /// # Errors
    /// [`Error::NoNormal`] if `normal` is zero, [`Error::NotFinite`] if an entry is not finite.
    ///
    /// ```
    /// use collision_laws::{Contact, Error};
    /// use nalgebra::Vector2;
    ///
    /// let contact = Contact::new(Vector2::zeros(), Vector2::new(0.0, -3e-200), 0)?;
    /// assert_eq!(contact.normal.y, -1.0);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn new(point: SVector<f64, N>, normal: SVector<f64, N>, surface: usize) -> Result<Self, Error> {
        if point.iter().any(|x| !x.is_finite()) {
            return Err(Error::NotFinite { quantity: "the contact point" });
        }
        if normal.iter().any(|x| !x.is_finite()) {
            return Err(Error::NotFinite { quantity: "the normal" });
        }
        let size = normal.amax(); // divided out first, so that no square over- or underflows
        if size == 0.0 {
            return Err(Error::NoNormal);
        }
        Ok(Self { point, normal: Unit::new_normalize(normal / size), surface })
    }

    /// The part of `x` in the contact plane, `x − ν(ν·x)`.
    #[inline]
    pub fn tangential(&self, x: &SVector<f64, N>) -> SVector<f64, N> {
        x - self.normal.as_ref() * self.normal.dot(x)
    }
}

//! Roughness: the directions of the contact plane in which a contact can push.

use crate::Error;
use nalgebra::{SMatrix, SVector, Unit};

/// A direction counts as lost when projecting leaves less than this share of its length.
///
/// Rounding leaves a few ε of a direction along an exact unit normal. But that of a thin wire is off by ε times length over radius, and
/// that of a wall far from the origin by ε times distance over size: up to a thousand of either, nothing is taken for a direction that is
/// made of rounding alone.
pub const LOST_DIRECTION: f64 = 2048.0 * f64::EPSILON;

/// A point of the Grassmannian `Gr(k, ν⊥)`: the choice a strict law makes at one contact.
///
/// The strict collision maps at a contact are exactly these, k = 0 … N−1, whatever the bodies' inertia: Cox, Feres and Ward
/// (arXiv:1501.06536), quoted as Theorem 1.1 by Cox and Feres, *No-slip billiards in dimension two*.
///
/// ```
/// use collision_laws::{Error, Roughness};
/// use nalgebra::{Unit, Vector3};
///
/// let normal = Unit::new_normalize(Vector3::new(0.0, 0.0, 3.0));
/// let along = Roughness::spanned_by(&normal, &[Vector3::new(2.0, 0.0, 5.0)])?; // only the part along the plane counts
/// assert_eq!((along.rank(), along.projector(&normal) * Vector3::new(1.0, 2.0, 3.0)), (1, Vector3::x()));
/// assert_eq!(Roughness::spanned_by(&normal, &[Vector3::x(), Vector3::y()])?, Roughness::Rough);
/// let none = Roughness::spanned_by(&normal, &[Vector3::z()]);
/// assert_eq!(none, Err(Error::RoughDirectionAlongNormal { index: 0 }));
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Roughness<const N: usize> {
    /// k = 0: only the normal pushes.
    Smooth,
    /// k = N−1: every direction pushes.
    Rough,
    /// 0 < k < N−1: the directions of a subspace of the contact plane push.
    Along(RoughSubspace<N>),
}

impl<const N: usize> Roughness<N> {
    /// The roughness in the given directions: what they span, projected into the contact plane of `normal`.
    ///
    /// The directions need be neither unit, nor orthogonal, nor tangent.
    ///
    /// # Errors
    /// [`Error::TooManyRoughDirections`], [`Error::RoughDirectionAlongNormal`], [`Error::DependentRoughDirections`], or
    /// [`Error::NotFinite`].
    pub fn spanned_by(normal: &Unit<SVector<f64, N>>, directions: &[SVector<f64, N>]) -> Result<Self, Error> {
        can_be_rough(directions)?;
        let mut basis = Basis::new(normal);
        let is_along_normal = |d| basis.rest(d).is_none_or(|rest| rest.norm() <= LOST_DIRECTION);
        if let Some(index) = directions.iter().position(is_along_normal) {
            return Err(Error::RoughDirectionAlongNormal { index });
        }
        let mut spans = [false; N];
        basis.extend(&directions.iter(), |index| spans[index] = true);
        match spans[..directions.len()].iter().rposition(|spans| !spans) {
            Some(index) => Err(Error::DependentRoughDirections { index }),
            None => Ok(basis.roughness()),
        }
    }

    /// Like [`spanned_by`](Self::spanned_by), but a direction that adds nothing lowers the rank instead of being an error.
    ///
    /// A law with fixed directions uses this, since one of them may happen to be the normal. At most N−1 of the directions count, and
    /// only finite ones: the direction away from a point, for example, is not finite at that point.
    pub fn of_span<'a, I>(normal: &Unit<SVector<f64, N>>, directions: I) -> Self
    where
        I: IntoIterator<Item = &'a SVector<f64, N>>,
        I::IntoIter: Clone,
    {
        let mut basis = Basis::new(normal);
        basis.extend(&directions.into_iter(), |_| ());
        basis.roughness()
    }

    /// The number k of rough directions.
    #[inline]
    pub fn rank(&self) -> usize {
        match self {
            Self::Smooth => 0,
            Self::Rough => N - 1,
            Self::Along(subspace) => subspace.rank,
        }
    }

    /// The orthogonal projector `P` of ℝᴺ onto the rough subspace.
    #[inline]
    pub fn projector(&self, normal: &Unit<SVector<f64, N>>) -> SMatrix<f64, N, N> {
        match self {
            Self::Smooth => SMatrix::zeros(),
            Self::Rough => SMatrix::identity() - normal.as_ref() * normal.transpose(),
            Self::Along(subspace) => subspace.projector,
        }
    }
}

/// Refuses more than N−1 directions, and one that is not finite.
pub(crate) fn can_be_rough<const N: usize>(directions: &[SVector<f64, N>]) -> Result<(), Error> {
    if directions.len() + 1 > N {
        return Err(Error::TooManyRoughDirections { given: directions.len(), most: N - 1 });
    }
    if directions.iter().flatten().any(|x| !x.is_finite()) {
        return Err(Error::NotFinite { quantity: "a rough direction" });
    }
    Ok(())
}

/// A proper subspace of the contact plane, stored as its orthogonal projector, so that equal subspaces are equal values up to
/// rounding. It belongs to the normal with which it was made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughSubspace<const N: usize> {
    projector: SMatrix<f64, N, N>,
    rank: usize,
}

impl<const N: usize> RoughSubspace<N> {
    /// The orthogonal projector `P` of ℝᴺ onto the subspace.
    #[inline]
    pub fn projector(&self) -> &SMatrix<f64, N, N> {
        &self.projector
    }

    /// The dimension k of the subspace.
    #[inline]
    pub fn rank(&self) -> usize {
        self.rank
    }
}

/// An orthonormal basis of rough directions under construction: columns 1 … rank, after the normal in column 0.
struct Basis<const N: usize> {
    columns: SMatrix<f64, N, N>,
    rank: usize,
}

impl<const N: usize> Basis<N> {
    fn new(normal: &Unit<SVector<f64, N>>) -> Self {
        let mut columns = SMatrix::<f64, N, N>::zeros();
        columns.set_column(0, normal);
        Self { columns, rank: 0 }
    }

    /// Adds directions, each time the one of which most is left beside those so far, and tells its index: so rounding of one that is
    /// almost along the normal, or along others, is never taken for a direction, whatever their order.
    fn extend<'a>(
        &mut self,
        directions: &(impl Iterator<Item = &'a SVector<f64, N>> + Clone),
        mut added: impl FnMut(usize),
    ) {
        while self.rank + 1 < N {
            let (mut found, mut most) = (None, LOST_DIRECTION);
            for (index, direction) in directions.clone().enumerate() {
                if let Some(rest) = self.rest(direction)
                    && rest.norm() > most
                {
                    (found, most) = (Some((index, rest)), rest.norm());
                }
            }
            let Some((index, rest)) = found else { return };
            // Gram–Schmidt once more, since one pass leaves an error of ε divided by the share of length that is left
            let rest = self.beside(rest / most);
            self.rank += 1;
            self.columns.set_column(self.rank, &(rest / rest.norm()));
            added(index);
        }
    }

    /// What is left of a direction, taken as a unit vector, beside the columns; `None` if it has no direction.
    fn rest(&self, direction: &SVector<f64, N>) -> Option<SVector<f64, N>> {
        let size = direction.amax();
        if size == 0.0 || !direction.iter().all(|x| x.is_finite()) {
            return None;
        }
        let x = direction / size;
        Some(self.beside(x / x.norm()))
    }

    /// A vector without its part along the columns.
    fn beside(&self, mut x: SVector<f64, N>) -> SVector<f64, N> {
        for column in 0..=self.rank {
            x -= self.columns.column(column) * self.columns.column(column).dot(&x);
        }
        x
    }

    fn roughness(&self) -> Roughness<N> {
        if self.rank == 0 {
            Roughness::Smooth
        } else if self.rank + 1 == N {
            Roughness::Rough
        } else {
            let t = self.columns.columns(1, self.rank);
            Roughness::Along(RoughSubspace { projector: t * t.transpose(), rank: self.rank })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Vector2, Vector3, Vector4};

    #[test]
    fn only_the_span_with_the_normal_matters() {
        let normal = Vector3::z_axis();
        let a = Roughness::spanned_by(&normal, &[Vector3::new(3.0, 0.0, 7.0)]).unwrap();
        let b = Roughness::spanned_by(&normal, &[Vector3::new(-1e-200, 0.0, 0.0)]).unwrap();
        assert_eq!((a, a.rank()), (b, 1));
    }

    #[test]
    fn a_power_of_two_in_the_length_of_a_direction_changes_no_bit() {
        let normal = Unit::new_normalize(Vector3::new(1.0, -2.0, 0.5));
        let directions = [Vector3::new(0.1, 0.7, -0.3)];
        let power = |exponent: i32| libm::ldexp(1.0, exponent);
        for scale in [-1000, -300, 300, 1000].map(power) {
            let scaled = directions.map(|d| d * scale);
            assert_eq!(Roughness::of_span(&normal, &scaled), Roughness::of_span(&normal, &directions), "{scale:e}");
        }
    }

    #[test]
    fn a_direction_that_is_none_adds_nothing() {
        let normal = Vector3::z_axis();
        for none in [Vector3::zeros(), Vector3::repeat(f64::NAN), Vector3::new(f64::INFINITY, 0.0, 0.0)] {
            assert_eq!(Roughness::of_span(&normal, &[none]), Roughness::Smooth);
            assert_eq!(Roughness::of_span(&normal, &[none, Vector3::x()]).rank(), 1);
        }
    }

    #[test]
    fn a_line_in_the_plane_is_all_of_the_contact_plane() {
        let roughness = Roughness::spanned_by(&Vector2::y_axis(), &[Vector2::new(1.0, 5.0)]);
        assert_eq!(roughness, Ok(Roughness::Rough));
    }

    #[test]
    fn a_direction_almost_along_others_leaves_the_projector_exact() {
        let normal = Unit::new_normalize(Vector4::new(1.0, -2.0, 0.5, 3.0));
        let (first, aside) = (Vector4::new(0.3, 0.7, -0.2, 0.1), Vector4::new(-0.4, 0.2, 0.9, 0.5));
        for share in [1.0, 1e-4, 1e-8, 1e-12] {
            let second = normal.into_inner() + first + aside * share;
            let projector = Roughness::spanned_by(&normal, &[first, second]).unwrap().projector(&normal);
            // some roundings of numbers up to 1
            assert!((projector * normal.as_ref()).norm() <= 4.0 * f64::EPSILON, "{share:e}");
            assert!((projector * projector - projector).norm() <= 8.0 * f64::EPSILON, "{share:e}");
        }
    }

    #[test]
    fn the_order_of_directions_does_not_matter() {
        let normal = Unit::new_normalize(Vector3::new(1.0, 2.0, 3.0));
        // both are in the plane of the normal and the second one
        let (askew, aside) = (Vector3::new(1.001, 2.0, 3.0), Vector3::x());
        for (directions, index) in [([askew, aside], 0), ([aside, askew], 1)] {
            assert_eq!(Roughness::of_span(&normal, &directions).rank(), 1);
            assert_eq!(
                Roughness::spanned_by(&normal, &directions),
                Err(Error::DependentRoughDirections { index }),
                "it is the one of which less is left"
            );
        }
        // along a wire they span one direction, whatever the normal
        let along = Vector3::new(1.0, 2.0, 2.0);
        let around = [Vector3::new(2.0, -1.0, 0.0), Vector3::new(2.0, 0.0, -1.0)];
        for k in 0..10_000 {
            let (sin, cos) = libm::sincos(f64::from(k));
            let normal = Unit::new_normalize(around[0] * cos + along.cross(&around[0]) / 3.0 * sin);
            for directions in [around, [around[1], around[0]]] {
                assert_eq!(Roughness::of_span(&normal, &directions).rank(), 1, "{k}");
            }
        }
    }

    #[test]
    fn bad_directions_say_which_and_why() {
        let normal = Vector3::z_axis();
        let (x, z) = (Vector3::x(), Vector3::z());
        let spanned = |d: &[Vector3<f64>]| Roughness::spanned_by(&normal, d).unwrap_err();
        assert_eq!(spanned(&[x, z]), Error::RoughDirectionAlongNormal { index: 1 });
        assert_eq!(spanned(&[Vector3::zeros()]), Error::RoughDirectionAlongNormal { index: 0 });
        assert_eq!(spanned(&[x, z - x * 2.0]), Error::DependentRoughDirections { index: 1 });
        assert_eq!(spanned(&[x, x, x]), Error::TooManyRoughDirections { given: 3, most: 2 });
        assert_eq!(spanned(&[x * f64::NAN]), Error::NotFinite { quantity: "a rough direction" });
    }

    #[test]
    fn a_direction_that_meets_the_normal_lowers_the_rank() {
        assert_eq!(Roughness::of_span(&Vector3::z_axis(), &[Vector3::z()]), Roughness::Smooth);
        assert_eq!(Roughness::of_span(&Vector3::z_axis(), &[Vector3::z(), Vector3::x()]).rank(), 1);
    }
}

//! The Delassus operator: all that a law needs to know of the two bodies.

use crate::{Roughness, symmetric::eigenframe};
use nalgebra::{SMatrix, SVector, Unit};

/// The inverse contact mass `K = J G⁻¹ Jᵀ` \[M⁻¹\]: an impulse `p` at the contact changes the contact velocity by `K p`.
///
/// `K` is symmetric and positive. That of a pair is the sum over the bodies that move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Delassus<const N: usize> {
    /// `K = normal·ν νᵀ + tangent·(1 − ν νᵀ)`, with the normal `ν` of the contact: points and balls.
    Isotropic {
        /// `ν·Kν`.
        normal: f64,
        /// The eigenvalue on the contact plane.
        tangent: f64,
    },
    /// Any symmetric positive matrix: other bodies.
    Dense(SMatrix<f64, N, N>),
}

impl<const N: usize> Delassus<N> {
    /// The operator of an immovable body.
    pub const ZERO: Self = Self::Isotropic { normal: 0.0, tangent: 0.0 };

    /// How much rounding may take from an operator, relative to its largest entry.
    const ROUNDING: f64 = 4.0 * N as f64 * f64::EPSILON;

    /// The operator of two bodies at one contact.
    #[inline]
    #[must_use]
    pub fn plus(&self, other: &Self, normal: &Unit<SVector<f64, N>>) -> Self {
        match (self, other) {
            (Self::Isotropic { normal: a, tangent: b }, Self::Isotropic { normal: c, tangent: d }) => {
                Self::Isotropic { normal: a + c, tangent: b + d }
            }
            _ => Self::Dense(self.to_matrix(normal) + other.to_matrix(normal)),
        }
    }

    /// The change `K p` of contact velocity that an impulse `p` makes.
    #[inline]
    pub fn apply(&self, normal: &Unit<SVector<f64, N>>, p: &SVector<f64, N>) -> SVector<f64, N> {
        match self {
            Self::Isotropic { normal: kn, tangent: kt } => {
                let along = normal.as_ref() * normal.dot(p);
                along * *kn + (p - along) * *kt
            }
            Self::Dense(k) => k * p,
        }
    }

    /// Whether the impulse and its effect on the bodies can be found by this operator, that of two bodies, with hardly any loss of digits.
    ///
    /// An isotropic operator takes two quotients. For any other, Gershgorin's discs must show that its eigenvalues are at most 16 times
    /// the sum of the least ones of the bodies. The least eigenvalue of the operator itself does not tell: two bodies with long arms in
    /// different directions may make it as large as the others, and yet the spin of each is determined better than by their sum.
    #[inline]
    pub(crate) fn is_well_conditioned(&self, bodies: &[Self; 2]) -> bool {
        let least = |body: &Self| body.range().0.max(0.0);
        matches!(self, Self::Isotropic { .. }) || self.range().1 <= 16.0 * (least(&bodies[0]) + least(&bodies[1]))
    }

    /// Bounds of the eigenvalues: for a matrix, by Gershgorin's discs.
    #[inline]
    fn range(&self) -> (f64, f64) {
        match self {
            Self::Isotropic { normal, tangent } => (normal.min(*tangent), normal.max(*tangent)),
            Self::Dense(k) => {
                let (mut least, mut largest) = (f64::INFINITY, 0.0_f64);
                for i in 0..N {
                    let radius = (0..N).map(|j| if j == i { 0.0 } else { k[(i, j)].abs() }).sum::<f64>();
                    least = least.min(k[(i, i)] - radius);
                    largest = largest.max(k[(i, i)] + radius);
                }
                (least, largest)
            }
        }
    }

    /// The largest eigenvalue over the smallest; infinite unless the smallest is positive, NaN if one of them is NaN.
    ///
    /// Where it is large, most ways to move the contact are ways to turn the body.
    pub fn condition_number(&self) -> f64 {
        let eigenvalues = match self {
            Self::Isotropic { normal, tangent } => SVector::from_fn(|i, _| if i == 0 { *normal } else { *tangent }),
            Self::Dense(k) => eigenframe(*k).0,
        };
        if eigenvalues.iter().any(|x| x.is_nan()) {
            return f64::NAN;
        }
        let (least, largest) = (eigenvalues.min(), eigenvalues.max());
        if least > 0.0 { largest / least } else { f64::INFINITY }
    }

    /// Whether `K p = u` has no meaningful solution `p`.
    ///
    /// An isotropic operator takes two quotients, and neither eigenvalue costs the other any digits, however different they are: it is
    /// singular unless both are positive and [normal](f64::is_normal) numbers. Any other is singular if its smallest eigenvalue is lost
    /// in the rounding of the largest.
    pub fn is_singular(&self) -> bool {
        match self {
            Self::Isotropic { normal, tangent } => !(divides(*normal) && divides(*tangent)),
            Self::Dense(_) => !(self.condition_number() < 1.0 / Self::ROUNDING),
        }
    }

    /// Whether `Q K Q` is [singular](Self::is_singular), the part of `K` on the normal and the given rough directions: all that is needed
    /// by a law that pushes in no other directions.
    ///
    /// Its entries are sums of products, with rounding errors relative to the sums of the absolute values.
    pub fn is_singular_on(&self, roughness: &Roughness<N>, normal: &Unit<SVector<f64, N>>) -> bool {
        let nu = normal.as_ref();
        match (self, roughness) {
            (Self::Isotropic { normal, .. }, Roughness::Smooth) => !divides(*normal),
            (Self::Isotropic { .. }, _) | (_, Roughness::Rough) => self.is_singular(),
            (Self::Dense(k), Roughness::Smooth) => {
                !(nu.dot(&(k * nu)) > Self::ROUNDING * nu.abs().dot(&(k.abs() * nu.abs())))
            }
            (Self::Dense(k), Roughness::Along(subspace)) => {
                let q = nu * nu.transpose() + subspace.projector();
                let elsewhere = (SMatrix::identity() - q) * nu.dot(&(k * nu));
                let lost = Self::ROUNDING * (q.abs() * k.abs() * q.abs()).amax();
                !eigenframe(q * k * q + elsewhere).0.iter().all(|x| *x > lost)
            }
        }
    }

    /// `K` as a matrix.
    #[inline]
    pub fn to_matrix(&self, normal: &Unit<SVector<f64, N>>) -> SMatrix<f64, N, N> {
        match self {
            Self::Isotropic { normal: kn, tangent: kt } => {
                let along = normal.as_ref() * normal.transpose();
                along * *kn + (SMatrix::identity() - along) * *kt
            }
            Self::Dense(k) => *k,
        }
    }
}

/// Whether division by this eigenvalue keeps all digits.
fn divides(eigenvalue: f64) -> bool {
    eigenvalue > 0.0 && eigenvalue.is_normal()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

    #[test]
    fn a_body_that_hardly_resists_turning_is_singular() {
        let k = |ratio: f64| Delassus::Dense(Matrix2::new(1.0 + ratio, ratio, ratio, 1.0 + ratio));
        assert!(!k(1e12).is_singular());
        assert!(k(1e17).is_singular());
        assert!(Delassus::<2>::ZERO.is_singular());
    }

    #[test]
    fn in_the_frame_of_the_normal_eigenvalues_are_quotients_of_their_own() {
        let singular = |normal, tangent| Delassus::<3>::Isotropic { normal, tangent }.is_singular();
        assert!(!singular(1.0, 1e17) && !singular(1e-300, 1e300));
        for wrong in [0.0, 1e-310, -1.0, f64::INFINITY, f64::NAN] {
            assert!(singular(wrong, 1.0) && singular(1.0, wrong), "{wrong}");
        }
    }

    #[test]
    fn discs_around_the_diagonal_show_which_operators_lose_no_digit() {
        let of = |a, b, c| Delassus::Dense(Matrix2::new(a, b, b, c));
        let k = |a, b, c| of(a, b, c).is_well_conditioned(&[of(a, b, c), Delassus::ZERO]);
        // eigenvalues 1 and 16; 1 and 17; 2 and 18; 1 and 19
        assert_eq!(
            [k(1.0, 0.0, 16.0), k(1.0, 0.0, 17.0), k(10.0, -8.0, 10.0), k(10.0, -9.0, 10.0)],
            [true, false, true, false]
        );
        assert!(Delassus::<2>::Isotropic { normal: 1.0, tangent: 1e9 }.is_well_conditioned(&[Delassus::ZERO; 2]));
        // two arms in different directions; a heavy body with a long arm hardly matters
        let normal = Vector2::x_axis();
        let together = |a: Delassus<2>, b: Delassus<2>| a.plus(&b, &normal).is_well_conditioned(&[a, b]);
        assert!(
            !together(of(1.0, 0.0, 50.0), of(50.0, 0.0, 1.0)) && !together(of(50.0, 49.0, 50.0), of(50.0, -49.0, 50.0))
        );
        assert!(together(of(1.0, 0.0, 10.0), of(10.0, 0.0, 1.0)) && together(of(1.0, 0.0, 2.0), of(1.0, 0.0, 0.01)));
        assert!(together(of(1.0, 0.0, 2.0), Delassus::Isotropic { normal: 0.01, tangent: 10.0 }));
    }

    #[test]
    fn the_condition_number_knows_what_is_no_number() {
        let of = |normal, tangent| Delassus::<3>::Isotropic { normal, tangent }.condition_number();
        assert_eq!([of(2.0, 8.0), of(8.0, 2.0), of(0.0, 1.0), of(-1.0, 1.0)], [4.0, 4.0, f64::INFINITY, f64::INFINITY]);
        let dense = Delassus::Dense(Matrix2::repeat(f64::NAN)).condition_number();
        assert!([of(f64::NAN, 1.0), of(1.0, f64::NAN), dense].iter().all(|x| x.is_nan()));
    }

    #[test]
    fn a_law_needs_the_inverse_only_where_it_pushes() {
        let (normal, x, y) = (Vector3::z_axis(), Vector3::x(), Vector3::y());
        let along = |d| Roughness::spanned_by(&normal, &[d]).unwrap();
        let k = |least| Delassus::Dense(Matrix3::from_diagonal(&Vector3::new(2.0, least, 1.0)));
        let singular = |k: &Delassus<3>| {
            [Roughness::Smooth, along(x), along(y), Roughness::Rough].map(|rough| k.is_singular_on(&rough, &normal))
        };
        assert_eq!(singular(&k(3.0)), [false, false, false, false]);
        assert_eq!(singular(&k(1e17)), [false, false, true, true]);
        assert_eq!(singular(&k(f64::NAN)), [true, true, true, true]);
        let ball = Delassus::Isotropic { normal: 1.0, tangent: f64::INFINITY };
        assert_eq!(singular(&ball), [false, true, true, true]);
        // a direction that does not yield at all makes K singular only where the law pushes along it, in any units
        for unit in [1.0, 1e-60, 1e60] {
            let still = Delassus::Dense(Matrix3::from_diagonal(&Vector3::new(0.0, 1.0, 1.0)) * unit);
            assert_eq!(singular(&still), [false, true, false, true], "{unit:e}");
            assert_eq!(
                singular(&Delassus::Dense(Matrix3::new(2.0, 0.3, 0.2, 0.3, 1.0, 0.1, 0.2, 0.1, 3.0) * unit)),
                [false; 4]
            );
        }
        // askew, what the product leaves of the small eigenvalue is noise
        let askew = Delassus::Dense(Matrix2::new(0.64, -0.48, -0.48, 0.36) * 1e17 + Matrix2::identity());
        assert!(askew.is_singular_on(&Roughness::Smooth, &Unit::new_normalize(Vector2::new(0.6, 0.8))));
    }
}

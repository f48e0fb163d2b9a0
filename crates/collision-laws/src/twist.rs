//! Velocities of one body: tangent vectors of its share of configuration space.

mod sums;

use crate::Error;
use nalgebra::{SMatrix, SVector, Vector3};
use std::fmt::Debug;

/// A velocity of one body, as a vector with coordinates.
///
/// The engine never asks for coordinates; the checks and the classification do. [`Body`](crate::Body) has an example of a velocity of your
/// own.
pub trait TangentVector<const N: usize>: Copy + Debug + PartialEq {
    /// How many coordinates there are.
    const DIMENSION: usize;

    /// The coordinates, [`DIMENSION`](Self::DIMENSION) of them.
    fn coordinates(&self) -> Vec<f64>;

    /// The velocity with these coordinates; missing ones are zero.
    fn from_coordinates(coordinates: &[f64]) -> Self;

    /// The velocity of the body in the rigid motion `x ↦ a + Ω (x − Q)` of all space, with `a` \[L T⁻¹\] and the spin `Ω` \[T⁻¹\], where
    /// `arm = Q − centre` \[L\]; called only for bodies that are [free](crate::Body::is_free).
    fn of_rigid_motion(arm: &SVector<f64, N>, a: &SVector<f64, N>, spin: &SMatrix<f64, N, N>) -> Self;

    /// The velocity \[L T⁻¹\] of the body's material point at `arm` \[L\], seen from the centre of mass: `v + Ω r` at `r` for a [`Twist`].
    fn at(&self, arm: &SVector<f64, N>) -> SVector<f64, N>;
}

/// Nothing moves.
impl<const N: usize> TangentVector<N> for () {
    const DIMENSION: usize = 0;

    fn coordinates(&self) -> Vec<f64> {
        Vec::new()
    }

    fn from_coordinates(_: &[f64]) -> Self {}

    fn of_rigid_motion(_: &SVector<f64, N>, _: &SVector<f64, N>, _: &SMatrix<f64, N, N>) -> Self {}

    #[inline]
    fn at(&self, _: &SVector<f64, N>) -> SVector<f64, N> {
        SVector::zeros()
    }
}

/// The velocity of a point.
impl<const N: usize> TangentVector<N> for SVector<f64, N> {
    const DIMENSION: usize = N;

    fn coordinates(&self) -> Vec<f64> {
        self.iter().copied().collect()
    }

    fn from_coordinates(coordinates: &[f64]) -> Self {
        Self::from_iterator(padded(coordinates))
    }

    fn of_rigid_motion(arm: &SVector<f64, N>, a: &SVector<f64, N>, spin: &SMatrix<f64, N, N>) -> Self {
        a - spin * arm
    }

    #[inline]
    fn at(&self, _: &SVector<f64, N>) -> SVector<f64, N> {
        *self
    }
}

/// The velocity of a rigid body: its material point at offset `r` from the centre of mass moves with `v + Ω r`.
///
/// `Ω ∈ so(N)` is the spin as a skew matrix in the space frame \[T⁻¹\]; in the plane it is one number, counter-clockwise
/// positive, in space an axial vector. Coordinates are those of `v`, then those of [`spin_coordinates`](Self::spin_coordinates).
///
/// The traits of [`approx`] compare velocities within rounding, each coordinate with its counterpart:
///
/// ```
/// use approx::{assert_relative_eq, assert_relative_ne};
/// use collision_laws::Twist;
/// use nalgebra::Vector2;
///
/// let (rolls, sum) = (Twist::planar(Vector2::new(0.3, 0.0), 3.0), Twist::planar(Vector2::new(0.1 + 0.2, 0.0), 3.0));
/// assert_ne!(rolls, sum);
/// assert_relative_eq!(rolls, sum, max_relative = 1e-15);
/// assert_relative_ne!(rolls, Twist::planar(rolls.linear, -3.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist<const N: usize> {
    /// The velocity `v` of the centre of mass \[L T⁻¹\].
    pub linear: SVector<f64, N>,
    spin: SMatrix<f64, N, N>,
}

impl<const N: usize> Twist<N> {
    /// The velocity `v + Ω r`.
    ///
    /// # Errors
    /// [`Error::SpinNotSkew`] if `spin` differs from minus its transpose by more than rounding, [`Error::NotFinite`].
    pub fn new(linear: SVector<f64, N>, spin: SMatrix<f64, N, N>) -> Result<Self, Error> {
        if linear.iter().chain(spin.iter()).any(|x| !x.is_finite()) {
            return Err(Error::NotFinite { quantity: "a velocity" });
        }
        let defect = (spin + spin.transpose()).amax();
        if defect > 4.0 * f64::EPSILON * spin.amax() {
            return Err(Error::SpinNotSkew { defect });
        }
        Ok(Self::from_skew(linear, &spin))
    }

    /// The velocity with the skew part `(A − Aᵀ)/2` of `spin`, exactly skew whatever the rounding.
    #[inline]
    pub fn from_skew(linear: SVector<f64, N>, spin: &SMatrix<f64, N, N>) -> Self {
        Self { linear, spin: spin * 0.5 - spin.transpose() * 0.5 } // halved first: the difference may overflow
    }

    /// The velocity of a body that does not spin.
    #[inline]
    pub fn translation(linear: SVector<f64, N>) -> Self {
        Self { linear, spin: SMatrix::zeros() }
    }

    /// The velocity with the given spin coordinates, whose form depends on the dimension: N = 2: `[ω]`; N = 3: the axial vector
    /// `[ω₁, ω₂, ω₃]`; else `Ω₂₁, Ω₃₁, Ω₃₂, Ω₄₁, …`, row by row below the diagonal.
    ///
    /// # Errors
    /// [`Error::WrongLength`] unless there are N(N−1)/2 of them, [`Error::NotFinite`].
    pub fn with_spin_coordinates(linear: SVector<f64, N>, spin: &[f64]) -> Result<Self, Error> {
        let expected = N * (N - 1) / 2;
        if spin.len() != expected {
            return Err(Error::WrongLength { quantity: "a spin", given: spin.len(), expected });
        }
        if linear.iter().chain(spin).any(|x| !x.is_finite()) {
            return Err(Error::NotFinite { quantity: "a velocity" });
        }
        Ok(Self { linear, spin: skew_from_coordinates(spin) })
    }

    /// The spin `Ω`, a skew matrix \[T⁻¹\].
    #[inline]
    pub fn spin(&self) -> &SMatrix<f64, N, N> {
        &self.spin
    }

    /// The coordinates of the spin, in the form of [`with_spin_coordinates`](Self::with_spin_coordinates).
    pub fn spin_coordinates(&self) -> Vec<f64> {
        if N == 3 {
            return vec![self.spin[(2, 1)], self.spin[(0, 2)], self.spin[(1, 0)]];
        }
        (0..N).flat_map(|i| (0..i).map(move |j| (i, j))).map(|ij| self.spin[ij]).collect()
    }

    /// The velocity changed by `linear`, and its spin by the plane rotation `q ∧ r = q rᵀ − r qᵀ`; exactly skew again.
    ///
    /// An impulse `p` at the arm `r` of a ball has `q = p / (m γ² R²)`.
    #[inline]
    #[must_use]
    pub fn kicked(&self, linear: SVector<f64, N>, q: &SVector<f64, N>, r: &SVector<f64, N>) -> Self {
        Self { linear: self.linear + linear, spin: self.spin + (q * r.transpose() - r * q.transpose()) }
    }
}

impl Twist<2> {
    /// A planar velocity with angular velocity `omega` \[T⁻¹\], counter-clockwise positive.
    #[inline]
    pub fn planar(linear: SVector<f64, 2>, omega: f64) -> Self {
        Self { linear, spin: SMatrix::<f64, 2, 2>::new(0.0, -omega, omega, 0.0) }
    }

    /// The angular velocity `ω` \[T⁻¹\], counter-clockwise positive.
    #[inline]
    pub fn angular_velocity(&self) -> f64 {
        self.spin[(1, 0)]
    }
}

impl Twist<3> {
    /// A spatial velocity with angular velocity `omega` \[T⁻¹\], an axial vector in the space frame: `Ω r = ω × r`.
    #[inline]
    pub fn spatial(linear: SVector<f64, 3>, omega: SVector<f64, 3>) -> Self {
        Self { linear, spin: omega.cross_matrix() }
    }

    /// The angular velocity `ω` \[T⁻¹\], an axial vector in the space frame.
    #[inline]
    pub fn angular_velocity(&self) -> SVector<f64, 3> {
        Vector3::new(self.spin[(2, 1)], self.spin[(0, 2)], self.spin[(1, 0)])
    }
}

impl<const N: usize> TangentVector<N> for Twist<N> {
    const DIMENSION: usize = N * (N + 1) / 2;

    fn coordinates(&self) -> Vec<f64> {
        let mut all = self.linear.coordinates();
        all.extend(self.spin_coordinates());
        all
    }

    fn from_coordinates(coordinates: &[f64]) -> Self {
        let (linear, spin) = coordinates.split_at(N.min(coordinates.len()));
        Self { linear: SVector::from_coordinates(linear), spin: skew_from_coordinates(spin) }
    }

    fn of_rigid_motion(arm: &SVector<f64, N>, a: &SVector<f64, N>, spin: &SMatrix<f64, N, N>) -> Self {
        Self::from_skew(a - spin * arm, spin)
    }

    #[inline]
    fn at(&self, arm: &SVector<f64, N>) -> SVector<f64, N> {
        self.linear + self.spin * arm
    }
}

fn padded(coordinates: &[f64]) -> impl Iterator<Item = f64> {
    coordinates.iter().copied().chain(std::iter::repeat(0.0))
}

fn skew_from_coordinates<const N: usize>(coordinates: &[f64]) -> SMatrix<f64, N, N> {
    let mut skew = SMatrix::zeros();
    let mut set = |i: usize, j: usize, x: f64| {
        skew[(i, j)] = x;
        skew[(j, i)] = -x;
    };
    let mut rest = padded(coordinates);
    if N == 3 {
        for (ij, x) in [(2, 1), (0, 2), (1, 0)].into_iter().zip(rest) {
            set(ij.0, ij.1, x);
        }
    } else {
        for i in 0..N {
            for j in 0..i {
                set(i, j, rest.next().unwrap_or(0.0));
            }
        }
    }
    skew
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Vector2, Vector4};

    #[test]
    fn spin_coordinates_come_back() {
        let plane = Twist::planar(Vector2::new(1.0, 2.0), 3.0);
        assert_eq!((plane.spin_coordinates(), plane.coordinates()), (vec![3.0], vec![1.0, 2.0, 3.0]));
        let space = Twist::spatial(Vector3::zeros(), Vector3::new(1.0, 2.0, 3.0));
        assert_eq!(space.spin_coordinates(), [1.0, 2.0, 3.0]);
        let c = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let four = Twist::<4>::with_spin_coordinates(Vector4::zeros(), &c).unwrap();
        assert_eq!(four.spin_coordinates(), c);
        assert_eq!(Twist::<4>::from_coordinates(&four.coordinates()), four);
        assert_eq!((four.spin()[(1, 0)], four.spin()[(2, 1)], four.spin()[(1, 2)]), (1.0, 3.0, -3.0));
    }

    #[test]
    fn counter_clockwise_spin_moves_the_right_of_the_body_up() {
        let at_right = Twist::planar(Vector2::zeros(), 2.0).at(&Vector2::x());
        assert_eq!(at_right, Vector2::new(0.0, 2.0));
        let axial = Twist::spatial(Vector3::zeros(), Vector3::z()).at(&Vector3::x());
        assert_eq!(axial, Vector3::y());
    }

    #[test]
    fn a_spin_near_the_end_of_the_range_of_numbers_comes_back() {
        let spin = SMatrix::<f64, 2, 2>::new(0.0, -1.2e308, 1.2e308, 0.0);
        assert_eq!(Twist::new(Vector2::zeros(), spin), Ok(Twist::planar(Vector2::zeros(), 1.2e308)));
    }

    #[test]
    fn a_spin_that_is_not_skew_is_refused() {
        let spin = SMatrix::<f64, 2, 2>::new(0.0, 1.0, 1.0, 0.0);
        assert_eq!(Twist::new(Vector2::zeros(), spin), Err(Error::SpinNotSkew { defect: 2.0 }));
        let wrong = Twist::<3>::with_spin_coordinates(Vector3::zeros(), &[1.0]);
        assert!(matches!(wrong, Err(Error::WrongLength { expected: 3, .. })));
    }
}

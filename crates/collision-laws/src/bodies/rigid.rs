//! A rigid body in any dimension.

use super::positive;
use crate::{
    Body, Delassus, Error, Twist,
    across::across,
    symmetric::{eigenframe, symmetric_part},
};
use nalgebra::{Matrix3, Rotation, SMatrix, SVector, Unit};

/// How a body resists turning, in one of the forms in use.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Inertia<const N: usize> {
    /// N = 2: the moment of inertia about the centre of mass \[M L²\].
    Moment(f64),
    /// N = 3: the inertia tensor about the centre of mass, in the space frame \[M L²\]. A collision is defined for every positive tensor,
    /// even for one that no rigid body has, in which a principal moment exceeds the sum of the other two.
    Tensor(SMatrix<f64, N, N>),
    /// Any N: the second moments per unit mass `S`, in the space frame \[L²\]: `mS = ∫ r rᵀ dm`. No eigenvalue is negative; a flat body
    /// has the eigenvalue zero perpendicular to itself.
    SecondMoments(SMatrix<f64, N, N>),
}

/// A rigid body in ℝᴺ, of any shape.
///
/// Its angular momentum is `Λ(Ω) = m (S Ω + Ω S)`, with `S` the second moments per unit mass. In an eigenframe of `S` this is
/// `Λᵢⱼ = μᵢⱼ Ωᵢⱼ`, with `μᵢⱼ = m (λᵢ + λⱼ)` the principal moment of inertia about the 2-plane `(i, j)`; the body stores the
/// frame and the `μᵢⱼ`, so that turning an impulse into a spin is N(N−1)/2 divisions. In the plane `μ₁₂` is the moment of
/// inertia, in space the `μᵢⱼ` are the eigenvalues of the inertia tensor.
///
/// ```
/// use collision_laws::{Body, Twist, bodies::{Inertia, RigidBody}};
/// use nalgebra::{Matrix2, Vector2};
///
/// let rod = RigidBody::<2>::new(3.0, Inertia::SecondMoments(Matrix2::new(4.0, 0.0, 0.0, 0.0)))?;
/// let same = RigidBody::<2>::new(3.0, Inertia::Moment(12.0))?; // I = m tr S
/// let v = Twist::planar(Vector2::zeros(), 1.0);
/// assert_eq!(rod.kinetic_energy(&v), same.kinetic_energy(&v));
/// # Ok::<(), collision_laws::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidBody<const N: usize> {
    mass: f64,
    /// Columns: an orthonormal eigenframe of the inertia, in the space frame.
    frame: SMatrix<f64, N, N>,
    /// Off the diagonal: the principal moment `μᵢⱼ` about the 2-plane of axes i and j.
    moments: SMatrix<f64, N, N>,
}

impl<const N: usize> RigidBody<N> {
    /// A body of the given mass \[M\] and inertia.
    ///
    /// # Errors
    /// [`Error::NotPositive`], [`Error::NotFinite`], [`Error::InertiaNotSymmetric`], [`Error::InertiaNotPositive`] or
    /// [`Error::SecondMomentsOfLowRank`] if the body spins for free in some plane (a rod in space), [`Error::InertiaLost`] if its
    /// moment there is at most ε = 2.2e-16 of the largest, [`Error::TooLarge`] if a moment is more than 1.8e308,
    /// [`Error::SecondMomentsNotPositive`] if one of them is negative beyond rounding, [`Error::InertiaForm`] for a form of another
    /// dimension.
    pub fn new(mass: f64, inertia: Inertia<N>) -> Result<Self, Error> {
        let mass = positive("the mass", mass)?;
        let form = |form, expected| Error::InertiaForm { form, expected, dimension: N };
        let (frame, moments) = match inertia {
            Inertia::Moment(_) if N != 2 => return Err(form("a moment of inertia", 2)),
            Inertia::Tensor(_) if N != 3 => return Err(form("an inertia tensor", 3)),
            Inertia::Moment(moment) => {
                let moment = positive("the moment of inertia", moment)?;
                (SMatrix::identity(), SMatrix::repeat(moment))
            }
            Inertia::Tensor(tensor) => {
                let (axes, frame) = eigenframe(symmetric("the inertia", &tensor)?);
                (frame, SMatrix::from_fn(|i, j| if i == j { 0.0 } else { axes[3 - i - j] }))
            }
            Inertia::SecondMoments(s) => {
                let (axes, frame) = eigenframe(symmetric("S, the second moments,", &s)?);
                let smallest = axes.min();
                // a flat body has a zero eigenvalue, which the rounding of S and of its eigenvalues may make negative
                if smallest < -4.0 * N as f64 * f64::EPSILON * axes.amax() {
                    return Err(Error::SecondMomentsNotPositive { smallest });
                }
                (frame, SMatrix::from_fn(|i, j| mass * (axes[i] + axes[j])))
            }
        };
        if planes::<N>().any(|ij| !moments[ij].is_finite()) {
            return Err(Error::TooLarge { quantity: "a principal moment of inertia" });
        }
        let all = || planes::<N>().map(|ij| moments[ij]);
        if let Some(value) = all().find(|moment| moment.is_subnormal()) {
            return Err(Error::TooSmall { quantity: "a principal moment of inertia", value });
        }
        let (smallest, largest) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
        if smallest <= 0.0 {
            if matches!(inertia, Inertia::SecondMoments(_)) {
                return Err(Error::SecondMomentsOfLowRank);
            }
            return Err(Error::InertiaNotPositive { smallest });
        }
        // a moment below the rounding of the eigenvalues counts as zero
        if smallest <= f64::EPSILON * largest {
            return Err(Error::InertiaLost { smallest, largest });
        }
        Ok(Self { mass, frame, moments })
    }

    /// The mass `m`.
    #[inline]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// The body after it has been turned by the rotation `R`: its inertia is `R I Rᵀ` in the space frame, with the same principal
    /// moments to the last bit.
    ///
    /// So make a body once, in a frame of its own, and turn it to any pose. Always turn that original body by the whole rotation: the
    /// rounding errors of successive turns accumulate.
    ///
    /// ```
    /// use collision_laws::{Body, Twist, bodies::{Inertia, RigidBody}};
    /// use nalgebra::{Matrix3, Rotation3, Vector3};
    ///
    /// let brick = RigidBody::<3>::new(1.0, Inertia::Tensor(Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 2.5))))?;
    /// let askew = brick.turned(&Rotation3::from_axis_angle(&Vector3::z_axis(), 0.6));
    /// let axis = Vector3::new(libm::cos(0.6), libm::sin(0.6), 0.0); // where its first axis is now
    /// let energy = askew.kinetic_energy(&Twist::spatial(Vector3::zeros(), axis));
    /// assert!((energy - 0.5).abs() < 1e-15);
    /// # Ok::<(), collision_laws::Error>(())
    /// ```
    #[must_use]
    pub fn turned(&self, by: &Rotation<f64, N>) -> Self {
        Self { frame: by.matrix() * self.frame, ..*self }
    }
}

impl RigidBody<3> {
    /// The inverse of the inertia tensor, in the space frame.
    pub(super) fn inverse_tensor(&self) -> Matrix3<f64> {
        let axis = |i: usize| 1.0 / self.moments[((i + 1) % 3, (i + 2) % 3)];
        let scaled = self.frame * Matrix3::from_diagonal(&SVector::from_fn(|i, _| axis(i)));
        scaled * self.frame.transpose()
    }
}

/// The pairs of axes i > j.
fn planes<const N: usize>() -> impl Iterator<Item = (usize, usize)> {
    (0..N).flat_map(|i| (0..i).map(move |j| (i, j)))
}

/// `a`, if it is finite and symmetric up to rounding; `quantity` is its name in messages.
pub(super) fn symmetric<const N: usize>(
    quantity: &'static str,
    a: &SMatrix<f64, N, N>,
) -> Result<SMatrix<f64, N, N>, Error> {
    if a.iter().any(|x| !x.is_finite()) {
        return Err(Error::NotFinite { quantity });
    }
    let defect = (a - a.transpose()).amax();
    if defect > 4.0 * f64::EPSILON * a.amax() {
        return Err(Error::InertiaNotSymmetric { quantity, defect });
    }
    Ok(symmetric_part(a))
}

impl<const N: usize> Body<N> for RigidBody<N> {
    type Velocity = Twist<N>;

    #[inline]
    fn inner_product(&self, v: &Twist<N>, w: &Twist<N>) -> f64 {
        let to_frame = self.frame.transpose();
        let (a, b) = (to_frame * v.spin() * self.frame, to_frame * w.spin() * self.frame);
        let spin: f64 = planes::<N>().map(|ij| self.moments[ij] * a[ij] * b[ij]).sum();
        self.mass * v.linear.dot(&w.linear) + spin
    }

    #[inline]
    fn apply_impulse(&self, arm: &SVector<f64, N>, p: &SVector<f64, N>, v: &Twist<N>) -> Twist<N> {
        let (r, q) = (self.frame.transpose() * arm, self.frame.transpose() * across(p, arm));
        let mut spin = SMatrix::<f64, N, N>::zeros();
        for (i, j) in planes::<N>() {
            spin[(i, j)] = (q[i] * r[j] - r[i] * q[j]) / self.moments[(i, j)];
            spin[(j, i)] = -spin[(i, j)];
        }
        Twist::from_skew(v.linear + p / self.mass, &(v.spin() + self.frame * spin * self.frame.transpose()))
    }

    #[inline]
    fn delassus(&self, arm: &SVector<f64, N>, _: &Unit<SVector<f64, N>>) -> Delassus<N> {
        let r = self.frame.transpose() * arm;
        let mut k = SMatrix::<f64, N, N>::identity() / self.mass;
        for (i, j) in planes::<N>() {
            let moment = self.moments[(i, j)];
            k[(i, i)] += r[j] * r[j] / moment;
            k[(j, j)] += r[i] * r[i] / moment;
            k[(i, j)] = -r[i] * r[j] / moment;
            k[(j, i)] = k[(i, j)];
        }
        let k = self.frame * k * self.frame.transpose();
        Delassus::Dense(symmetric_part(&k))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Contact, check};
    use nalgebra::{Matrix2, Matrix4, Vector4};

    #[test]
    fn an_inertia_says_what_is_wrong_with_it() {
        let built = |inertia| RigidBody::<3>::new(1.0, inertia).unwrap_err();
        let mut tensor = Matrix3::identity();
        assert_eq!(
            built(Inertia::Moment(1.0)),
            Error::InertiaForm { form: "a moment of inertia", expected: 2, dimension: 3 }
        );
        tensor[(0, 1)] = 0.5;
        assert_eq!(built(Inertia::Tensor(tensor)), Error::InertiaNotSymmetric { quantity: "the inertia", defect: 0.5 });
        for unit in [1e-20, 1e20] {
            let built = built(Inertia::Tensor(tensor * unit)); // in any units
            assert_eq!(built, Error::InertiaNotSymmetric { quantity: "the inertia", defect: 0.5 * unit });
        }
        let skew = RigidBody::<2>::new(1.0, Inertia::SecondMoments(Matrix2::new(1.0, 0.5, 0.0, 1.0))).unwrap_err();
        assert!(skew.to_string().starts_with("S, the second moments, is not symmetric"), "{skew}");
        tensor = Matrix3::from_diagonal(&[1.0, -2.0, 1.0].into());
        assert_eq!(built(Inertia::Tensor(tensor)), Error::InertiaNotPositive { smallest: -2.0 });
        let rod = Matrix3::from_diagonal(&[1.0, 0.0, 0.0].into());
        assert_eq!(built(Inertia::SecondMoments(rod)), Error::SecondMomentsOfLowRank);
        let negative = Matrix4::from_diagonal(&[2.0, 2.0, 2.0, -1.0].into());
        let refused = RigidBody::<4>::new(1.0, Inertia::SecondMoments(negative)).unwrap_err();
        assert_eq!(refused, Error::SecondMomentsNotPositive { smallest: -1.0 });
        let negative = Inertia::SecondMoments(Matrix2::new(2.0, 0.0, 0.0, -1.0));
        assert!(matches!(RigidBody::<2>::new(1.0, negative), Err(Error::SecondMomentsNotPositive { .. })));
        assert!(matches!(RigidBody::<2>::new(-1.0, Inertia::Moment(1.0)), Err(Error::NotPositive { .. })));
        let tensor = Inertia::Tensor(Matrix4::identity());
        assert!(matches!(RigidBody::<4>::new(1.0, tensor), Err(Error::InertiaForm { .. })));
        let nan = Inertia::SecondMoments(Matrix2::repeat(f64::NAN));
        assert!(matches!(RigidBody::<2>::new(1.0, nan), Err(Error::NotFinite { .. })));
    }

    #[test]
    fn a_moment_lost_in_the_rounding_of_another_and_one_out_of_range_are_told_as_such() {
        let of = |x, y, z| RigidBody::<3>::new(1.0, Inertia::Tensor(Matrix3::from_diagonal(&[x, y, z].into())));
        let slender = of(1.0, 2.0, 1e-17).unwrap_err();
        assert_eq!(slender, Error::InertiaLost { smallest: 1e-17, largest: 2.0 });
        assert!(slender.to_string().contains("lost in rounding"), "{slender}");
        assert!(of(1.0, 2.0, 1e-15).is_ok());
        assert_eq!(of(1.0, 0.0, 1.0).unwrap_err(), Error::InertiaNotPositive { smallest: 0.0 });
        // m(λ₁ + λ₂) overflows; for the second body in two of the three planes
        let out = Error::TooLarge { quantity: "a principal moment of inertia" };
        let disk = RigidBody::<2>::new(1.0, Inertia::SecondMoments(Matrix2::identity() * 1e308));
        assert_eq!(disk.unwrap_err(), out);
        let rod = Matrix3::from_diagonal(&[1e299, 1e285, 1e285].into());
        assert_eq!(RigidBody::<3>::new(1e10, Inertia::SecondMoments(rod)).unwrap_err(), out);
        // m(λ₁ + λ₂) has lost digits
        let lost = RigidBody::<2>::new(1e-160, Inertia::SecondMoments(Matrix2::identity() * 1e-155)).unwrap_err();
        assert!(matches!(lost, Error::TooSmall { quantity: "a principal moment of inertia", .. }), "{lost}");
        // no intermediate result overflows unless a moment itself does
        assert!(of(1.2e308, 1.2e308, 1.2e308).is_ok());
        assert!(RigidBody::<2>::new(1.0, Inertia::SecondMoments(Matrix2::new(1.2e308, 0.0, 0.0, 0.0))).is_ok());
    }

    #[test]
    fn a_flat_body_askew_is_a_body_whatever_rounding_makes_of_its_thickness() {
        for k in 0..100 {
            let (sin, cos) = libm::sincos(f64::from(k));
            let along = Matrix2::new(cos * cos, sin * cos, sin * cos, sin * sin) * 3.0;
            assert!(RigidBody::<2>::new(1.0, Inertia::SecondMoments(along)).is_ok(), "{k}");
        }
    }

    /// A rotation of ℝ⁴ in two planes; all its entries are rounded.
    fn askew() -> Rotation<f64, 4> {
        let in_plane = |i: usize, j: usize, angle: f64| {
            let (sin, cos) = libm::sincos(angle);
            let mut r = Matrix4::identity();
            (r[(i, i)], r[(i, j)], r[(j, i)], r[(j, j)]) = (cos, -sin, sin, cos);
            r
        };
        Rotation::from_matrix_unchecked(in_plane(0, 1, 0.7) * in_plane(1, 3, -0.4) * in_plane(2, 3, 1.9))
    }

    #[test]
    fn a_turned_body_is_the_one_whose_second_moments_are_turned() {
        let (s, r) = (Matrix4::from_diagonal(&Vector4::new(1.0, 2.0, 0.5, 0.25)), askew());
        let turned = RigidBody::<4>::new(3.0, Inertia::SecondMoments(s)).unwrap().turned(&r);
        let moments = r.matrix() * s * r.matrix().transpose();
        let made = RigidBody::<4>::new(3.0, Inertia::SecondMoments((moments + moments.transpose()) * 0.5)).unwrap();
        let (arm, normal) = (Vector4::new(0.3, -0.2, 0.9, 0.4), Unit::new_normalize(Vector4::new(1.0, 2.0, 3.0, 4.0)));
        let dense = |body: &RigidBody<4>| body.delassus(&arm, &normal).to_matrix(&normal);
        let (found, expected) = (dense(&turned), dense(&made));
        assert!((found - expected).amax() < 1e-14, "{found} for {expected}");
        let contact = Contact::new(Vector4::zeros(), normal.into_inner(), 0).unwrap();
        assert!(check::body(&turned, &contact, &arm, check::Samples::default()).worst() < 1e-14);
    }

    #[test]
    fn a_turned_body_spins_with_the_energy_that_it_had_before_it_was_turned_with_its_spin() {
        let second = Inertia::SecondMoments(Matrix4::from_diagonal(&Vector4::new(1.0, 2.0, 0.5, 0.25)));
        let (body, r) = (RigidBody::<4>::new(3.0, second).unwrap(), askew());
        let v = Twist::<4>::with_spin_coordinates(Vector4::zeros(), &[0.1, -0.4, 0.2, 0.9, 0.3, -0.7]).unwrap();
        let moved = Twist::from_skew(Vector4::zeros(), &(r.matrix() * v.spin() * r.matrix().transpose()));
        let (before, after) = (body.kinetic_energy(&v), body.turned(&r).kinetic_energy(&moved));
        assert!((after / before - 1.0).abs() < 1e-14, "{after} for {before}");
    }
}

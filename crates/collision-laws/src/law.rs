//! The law: from the contact velocity to the contact impulse, and the one formula behind every strict law.

use crate::{Contact, Delassus, Roughness};
use nalgebra::{SMatrix, SVector};
use std::sync::Arc;

/// From the contact velocity `u` to the impulse `p` on body 1. Object safe.
///
/// Each method is a pure function of its arguments: it may be called more than once in a collision, or for a collision that is discarded,
/// as when orbits run side by side and some lanes are idle. Randomness and memory are allowed only as functions of the contact, as in
/// [`RandomGrassmannian`](crate::laws::RandomGrassmannian).
///
/// Where a law is taken by value, [`Through`](crate::Through) passes a pointer to one, and [`AnyLaw`](crate::AnyLaw) one of several
/// types.
///
/// ```
/// use collision_laws::{CollisionLaw, Contact, Delassus, Fixed, Pair, bodies::Point};
/// use nalgebra::Vector2;
///
/// /// The faster a body hits, the more it loses: `ν·u⁺ = −ν·u/(1 + |ν·u|/c)`, and nothing along the wall.
/// struct Soft(f64);
/// impl CollisionLaw<2> for Soft {
///     fn impulse(&self, contact: &Contact<2>, delassus: &Delassus<2>, u: &Vector2<f64>) -> Vector2<f64> {
///         let normal = contact.normal.as_ref();
///         let yields = normal.dot(&delassus.apply(&contact.normal, normal)); // ν·Kν: the change of ν·u by p = ν
///         let speed = normal.dot(u);
///         normal * (-speed * (1.0 + 1.0 / (1.0 + speed.abs() / self.0)) / yields)
///     }
/// }
/// let contact = Contact::new(Vector2::zeros(), Vector2::new(0.0, 1.0), 0)?;
/// let pair = Pair::new(contact, (Point::new(2.0)?, Vector2::zeros()), (Fixed, Vector2::zeros()));
/// let after = pair.collide(&Soft(1.0), &(Vector2::new(1.0, -3.0), ())).velocities.0;
/// assert_eq!(after, Vector2::new(1.0, 0.75));
/// # Ok::<(), collision_laws::Error>(())
/// ```
pub trait CollisionLaw<const N: usize> {
    /// The impulse `p` \[M L T⁻¹\] on body 1 (body 2 receives `−p`) at contact velocity `u` \[L T⁻¹\].
    ///
    /// In a collision the bodies approach, `u·n < 0`. For a receding `u` the law must return an impulse too, and not NaN:
    /// [`check`](crate::check) applies the law to any velocity, including the results of the law.
    fn impulse(&self, contact: &Contact<N>, delassus: &Delassus<N>, u: &SVector<f64, N>) -> SVector<f64, N>;

    /// The law at `contact` as a sum of reflections, `p = Σ w reflect(R, u)`: the weight `w` and the rough directions `R` of each. Empty
    /// for a law that is no such sum, or does not say so.
    ///
    /// If `K` is ill-conditioned, as for a body that hardly resists turning, an [`impulse`](Self::impulse) that is found by `K` is off by
    /// the condition number times 10⁻¹⁶. What a reflection must do to the bodies' velocities is known without `K`, so
    /// [`Pair::collide`](crate::Pair::collide) finds it to all digits.
    #[inline]
    fn reflections(&self, _: &Contact<N>) -> Vec<(f64, Roughness<N>)> {
        Vec::new()
    }

    /// The directions, besides the normal, in which the law may push at `contact`: all of them unless it says otherwise.
    ///
    /// The impulse comes from the inverse of `K` on these and the normal, so `K` must be invertible only there
    /// ([`Pair::try_collide`](crate::Pair::try_collide)).
    #[inline]
    fn pushes(&self, _: &Contact<N>) -> Roughness<N> {
        Roughness::Rough
    }

    /// Whether the law is strict at every contact, as each [`StrictLaw`] is: then the normal component of the contact velocity always
    /// reverses and the energy is conserved, and the caller may correct rounding errors accordingly. `false` unless a law says otherwise.
    #[inline]
    fn is_strict(&self) -> bool {
        false
    }
}

/// A law that only chooses rough directions. Every strict law is a [`CollisionLaw`].
///
/// The choice may depend on the contact but not on the velocity, or the collision map would not be linear. It must be a function of the
/// contact, since a collision may ask for it more than once and the answers must agree: a law drawn from a stream of random numbers at
/// each call would not conserve energy. [`RandomGrassmannian`](crate::laws::RandomGrassmannian) draws by seed and place.
///
/// ```
/// use collision_laws::{Contact, Fixed, Pair, Roughness, StrictLaw, bodies::Ball, check::{self, Samples}};
/// use nalgebra::Vector3;
///
/// /// Rough along the lines of latitude about the third axis.
/// struct Latitude;
/// impl StrictLaw<3> for Latitude {
///     fn roughness(&self, contact: &Contact<3>) -> Roughness<3> {
///         let around = Vector3::new(-contact.point.y, contact.point.x, 0.0);
///         Roughness::of_span(&contact.normal, &[around]) // smooth on the axis
///     }
/// }
/// let point = Vector3::new(0.3, 0.4, 1.0);
/// let contact = Contact::new(point, -point, 0)?;
/// assert_eq!(Latitude.roughness(&contact).rank(), 1);
/// let arm = contact.normal.into_inner() * -0.5;
/// let pair = Pair::new(contact, (Ball::<3>::uniform(1.0, 0.5)?, arm), (Fixed, Vector3::zeros()));
/// assert!(check::law(&pair, &Latitude, Samples::default()).is_strict(check::TOLERANCE));
/// # Ok::<(), collision_laws::Error>(())
/// ```
pub trait StrictLaw<const N: usize> {
    /// The rough directions at `contact`, made with its normal: with that of another wall energy would not be conserved.
    fn roughness(&self, contact: &Contact<N>) -> Roughness<N>;
}

impl<const N: usize, L: StrictLaw<N> + ?Sized> CollisionLaw<N> for L {
    #[inline]
    fn impulse(&self, contact: &Contact<N>, delassus: &Delassus<N>, u: &SVector<f64, N>) -> SVector<f64, N> {
        reflect(&self.roughness(contact), contact, delassus, u)
    }

    #[inline]
    fn reflections(&self, contact: &Contact<N>) -> Vec<(f64, Roughness<N>)> {
        vec![(1.0, self.roughness(contact))]
    }

    #[inline]
    fn pushes(&self, contact: &Contact<N>) -> Roughness<N> {
        self.roughness(contact)
    }

    #[inline]
    fn is_strict(&self) -> bool {
        true
    }
}

impl<const N: usize, L: StrictLaw<N> + ?Sized> StrictLaw<N> for &L {
    #[inline]
    fn roughness(&self, contact: &Contact<N>) -> Roughness<N> {
        (**self).roughness(contact)
    }
}

impl<const N: usize, L: StrictLaw<N> + ?Sized> StrictLaw<N> for Box<L> {
    #[inline]
    fn roughness(&self, contact: &Contact<N>) -> Roughness<N> {
        (**self).roughness(contact)
    }
}

impl<const N: usize, L: StrictLaw<N> + ?Sized> StrictLaw<N> for Arc<L> {
    #[inline]
    fn roughness(&self, contact: &Contact<N>) -> Roughness<N> {
        (**self).roughness(contact)
    }
}

/// The impulse of the strict law with the given rough directions: the reflection `u⁺ = u + K p`.
///
/// With `P` the projector onto the rough directions and `Q = ν νᵀ + P`, it is the solution of `(Q K Q + 1 − Q) p = −2 Q u`;
/// in words, the components of `u` along the normal and the rough directions reverse, and the impulse lies in their span.
/// (The term `1 − Q` only makes the matrix invertible; it is scaled to the size of `Q K Q`. The part of `p` off the span, left by
/// rounding, is removed: for a body that hardly resists turning `K` is large there.)
///
/// The subspace of the roughness must lie in the contact plane, `P ν = 0`; one made for another normal gives an impulse that does not
/// conserve energy, which [`check::law`](crate::check::law) detects.
///
/// The result is NaN if `K` is singular to working precision; [`Pair::try_collide`](crate::Pair::try_collide) reports this.
#[inline]
pub fn reflect<const N: usize>(
    roughness: &Roughness<N>,
    contact: &Contact<N>,
    delassus: &Delassus<N>,
    u: &SVector<f64, N>,
) -> SVector<f64, N> {
    let nu = contact.normal.as_ref();
    match (delassus, roughness) {
        (Delassus::Isotropic { normal, .. }, Roughness::Smooth) => nu * (-2.0 * nu.dot(u) / normal),
        (Delassus::Isotropic { normal, tangent }, Roughness::Rough) => {
            let along = nu.dot(u);
            nu * (-2.0 * along / normal) + (u - nu * along) * (-2.0 / tangent)
        }
        (Delassus::Isotropic { normal, tangent }, Roughness::Along(subspace)) => {
            nu * (-2.0 * nu.dot(u) / normal) + subspace.projector() * u * (-2.0 / tangent)
        }
        (Delassus::Dense(k), Roughness::Smooth) => nu * (-2.0 * nu.dot(u) / nu.dot(&(k * nu))),
        (Delassus::Dense(k), Roughness::Rough) => solve(*k, u * -2.0),
        (Delassus::Dense(k), Roughness::Along(subspace)) => {
            let q = nu * nu.transpose() + subspace.projector();
            let on_span = q * k * q;
            let size = (on_span / (subspace.rank() + 1) as f64).trace(); // the mean eigenvalue of K on the span
            // the span mixes with its complement by the rounding of the largest eigenvalue, hence the last product
            q * solve(on_span + (SMatrix::identity() - q) * size, q * u * -2.0)
        }
    }
}

/// The solution of `a x = b` for a symmetric positive `a`; NaN if it is not positive.
fn solve<const N: usize>(a: SMatrix<f64, N, N>, b: SVector<f64, N>) -> SVector<f64, N> {
    match a.cholesky() {
        Some(factor) => factor.solve(&b),
        None => SVector::repeat(f64::NAN),
    }
}

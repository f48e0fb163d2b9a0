//! The body: four maps are all that a contact sees of it.

use crate::{Delassus, TangentVector};
use nalgebra::{SVector, Unit};

/// A rigid body, in its present pose, as one contact sees it.
///
/// `arm = Q − centre of mass`, the contact point seen from the body \[L\]. The four maps belong together:
/// `J(v + G⁻¹Jᵀp) = J v + K p` and `⟨G⁻¹Jᵀp, v⟩ = p·J v`; [`check::body`](crate::check::body) tests that.
///
/// ```
/// use collision_laws::{Body, Twist, bodies::Ball};
/// use nalgebra::Vector2;
///
/// let hoop = Ball::<2>::shell(3.0, 2.0)?; // mass 3, radius 2: moment of inertia m R² = 12
/// let spinning = Twist::planar(Vector2::zeros(), 1.0);
/// assert_eq!(hoop.kinetic_energy(&spinning), 6.0);
/// # Ok::<(), collision_laws::Error>(())
/// ```
///
/// A body of your own, with velocities of its own:
///
/// ```
/// use collision_laws::{Body, Contact, Delassus, Error, TangentVector, check::{self, Samples}};
/// use nalgebra::{SMatrix, Unit, Vector2};
///
/// /// The angular velocity of a door [T⁻¹], counter-clockwise.
/// #[derive(Clone, Copy, Debug, PartialEq)]
/// struct Turning(f64);
/// impl TangentVector<2> for Turning {
///     const DIMENSION: usize = 1;
///     fn coordinates(&self) -> Vec<f64> {
///         vec![self.0]
///     }
///     fn from_coordinates(coordinates: &[f64]) -> Self {
///         Turning(coordinates.first().copied().unwrap_or(0.0))
///     }
///     fn of_rigid_motion(_: &Vector2<f64>, _: &Vector2<f64>, _: &SMatrix<f64, 2, 2>) -> Self {
///         unreachable!("a door is not free")
///     }
///     fn at(&self, arm: &Vector2<f64>) -> Vector2<f64> {
///         Vector2::new(-arm.y, arm.x) * self.0
///     }
/// }
/// /// A door with this moment of inertia about its hinge [M L²], from which arms are measured.
/// struct Door(f64);
/// impl Body<2> for Door {
///     type Velocity = Turning;
///     fn inner_product(&self, v: &Turning, w: &Turning) -> f64 {
///         self.0 * v.0 * w.0
///     }
///     fn apply_impulse(&self, arm: &Vector2<f64>, p: &Vector2<f64>, v: &Turning) -> Turning {
///         Turning(v.0 + arm.perp(p) / self.0)
///     }
///     fn delassus(&self, arm: &Vector2<f64>, _: &Unit<Vector2<f64>>) -> Delassus<2> {
///         let along = Vector2::new(-arm.y, arm.x);
///         Delassus::Dense(along * along.transpose() / self.0)
///     }
///     fn is_free(&self) -> bool {
///         false
///     }
/// }
/// let contact = Contact::new(Vector2::zeros(), Vector2::y(), 0)?;
/// assert!(check::body(&Door(2.0), &contact, &Vector2::new(1.0, -0.3), Samples::default()).worst() < 1e-14);
/// # Ok::<(), Error>(())
/// ```
pub trait Body<const N: usize> {
    /// The body's velocities: `Twist<N>` for a ball, `()` for [`Fixed`].
    type Velocity: TangentVector<N>;

    /// The kinetic-energy metric `⟨v, w⟩ = m v·w + ½ tr(Λ(Ω) Ω'ᵀ)` \[M L² T⁻²\], `Λ(Ω)` the angular momentum.
    fn inner_product(&self, v: &Self::Velocity, w: &Self::Velocity) -> f64;

    /// The velocity `J v` \[L T⁻¹\] of the material point at `arm` \[L\].
    #[inline]
    fn contact_velocity(&self, arm: &SVector<f64, N>, v: &Self::Velocity) -> SVector<f64, N> {
        v.at(arm)
    }

    /// The velocity `v + G⁻¹Jᵀ p` after an impulse `p` \[M L T⁻¹\] at `arm` \[L\].
    fn apply_impulse(&self, arm: &SVector<f64, N>, p: &SVector<f64, N>, v: &Self::Velocity) -> Self::Velocity;

    /// The Delassus operator `J G⁻¹ Jᵀ` \[M⁻¹\] of this body alone, at `arm` \[L\]; [`Delassus::ZERO`] for one that cannot move.
    fn delassus(&self, arm: &SVector<f64, N>, normal: &Unit<SVector<f64, N>>) -> Delassus<N>;

    /// The kinetic energy `½⟨v, v⟩` \[M L² T⁻²\].
    #[inline]
    fn kinetic_energy(&self, v: &Self::Velocity) -> f64 {
        0.5 * self.inner_product(v, v)
    }

    /// The number of degrees of freedom: the dimension of the space of velocities, or 0 for a body that is held fixed.
    fn degrees_of_freedom(&self) -> usize {
        Self::Velocity::DIMENSION
    }

    /// Whether the body takes part in the rigid motions of all space, as any unconstrained body does. The support of a hinged or fixed
    /// body takes up momentum, so the pair conserves none; a hinged body answers `false` here.
    fn is_free(&self) -> bool {
        self.degrees_of_freedom() > 0
    }
}

/// The wall: an immovable body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Fixed;

impl<const N: usize> Body<N> for Fixed {
    type Velocity = ();

    #[inline]
    fn inner_product(&self, (): &(), (): &()) -> f64 {
        0.0
    }

    #[inline]
    fn apply_impulse(&self, _: &SVector<f64, N>, _: &SVector<f64, N>, (): &()) {}

    #[inline]
    fn delassus(&self, _: &SVector<f64, N>, _: &Unit<SVector<f64, N>>) -> Delassus<N> {
        Delassus::ZERO
    }
}

/// A body that may be held fixed: `None` stays at rest, whatever velocity it is given.
///
/// For choices made at run time; [`Fixed`] is the same wall known at compile time.
impl<const N: usize, B: Body<N>> Body<N> for Option<B> {
    type Velocity = B::Velocity;

    #[inline]
    fn inner_product(&self, v: &B::Velocity, w: &B::Velocity) -> f64 {
        self.as_ref().map_or(0.0, |body| body.inner_product(v, w))
    }

    #[inline]
    fn contact_velocity(&self, arm: &SVector<f64, N>, v: &B::Velocity) -> SVector<f64, N> {
        self.as_ref().map_or_else(SVector::zeros, |body| body.contact_velocity(arm, v))
    }

    #[inline]
    fn apply_impulse(&self, arm: &SVector<f64, N>, p: &SVector<f64, N>, v: &B::Velocity) -> B::Velocity {
        self.as_ref().map_or(*v, |body| body.apply_impulse(arm, p, v))
    }

    #[inline]
    fn delassus(&self, arm: &SVector<f64, N>, normal: &Unit<SVector<f64, N>>) -> Delassus<N> {
        self.as_ref().map_or(Delassus::ZERO, |body| body.delassus(arm, normal))
    }

    fn degrees_of_freedom(&self) -> usize {
        self.as_ref().map_or(0, Body::degrees_of_freedom)
    }

    fn is_free(&self) -> bool {
        self.as_ref().is_some_and(Body::is_free)
    }
}

impl<const N: usize, B: Body<N> + ?Sized> Body<N> for &B {
    type Velocity = B::Velocity;

    #[inline]
    fn inner_product(&self, v: &B::Velocity, w: &B::Velocity) -> f64 {
        (**self).inner_product(v, w)
    }

    #[inline]
    fn contact_velocity(&self, arm: &SVector<f64, N>, v: &B::Velocity) -> SVector<f64, N> {
        (**self).contact_velocity(arm, v)
    }

    #[inline]
    fn apply_impulse(&self, arm: &SVector<f64, N>, p: &SVector<f64, N>, v: &B::Velocity) -> B::Velocity {
        (**self).apply_impulse(arm, p, v)
    }

    #[inline]
    fn delassus(&self, arm: &SVector<f64, N>, normal: &Unit<SVector<f64, N>>) -> Delassus<N> {
        (**self).delassus(arm, normal)
    }

    fn degrees_of_freedom(&self) -> usize {
        (**self).degrees_of_freedom()
    }

    fn is_free(&self) -> bool {
        (**self).is_free()
    }
}

//! Laws behind pointers: a borrowed law, or one of several types.

use crate::{CollisionLaw, Contact, Delassus, Roughness};
use nalgebra::SVector;
use std::{fmt, ops::Deref, sync::Arc};

/// A law, strict or not, behind a pointer `P` to it: `&L`, `Box<L>`, `Arc<L>`, where `L` may borrow data, or be `dyn CollisionLaw<N>`.
///
/// A pointer to a strict law is a law already.
///
/// ```
/// use collision_laws::{CollisionLaw, Contact, Delassus, Roughness, Through, laws::PerSurface, reflect};
/// use nalgebra::Vector2;
///
/// /// Each surface gives back its own part of the normal velocity.
/// struct Bouncing<'a>(&'a [f64]);
///
/// impl CollisionLaw<2> for Bouncing<'_> {
///     fn impulse(&self, contact: &Contact<2>, delassus: &Delassus<2>, u: &Vector2<f64>) -> Vector2<f64> {
///         reflect(&Roughness::Smooth, contact, delassus, u) * (0.5 + 0.5 * self.0[contact.surface])
///     }
/// }
///
/// let measured = [1.0, 0.5];
/// let law = Bouncing(&measured);
/// let elsewhere = PerSurface::new(Through(&law)).with(7, Through(&law));
/// # let _ = elsewhere;
/// ```
#[derive(Clone, Copy)]
pub struct Through<P>(pub P);

/// Any collision law, chosen at run time.
///
/// `Box<dyn StrictLaw<N>>` is a law already; this holds the others too.
///
/// ```
/// use collision_laws::{AnyLaw, laws::{NoSlip, Restitution}};
///
/// let laws: [AnyLaw<3>; 2] = [AnyLaw::new(NoSlip), AnyLaw::new(Restitution::new(0.9, 0.4)?)];
/// # Ok::<(), collision_laws::Error>(())
/// ```
pub type AnyLaw<const N: usize> = Through<Arc<dyn CollisionLaw<N> + Send + Sync>>;

impl<const N: usize> AnyLaw<N> {
    /// Wraps `law`.
    pub fn new(law: impl CollisionLaw<N> + Send + Sync + 'static) -> Self {
        Through(Arc::new(law))
    }
}

impl<const N: usize, P: Deref<Target: CollisionLaw<N>>> CollisionLaw<N> for Through<P> {
    #[inline]
    fn impulse(&self, contact: &Contact<N>, delassus: &Delassus<N>, u: &SVector<f64, N>) -> SVector<f64, N> {
        self.0.impulse(contact, delassus, u)
    }

    #[inline]
    fn reflections(&self, contact: &Contact<N>) -> Vec<(f64, Roughness<N>)> {
        self.0.reflections(contact)
    }

    #[inline]
    fn pushes(&self, contact: &Contact<N>) -> Roughness<N> {
        self.0.pushes(contact)
    }

    #[inline]
    fn is_strict(&self) -> bool {
        self.0.is_strict()
    }
}

impl<P> fmt::Debug for Through<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Through(a law)")
    }
}

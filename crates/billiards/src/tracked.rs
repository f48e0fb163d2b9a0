//! What can be read off a track besides the time.
use crate::track::{Angle, Cell, Clock};
use lanes::Lane;

/// A track that knows the scaled spin position.
pub trait Turned<F: Lane> {
    /// The scaled spin position `x₀ = γ R θ` \[L\], not reduced modulo a turn.
    fn angle(&self) -> F;
}

impl<F: Lane> Turned<F> for Angle<F> {
    #[inline(always)]
    fn angle(&self) -> F {
        self.0.value()
    }
}

impl<F: Lane, B> Turned<F> for (Angle<F>, B) {
    #[inline(always)]
    fn angle(&self) -> F {
        self.0.angle()
    }
}

impl<F: Lane, B: Turned<F>> Turned<F> for (Clock<F>, B) {
    #[inline(always)]
    fn angle(&self) -> F {
        self.1.angle()
    }
}

/// A track that may know the cell of the lattice.
pub trait InCell<F: Lane> {
    /// The accumulated translation in multiples of the lattice vectors; `None` where nobody counts it, as in most tracks.
    #[inline(always)]
    fn cell(&self) -> Option<[F; 2]> {
        None
    }
}

impl<F: Lane> InCell<F> for () {}
impl<F: Lane> InCell<F> for Clock<F> {}
impl<F: Lane> InCell<F> for Angle<F> {}

impl<F: Lane> InCell<F> for Cell<F> {
    #[inline(always)]
    fn cell(&self) -> Option<[F; 2]> {
        Some(self.cell)
    }
}

impl<F: Lane, A: InCell<F>, B: InCell<F>> InCell<F> for (A, B) {
    #[inline(always)]
    fn cell(&self) -> Option<[F; 2]> {
        self.0.cell().or_else(|| self.1.cell())
    }
}

//! Where a particle is and how it moves.
use crate::{energy::EnergyKeeper, track::Track};
use lanes::Lane;

/// The state of a ball between two collisions, or of as many as there are lanes.
///
/// `S` is the number of spin components that the scene needs: 0 for a point, 1 for a disk, 3 for a ball in space.
/// `K` keeps the energy, `T` tracks what grows along the path; both are `()` where nobody asks.
#[derive(Clone, Copy, Debug)]
pub struct Orbit<F, const N: usize, const S: usize, K = (), T = ()> {
    /// Position of the centre \[L\].
    pub position: [F; N],
    /// Velocity of the centre [L T⁻¹].
    pub velocity: [F; N],
    /// Scaled spin `γ R ω` [L T⁻¹]: kinetic energy is `(m/2)(|velocity|² + |spin|²)`.
    pub spin: [F; S],
    /// Keeps the energy where the law conserves it, and between round walls the [digits](crate::Recurring) of the velocity that
    /// are rounded off here. It belongs to this motion: whoever changes position, velocity or spin makes a new orbit.
    pub keeper: K,
    /// What is tracked along the path.
    pub track: T,
}

impl<F: Lane, const N: usize, const S: usize, K: EnergyKeeper<F, N, S>, T: Track<F, N, S>> Orbit<F, N, S, K, T> {
    /// The orbit that starts at `position` with `velocity` and scaled `spin`.
    #[inline]
    pub fn new(position: [F; N], velocity: [F; N], spin: [F; S], track: T) -> Self {
        Orbit { position, velocity, spin, keeper: K::new(&velocity, &spin), track }
    }
}

//! A billiard: a table's walls and a ball's law.
use crate::{energy::EnergyKeeper, orbit::Orbit, track::Track};
use geometry::{WallHit, Walls};
use lanes::Lane;

/// What a collision with the wall does to a ball, in lanes: the law as the engine's loop applies it.
///
/// `S` is the number of components of the scaled spin `γ R ω` that the law needs (see [`Orbit`]). Laws of
/// [`collision_laws`] become ball laws by [`laws`](crate::laws).
pub trait BallLaw<const N: usize, const S: usize>: Sync {
    /// Turns the velocity and the spin before a collision into those after it.
    fn collide<F: Lane>(&self, hit: &WallHit<F, N>, velocity: &mut [F; N], spin: &mut [F; S]);
}

/// Walls and a law: the billiard map.
#[derive(Clone, Copy, Debug)]
pub struct Billiard<'a, W, L> {
    /// What can be hit.
    pub walls: &'a W,
    /// What a hit does.
    pub law: &'a L,
}

impl<W, L> Billiard<'_, W, L> {
    /// The flight from where the orbit is to its next hit.
    #[inline(always)]
    pub fn flight<F: Lane, const N: usize, const S: usize, K, T>(&self, orbit: &Orbit<F, N, S, K, T>) -> WallHit<F, N>
    where
        W: Walls<N>,
    {
        self.walls.first_hit(&orbit.position, &orbit.velocity)
    }

    /// Moves the orbit to the hit and through the collision there.
    #[inline(always)]
    pub fn collide<F: Lane, const N: usize, const S: usize, K, T>(
        &self,
        orbit: &mut Orbit<F, N, S, K, T>,
        hit: &WallHit<F, N>,
    ) where
        L: BallLaw<N, S>,
        K: EnergyKeeper<F, N, S>,
        T: Track<F, N, S>,
    {
        orbit.track.fly(&orbit.position, &orbit.velocity, &orbit.spin, hit);
        orbit.position = hit.point;
        orbit.keeper.arrive(&mut orbit.velocity);
        self.law.collide(hit, &mut orbit.velocity, &mut orbit.spin);
        orbit.keeper.leave(&orbit.velocity, &orbit.spin, hit);
    }
}

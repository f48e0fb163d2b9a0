//! A motion for one orbit, behind a pointer.
use crate::{
    billiard::{BallLaw, Billiard},
    rolling::Rolling,
};
use geometry::{Homogeneous, WallHit, Walls};

/// Walls and a law for one orbit, behind a pointer.
pub trait Bounce<const N: usize, const S: usize>: Sync {
    /// The first hit of the path from `position` with `velocity`.
    fn first_hit(&self, position: &[f64; N], velocity: &[f64; N]) -> WallHit<f64, N>;
    /// What the hit does to velocity and spin.
    fn collide(&self, hit: &WallHit<f64, N>, velocity: &mut [f64; N], spin: &mut [f64; S]);
}

impl<W: Walls<N>, L: BallLaw<N, S>, const N: usize, const S: usize> Bounce<N, S> for Billiard<'_, W, L> {
    fn first_hit(&self, position: &[f64; N], velocity: &[f64; N]) -> WallHit<f64, N> {
        self.walls.first_hit(position, velocity)
    }
    fn collide(&self, hit: &WallHit<f64, N>, velocity: &mut [f64; N], spin: &mut [f64; S]) {
        self.law.collide(hit, velocity, spin);
    }
}

impl<W: Homogeneous, L: BallLaw<2, 1>> Bounce<2, 1> for Rolling<'_, W, L> {
    fn first_hit(&self, position: &[f64; 2], velocity: &[f64; 2]) -> WallHit<f64, 2> {
        self.walls.first_hit(position, velocity)
    }
    fn collide(&self, hit: &WallHit<f64, 2>, velocity: &mut [f64; 2], spin: &mut [f64; 1]) {
        self.law.collide(hit, velocity, spin);
    }
}

//! The specular law: frictionless contact. Spin is neither read nor written.
use super::Mirror;
use crate::billiard::BallLaw;
use collision_laws::laws::Specular;
use geometry::WallHit;
use lanes::{Lane, dot};

/// `v⁺ = v − 2 (v·ν) ν`, in any dimension, whatever the spin.
impl<const N: usize, const S: usize> BallLaw<N, S> for Specular {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, N>, velocity: &mut [F; N], _: &mut [F; S]) {
        let n = &hit.normal;
        let vn = dot(velocity, n) * hit.inverse;
        let twice = (hit.inverse + hit.inverse) * vn;
        for i in 0..N {
            velocity[i] = velocity[i] - twice * n[i];
        }
    }

    #[inline(always)]
    fn collide_in_frame<F: Lane>(&self, _: &WallHit<F, 2>, velocity: &mut [F; 2], _: &mut [F; S]) {
        velocity[0] = -velocity[0];
    }

    #[inline(always)]
    fn is_strict(&self) -> bool {
        true
    }

    fn mirror(&self) -> Option<Mirror> {
        Some(Mirror::specular())
    }
}

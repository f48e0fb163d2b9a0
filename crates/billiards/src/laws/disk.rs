//! Laws that are one constant matrix for a disk: no-slip, specular, restitution.
use crate::billiard::BallLaw;
use collision_laws::{DiskLaw, DiskMap};
use geometry::WallHit;
use lanes::Lane;

/// A disk whose law is the same linear map at every contact.
#[derive(Clone, Copy, Debug)]
pub struct Disk(pub(crate) DiskMap);

impl Disk {
    /// `law` for a disk with mass distribution parameter γ.
    pub fn new(law: &impl DiskLaw, gamma: f64) -> Disk {
        Disk(law.disk_map(gamma))
    }
}

/// Applies a map to what happens at a hit.
///
/// With a normal `n` of any length, `t = J n` and the inverses `ι = 1/|n|`, `ι²`, the velocity changes by
/// `ι² (e−1) (v·n) n + (ι² (c−1) (v·t) + ι s v₀) t`: exact whatever the rounding of `|n|`.
#[inline(always)]
pub(super) fn apply<F: Lane>(map: &LaneMap<F>, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
    let [n1, n2] = hit.normal;
    let [v1, v2] = *velocity;
    // t = J n = (−n₂, n₁)
    let vn = v1 * n1 + v2 * n2;
    let vt = v2 * n1 - v1 * n2;
    let v0 = spin[0];
    spin[0] = map.spin_spin * v0 + map.spin_tangent * (vt * hit.inverse);
    let along_n = map.normal_less_1 * (vn * hit.inverse_square);
    let along_t = map.tangent_spin * (v0 * hit.inverse) + map.tangent_tangent_less_1 * (vt * hit.inverse_square);
    *velocity = [v1 + (along_n * n1 - along_t * n2), v2 + (along_n * n2 + along_t * n1)];
}

/// The coefficients of a [`DiskMap`], with the identity taken off velocity, in lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct LaneMap<F> {
    spin_spin: F,
    spin_tangent: F,
    tangent_spin: F,
    tangent_tangent_less_1: F,
    normal_less_1: F,
}

impl<F: Lane> LaneMap<F> {
    /// The coefficients that `map` has for each lane; `like` says how many lanes.
    #[inline(always)]
    pub(super) fn new<'a>(like: F, map: impl Fn(usize) -> &'a DiskMap) -> Self {
        LaneMap {
            spin_spin: like.each(|k| map(k).spin_spin),
            spin_tangent: like.each(|k| map(k).spin_tangent),
            tangent_spin: like.each(|k| map(k).tangent_spin),
            tangent_tangent_less_1: like.each(|k| map(k).tangent_tangent - 1.0),
            normal_less_1: like.each(|k| map(k).normal - 1.0),
        }
    }
}

impl BallLaw<2, 1> for Disk {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        apply(&LaneMap::new(hit.time, |_| &self.0), hit, velocity, spin);
    }
}

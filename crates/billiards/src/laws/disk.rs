//! Laws that are one constant matrix for a disk: no-slip, specular, restitution.
use crate::billiard::BallLaw;
use collision_laws::DiskLaw;
use geometry::WallHit;
use lanes::Lane;

/// A disk whose law is the same linear map at every contact.
#[derive(Clone, Copy, Debug)]
pub struct Disk(pub(super) Change);

impl Disk {
    /// `law` for a disk with mass distribution parameter γ.
    pub fn new(law: &impl DiskLaw, gamma: f64) -> Disk {
        let map = law.disk_map(gamma);
        Disk(Change {
            spin_spin: map.spin_spin,
            spin_tangent: map.spin_tangent,
            tangent_spin: map.tangent_spin,
            tangent_tangent: map.tangent_tangent - 1.0,
            normal: map.normal - 1.0,
        })
    }
}

/// The coefficients of a [`DiskMap`](collision_laws::DiskMap), with the identity taken off the velocity's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change<F = f64> {
    spin_spin: F,
    spin_tangent: F,
    tangent_spin: F,
    tangent_tangent: F,
    normal: F,
}

/// Applies a change to what happens at a hit.
///
/// With a normal `n` of any length, `t = J n` and the inverses `ι = 1/|n|`, `ι²`, the velocity changes by
/// `ι² (e−1) (v·n) n + (ι² (c−1) (v·t) + ι s v₀) t`: exact whatever the rounding of `|n|`.
#[inline(always)]
pub(super) fn apply<F: Lane>(change: &Change<F>, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
    let [n1, n2] = hit.normal;
    let [v1, v2] = *velocity;
    // t = J n = (−n₂, n₁)
    let vn = v1 * n1 + v2 * n2;
    let vt = v2 * n1 - v1 * n2;
    let v0 = spin[0];
    spin[0] = change.spin_spin * v0 + change.spin_tangent * (vt * hit.inverse);
    let along_n = change.normal * (vn * hit.inverse_square);
    let along_t = change.tangent_spin * (v0 * hit.inverse) + change.tangent_tangent * (vt * hit.inverse_square);
    *velocity = [(v1 + along_n * n1) - along_t * n2, (v2 + along_n * n2) + along_t * n1];
}

/// Applies a change to the normal and tangential components: `vₙ + (e−1) vₙ`, `vₜ + ((c−1) vₜ + s v₀)`.
#[inline(always)]
pub(super) fn apply_in_frame<F: Lane>(change: &Change<F>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
    let [vn, vt] = *velocity;
    let v0 = spin[0];
    spin[0] = change.spin_spin * v0 + change.spin_tangent * vt;
    *velocity = [vn + change.normal * vn, vt + (change.tangent_spin * v0 + change.tangent_tangent * vt)];
}

impl Change {
    /// The coefficients in lanes like those of `like`.
    #[inline(always)]
    fn in_lanes<F: Lane>(&self, like: F) -> Change<F> {
        Change {
            spin_spin: like.same(self.spin_spin),
            spin_tangent: like.same(self.spin_tangent),
            tangent_spin: like.same(self.tangent_spin),
            tangent_tangent: like.same(self.tangent_tangent),
            normal: like.same(self.normal),
        }
    }

    /// The coefficients that `of` has for each lane, as many as `like` has.
    #[inline(always)]
    pub(super) fn by_lane<'a, F: Lane>(like: F, of: impl Fn(usize) -> &'a Change) -> Change<F> {
        Change {
            spin_spin: like.each(|k| of(k).spin_spin),
            spin_tangent: like.each(|k| of(k).spin_tangent),
            tangent_spin: like.each(|k| of(k).tangent_spin),
            tangent_tangent: like.each(|k| of(k).tangent_tangent),
            normal: like.each(|k| of(k).normal),
        }
    }
}

impl BallLaw<2, 1> for Disk {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        apply(&self.0.in_lanes(hit.time), hit, velocity, spin);
    }
    #[inline(always)]
    fn collide_in_frame<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        apply_in_frame(&self.0.in_lanes(hit.time), velocity, spin);
    }
}

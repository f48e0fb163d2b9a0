//! Laws that are one constant matrix for a disk: no-slip, specular, restitution.
use crate::billiard::BallLaw;
use collision_laws::DiskLaw;
use geometry::WallHit;
use lanes::{Double, Lane, two_prod};

/// A disk whose law is the same linear map at every contact.
#[derive(Clone, Copy, Debug)]
pub struct Disk {
    /// In the coordinates of the plane.
    pub(super) change: Change,
    /// In the frame of the contact.
    pub(super) in_frame: Change,
}

impl Disk {
    /// `law` for a disk with mass distribution parameter γ.
    pub fn new(law: &impl DiskLaw, gamma: f64) -> Disk {
        let map = law.disk_map(gamma);
        let in_frame = Change {
            spin_spin: map.spin_spin,
            spin_tangent: map.spin_tangent,
            tangent_spin: map.tangent_spin,
            tangent_tangent: map.tangent_tangent - 1.0,
            normal: map.normal - 1.0,
        };
        Disk { change: in_frame.orthogonal(), in_frame }
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

impl Change {
    /// The same reflection of spin and tangential velocity with coefficients that are orthogonal to more digits than
    /// they have: of the neighbours of `c` and `s`, those with the least `|c² + s² − 1|`. A map that is no reflection
    /// stays as it is.
    ///
    /// Rounded coefficients stretch the plane by 10⁻¹⁶ in every collision alike, which the energy keeper would hand to
    /// the normal velocity for ever.
    fn orthogonal(self) -> Change {
        let defect = |c: f64, s: f64| {
            let mut sum = Double::new(-1.0);
            for x in [c, s] {
                let (square, rest) = two_prod(x, x);
                sum.add(square);
                sum.add(rest);
            }
            sum.value().abs()
        };
        let (c, s) = (-self.spin_spin, self.tangent_spin);
        let reflects = self.spin_tangent == s && self.tangent_tangent == c - 1.0 && defect(c, s) <= 4.0 * f64::EPSILON;
        if !reflects || s == 0.0 {
            return self;
        }
        let near = |x: f64| [x, x.next_down(), x.next_up()];
        let mut best = (defect(1.0 + self.tangent_tangent, s), self.tangent_tangent, s);
        let one_more = near(self.tangent_tangent).map(|less| 1.0 + less);
        for c in near(c).into_iter().chain(one_more) {
            for s in near(s) {
                // both c and c − 1 must be numbers
                let less = c - 1.0;
                if 1.0 + less == c && defect(c, s) < best.0 {
                    best = (defect(c, s), less, s);
                }
            }
        }
        let (_, less, s) = best;
        Change { spin_spin: -(1.0 + less), spin_tangent: s, tangent_spin: s, tangent_tangent: less, ..self }
    }
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
        apply(&self.change.in_lanes(hit.time), hit, velocity, spin);
    }
    #[inline(always)]
    fn collide_in_frame<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        apply_in_frame(&self.in_frame.in_lanes(hit.time), velocity, spin);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use collision_laws::laws::{NoSlip, Restitution};

    #[test]
    fn the_no_slip_law_is_orthogonal_beyond_its_digits() {
        for gamma_squared in [0.1_f64, 0.25, 0.4, 0.5, 2.0 / 3.0, 1.0] {
            let change = Disk::new(&NoSlip, gamma_squared.sqrt()).change;
            let (c, s) = (1.0 + change.tangent_tangent, change.tangent_spin);
            let mut sum = Double::new(-1.0);
            for x in [c, s] {
                let (square, rest) = two_prod(x, x);
                sum.add(square);
                sum.add(rest);
            }
            // rounded to the nearest, most of these are off by 10⁻¹⁶
            assert!(sum.value().abs() <= 2.5e-17, "{gamma_squared}: {:e}", sum.value());
            assert_eq!((change.spin_spin, change.spin_tangent), (-c, s));
        }
    }

    #[test]
    fn a_law_that_is_no_reflection_is_left_as_it_is() {
        let restitution = Restitution::new(0.5, 0.25).expect("between 0 and 1");
        let disk = Disk::new(&restitution, 0.5_f64.sqrt());
        assert_eq!(disk.change.tangent_spin, disk.in_frame.tangent_spin);
        assert_eq!(disk.change.tangent_tangent, disk.in_frame.tangent_tangent);
    }
}

//! Laws that are one constant matrix for a disk: no-slip, specular, restitution.
use super::{Mirror, checked_gamma, coefficients::Coefficients, slip::Slip};
use crate::{Error, billiard::BallLaw};
use collision_laws::{DiskLaw, DiskMap};
use geometry::WallHit;
use lanes::{Lane, Mask};

/// A disk whose law is the same linear map at every contact.
#[derive(Clone, Copy, Debug)]
pub struct Disk {
    /// In the coordinates of the plane: push and pull of the slip, `−(1 + eₙ)` along the normal.
    pub(super) in_plane: Coefficients,
    /// In the frame of the contact: the map as it is.
    pub(super) in_frame: Coefficients,
    /// The same for a strict law, which undoes itself.
    mirror: Option<Mirror>,
    /// Whether every hit leaves spin and tangential velocity as they are: a CPU predicts this branch, and the next flight does not wait
    /// for products by 0 and 1.
    smooth: bool,
}

impl Disk {
    /// `law` for a disk with mass distribution parameter γ.
    ///
    /// Its [map](DiskLaw::disk_map) must be one of impulses at the contact: with each change of the tangential velocity,
    /// the scaled spin changes by −1/γ times that. Each way to run an orbit uses the entries of the map that suit it, so any other
    /// map would be a different law on different tables.
    ///
    /// This takes some milliseconds: for a strict law it searches for the rounding of the coefficients that keeps the energy best.
    ///
    /// # Errors
    /// [`Error::Ball`] unless γ is finite and not negative; [`Error::NoContactImpulse`] of a law whose map is not one of impulses at
    /// the contact, within 10⁻⁹ of its entries.
    pub fn new(law: &(impl DiskLaw + ?Sized), gamma: f64) -> Result<Disk, Error> {
        let gamma = checked_gamma(gamma)?;
        let map = law.disk_map(gamma);
        if !acts_at_the_contact(&map, gamma) {
            return Err(Error::NoContactImpulse { map, gamma });
        }
        let Slip { push, pull, reflects } = Slip::of(&map, gamma);
        Ok(Disk {
            in_plane: Coefficients([push[0], push[1], pull[0], pull[1]], map.normal - 1.0),
            in_frame: Coefficients(
                [map.spin_spin, map.spin_tangent, map.tangent_spin, map.tangent_tangent],
                map.normal,
            ),
            mirror: Mirror::of(&map, gamma, reflects),
            smooth: pull == [0.0; 2],
        })
    }
}

/// Whether `(1, −γ)` is the direction of what a map changes, within 10⁻⁹ of its entries.
fn acts_at_the_contact(map: &DiskMap, gamma: f64) -> bool {
    let &DiskMap { spin_spin, spin_tangent, tangent_spin, tangent_tangent, .. } = map;
    let near = |a: f64, b: f64, size: f64| (a - b).abs() <= 1e-9 * size;
    near(tangent_spin, gamma * (1.0 - spin_spin), tangent_spin.abs() + gamma * (1.0 + spin_spin.abs()))
        && near(1.0 - tangent_tangent, gamma * spin_tangent, 1.0 + tangent_tangent.abs() + gamma * spin_tangent.abs())
}

/// Applies the law to what happens at a hit.
///
/// With a normal `n` of any length, `t = J n`, `ι = 1/|n|` and the slip's change `δ = p · (v₀, ι v·t)`, the spin changes by
/// `−u₀ δ` and the velocity by `−(1 + eₙ) ι² (v·n) n − ι u₁ δ t`, with `eₙ` the normal restitution, 1 for a strict law.
#[inline(always)]
pub(super) fn in_plane<F: Lane>(law: Coefficients<F>, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
    let Coefficients([push_spin, push_tangent, pull_spin, pull_tangent], _) = law;
    let [n1, n2] = hit.normal;
    let [v1, v2] = *velocity;
    // t = J n = (−n₂, n₁)
    let vt = v2 * n1 - v1 * n2;
    // The next flight waits for this chain, and ι is known last. What is constant along a straight wall is multiplied only
    // where that is exact (ι and the push have few bits there): rounded, it would be off alike at every hit
    let slip = (pull_tangent * vt) * hit.inverse + pull_spin * spin[0];
    spin[0] = spin[0] - push_spin * slip;
    let against_t = slip * (push_tangent * hit.inverse);
    along_normal(law, hit, velocity);
    *velocity = [velocity[0] + against_t * n2, velocity[1] - against_t * n1];
}

/// What the law does to the velocity along the normal, whatever the slip: all of it where the law is smooth.
#[inline(always)]
fn along_normal<F: Lane>(law: Coefficients<F>, hit: &WallHit<F, 2>, velocity: &mut [F; 2]) {
    let Coefficients(_, normal) = law;
    let [n1, n2] = hit.normal;
    let [v1, v2] = *velocity;
    let along_n = (normal * (v1 * n1 + v2 * n2)) * (hit.inverse * hit.inverse);
    *velocity = [v1 + along_n * n1, v2 + along_n * n2];
}

/// Applies the law to the normal and tangential components.
#[inline(always)]
pub(super) fn in_frame<F: Lane>(law: Coefficients<F>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
    let Coefficients([spin_spin, spin_tangent, tangent_spin, tangent_tangent], normal) = law;
    let [vn, vt] = *velocity;
    let v0 = spin[0];
    spin[0] = spin_spin * v0 + spin_tangent * vt;
    *velocity = [normal * vn, tangent_spin * v0 + tangent_tangent * vt];
}

impl BallLaw<2, 1> for Disk {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        let law = self.in_plane.in_lanes(hit.time);
        if self.smooth {
            along_normal(law, hit, velocity);
        } else {
            in_plane(law, hit, velocity, spin);
        }
    }
    #[inline(always)]
    fn collide_along_axis<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        // as elsewhere, without the products by 0, and those by ±1 made with constants
        let Coefficients([push_spin, push_tangent, pull_spin, pull_tangent], normal) = self.in_plane.in_lanes(hit.time);
        let ([n1, n2], [v1, v2]) = (hit.normal, *velocity);
        let is_first = n1.same(0.0).lt(n1.abs());
        let [vn, mut vt, sign] = is_first.choose([v1, v2, n1], [v2, v1, -n2]);
        if !self.smooth {
            let slip = (pull_tangent * sign) * vt + pull_spin * spin[0];
            spin[0] = spin[0] - push_spin * slip;
            vt = vt - (push_tangent * sign) * slip;
        }
        let vn = vn + normal * vn;
        *velocity = is_first.choose([vn, vt], [vt, vn]);
    }
    #[inline(always)]
    fn collide_in_frame<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        in_frame(self.in_frame.in_lanes(hit.time), velocity, spin);
    }
    #[inline(always)]
    fn is_strict(&self) -> bool {
        self.mirror.is_some()
    }
    fn mirror(&self) -> Option<Mirror> {
        self.mirror
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use collision_laws::{
        CollisionLaw, Contact, Delassus,
        laws::{NoSlip, Restitution, Specular},
    };
    use geometry::Vector2;

    #[test]
    fn a_law_without_slip_moves_a_disk_as_its_matrix_does() {
        let bounces = Restitution::new(0.7, -1.0).expect("coefficients");
        for (law, smooth) in [
            (Disk::new(&Specular, 0.6).unwrap(), true),
            (Disk::new(&bounces, 3.0).unwrap(), true),
            (Disk::new(&NoSlip, 0.6).unwrap(), false),
            (Disk::new(&Restitution::new(0.7, 1.0).expect("coefficients"), 0.6).unwrap(), false),
        ] {
            assert_eq!(law.smooth, smooth, "{law:?}");
            let hit = WallHit { normal: [0.7, -1.1], inverse: 1.0 / libm::hypot(0.7, 1.1), ..WallHit::never([0.0; 2]) };
            let (mut found, mut spun) = ([0.3, 0.9], [0.4]);
            let (mut expected, mut spin) = (found, spun);
            law.collide(&hit, &mut found, &mut spun);
            in_plane(law.in_plane, &hit, &mut expected, &mut spin);
            assert_eq!((found, spun), (expected, spin));
        }
    }

    #[test]
    fn along_an_axis_a_law_does_the_same_to_the_last_bit() {
        for law in [
            Disk::new(&Specular, 0.6).unwrap(),
            Disk::new(&NoSlip, 0.6).unwrap(),
            Disk::new(&Restitution::new(0.7, 0.4).expect("coefficients"), 0.3).unwrap(),
        ] {
            for normal in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [-0.0, 1.0]] {
                let hit = WallHit { normal, inverse: 1.0, ..WallHit::never([0.0; 2]) };
                let (mut found, mut spun) = ([0.1 + 0.2, -0.9], [0.43]);
                let (mut expected, mut spin) = (found, spun);
                law.collide_along_axis(&hit, &mut found, &mut spun);
                law.collide(&hit, &mut expected, &mut spin);
                assert_eq!((found, spun), (expected, spin), "{law:?} {normal:?}");
            }
        }
    }

    #[test]
    fn a_law_chosen_at_run_time_is_a_disk_s_law() {
        let laws: [Box<dyn DiskLaw>; 2] = [Box::new(Specular), Box::new(NoSlip)];
        let disks = laws.map(|law| Disk::new(&*law, 0.6).unwrap());
        assert_eq!(disks.map(|disk| disk.smooth), [true, false]);
    }

    #[test]
    fn a_map_of_impulses_elsewhere_is_refused() {
        // both reversed: no push at the rim does that
        struct Elsewhere;
        impl CollisionLaw<2> for Elsewhere {
            fn impulse(&self, _: &Contact<2>, _: &Delassus<2>, _: &Vector2<f64>) -> Vector2<f64> {
                Vector2::zeros()
            }
        }
        impl DiskLaw for Elsewhere {
            fn disk_map(&self, _: f64) -> DiskMap {
                DiskMap { spin_spin: -1.0, spin_tangent: 0.0, tangent_spin: 0.0, tangent_tangent: -1.0, normal: -1.0 }
            }
        }
        let error = Disk::new(&Elsewhere, 0.5).unwrap_err();
        assert!(matches!(error, Error::NoContactImpulse { gamma: 0.5, .. }), "{error}");
    }

    #[test]
    fn every_gamma_that_is_one_has_its_laws() {
        let lossy = Restitution::new(0.7, 0.4).expect("coefficients");
        for gamma in [0.0, 5e-324, 1e-200, 1e-9, 0.3, 1.0, 7.0, 1e9, 1e154, 1e200, f64::MAX] {
            assert!(Disk::new(&Specular, gamma).is_ok() && Disk::new(&lossy, gamma).is_ok(), "{gamma:e}");
            assert!(Disk::new(&NoSlip, gamma).is_ok_and(|disk| disk.is_strict()), "{gamma:e}");
        }
        for none in [-0.5, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            let error = Disk::new(&NoSlip, none).unwrap_err();
            assert!(matches!(error, Error::Ball { quantity: "γ", .. }), "{error}");
        }
    }
}

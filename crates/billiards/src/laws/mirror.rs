//! Laws that are their own inverse, to twice the digits.
use collision_laws::DiskMap;
use lanes::Double;

/// What a strict law does to the spin and the tangential velocity of a disk: nothing, or the reflection in a direction.
///
/// Applied twice it changes nothing. The normal velocity is reversed.
#[derive(Clone, Copy, Debug)]
pub struct Mirror {
    /// `(1, −γ)`, the direction of all impulses at the contact, times a power of two; `None` for the specular law.
    direction: Option<[f64; 2]>,
}

impl Mirror {
    /// The specular law's: nothing changes.
    pub fn specular() -> Mirror {
        Mirror { direction: None }
    }

    /// The no-slip law's, for a disk with mass distribution parameter γ.
    pub fn no_slip(gamma: f64) -> Mirror {
        let direction = if gamma <= 1.0 {
            [1.0, -gamma]
        } else if gamma < f64::INFINITY {
            let (fraction, exponent) = libm::frexp(gamma);
            [libm::ldexp(1.0, -exponent), -fraction]
        } else {
            [0.0, -1.0]
        };
        Mirror { direction: Some(direction) }
    }

    /// That of a map which changes nothing along the wall, or `reflects`.
    pub(super) fn of(map: &DiskMap, gamma: f64, reflects: bool) -> Option<Mirror> {
        let identity = [map.spin_spin, map.spin_tangent, map.tangent_spin, map.tangent_tangent] == [1.0, 0.0, 0.0, 1.0];
        let mirror = if reflects { Some(Mirror::no_slip(gamma)) } else { identity.then(Mirror::specular) };
        mirror.filter(|_| map.normal == -1.0)
    }

    /// Whether it leaves spin and tangential velocity as they are.
    pub(crate) fn is_specular(self) -> bool {
        self.direction.is_none()
    }

    /// Spin and tangential velocity after a collision.
    pub(crate) fn apply(&self, before: [Double; 2]) -> [Double; 2] {
        let [spin, tangential] = before;
        let Some(direction) = self.direction else { return before };
        let [u0, u1] = direction.map(Double::new);
        let square = u0.times(u0).plus(u1.times(u1));
        let along = u0.times(spin).plus(u1.times(tangential));
        let twice = along.plus(along).over(square);
        [spin.plus(-twice.times(u0)), tangential.plus(-twice.times(u1))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use collision_laws::{
        DiskLaw,
        laws::{NoSlip, Restitution, Specular},
    };

    const GAMMAS: [f64; 7] = [0.0, 1e-9, 0.3, core::f64::consts::FRAC_1_SQRT_2, 3.0, 1e9, 1e200];

    #[test]
    fn a_mirror_undoes_itself_to_thirty_digits_and_is_the_law() {
        for gamma in GAMMAS {
            let mirrors =
                [(Mirror::no_slip(gamma), NoSlip.disk_map(gamma)), (Mirror::specular(), Specular.disk_map(gamma))];
            for (mirror, map) in mirrors {
                let before = [Double::new(0.7), Double::new(-0.4)];
                let after = mirror.apply(before);
                let again = mirror.apply(after);
                let found = after.map(|x| x.value());
                let expected = [
                    map.spin_spin * 0.7 + map.spin_tangent * -0.4,
                    map.tangent_spin * 0.7 + map.tangent_tangent * -0.4,
                ];
                for i in 0..2 {
                    assert!((found[i] - expected[i]).abs() < 1e-15, "{gamma}: {found:?} for {expected:?}");
                    assert!(again[i].plus(-before[i]).value().abs() < 1e-30, "{gamma}");
                }
            }
        }
    }

    #[test]
    fn laws_that_lose_something_have_none() {
        for (normal, tangential) in [(0.5, 1.0), (1.0, 0.5)] {
            let map = Restitution::new(normal, tangential).expect("between 0 and 1").disk_map(0.6);
            assert!(Mirror::of(&map, 0.6, false).is_none());
        }
    }
}

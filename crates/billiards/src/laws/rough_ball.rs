//! Strict laws of a ball in space: specular, no-slip, and the rough directions between.
use super::{checked_gamma, slip::Slip};
use crate::{Error, billiard::BallLaw};
use collision_laws::{DiskLaw, LOST_DIRECTION, laws::NoSlip};
use geometry::WallHit;
use lanes::{Lane, Mask, dot};
use nalgebra::Vector3;

/// A ball in ℝ³ whose wall is rough along some directions.
///
/// With `W = γ R ω`, inward normal `ν`, and `Π` the projector onto the rough directions in the contact plane,
/// `q = Π(γ v − W × ν)`:
///
/// `v⁺ = v − 2 (v·ν) ν − (2γ/(1+γ²)) q`, `W⁺ = W + (2/(1+γ²)) ν × q`.
///
/// This is the strict law of Cox, Feres and Ward (arXiv:1501.06536) for a ball and a fixed wall; the spin about the normal never changes.
#[derive(Clone, Copy, Debug)]
pub struct RoughBall {
    /// What changes spin and tangential velocity, as for a disk.
    slip: Slip,
    rough: Rough,
}

#[derive(Clone, Copy, Debug)]
enum Rough {
    All,
    /// k = 1: the tangential part of a fixed vector.
    Along([f64; 3]),
}

impl RoughBall {
    /// No-slip: both tangential directions are rough.
    ///
    /// This takes some milliseconds: it searches for the rounding of the coefficients that keeps the energy best.
    ///
    /// # Errors
    /// [`Error::Ball`] unless γ is finite and not negative.
    pub fn no_slip(gamma: f64) -> Result<RoughBall, Error> {
        let gamma = checked_gamma(gamma)?;
        Ok(RoughBall { slip: Slip::of(&NoSlip.disk_map(gamma), gamma), rough: Rough::All })
    }

    /// Rough along the tangential part of `direction` alone (k = 1), which may have any finite length; smooth where the direction is
    /// normal to the wall, and everywhere if it is zero.
    ///
    /// # Errors
    /// [`Error::Ball`] unless γ is finite and not negative and the direction finite.
    pub fn along(gamma: f64, direction: Vector3<f64>) -> Result<RoughBall, Error> {
        if let Some(&value) = direction.iter().find(|x| !x.is_finite()) {
            return Err(Error::Ball { quantity: "rough direction", must: "finite", value });
        }
        // by a power of two, which rounds nothing: neither its square nor the slip's part along it over- or underflows
        let (_, exponent) = libm::frexp(direction.amax());
        let direction = direction.map(|x| libm::ldexp(x, -exponent));
        Ok(RoughBall { rough: Rough::Along(direction.into()), ..RoughBall::no_slip(gamma)? })
    }
}

#[inline(always)]
fn cross<F: Lane>(a: &[F; 3], b: &[F; 3]) -> [F; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

impl BallLaw<3, 3> for RoughBall {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 3>, velocity: &mut [F; 3], spin: &mut [F; 3]) {
        let n = &hit.unit_normal();
        let vn = dot(velocity, n);
        let wn = cross(spin, n);
        let Slip { push: [push_spin, push_tangent], pull: [pull_spin, pull_tangent], .. } = self.slip;
        // the velocity without its normal part; W × ν has none
        let mut slip = [vn; 3];
        for i in 0..3 {
            slip[i] = (velocity[i] - vn * n[i]) * pull_tangent + wn[i] * pull_spin;
        }
        let q = match self.rough {
            Rough::All => slip,
            Rough::Along(direction) => {
                let d = [vn.same(direction[0]), vn.same(direction[1]), vn.same(direction[2])];
                let mut t = d;
                // twice: if a direction is almost normal to the wall, what rounding leaves along the normal is a large part of it
                for _ in 0..2 {
                    let along = dot(&t, n);
                    for i in 0..3 {
                        t[i] = t[i] - along * n[i];
                    }
                }
                let square = dot(&t, &t);
                // a direction along the normal, within rounding, leaves the wall smooth
                let rough = (dot(&d, &d) * (LOST_DIRECTION * LOST_DIRECTION)).lt(square);
                let part = rough.select(dot(&t, &slip) / square, vn.same(0.0));
                [t[0] * part, t[1] * part, t[2] * part]
            }
        };
        let turn = cross(n, &q);
        let twice = vn + vn;
        for i in 0..3 {
            velocity[i] = velocity[i] - twice * n[i] - q[i] * push_tangent;
            spin[i] = spin[i] - turn[i] * push_spin;
        }
    }
    #[inline(always)]
    fn is_strict(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_that_does_not_turn_slides_back_as_it_came_whatever_its_gamma() {
        let hit = WallHit { normal: [0.0, 0.0, 1.0], inverse: 1.0, ..WallHit::never([0.0; 3]) };
        for gamma in [1e20, 1e140, 1e154, 1e155, f64::MAX] {
            let (mut v, mut w) = ([0.3, -0.4, -0.7], [0.2, 0.5, -0.1]);
            RoughBall::no_slip(gamma).unwrap().collide(&hit, &mut v, &mut w);
            let expected = [-0.3, 0.4, 0.7, 0.2, 0.5, -0.1];
            for (found, expected) in v.iter().chain(&w).zip(expected) {
                assert!((found - expected).abs() < 1e-15, "{gamma:e}: {v:?} {w:?}");
            }
        }
    }

    #[test]
    fn a_direction_almost_normal_to_the_wall_keeps_energy_and_reverses_the_normal_velocity() {
        let normal = Vector3::new(1.0, 2.0, -3.0).normalize();
        let hit = WallHit { normal: normal.into(), inverse: 1.0, ..WallHit::never([0.0; 3]) };
        for off in [1e-8, 1e-11, 1e-13, 3e-15, 1e-15, 0.0] {
            let law = RoughBall::along(0.6, Vector3::new(1.0, 2.0 - 7.0 * off, off - 3.0)).unwrap();
            let (before, spin) = (Vector3::new(2.0, 1.5, 0.5), Vector3::new(0.1, 0.2, 0.3));
            let (mut v, mut w) = (before.into(), spin.into());
            law.collide(&hit, &mut v, &mut w);
            let [v, w] = [v, w].map(Vector3::from);
            let energy = v.norm_squared() + w.norm_squared();
            assert!((energy - before.norm_squared() - spin.norm_squared()).abs() < 1e-14, "{off:e}: {energy}");
            assert!((normal.dot(&v) + normal.dot(&before)).abs() < 1e-15, "{off:e}: {v:?}");
        }
    }

    #[test]
    fn what_is_no_gamma_or_no_direction_is_refused() {
        for none in [-0.5, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            assert!(matches!(RoughBall::no_slip(none), Err(Error::Ball { quantity: "γ", .. })), "{none}");
            assert!(matches!(RoughBall::along(none, Vector3::x()), Err(Error::Ball { quantity: "γ", .. })), "{none}");
        }
        for none in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            let refused = RoughBall::along(0.5, Vector3::new(1.0, none, 0.0)).unwrap_err();
            assert!(matches!(refused, Error::Ball { quantity: "rough direction", .. }), "{refused}");
        }
    }

    #[test]
    fn only_the_line_of_a_rough_direction_matters() {
        let hit = WallHit { normal: [0.6, 0.0, 0.8], inverse: 1.0, ..WallHit::never([0.0; 3]) };
        let after = |law: RoughBall| {
            let (mut v, mut w) = ([0.3, -0.4, -0.7], [0.2, 0.5, -0.1]);
            law.collide(&hit, &mut v, &mut w);
            (v, w)
        };
        let direction = Vector3::new(0.25, -0.75, 1.5);
        let once = after(RoughBall::along(0.6, direction).unwrap());
        for power in [-1000, -570, -1, 1, 530, 1000] {
            let length = libm::ldexp(1.0, power);
            assert_eq!(after(RoughBall::along(0.6, direction * length).unwrap()), once, "2^{power}");
        }
        let smooth = after(RoughBall::along(0.6, Vector3::zeros()).unwrap());
        assert_eq!(smooth.1, [0.2, 0.5, -0.1]);
        assert_eq!(after(RoughBall::along(0.6, Vector3::new(0.6, 0.0, 0.8) * 1e-200).unwrap()), smooth);
    }
}

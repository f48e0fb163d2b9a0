//! What a law does to spin and tangential velocity: a change along one direction.
//!
//! An impulse `J t` at the contact changes `(v₀, vₜ)` by a multiple of `(1, −γ)`, whatever the law: the map is
//! `1 − u pᵀ`, with `u` along `(1, −γ)`.
use collision_laws::DiskMap;
use core::cmp::Ordering;
use lanes::{Kernel, Lane, Mask, two_prod, two_sum};

/// `(v₀, vₜ) ↦ (v₀, vₜ) − u (p·(v₀, vₜ))`
#[derive(Clone, Copy, Debug)]
pub(super) struct Slip {
    /// `u`, for spin and tangential velocity.
    pub(super) push: [f64; 2],
    /// `p`
    pub(super) pull: [f64; 2],
    /// Whether it is the reflection in `u`.
    pub(super) reflects: bool,
}

/// A strict law needs no more digits than this: an upper bound for what is left of `p·u − 2` and `p ∧ u`.
const ENOUGH: f64 = f64::EPSILON / 2048.0;
/// The number of lengths of `u` to choose from. About one in 10⁶ is good enough.
const LENGTHS: u32 = 1 << 22;

impl Slip {
    /// That of a map for a disk with mass distribution parameter γ.
    ///
    /// The map of a strict law that is not specular is the reflection in `u`, with `p = 2u/|u|²`. Rounded coefficients would stretch the
    /// plane by 10⁻¹⁶ in every collision, always the same way. The length of `u` is free, though, and each length rounds differently: it
    /// is chosen such that `p·u = 2` and `p ∥ u` to three digits more than the coefficients have.
    pub(super) fn of(map: &DiskMap, gamma: f64) -> Slip {
        // the direction of u, with a greater component of 1
        let push = if gamma <= 1.0 { [1.0, -gamma] } else { [1.0 / gamma, -1.0] };
        let pull = if gamma <= 1.0 {
            [1.0 - map.spin_spin, -map.spin_tangent]
        } else {
            [map.tangent_spin, map.tangent_tangent - 1.0]
        };
        // the coefficients of a law come from a few operations each
        let reflects = defect(push, pull) <= 16.0 * f64::EPSILON;
        if reflects { lanes::dispatch(Reflection { direction: even(push) }) } else { Slip { push, pull, reflects } }
    }
}

/// The same direction with a power of two along the tangent, so that the push along that has no more bits than a length.
fn even([spin, tangent]: [f64; 2]) -> [f64; 2] {
    if tangent == 0.0 {
        return [spin, tangent];
    }
    let power = libm::ldexp(1.0, libm::frexp(tangent).1).copysign(tangent);
    [spin * (power / tangent), power]
}

/// The greater of `|p·u − 2|` and `|p ∧ u|`, right to 10⁻³²: both are 0 for a reflection.
#[inline(always)]
fn defect<F: Lane>([u0, u1]: [F; 2], [p0, p1]: [F; 2]) -> F {
    let ((a, a_rest), (b, b_rest)) = (two_prod(p0, u0), two_prod(p1, u1));
    let (sum, rest) = two_sum(a, b);
    let stretch = (sum + -2.0) + (rest + (a_rest + b_rest));
    let ((a, a_rest), (b, b_rest)) = (two_prod(p0, u1), two_prod(p1, u0));
    let skew = (a - b) + (a_rest - b_rest);
    stretch.abs().max(skew.abs())
}

/// The search for the reflection in a direction, in the digits that suit it best.
struct Reflection {
    direction: [f64; 2],
}

impl Reflection {
    /// Push and pull for a length of `u`.
    #[inline(always)]
    fn of_length<F: Lane>(&self, length: F) -> [[F; 2]; 2] {
        // no closures: in a build without optimisation they would be functions of their own, for another instruction set
        let [spin, tangent] = self.direction;
        let push = [length * spin, length * tangent];
        let factor = length.same(2.0) / (push[0] * push[0] + push[1] * push[1]);
        [push, [push[0] * factor, push[1] * factor]]
    }
}

impl Kernel for Reflection {
    type Output = Slip;
    #[inline(always)]
    fn run<F: Lane>(self, zero: F) -> Slip {
        let unit = 1.0 / f64::from(LENGTHS);
        let mut length = zero.each(|lane| 1.0 + lane as f64 * unit);
        let (mut best, mut least) = (length, zero.same(f64::INFINITY));
        for _ in (0..LENGTHS).step_by(F::LANES) {
            let [push, pull] = self.of_length(length);
            let found = defect(push, pull);
            let better = found.lt(least);
            (best, least) = (better.select(length, best), better.select(found, least));
            // the first length in their order, however many are looked at side by side
            if found.lt(zero.same(ENOUGH)).any() {
                break;
            }
            length = length + F::LANES as f64 * unit;
        }
        let order = |lane: &usize| (least.lane(*lane).max(ENOUGH), best.lane(*lane));
        let first =
            (0..F::LANES).min_by(|a, b| order(a).partial_cmp(&order(b)).unwrap_or(Ordering::Equal)).unwrap_or(0);
        let [push, pull] = self.of_length(best.lane(first));
        Slip { push, pull, reflects: true }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use collision_laws::{
        DiskLaw,
        laws::{NoSlip, Restitution, Specular},
    };

    const GAMMAS: [f64; 9] =
        [0.0, 1e-9, 0.3, 0.632_455_532_033_675_9, core::f64::consts::FRAC_1_SQRT_2, 1.0, 3.0, 1e9, 1e200];

    #[test]
    fn the_no_slip_law_is_a_reflection_to_three_digits_more_than_it_has() {
        for gamma in GAMMAS {
            let slip = Slip::of(&NoSlip.disk_map(gamma), gamma);
            // rounded to the nearest, most of these are off by 10⁻¹⁶
            let defect = defect(slip.push, slip.pull);
            assert!(defect <= ENOUGH, "{gamma}: {defect:e}");
        }
    }

    #[test]
    fn a_slip_is_the_map_that_it_was_made_of() {
        for gamma in GAMMAS {
            let restitution = Restitution::new(0.5, 0.25).expect("between 0 and 1");
            for map in [NoSlip.disk_map(gamma), Specular.disk_map(gamma), restitution.disk_map(gamma)] {
                let Slip { push: [u0, u1], pull: [p0, p1], .. } = Slip::of(&map, gamma);
                let entries = [
                    (1.0 - u0 * p0, map.spin_spin),
                    (-u0 * p1, map.spin_tangent),
                    (-u1 * p0, map.tangent_spin),
                    (1.0 - u1 * p1, map.tangent_tangent),
                ];
                for (found, expected) in entries {
                    assert!((found - expected).abs() <= 4.0 * f64::EPSILON, "{gamma}: {found} for {expected}");
                }
            }
        }
    }
}

//! Periodic orbits of the circle.
use super::wedge_periods::apart;
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    circle::state,
    law::{ALL, cos_beta, sin_beta},
    motion::{bounces, distance, no_slip},
    random::Stream,
    statistics::{Range, worst},
};
use billiards::geometry::tables;
use core::f64::consts::{PI, TAU};

pub(super) const CLAIM: Claim = Claim {
    name: "circle-polygons",
    place: "after eq. (3.2)",
    statement: "If moreover ẋ₂ = tan(π/n) ẋ₁ the orbit is a regular n-gon. For each n there is a continuum of initial conditions with periodic \
                orbits.",
    verdict: Verdict::HoldsCorrected(
        "The n-gons are as stated. There is a continuum of further orbits for even n only: two collisions restore the velocity in the frame of the wall, so that an \
         orbit of odd period has the same one after every collision, and is one of the regular n-gons and star polygons of the standard billiard.",
    ),
    general_gamma: Some(
        "With ẋ₀ = γ ẋ₁. In general, the orbits of period 2k have θ₁ + θ₂ a multiple of π/k, with tan θᵢ = τᵢ/ẋ₂: a curve of velocities.",
    ),
    measure,
};

fn measure(effort: Effort) -> Measurement {
    let orbits = effort.of(20, 500);
    let (mut closed, mut sides, mut early) = (vec![], vec![], Range::EMPTY);
    let (mut families, mut families_early) = (vec![], Range::EMPTY);
    let (mut odd, mut even) = (vec![], vec![]);
    for sample in 0..orbits {
        let mut stream = Stream::new(232, sample);
        let gamma_squared = ALL[sample % 4];
        let gamma = libm::sqrt(gamma_squared);
        let circle = no_slip(tables::circle(1.0), gamma_squared);
        let phi = stream.between(0.0, TAU);
        for n in 3..=12_u32 {
            let tau =
                1.0 / libm::sqrt(1.0 + gamma_squared + libm::tan(PI / f64::from(n)) * libm::tan(PI / f64::from(n)));
            let start = state(1.0, phi, gamma * tau, tau, libm::tan(PI / f64::from(n)) * tau);
            let orbit = bounces(&circle, start, n as usize + 1);
            let place = |i: usize| [orbit[i].state.x[1], orbit[i].state.x[2]];
            closed.push(distance(place(0), place(n as usize)));
            (1..n as usize).for_each(|i| early.add(distance(place(0), place(i))));
            let side = 2.0 * libm::sin(PI / f64::from(n));
            sides.extend((0..n as usize).map(|i| (distance(place(i), place(i + 1)) - side).abs()));
        }
        // θ₁ at will, θ₂ = π m/k − θ₁: tan θ₂ = τ₂/n with τ₂ = s v₀ + c τ₁
        for (m, k) in [(1, 3_u32), (1, 4), (2, 5), (1, 7)] {
            let sum = PI * f64::from(m) / f64::from(k);
            let first = stream.between(sum - 1.3, 1.3);
            let [t1, t2] = [first, sum - first].map(libm::tan);
            let v0 = (t2 - cos_beta(gamma_squared) * t1) / sin_beta(gamma_squared);
            let size = libm::sqrt(1.0 + t1 * t1 + v0 * v0);
            let orbit = bounces(&circle, state(1.0, phi, v0 / size, t1 / size, 1.0 / size), 2 * k as usize + 1);
            families.push(apart(&orbit[0], &orbit[2 * k as usize]));
            (1..k as usize).for_each(|i| families_early.add(apart(&orbit[0], &orbit[2 * i])));
        }
        // (v₀, vₜ) in the frame of the wall, of any orbit: one collision is a reflection in the line v₀ = γ vₜ
        let [v0, tau, n] = stream.on_sphere();
        let off = (v0 - gamma * tau).abs() / libm::sqrt(1.0 + gamma_squared);
        let orbit = bounces(&circle, state(1.0, phi, v0, tau, n.abs().max(0.1)), 12);
        let in_frame = |i: usize| [orbit[i].state.v[0], orbit[i].tangential_velocity()];
        odd.extend((1..12).step_by(2).map(|i| (distance(in_frame(0), in_frame(i)) - 2.0 * off).abs()));
        even.extend((2..12).step_by(2).map(|i| distance(in_frame(0), in_frame(i))));
    }
    // up to 14 collisions of some ten roundings, with normal velocities of 0.05 or more to divide by
    let rounding = 14.0 * 16.0 * f64::EPSILON / 0.05;
    [
        Quantity::residual("n-gons, n = 3 … 12: deviation after n collisions", worst(closed), rounding),
        Quantity::at_least("n-gons: nearest return before that", early.min, 2.0 * libm::sin(PI / 12.0), rounding),
        Quantity::residual("n-gons: length of a side against 2 sin(π/n)", worst(sides), rounding),
        Quantity::residual("θ₁ + θ₂ = πm/k, random θ₁: deviation after 2k collisions", worst(families), rounding),
        Quantity::residual("any orbit: change of (v₀, vₜ) in an even number of collisions", worst(even), rounding),
        Quantity::residual(
            "the same in an odd number, against twice the distance from v₀ = γ vₜ",
            worst(odd),
            rounding,
        ),
        Quantity::at_least("θ₁ + θ₂ = πm/k, random θ₁: nearest return before that", families_early.min, 0.5, 0.0),
    ]
    .into()
}

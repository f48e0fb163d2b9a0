//! How far two hits in a wedge turn the velocity.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{ALL, UNIFORM, beta},
    motion::bounces,
    random::Stream,
    statistics::worst,
    wedge::{axis, billiard, bounded_start, delta, two_hits},
};
use core::f64::consts::PI;
use nalgebra::Vector3;

pub(super) const CLAIM: Claim = Claim {
    name: "wedge-angle",
    place: "Proposition 2.6",
    statement: "Two collisions in the wedge of angle θ turn the velocity about the axis of periodicity by the angle α with \
                cos α = (32/9) cos⁴(θ/2) − (16/3) cos²(θ/2) + 1.",
    verdict: Verdict::HoldsCorrected(
        "The formula holds. In its proof, cos α = v·S v is to be w·S w: v is the axis of the rotation S, and w = (0, 0, 1) is perpendicular to it.",
    ),
    general_gamma: Some("cos(α/2) = (γ² − cos θ)/(1+γ²), or α = 2π − 4δ with cos δ = cos(θ/2)/√(1+γ²)."),
    measure,
};

/// The paper's `cos α`, a polynomial of degree 4 in `cos(θ/2)`.
fn quartic(theta: f64) -> f64 {
    let square = libm::cos(0.5 * theta) * libm::cos(0.5 * theta);
    32.0 / 9.0 * square * square - 16.0 / 3.0 * square + 1.0
}

fn measure(effort: Effort) -> Measurement {
    let (mut by_w, mut by_quartic, mut general, mut by_delta, mut orbits) = (vec![], vec![], vec![], vec![], vec![]);
    for sample in 0..effort.of(200, 20_000) {
        let mut stream = Stream::new(221, sample);
        let theta = stream.between(0.01, PI - 0.01);
        let cos = 0.5 * (two_hits(theta, UNIFORM).trace() - 1.0);
        by_quartic.push((cos - quartic(theta)).abs());
        by_w.push((two_hits(theta, UNIFORM)[(2, 2)] - quartic(theta)).abs());
        for gamma_squared in ALL.into_iter().chain([1.0]) {
            let cos = 0.5 * (two_hits(theta, gamma_squared).trace() - 1.0);
            let half = (gamma_squared - libm::cos(theta)) / (1.0 + gamma_squared);
            general.push((cos - (2.0 * half * half - 1.0)).abs());
            by_delta.push((cos - libm::cos(4.0 * delta(theta, gamma_squared))).abs());
        }
        // and the engine's orbits: the angle between the parts of two velocities off the axis
        let theta = stream.between(0.3, 2.8);
        let start = bounded_start(theta, UNIFORM, 0.9, &mut stream);
        let orbit = bounces(&billiard(theta, UNIFORM), start, 5);
        let b = Vector3::from(axis(theta, UNIFORM));
        let off = |i: usize| Vector3::from(orbit[i].state.v) - b * b.dot(&Vector3::from(orbit[i].state.v));
        // an angle between short vectors is as uncertain as they are short
        orbits.push((off(1).dot(&off(3)) - quartic(theta) * off(1).norm_squared()).abs());
    }
    // traces of products of two matrices, a few dozen roundings of numbers up to 4
    let rounding = 64.0 * f64::EPSILON;
    [
        Quantity::residual("cos α of the law's matrices against the paper's quartic", worst(by_quartic), rounding),
        Quantity::residual("w·S w, w = (0, 0, 1), against it", worst(by_w), rounding),
        Quantity::residual("cos α of orbits against the paper's quartic", worst(orbits), rounding),
        // the strip is the wedge of angle 0
        Quantity::equal(
            "quartic at θ = 0, against cos α of the strip",
            quartic(0.0),
            libm::cos(2.0 * beta(UNIFORM)),
            rounding,
        ),
        Quantity::residual("cos α against the formula for all γ, five values of γ", worst(general), rounding),
        Quantity::residual("cos α against cos 4δ, five values of γ", worst(by_delta), rounding),
    ]
    .into()
}

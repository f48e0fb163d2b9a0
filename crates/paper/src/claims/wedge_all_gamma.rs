//! The wedge for all disks.
use super::wedge_periods::Survey;
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::no_slip,
    motion::{Bounce, bounces},
    random::Stream,
    statistics::{Range, worst},
    wedge::{axis, billiard, bounded_start, delta, normals, opening, period},
};
use core::f64::consts::{FRAC_PI_2, PI};
use nalgebra::{Matrix3, Vector3};

pub(super) const CLAIM: Claim = Claim {
    name: "wedge-all-gamma",
    place: "beyond the paper",
    statement: "Folded along its bisector the wedge has a single collision map, H = M C, which turns the velocity by −2δ about b ∝ (sin(θ/2)/γ, 1, 0), cos δ = cos(θ/2)/√(1+γ²). So |v·b| and \
                I = l (v·ν) are kept; with δ = πp/q in lowest terms the period is q for even q and 2q for odd q, and x₀ returns for odd q only. A right angle with γ = 1 \
                has period 6, θ = arccos γ² has period 4.",
    verdict: Verdict::Holds,
    general_gamma: Some("As stated."),
    measure,
};

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(100, 1000), effort.of(2000, 100_000));
    let (mut folded, mut along, mut momentum) = (vec![], vec![], vec![]);
    for sample in 0..orbits {
        let mut stream = Stream::new(195, sample);
        let (theta, gamma_squared) = (stream.between(0.3, 2.8), stream.between(0.05, 1.0));
        let b = Vector3::from(axis(theta, gamma_squared));
        let mirror = Matrix3::from_diagonal(&Vector3::new(-1.0, -1.0, 1.0));
        let h = mirror * no_slip(gamma_squared, normals(theta)[1]);
        let d = delta(theta, gamma_squared);
        // Rodrigues: the rotation by −2δ about b; the hit is that of the left wall
        let (sin, cos) = libm::sincos(-2.0 * d);
        let cross = Matrix3::new(0.0, -b.z, b.y, b.z, 0.0, -b.x, -b.y, b.x, 0.0);
        let turn = Matrix3::identity() * cos + cross * sin + b * b.transpose() * (1.0 - cos);
        folded.push((h - turn).amax());

        let start = bounded_start(theta, gamma_squared, 0.9, &mut stream);
        let orbit = bounces(&billiard(theta, gamma_squared), start, collisions);
        let least: Range = orbit.iter().map(Bounce::normal_velocity).collect();
        let kept = |k: usize| Vector3::from(orbit[k].state.v).dot(&b).abs();
        let i = |k: usize| libm::hypot(orbit[k].state.x[1], orbit[k].state.x[2]) * orbit[k].normal_velocity();
        // Rounding of the energy goes to the normal velocity, an ulp over v·ν of it; and I is a product with v·ν
        along.extend((0..orbit.len()).map(|k| (kept(k) - kept(0)).abs() * least.min));
        momentum.extend((0..orbit.len()).map(|k| (i(k) / i(0) - 1.0).abs() * least.min));
        if orbit.len() < collisions {
            momentum.push(f64::INFINITY);
        }
    }
    // some ten roundings per collision
    let rounding = 16.0 * f64::EPSILON * collisions as f64;
    let mut quantities = vec![
        Quantity::residual("H against the rotation by −2δ about b, random θ and γ", worst(folded), 32.0 * f64::EPSILON),
        Quantity::residual(
            format!("change of |v·b| in {collisions} collisions, times least v·ν"),
            worst(along),
            rounding,
        ),
        Quantity::residual(
            format!("relative change of I in {collisions} collisions, times least v·ν"),
            worst(momentum),
            rounding,
        ),
    ];
    for (gamma_squared, p, q) in
        [(0.15, 1, 4), (0.15, 2, 7), (0.4, 1, 3), (0.4, 3, 10), (0.85, 2, 5), (1.0, 1, 3), (1.0, 3, 8)]
    {
        let theta = opening(PI * f64::from(p) / f64::from(q), gamma_squared).expect("an angle below π");
        let name = format!("γ² = {gamma_squared}, δ = {p}π/{q}, θ = {theta:.5}");
        quantities.extend(Survey::new(theta, gamma_squared, period(q), orbits).quantities(&name, q % 2 == 1));
    }
    quantities.extend([
        Quantity::equal("δ/π at a right angle with γ = 1", delta(FRAC_PI_2, 1.0) / PI, 1.0 / 3.0, 4.0 * f64::EPSILON),
        Quantity::equal("δ/π at θ = arccos γ², γ² = 0.4", delta(libm::acos(0.4), 0.4) / PI, 0.25, 4.0 * f64::EPSILON),
    ]);
    quantities.into()
}

//! Orbits of the circle with one caustic.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    circle::{caustic, state},
    law::ALL,
    motion::{bounces, distance, no_slip, specular},
    random::Stream,
    statistics::worst,
};
use billiards::geometry::tables;
use core::f64::consts::TAU;

pub(super) const CLAIM: Claim = Claim {
    name: "circle-one-caustic",
    place: "after eq. (3.2)",
    statement: "The caustics coincide if ẋ₁ = √2 ẋ₀. The orbits with r₁ = r₂ are those whose rotational velocity never changes, and correspond \
                precisely to the orbits of the standard billiard.",
    verdict: Verdict::HoldsCorrected(
        "Those with ẋ₁ = √2 ẋ₀ do. But r₁ = r₂ (as radii) has a second family, ẋ₀ = −√2 ẋ₁: the whole velocity along the wall is reversed at each \
         hit, and the disk goes to and fro on one chord, spinning the other way each time: period two.",
    ),
    general_gamma: Some("ẋ₀ = γ ẋ₁, and ẋ₀ = −ẋ₁/γ."),
    measure,
};

fn measure(effort: Effort) -> Measurement {
    let orbits = effort.of(50, 2000);
    let (mut standard, mut spin, mut one, mut back, mut turned) = (vec![], vec![], vec![], vec![], vec![]);
    for sample in 0..orbits {
        let mut stream = Stream::new(231, sample);
        let gamma_squared = ALL[sample % 4];
        let gamma = libm::sqrt(gamma_squared);
        let circle = no_slip(tables::circle(1.0), gamma_squared);
        let (phi, tau) = (stream.between(0.0, TAU), stream.between(0.1, 0.3));
        let speed = |v0: f64| libm::sqrt(1.0 - v0 * v0 - tau * tau);

        let start = state(1.0, phi, gamma * tau, tau, speed(gamma * tau));
        let (orbit, smooth) = (bounces(&circle, start, 200), bounces(&specular(tables::circle(1.0)), start, 200));
        standard.extend(orbit.iter().zip(&smooth).map(|(a, b)| distance(a.state.x, b.state.x)));
        spin.extend(orbit.iter().map(|b| (b.state.v[0] - start.v[0]).abs()));

        let v0 = -tau / gamma;
        let start = state(1.0, phi, v0, tau, speed(v0));
        let orbit = bounces(&circle, start, 200);
        one.extend(orbit.iter().map(|b| (caustic(b) - caustic(&orbit[0])).abs()));
        turned.extend(orbit.iter().map(|b| (b.state.v[0] / v0 - if b.n % 2 == 0 { 1.0 } else { -1.0 }).abs()));
        back.push(distance(orbit[0].state.x, orbit[198].state.x) + distance(orbit[0].state.v, orbit[198].state.v));
    }
    // a phase of the regular orbit drifts with the rounding of its step; the other family turns back on itself
    let rounding = 200.0 * 200.0 * f64::EPSILON;
    [
        Quantity::residual(
            "ẋ₀ = γẋ₁: 200 points of the orbit against the smooth disk's, x₀ included",
            worst(standard),
            rounding,
        ),
        Quantity::residual("ẋ₀ = γẋ₁: change of the spin in 200 collisions", worst(spin), rounding),
        Quantity::residual("ẋ₀ = −ẋ₁/γ: spread of the caustic's radius", worst(one), rounding),
        Quantity::residual("ẋ₀ = −ẋ₁/γ: spin over its first value, against ±1 in turn", worst(turned), rounding),
        Quantity::residual("ẋ₀ = −ẋ₁/γ: deviation after 198 collisions, x₀ included", worst(back), rounding),
    ]
    .into()
}

//! Two caustics in a circle.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    circle::{caustic, next_tangential, state},
    law::ALL,
    motion::{bounces, no_slip},
    random::Stream,
    statistics::{Range, worst},
};
use billiards::geometry::tables;
use core::f64::consts::TAU;

pub(super) const CLAIM: Claim = Claim {
    name: "circle-caustics",
    place: "Proposition 3.1, eqs. (3.1) and (3.2)",
    statement: "In a circle of radius r the vertex angle is the same at each collision, and the flights, each at its midpoint, touch two \
                concentric circles in turn, of radii r₁ = ẋ₁/√(ẋ₁² + ẋ₂²) and r₂ = y/√(y² + ẋ₂²), y = (2√2/3) ẋ₀ + (1/3) ẋ₁, with the \
                velocity in the frame of the tangent and the radius.",
    verdict: Verdict::HoldsCorrected(
        "The radii are r times the absolute values; the formulas are for r = 1 and may be negative.",
    ),
    general_gamma: Some("y = sin β ẋ₀ + cos β ẋ₁."),
    measure,
};

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(50, 1000), effort.of(400_u32, 4000));
    let (mut spread, mut formula, mut vertex, mut middle) = (vec![], vec![], vec![], vec![]);
    let mut negative = 0;
    for sample in 0..orbits {
        let mut stream = Stream::new(230, sample);
        let gamma_squared = ALL[sample % 4];
        let radius = stream.between(0.1, 10.0);
        let circle = no_slip(tables::circle(radius), gamma_squared);
        let [v0, tau] = stream.in_disk();
        let n = libm::sqrt(1.0 - v0 * v0 - tau * tau);
        let orbit = bounces(&circle, state(radius, stream.between(0.0, TAU), v0, tau, n), collisions as usize);
        let other = next_tangential(gamma_squared, v0, tau);
        let [first, second] = [other, tau].map(|tau| (tau / libm::hypot(tau, n)).abs());
        negative += usize::from(tau < 0.0 || other < 0.0);
        for parity in [0, 1] {
            let caustics: Range = orbit.iter().skip(parity).step_by(2).map(|b| caustic(b) / radius).collect();
            spread.push(caustics.width());
            formula.push((caustics.max - [first, second][parity]).abs());
        }
        let direction = |i: usize| [orbit[i].state.v[1], orbit[i].state.v[2]];
        let cosines: Range = (1..orbit.len())
            .map(|i| {
                let ([a1, a2], [b1, b2]) = (direction(i - 1), direction(i));
                (a1 * b1 + a2 * b2) / libm::hypot(a1, a2) / libm::hypot(b1, b2)
            })
            .collect();
        vertex.push(cosines.width());
        // the point of a flight nearest to the centre is the middle: both ends are on the circle
        middle.extend(orbit.windows(2).map(|two| {
            let ([_, a1, a2], [_, b1, b2], [v1, v2]) = (two[0].state.x, two[1].state.x, direction(two[0].n - 1));
            ((0.5 * (a1 + b1)) * v1 + (0.5 * (a2 + b2)) * v2).abs() / libm::hypot(v1, v2) / radius
        }));
    }
    // the energy is kept by the normal velocity, whose rounding is an ulp or two per collision; directions of flights divide by a
    // planar speed that is 0.05 or so at the least
    let rounding = 40.0 * f64::EPSILON * f64::from(collisions);
    [
        Quantity::residual("spread of a caustic's radius / r", worst(spread), rounding),
        Quantity::residual("caustics / r against |r₁|, |r₂|, four values of γ", worst(formula), rounding),
        Quantity::residual("spread of the cosine of the vertex angle", worst(vertex), rounding),
        Quantity::residual("distance of the tangency from the midpoint of the flight / r", worst(middle), rounding),
        Quantity::at_least(
            "orbits for which a formula without | | is negative",
            negative as f64,
            0.25 * orbits as f64,
            0.0,
        ),
    ]
    .into()
}

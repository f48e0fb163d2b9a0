//! Whether the width of the strip's orbits is reached.
use super::strip_width::rounding;
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{UNIFORM, beta},
    motion::{State, bounces, distance, no_slip},
    random::Stream,
    statistics::{Range, least},
    strip::{centre, ladder},
};
use billiards::geometry::tables;
use core::f64::consts::PI;

pub(super) const CLAIM: Claim = Claim {
    name: "optimal-width",
    place: "after Proposition 2.4",
    statement: "The bound of Proposition 2.1 is optimal: orbits that are not vertical come as close to it as one likes. An orbit that reaches \
                it on one side turns back on itself there, and never reaches it on the other side.",
    verdict: Verdict::HoldsCorrected(
        "It holds with the correct bound: √3·ℓ in place of √(3/2)·ℓ, that is √3/2·ℓ from the middle to either side.",
    ),
    general_gamma: Some(
        "ℓ/(2 sin(β/2)) from the middle; reached on both sides if and only if β/π = p/q in lowest terms with p odd.",
    ),
    measure,
};

/// The farthest contact points on either side of the middle, over ℓ, of an orbit that turns back on itself at its first collision, and how far
/// the velocity after that is from minus the one before.
fn turning(gamma_squared: f64, sample: usize, collisions: usize) -> ([f64; 2], f64) {
    let strip = no_slip(tables::strip(1.0), gamma_squared);
    let steep = Stream::new(207, sample).between(0.3, 0.9);
    // towards the upper wall, which reverses (1, −γ) in the (x₀, x₁) plane: perpendicular to the lower wall's line of contacts
    let flat = libm::sqrt((1.0 - steep) * (1.0 + steep) / (1.0 + gamma_squared));
    let start = State { x: [0.0, 0.0, 0.5], v: [flat, -libm::sqrt(gamma_squared) * flat, steep] };
    let orbit = bounces(&strip, start, collisions);
    let (o, ell) = (centre(gamma_squared, &orbit[0], &orbit[1])[1], ladder(&start));
    let x1: Range = orbit.iter().map(|b| (b.state.x[1] - o) / ell).collect();
    ([-x1.min, x1.max], distance(orbit[0].state.v, start.v.map(|v| -v)))
}

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(10, 100), effort.of(4_000, 10_000_u32));
    let reach = 0.5 / libm::sin(0.5 * beta(UNIFORM));
    // contact points n hits after the turning point are at reach·cos(nβ)
    let other = least((0..collisions).map(|n| libm::cos(f64::from(n) * beta(UNIFORM))));
    let (mut near, mut far, mut back) = (Range::EMPTY, Range::EMPTY, Range::EMPTY);
    for sample in 0..orbits {
        let ([first, second], turned) = turning(UNIFORM, sample, collisions as usize);
        near.add(first);
        far.add(second);
        back.add(turned);
    }
    let rounding = rounding(f64::from(collisions));
    let mut quantities = vec![
        Quantity::residual("velocity after turning back, against its negative", back.max, 8.0 * f64::EPSILON),
        Quantity::equal("distance from the middle / ℓ on the side where it turns, least", near.min, reach, rounding),
        Quantity::equal("distance from the middle / ℓ on the side where it turns, greatest", near.max, reach, rounding),
        Quantity::equal("√3/2", reach, 0.5 * libm::sqrt(3.0), 4.0 * f64::EPSILON),
        Quantity::equal("distance on the other side / ℓ, greatest", far.max, -other * reach, rounding),
        // short of it by more than rounding explains
        Quantity::at_most("distance on the other side / ℓ, greatest, below √3/2", far.max, reach, -10.0 * rounding),
    ];
    // β = πp/q: the other side is reached for odd p
    for (p, q, expected) in [(1, 2, 1.0), (1, 3, 1.0), (2, 5, libm::cos(0.2 * PI))] {
        let gamma = libm::tan(0.5 * PI * f64::from(p) / f64::from(q));
        let ([first, second], _) = turning(gamma * gamma, 0, 100);
        let label = format!("β = {p}π/{q}: reach on the other side over that on the side where it turns");
        quantities.push(Quantity::equal(label, second / first, expected, rounding));
    }
    quantities.into()
}

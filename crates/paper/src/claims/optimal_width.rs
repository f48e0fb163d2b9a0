//! Whether the width of the strip's orbits is reached.
use super::strip_width::rounding;
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{UNIFORM, beta},
    motion::{State, bounces, distance, no_slip},
    random::Stream,
    statistics::Range,
    strip::{centre, ladder},
};
use billiards::geometry::tables;

pub(super) const CLAIM: Claim = Claim {
    name: "optimal-width",
    place: "after Proposition 2.4",
    statement: "The bound of Proposition 2.1 is optimal: orbits that are not vertical come as close to it as one likes. An orbit that reaches \
                it on one side turns back on itself there, and never reaches it on the other side.",
    verdict: Verdict::HoldsCorrected(
        "It holds with the right bound: √3·ℓ in place of √(3/2)·ℓ, √3/2·ℓ from the middle to either side.",
    ),
    general_gamma: Some(
        "ℓ/(2 sin(β/2)) from the middle; reached on both sides if and only if β/π = p/q in lowest terms with p + q odd.",
    ),
    measure,
};

fn measure(effort: Effort) -> Measurement {
    let (orbits, turns) = (effort.of(10, 100), effort.of(2_000, 5_000_u32));
    let strip = no_slip(tables::strip(1.0), UNIFORM);
    let gamma = libm::sqrt(UNIFORM);
    let reach = 0.5 / libm::sin(0.5 * beta(UNIFORM));
    // contact points n hits after the turning point: reach·cos(nβ) with sign (−1)ⁿ
    let other = (1..2 * turns)
        .map(|n| libm::cos(f64::from(n) * beta(UNIFORM)) * if n % 2 == 0 { 1.0 } else { -1.0 })
        .fold(1.0, f64::min);
    let (mut near, mut far, mut back) = (Range::EMPTY, Range::EMPTY, vec![]);
    for sample in 0..orbits {
        let mut stream = Stream::new(207, sample);
        // towards the upper wall, which reverses (1, −γ) in the (x₀, x₁) plane: perpendicular to its contact line
        let (steep, size) = (stream.between(0.3, 0.9), libm::sqrt(1.0 + UNIFORM));
        let flat = libm::sqrt(1.0 - steep * steep) / size;
        let start = State { x: [0.0, 0.0, 0.5], v: [flat, -gamma * flat, steep] };
        let orbit = bounces(&strip, start, 2 * turns as usize);
        back.push(distance(orbit[0].state.v, start.v.map(|v| -v)));
        let (o, ell) = (centre(UNIFORM, &orbit[0], &orbit[1])[1], ladder(&start));
        let x1: Range = orbit.iter().map(|b| (b.state.x[1] - o) / ell).collect();
        near.add(-x1.min);
        far.add(x1.max);
    }
    let rounding = rounding(2.0 * f64::from(turns));
    let turned = back.into_iter().fold(0.0, f64::max);
    [
        Quantity::residual("velocity after turning back, against its negative", turned, 8.0 * f64::EPSILON),
        Quantity::equal("distance from the middle / ℓ on the side where it turns, least", near.min, reach, rounding),
        Quantity::equal("distance from the middle / ℓ on the side where it turns, greatest", near.max, reach, rounding),
        Quantity::equal("√3/2", reach, 0.5 * libm::sqrt(3.0), 4.0 * f64::EPSILON),
        Quantity::equal("distance on the other side / ℓ, greatest", far.max, -other * reach, rounding),
        Quantity::at_most("distance on the other side / ℓ, greatest, below √3/2", far.max, reach * (1.0 - 1e-9), 0.0),
    ]
    .into()
}

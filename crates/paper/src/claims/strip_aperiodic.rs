//! Periodic orbits of the strip.
use super::strip_width::random_start;
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{UNIFORM, beta},
    motion::{State, bounces, distance, no_slip},
    random::Stream,
    statistics::{Range, least, worst},
};
use billiards::geometry::tables;

pub(super) const CLAIM: Claim = Claim {
    name: "strip-aperiodic",
    place: "Proposition 2.4",
    statement: "The strip has no periodic orbits but the vertical ones without spin, of period two, since S turns by \
                α = arccos(7/9), which is no rational multiple of π.",
    verdict: Verdict::HoldsCorrected(
        "α = arccos(−7/9) = 141.06°, which is 2β; the proof needs no other change than this sign.",
    ),
    general_gamma: Some("Orbits are periodic exactly if β/π is rational: see the claim strip-of-period-six."),
    measure,
};

fn measure(effort: Effort) -> Measurement {
    let (orbits, turns) = (effort.of(10, 100), effort.of(5_000_u32, 50_000));
    let strip = no_slip(tables::strip(1.0), UNIFORM);
    let alpha = libm::acos(-7.0 / 9.0);
    // after n turns the velocity is off by 2 |sin(nα/2)| of its part along the wall
    let expected = least((1..turns).map(|n| 2.0 * libm::sin(0.5 * alpha * f64::from(n)).abs()));
    let (mut angles, mut nearest) = (Range::EMPTY, Range::EMPTY);
    for sample in 0..orbits {
        let orbit = bounces(&strip, random_start(&mut Stream::new(206, sample)), 2 * turns as usize);
        let v = orbit[0].state.v;
        let (size, [w0, w1, _]) = (libm::hypot(v[0], v[1]), orbit[2].state.v);
        angles.add(libm::acos((v[0] * w0 + v[1] * w1) / (size * size)));
        let returns = orbit.iter().step_by(2).skip(1).map(|b| distance(v, b.state.v) / size);
        nearest.add(least(returns));
    }
    let vertical = bounces(&strip, State { x: [0.0, 0.25, 0.5], v: [0.0, 0.0, 1.0] }, 1000);
    let still =
        worst(vertical.windows(3).map(|w| distance(w[0].state.v, w[2].state.v) + distance(w[0].state.x, w[2].state.x)));
    // velocities turn by two roundings per collision, over |v along the wall| ≥ 0.14
    let rounding = 32.0 * f64::EPSILON * f64::from(turns);
    // an arccosine loses as much as its sine is less than 1, and the velocities are exact to a few ulp of 1/0.14²
    [
        Quantity::equal("α, least", angles.min, alpha, 1e-12),
        Quantity::equal("α, greatest", angles.max, alpha, 1e-12),
        Quantity::equal("α against 2β", alpha, 2.0 * beta(UNIFORM), 4.0 * f64::EPSILON),
        Quantity::differs("α against the paper's arccos(7/9)", angles.min, libm::acos(7.0 / 9.0), 1.0),
        Quantity::equal(
            format!("nearest return of a velocity in {turns} turns, least"),
            nearest.min,
            expected,
            rounding,
        ),
        Quantity::equal(
            format!("nearest return of a velocity in {turns} turns, greatest"),
            nearest.max,
            expected,
            rounding,
        ),
        Quantity::residual("vertical orbit without spin, two collisions apart", still, 0.0),
    ]
    .into()
}

//! The strips in which every orbit is periodic.
use super::strip_width::{random_start, rounding};
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{UNIFORM, beta},
    motion::{Bounce, bounces, distance, no_slip},
    random::Stream,
    statistics::worst,
};
use billiards::geometry::tables;
use core::f64::consts::PI;

pub(super) const CLAIM: Claim = Claim {
    name: "strip-of-period-six",
    place: "beyond the paper",
    statement: "All orbits of the strip are periodic if β/π = p/q is rational, with period 2q in lowest terms, and then the spin position returns \
                as well. The disk with γ² = 1/3 has β = π/3 and period 6, the hoop β = π/2 and period 4.",
    verdict: Verdict::Holds,
    general_gamma: Some("γ = tan(πp/2q)."),
    measure,
};

/// How far a collision is from another one, spin position included.
fn off(a: &Bounce, b: &Bounce) -> f64 {
    if a.piece == b.piece { distance(a.state.x, b.state.x) + distance(a.state.v, b.state.v) } else { f64::INFINITY }
}

fn measure(effort: Effort) -> Measurement {
    let orbits = effort.of(20, 1000);
    let mut quantities = vec![
        Quantity::equal("β for γ² = 1/3, over π", beta(1.0 / 3.0) / PI, 1.0 / 3.0, 4.0 * f64::EPSILON),
        Quantity::equal("β for the hoop, over π", beta(1.0) / PI, 0.5, 4.0 * f64::EPSILON),
    ];
    for (p, q) in [(1, 2_u32), (1, 3), (1, 4), (2, 5), (1, 7), (3, 8)] {
        let gamma = libm::tan(0.5 * PI * f64::from(p) / f64::from(q));
        let strip = no_slip(tables::strip(1.0), gamma * gamma);
        let period = 2 * q as usize;
        let (mut closed, mut early) = (vec![], f64::INFINITY);
        for sample in 0..orbits {
            let orbit = bounces(&strip, random_start(&mut Stream::new(210, sample)), 50 * period + 1);
            closed.push(off(&orbit[0], &orbit[50 * period]));
            early = (1..period).map(|n| off(&orbit[0], &orbit[n])).fold(early, f64::min);
        }
        // in places as far out as ℓ√(1+γ²)/γ, with ℓ up to 3.2 and γ down to tan(π/14) = 0.23
        let rounding = 15.0 * rounding(50.0 * period as f64);
        quantities.push(Quantity::residual(
            format!("β = {p}π/{q}: off after 50 periods of {period}"),
            worst(closed),
            rounding,
        ));
        // by the least turn of a velocity of 0.14 or more along the wall
        quantities.push(Quantity::at_least(
            format!("β = {p}π/{q}: nearest return before"),
            early,
            0.14 * libm::sin(PI / f64::from(q)),
            0.0,
        ));
    }
    let uniform = no_slip(tables::strip(1.0), UNIFORM);
    let orbit = bounces(&uniform, random_start(&mut Stream::new(210, 0)), 1000);
    let nearest = orbit.iter().skip(1).map(|b| off(&orbit[0], b)).fold(f64::INFINITY, f64::min);
    quantities.push(Quantity::at_least("uniform disk: nearest return in 1000 collisions", nearest, 1e-4, 0.0));
    quantities.into()
}

//! The strips in which every orbit is periodic.
use super::strip_width::{random_start, rounding};
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{UNIFORM, beta},
    motion::{Bounce, bounces, distance, no_slip},
    random::Stream,
    statistics::{Range, least, worst},
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
        let (mut closed, mut early) = (vec![], Range::EMPTY);
        for sample in 0..orbits {
            let orbit = bounces(&strip, random_start(&mut Stream::new(210, sample)), 50 * period + 1);
            closed.push(off(&orbit[0], &orbit[50 * period]));
            (1..period).for_each(|n| early.add(off(&orbit[0], &orbit[n])));
        }
        // in places as far out as ℓ√(1+γ²)/γ, with ℓ up to 3.2 and γ down to tan(π/14) = 0.23
        let rounding = 15.0 * rounding(50.0 * period as f64);
        quantities.push(Quantity::residual(
            format!("β = {p}π/{q}: deviation after 50 periods of {period}"),
            worst(closed),
            rounding,
        ));
        // by the least turn of a velocity of 0.14 or more along the wall
        quantities.push(Quantity::at_least(
            format!("β = {p}π/{q}: nearest return before that"),
            early.min,
            0.14 * libm::sin(PI / f64::from(q)),
            0.0,
        ));
    }
    let uniform = no_slip(tables::strip(1.0), UNIFORM);
    let orbit = bounces(&uniform, random_start(&mut Stream::new(210, 0)), 1000);
    let nearest = least(orbit.iter().skip(1).map(|b| off(&orbit[0], b)));
    // the velocity alone is off by 2 |sin kβ| of its part along the wall after 2k collisions
    let [v0, v1, _] = orbit[0].state.v;
    let turned = least((1..500_u32).map(|k| 2.0 * libm::sin(f64::from(k) * beta(UNIFORM)).abs()));
    quantities.push(Quantity::at_least(
        "uniform disk: nearest return in 1000 collisions",
        nearest,
        libm::hypot(v0, v1) * turned,
        rounding(1000.0),
    ));
    quantities.into()
}

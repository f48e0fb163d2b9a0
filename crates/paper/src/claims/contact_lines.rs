//! Where an orbit of the strip touches the walls.
use super::strip_width::{random_start, rounding};
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{ALL, UNIFORM, beta},
    motion::{bounces, no_slip},
    random::Stream,
    statistics::{Range, worst},
    strip::{contact_direction, cross, ladder, seen},
};
use billiards::geometry::tables;

pub(super) const CLAIM: Claim = Claim {
    name: "contact-lines",
    place: "proof of Proposition 2.1, Figure 7",
    statement: "Seen along x₂, all contact points of an orbit with one wall of a strip lie on a line, of slope dx₁/dx₀ = √2 for the upper wall and −√2 \
                for the lower one.",
    verdict: Verdict::HoldsCorrected(
        "True with the matrix T, that is, with x₀ counted clockwise (see the claim matrix-t); with equation (2.1) it is −√2 for the upper wall and √2 for the \
         lower one.",
    ),
    general_gamma: Some("The slopes are ±1/γ, so the lines cross at the angle β, bisected by the x₁ axis."),
    measure,
};

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(30, 300), effort.of(1000_u32, 3000));
    let rounding = rounding(f64::from(collisions));
    let mut quantities = vec![];
    for gamma_squared in ALL {
        let strip = no_slip(tables::strip(1.0), gamma_squared);
        let mut off = vec![];
        let mut slopes = [Range::EMPTY; 2];
        for sample in 0..orbits {
            let start = random_start(&mut Stream::new(202, sample));
            let orbit = bounces(&strip, start, collisions as usize);
            for piece in [0, 1] {
                let touches: Vec<_> = orbit.iter().filter(|b| b.piece == piece).map(seen).collect();
                let direction = contact_direction(gamma_squared, piece);
                let along = |p: [f64; 2]| p[0] * direction[0] + p[1] * direction[1];
                let by_place = |a: &&[f64; 2], b: &&[f64; 2]| along(**a).total_cmp(&along(**b));
                let (Some(low), Some(high)) = (touches.iter().min_by(by_place), touches.iter().max_by(by_place)) else {
                    continue;
                };
                slopes[piece].add((high[1] - low[1]) / (high[0] - low[0]));
                off.extend(
                    touches.iter().map(|p| cross([p[0] - low[0], p[1] - low[1]], direction).abs() / ladder(&start)),
                );
            }
        }
        let slope = 1.0 / libm::sqrt(gamma_squared);
        let label = |what: &str| format!("{what}, γ² = {gamma_squared}");
        quantities.extend([
            Quantity::equal(label("slope on the lower wall, least"), slopes[0].min, slope, slope * 4.0 * rounding),
            Quantity::equal(label("slope on the lower wall, greatest"), slopes[0].max, slope, slope * 4.0 * rounding),
            Quantity::equal(label("slope on the upper wall, least"), slopes[1].min, -slope, slope * 4.0 * rounding),
            Quantity::equal(label("slope on the upper wall, greatest"), slopes[1].max, -slope, slope * 4.0 * rounding),
            Quantity::residual(label("distance of contact points from their line, over ℓ"), worst(off), rounding),
        ]);
        if gamma_squared == UNIFORM {
            // the angle between the lines that the x₁ axis halves
            let angle = 2.0 * libm::atan2(1.0, slopes[0].max);
            quantities.push(Quantity::equal(
                "angle between the lines, bisected by the x₁ axis",
                angle,
                beta(UNIFORM),
                4.0 * rounding,
            ));
        }
    }
    quantities.into()
}

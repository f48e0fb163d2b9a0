//! The curve that the flights of the strip touch.
use super::strip_width::{random_start, rounding};
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{OTHERS, UNIFORM, beta, cos_beta, sin_beta},
    motion::{bounces, no_slip},
    random::Stream,
    statistics::worst,
    strip::{centre, cross, ladder, seen},
};
use billiards::{geometry::tables, observe::Moments};

pub(super) const CLAIM: Claim = Claim {
    name: "sliding-ladder",
    place: "proof of Proposition 2.1, Figure 8",
    statement: "Seen along x₂, the flights of an orbit in the strip are segments of the same length ℓ from one contact line to the other, \
                and lie in an astroid.",
    verdict: Verdict::HoldsCorrected(
        "The curve that the flights touch is a parallel curve of an astroid, at the distance (ℓ/2) cot β from it: its support function \
         about the crossing of the lines is h(φ) = ℓ/(2 sin β)·(cos 2φ + cos β). A ladder envelops an astroid if the lines are \
         perpendicular, which contact lines are only for γ = 1. No point of a flight is farther from the crossing than ℓ/sin β.",
    ),
    general_gamma: Some("As corrected, with the angle β between the lines; for γ = 1 it is an astroid."),
    measure,
};

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(30, 300), effort.of(1000_u32, 3000));
    let rounding = rounding(f64::from(collisions));
    let mut quantities = vec![];
    for gamma_squared in [UNIFORM, 1.0].into_iter().chain(OTHERS) {
        let strip = no_slip(tables::strip(1.0), gamma_squared);
        let (mut lengths, mut supports, mut far, mut constant) = (vec![], vec![], vec![], Moments::default());
        for sample in 0..orbits {
            let start = random_start(&mut Stream::new(203, sample));
            let ell = ladder(&start);
            let orbit = bounces(&strip, start, collisions as usize);
            let o = centre(gamma_squared, &orbit[0], &orbit[1]);
            for flight in orbit.windows(2) {
                let [p, q] = [&flight[0], &flight[1]].map(|b| {
                    let [x0, x1] = seen(b);
                    [(x0 - o[0]) / ell, (x1 - o[1]) / ell]
                });
                let along = [q[0] - p[0], q[1] - p[1]];
                let length = libm::hypot(along[0], along[1]);
                lengths.push((length - 1.0).abs());
                far.push(libm::hypot(p[0], p[1]).max(libm::hypot(q[0], q[1])) * sin_beta(gamma_squared));
                // the distance of its line from O, with the angle φ of the line's normal from the x₁ axis: along is normal
                // to it, so cos 2φ = (along₀² − along₁²)/|along|²
                let cos = (along[0] * along[0] - along[1] * along[1]) / (length * length);
                let distance = cross(p, along).abs() / length;
                let half = 0.5 / sin_beta(gamma_squared);
                supports.push((distance - half * (cos + cos_beta(gamma_squared)).abs()).abs());
                if cos + cos_beta(gamma_squared) > 0.0 {
                    constant.add(distance - half * cos);
                }
            }
        }
        let label = |what: &str| format!("{what}, γ² = {gamma_squared}");
        let parallel = 0.5 / libm::tan(beta(gamma_squared));
        quantities.extend([
            Quantity::residual(label("| length of a flight / ℓ − 1 |, greatest"), worst(lengths), rounding),
            Quantity::residual(label("support function / ℓ against the formula"), worst(supports), rounding),
            Quantity::at_most(label("distance from the crossing / (ℓ/sin β), greatest"), worst(far), 1.0, rounding),
            Quantity::equal(label("distance from an astroid / ℓ"), constant.mean().mean, parallel, rounding),
        ]);
        if gamma_squared == UNIFORM {
            quantities.push(Quantity::differs(
                "distance from an astroid / ℓ, against the paper's 0",
                constant.mean().mean,
                0.0,
                0.1,
            ));
        }
    }
    quantities.into()
}

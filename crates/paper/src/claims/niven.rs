//! Rational cosines of rational angles.
use crate::{Claim, Effort, Measurement, Quantity, Verdict, fractions::reduced_numerators, statistics::Range};
use core::f64::consts::TAU;

pub(super) const CLAIM: Claim = Claim {
    name: "niven",
    place: "Lemma 2.3",
    statement: "If θ is a rational multiple of π and cos θ is rational, then cos θ is 0, ±1/2 or ±1.",
    verdict: Verdict::Holds,
    general_gamma: None,
    measure,
};

fn measure(effort: Effort) -> Measurement {
    let most = effort.of(300, 3000);
    let (mut integers, mut nearest) = (vec![], Range::EMPTY);
    for q in 1..=most {
        for p in reduced_numerators(q) {
            let twice = 2.0 * libm::cos(TAU * f64::from(p) / f64::from(q));
            let gap = (twice - libm::round(twice)).abs();
            if q <= 6 && gap < 1e-12 {
                integers.push(libm::round(twice));
            } else {
                nearest.add(gap);
            }
        }
    }
    integers.sort_by(f64::total_cmp);
    // near an integer value a cosine goes like its angle, or its square near ±2: two angles differ by 1/(6 q) turns or more
    let apart = TAU / (6.0 * f64::from(most));
    [
        Quantity::count(
            "values of 2 cos θ that are integers (2 cos θ is an algebraic integer: rational only if an integer)",
            integers.len(),
            5,
        ),
        Quantity::residual(
            "2 cos θ against −2, −1, 0, 1, 2",
            integers.iter().zip(-2..).map(|(x, n)| (x - f64::from(n)).abs()).sum(),
            0.0,
        ),
        Quantity::at_least(
            format!("least distance of any other 2 cos(2πp/q), q ≤ {most}, from an integer"),
            nearest.min,
            apart * apart,
            0.0,
        ),
    ]
    .into()
}

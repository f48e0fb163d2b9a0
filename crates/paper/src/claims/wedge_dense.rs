//! Periodic wedge angles are dense.
use super::wedge_periods::reduced_period;
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::UNIFORM,
    motion::bounces,
    random::Stream,
    wedge::{billiard, bounded_start, delta, opening, period},
};
use core::f64::consts::PI;

pub(super) const CLAIM: Claim = Claim {
    name: "wedge-dense",
    place: "Corollary 2.2",
    statement: "The wedge angles for which all bounded orbits are periodic are dense in (0, π).",
    verdict: Verdict::HoldsCorrected("So they are not isolated, as the beginning of Section 2.2 calls them."),
    general_gamma: Some(
        "Holds for every γ > 0: δ is a continuous, increasing function of θ, and these angles are those with δ ∈ πℚ (derived; measured for γ² = 1/2).",
    ),
    measure,
};

/// The fraction with the least denominator in an open interval of (0, 1), by the Stern–Brocot tree.
fn simplest_between(low: f64, high: f64) -> (u32, u32) {
    let ((mut a, mut b), (mut c, mut d)) = ((0, 1), (1, 1));
    loop {
        let (p, q) = (a + c, b + d);
        let middle = f64::from(p) / f64::from(q);
        if middle <= low {
            (a, b) = (p, q);
        } else if middle >= high {
            (c, d) = (p, q);
        } else {
            return (p, q);
        }
    }
}

fn measure(effort: Effort) -> Measurement {
    let (angles, mut quantities) = (effort.of(30, 300), vec![]);
    for nearness in [0.1, 0.01, 0.001] {
        let (mut periodic, mut longest) = (0, 0);
        for sample in 0..angles {
            let mut stream = Stream::new(223, sample);
            let theta = stream.between(0.01, PI - 0.01);
            let [low, high] = [-nearness, nearness].map(|by| delta((theta + by).clamp(1e-4, PI - 1e-4), UNIFORM) / PI);
            let (p, q) = simplest_between(low, high);
            let near = opening(PI * f64::from(p) / f64::from(q), UNIFORM).unwrap_or(f64::NAN);
            // two orbits: any velocities in the cap have the same period
            let orbits = (0..2).map(|_| {
                bounces(&billiard(near, UNIFORM), bounded_start(near, UNIFORM, 0.9, &mut stream), 2 * period(q))
            });
            let all = orbits.into_iter().all(|orbit| reduced_period(&orbit, period(q)) == period(q));
            if all && (near - theta).abs() <= nearness {
                periodic += 1;
            }
            longest = longest.max(period(q));
        }
        quantities.push(Quantity::count(
            format!("random angles of {angles} with a periodic one within {nearness} (periods up to {longest})"),
            periodic,
            angles,
        ));
    }
    quantities.into()
}

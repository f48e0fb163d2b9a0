//! Repeated velocities in a wedge.
use super::wedge_periods::apart;
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{ALL, UNIFORM},
    motion::{Bounce, bounces},
    random::Stream,
    statistics::{Range, worst},
    wedge::{billiard, bounded_start, opening, period},
};
use core::f64::consts::PI;

pub(super) const CLAIM: Claim = Claim {
    name: "wedge-repeat",
    place: "Lemma 2.8",
    statement: "If two collision points of an orbit on the same wall of a wedge have identical velocities then they are the same point, and \
                the orbit is periodic.",
    verdict: Verdict::HoldsCorrected(
        "For (x₁, x₂), not for x₀. The proof is one line: the distance l from the apex times the normal velocity is the angular momentum \
         of the centre about the apex up to sign, which a flight keeps and a hit reverses; so l = I/(v·ν) is a function of the velocity.",
    ),
    general_gamma: Some(
        "Holds for every strict law, whatever γ: the invariant I uses only that the normal velocity is reversed.",
    ),
    measure,
};

fn measure(effort: Effort) -> Measurement {
    let (mut invariant, mut places, mut turned) = (vec![], vec![], vec![]);
    let collisions = effort.of(2000, 20_000);
    let periodic = opening(3.0 * PI / 8.0, UNIFORM).unwrap_or(f64::NAN);
    for sample in 0..effort.of(200, 2000) {
        let mut stream = Stream::new(226, sample);
        let gamma_squared = ALL[sample % 4];
        let theta = stream.between(0.3, 2.8);
        let start = bounded_start(theta, gamma_squared, 0.9, &mut stream);
        let orbit = bounces(&billiard(theta, gamma_squared), start, collisions);
        // a hit rounds place and normal velocity some ten times, by ulps of the speed, which count the more the less v·ν is
        let i = |k: usize| libm::hypot(orbit[k].state.x[1], orbit[k].state.x[2]) * orbit[k].normal_velocity();
        let least: Range = orbit.iter().map(Bounce::normal_velocity).collect();
        invariant.extend((0..orbit.len()).map(|k| (i(k) / i(0) - 1.0).abs() * least.min));

        // where velocities repeat every eight hits places do; spin positions do not, q being even
        let start = bounded_start(periodic, UNIFORM, 0.9, &mut stream);
        let orbit = bounces(&billiard(periodic, UNIFORM), start, 10 * period(8) + 1);
        let (first, last) = (&orbit[0], &orbit[orbit.len() - 1]);
        let least: Range = orbit.iter().map(Bounce::normal_velocity).collect();
        places.push(apart(first, last) * least.min * least.min);
        turned.push((first.state.x[0] - last.state.x[0]).abs());
    }
    turned.sort_by(f64::total_cmp);
    let label = format!("change of I = l (v·ν) in {collisions} collisions, over I / least v·ν");
    [
        Quantity::residual(label, worst(invariant), 16.0 * f64::EPSILON * collisions as f64),
        // l = I/(v·ν) magnifies the rounding of a velocity by 1/(v·ν)²
        Quantity::residual(
            "period-8 wedge: deviation in (x₁, x₂, v) after 10 periods, times least (v·ν)²",
            worst(places),
            80.0 * 16.0 * f64::EPSILON,
        ),
        Quantity::at_least("period-8 wedge: |Δx₀| after 10 periods, median", turned[turned.len() / 2], 1e-2, 0.0),
    ]
    .into()
}

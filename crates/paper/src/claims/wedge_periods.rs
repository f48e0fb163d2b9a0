//! Wedges in which every bounded orbit is periodic.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::UNIFORM,
    motion::{Bounce, bounces, distance},
    random::Stream,
    statistics::{Range, worst},
    wedge::{billiard, bounded_start, opening_of_turn},
};
use core::f64::consts::{FRAC_PI_3, PI, TAU};

pub(super) const CLAIM: Claim = Claim {
    name: "wedge-periods",
    place: "Corollary 2.1, Figures 9 and 12",
    statement: "For every n ≥ 2 (in the introduction, n ≥ 1) there is a wedge angle for which all bounded orbits, degenerate ones excepted, have period 2n: the one \
                for which S turns by α = π/n. Period 4 occurs at π/3, period 8 at 2.16598, period 10 at 0.2709.",
    verdict: Verdict::HoldsCorrected(
        "The angle must be α = 2πm/n with m coprime to n (α = π/n gives period 4n): θ = arccos(1/2 − (3/2) cos(πm/n)), which agrees \
         with the captions, m = 1 for π/3 and 2.16598, and m = 3, n = 5 for 0.2709. There is none for n = 1: α = 2π would need cos θ = 2. And 2n is the period in the reduced phase \
         space: with δ = πp/q in lowest terms, cos δ = cos(θ/2)/√(3/2), the spin position x₀ returns if and only if q is odd (for \
         m = 1: if n is), and drifts in each period otherwise.",
    ),
    general_gamma: Some(
        "With δ = πp/q in lowest terms the period is q (q even) or 2q (q odd), and x₀ returns if and only if q is odd.",
    ),
    measure,
};

/// The distance of two collisions in the reduced phase space, infinite on different walls.
pub(super) fn apart(a: &Bounce, b: &Bounce) -> f64 {
    let place = |bounce: &Bounce| [bounce.state.x[1], bounce.state.x[2]];
    if a.piece == b.piece { distance(place(a), place(b)) + distance(a.state.v, b.state.v) } else { f64::INFINITY }
}

/// The least `n ≤ most` such that the orbit is back in the reduced phase space after `n` collisions, and 0 if there is none.
pub(super) fn reduced_period(orbit: &[Bounce], most: usize) -> usize {
    // what returns is off by some ten ulps per collision over (v·ν)², below 1e-9 unless v·ν < 10⁻³; what does not is off by a turn of its
    // velocity, below 1e-9 only for a start as near to a shorter orbit
    (1..orbit.len().min(most + 1)).find(|n| apart(&orbit[0], &orbit[*n]) < 1e-9).unwrap_or(0)
}

/// What bounded orbits of a wedge do.
pub(super) struct Survey {
    orbits: usize,
    period: usize,
    /// How many of them have the period in the reduced phase space.
    periodic: usize,
    /// `|Δx₀|` in a period, in order.
    drifts: Vec<f64>,
    /// The greatest `|Δx₀|` in a period times the least `(v·ν)²` of the orbit: `l = I/(v·ν)` magnifies rounding by the inverse of that.
    rounded: f64,
}

impl Survey {
    pub(super) fn new(theta: f64, gamma_squared: f64, period: usize, orbits: usize) -> Survey {
        let wedge = billiard(theta, gamma_squared);
        let (mut periodic, mut drifts, mut rounded) = (0, vec![], vec![]);
        for sample in 0..orbits {
            let start = bounded_start(theta, gamma_squared, 0.95, &mut Stream::new(222, sample));
            let orbit = bounces(&wedge, start, 2 * period + 1);
            periodic += usize::from(reduced_period(&orbit, 2 * period) == period);
            let drift = (orbit[period].state.x[0] - orbit[0].state.x[0]).abs();
            let least: Range = orbit.iter().map(Bounce::normal_velocity).collect();
            drifts.push(drift);
            rounded.push(drift * least.min * least.min);
        }
        drifts.sort_by(f64::total_cmp);
        Survey { orbits, period, periodic, drifts, rounded: worst(rounded) }
    }

    /// The period of all orbits, and whether `x₀` returns.
    pub(super) fn quantities(&self, name: &str, returns: bool) -> [Quantity; 2] {
        let Survey { orbits, period, periodic, .. } = *self;
        let drift = if returns {
            // some ten roundings per collision
            let rounding = 16.0 * f64::EPSILON * period as f64;
            Quantity::residual(
                format!("{name}: greatest drift of x₀ in a period, times least (v·ν)²"),
                self.rounded,
                rounding,
            )
        } else {
            // a smooth function of the velocity that vanishes on the axis and on curves through it, and nowhere else
            Quantity::at_least(format!("{name}: median drift of x₀ in a period"), self.drifts[orbits / 2], 1e-4, 0.0)
        };
        [Quantity::count(format!("{name}: bounded orbits of period {period}, of {orbits}"), periodic, orbits), drift]
    }
}

fn measure(effort: Effort) -> Measurement {
    let orbits = effort.of(200, 5000);
    let mut quantities = vec![];
    let mut try_angle = |name: String, theta: f64, period: usize, returns: bool| {
        quantities.extend(Survey::new(theta, UNIFORM, period, orbits).quantities(&name, returns));
    };
    for n in 2..=9_u32 {
        let theta = opening_of_turn(2.0 * PI / f64::from(n)).unwrap_or(f64::NAN);
        try_angle(format!("α = 2π/{n}, θ = {theta:.5}"), theta, 2 * n as usize, n % 2 == 1);
    }
    for n in [3_u32, 5] {
        let theta = opening_of_turn(PI / f64::from(n)).unwrap_or(f64::NAN);
        try_angle(format!("α = π/{n}, θ = {theta:.5}"), theta, 4 * n as usize, false);
    }
    let tenfold = opening_of_turn(1.2 * PI).unwrap_or(f64::NAN);
    try_angle("Figure 9, α = 6π/5".into(), tenfold, 10, true);
    quantities.extend([
        Quantity::count("angles for n = 1", usize::from(opening_of_turn(TAU).is_some()), 0),
        // the paper's angles are given to that many digits
        Quantity::equal("θ for n = 2, against π/3", opening_of_turn(PI).unwrap_or(f64::NAN), FRAC_PI_3, 1e-15),
        Quantity::equal(
            "θ for n = 4, against the paper's",
            opening_of_turn(0.5 * PI).unwrap_or(f64::NAN),
            2.16598,
            5e-6,
        ),
        Quantity::equal("θ for α = 6π/5, against the paper's", tenfold, 0.2709, 5e-5),
    ]);
    quantities.into()
}

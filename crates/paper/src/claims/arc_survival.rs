//! Whether orbits stay on an arc.
use crate::{
    Claim, Effort, Measurement, Quantity, STANDARD_ERRORS, Verdict,
    circle::state,
    law::{UNIFORM, sin_beta},
    motion::{Billiard, fly, no_slip},
    random::Stream,
    statistics::standard_error_of_share,
};
use billiards::{geometry::tables, observe::Survival};
use core::{
    f64::consts::{FRAC_PI_2, PI, TAU},
    ops::ControlFlow,
};

pub(super) const CLAIM: Claim = Claim {
    name: "arc-survival",
    place: "Remark 2",
    statement: "For any boundary arc of an angle greater than π/2 there is a region of positive measure in phase space whose orbits keep their double \
                caustics, staying on the arc for ever.",
    verdict: Verdict::False(
        "The polar angle advances by 2(θ₁ + θ₂) per two hits, so an orbit leaves any arc of less than 2π unless θ₁ + θ₂ = 0 mod π: the period-two \
         orbits on a chord, a set of codimension one (or unless, on an arc of more than π, it visits finitely many points: measure zero). The share \
         of orbits still on an arc of angle Φ ≤ π after N hits falls as C/N with C = (2/(πΦ sin β)) ∫ (Φ−π+2θ)² (cos²θ + (1+1/γ²) sin²θ)⁻² dθ over \
         (π−Φ)/2 < θ < π/2; C = 0.0337 for Φ = π/2. On \
         larger arcs N times the share stays bounded too (measured for Φ = 1.5π and 1.95π). So the flower is not shown to be non-ergodic by this remark.",
    ),
    general_gamma: Some("As corrected."),
    measure,
};

/// `lim N · P(on an arc of angle `arc` for N hits)`, `arc ≤ π`, starts by the canonical measure of the arc.
///
/// Survivors have small `ε = 2(θ₁+θ₂)`. For a chord that spans `π − 2θ` of the arc, the shift `εN/2` has room for a total of
/// `arc − (π − 2θ)`; integrate over the place of the chord and over `τ`, with `|∂v₀/∂ε| = (n²+τ²)/(2 n sin β)` at `v₀ = −τ/γ`.
pub(super) fn limit(arc: f64, gamma_squared: f64) -> f64 {
    let a = 1.0 + 1.0 / gamma_squared;
    let (low, high) = (0.5 * (PI - arc), FRAC_PI_2);
    // Simpson's rule; the integrand is smooth
    let n = 1000;
    let sum: f64 = (0..=n)
        .map(|k| {
            let theta = low + (high - low) * f64::from(k) / f64::from(n);
            let (sin, cos) = libm::sincos(theta);
            let weight = if k == 0 || k == n {
                1.0
            } else if k % 2 == 1 {
                4.0
            } else {
                2.0
            };
            let (room, size) = (arc - PI + 2.0 * theta, cos * cos + a * sin * sin);
            weight * room * room / (size * size)
        })
        .sum();
    2.0 / (PI * arc * sin_beta(gamma_squared)) * sum * (high - low) / f64::from(3 * n)
}

/// How many hits an orbit makes on the arc before it leaves it, at most `most`.
fn hits_on_arc(circle: &Billiard, arc: f64, sample: usize, most: usize) -> usize {
    let mut stream = Stream::new(233, sample);
    let (phi, [v0, tau]) = (arc * stream.uniform(), stream.in_disk());
    let start = state(1.0, phi, v0, tau, libm::sqrt(1.0 - v0 * v0 - tau * tau));
    let mut hits = 0;
    fly(circle, start, most, &mut |bounce| {
        let angle = libm::atan2(bounce.state.x[2], bounce.state.x[1]);
        let angle = if angle < 0.0 { angle + TAU } else { angle };
        if angle > arc {
            return ControlFlow::Break(());
        }
        hits = bounce.n;
        ControlFlow::Continue(())
    });
    hits
}

/// Counts orbits that last for 50, 250, 1250 and 6250 hits, as far as `most`.
pub(super) fn survival(most: usize) -> Survival {
    Survival::at([50, 250, 1250, 6250].into_iter().filter(|n| *n <= most as u64))
}

/// How many of some orbits stay on the arc for how many hits.
fn survivors(arc: f64, gamma_squared: f64, samples: usize, most: usize) -> Survival {
    let circle = no_slip(tables::circle(1.0), gamma_squared);
    let mut survival = survival(most);
    for sample in 0..samples {
        survival.add(hits_on_arc(&circle, arc, sample, most) as u64);
    }
    survival
}

fn measure(effort: Effort) -> Measurement {
    let (samples, most) = (effort.of(400_000, 8_000_000), effort.of(250, 6250));
    let mut quantities = vec![];
    for (name, arc, gamma_squared) in
        [("π/2", FRAC_PI_2, UNIFORM), ("3π/4", 0.75 * PI, UNIFORM), ("π/2, γ² = 1", FRAC_PI_2, 1.0)]
    {
        let limit = limit(arc, gamma_squared);
        for (n, count) in survivors(arc, gamma_squared, samples, most).survivors() {
            let share = count as f64 / samples as f64;
            let (mean, error) = (share * n as f64, n as f64 * standard_error_of_share(limit / n as f64, samples));
            let label = format!("arc {name}: {n} × share still on the arc after {n} hits");
            // hits come in pairs, and small angles are small: corrections of relative size 2/n
            quantities.push(Quantity::sampled_near(label, mean, error, limit, 2.0 / n as f64 * limit));
        }
    }
    for (name, arc) in [("1.5π", 1.5 * PI), ("1.95π", 1.95 * PI)] {
        // more orbits stay than on shorter arcs
        let samples = samples / 8;
        let survivors: Vec<_> = survivors(arc, UNIFORM, samples, most).survivors().collect();
        let scaled = |(n, count): (u64, u64)| {
            let share = count as f64 / samples as f64;
            (n, share * n as f64, n as f64 * standard_error_of_share(share, samples))
        };
        for two in survivors.windows(2) {
            let [(before, more, a), (n, mean, b)] = [scaled(two[0]), scaled(two[1])];
            let label = format!("arc {name}: {n} × share still on the arc after {n} hits, not above that for {before}");
            // a share of orbits that stay for good would make it five times as much
            quantities.push(Quantity::at_most(label, mean, more, STANDARD_ERRORS * libm::hypot(a, b)));
        }
    }
    quantities.push(Quantity::equal("C for the arc π/2, uniform disk", limit(FRAC_PI_2, UNIFORM), 0.0337, 5e-5));
    quantities.into()
}

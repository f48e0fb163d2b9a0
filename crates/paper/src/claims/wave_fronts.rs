//! How fast wave fronts grow.
use crate::{
    Claim, Effort, Measurement, Quantity, STANDARD_ERRORS, Verdict,
    law::UNIFORM,
    motion::{Billiard, State, bounces, distance, no_slip, specular},
    random::Stream,
};
use billiards::{
    geometry::tables,
    observe::{Mean, Moments},
};
use core::f64::consts::{PI, TAU};

pub(super) const CLAIM: Claim = Claim {
    name: "wave-fronts",
    place: "Section 3.3, Figure 19",
    statement: "In channels with curved walls, convex or concave, fronts of no-slip disks grow too, but a greater curvature is needed for comparable growth after the \
                same number of collisions.",
    verdict: Verdict::Holds,
    general_gamma: Some(
        "As γ → 0 the growth tends to that of the smooth disk, but not always monotonically: between convex walls of sagitta 0.05 fronts grow less for γ² = 0.05 than for 1/2.",
    ),
    measure,
};

/// The mean of `ln(L/α)`, `L` the length of a short front after so many collisions, `α` the angle that it opens with, of disks that
/// start from a point of the middle line without spin.
fn growth(billiard: &Billiard, collisions: usize, samples: usize) -> Mean {
    let tiny = 1e-8;
    let mut logs = Moments::default();
    for sample in 0..samples {
        let mut stream = Stream::new(198, sample);
        let (x1, angle) = (stream.uniform(), PI * stream.between(0.15, 0.85));
        let at = |angle: f64| State { x: [0.0, x1, 0.5], v: [0.0, libm::cos(angle), libm::sin(angle)] };
        let [a, b] = [angle, angle + tiny].map(|angle| bounces(billiard, at(angle), collisions));
        let (Some(a), Some(b)) = (a.get(collisions - 1), b.get(collisions - 1)) else { continue };
        // neighbours hit the same wall, about a front's length apart, or across the edge of the cell
        let place = |s: &State| [libm::sin(TAU * s.x[1]) / TAU, libm::cos(TAU * s.x[1]) / TAU, s.x[2]];
        if a.piece == b.piece {
            logs.add(libm::log(distance(place(&a.state), place(&b.state)) / tiny));
        }
    }
    logs.mean()
}

fn measure(effort: Effort) -> Measurement {
    let (samples, collisions) = (effort.of(4000, 100_000), 6);
    let mut quantities = vec![];
    for (kind, sign) in [("convex", -1.0), ("concave", 1.0)] {
        let mut less: Option<(f64, Mean)> = None;
        for amount in [0.0, 0.05, 0.1, 0.2] {
            let channel = tables::channel(1.0, 1.0, sign * amount);
            let rough = growth(&no_slip(channel.clone(), UNIFORM), collisions, samples);
            let label = |what: &str| {
                format!(
                    "{kind} walls, sagitta {amount}: mean ln(length/opening angle) of a no-slip front after {collisions} hits, {what}"
                )
            };
            let within = |other: &Mean| STANDARD_ERRORS * libm::hypot(rough.standard_error, other.standard_error);
            if amount > 0.0 {
                let smooth = growth(&specular(channel.clone()), collisions, samples);
                let bound = -within(&smooth);
                quantities.push(Quantity::at_most(label("below a smooth one's"), rough.mean, smooth.mean, bound));
                // six hits mix a spin of 6β = 0.12 of the velocity in: less than sampling tells
                let light = growth(&no_slip(channel.clone(), 1e-4), collisions, samples);
                let error = STANDARD_ERRORS * libm::hypot(smooth.standard_error, light.standard_error);
                let label_of_light = label("γ² = 10⁻⁴, against a smooth one's");
                quantities.push(Quantity::equal(label_of_light, light.mean, smooth.mean, error));
                if (kind, amount) == ("convex", 0.05) {
                    let between = growth(&no_slip(channel, 0.05), collisions, samples);
                    let bound = -within(&between);
                    let label = label("that for γ² = 0.05 below it");
                    quantities.push(Quantity::at_most(label, between.mean, rough.mean, bound));
                }
            }
            if let Some((flatter, before)) = less {
                let bound = -within(&before);
                quantities.push(Quantity::at_least(
                    label(&format!("above that at {flatter}")),
                    rough.mean,
                    before.mean,
                    bound,
                ));
            }
            less = Some((amount, rough));
        }
    }
    quantities.into()
}

//! Small smooth perturbations of the pentagon.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    claim::STANDARD_ERRORS,
    law::UNIFORM,
    motion::{Billiard, State, bounces, canonical, distance, no_slip, specular},
    statistics::worst,
};
use billiards::geometry::tables;

pub(super) const CLAIM: Claim = Claim {
    name: "perturbed-pentagon",
    place: "Figure 21",
    statement: "Small C² perturbations of the regular pentagon keep the structure of its phase portrait, with parts of positive measure where the motion is regular.",
    verdict: Verdict::Holds,
    general_gamma: None,
    measure,
};

/// The share of orbits whose neighbours at 10⁻⁹ part no faster than linearly: their farthest distance in hits N to 2N is at most three
/// times that up to N. Twice is linear; half as much again allows for where in a turn the hits fall.
fn regular(billiard: &Billiard, orbits: usize, collisions: usize) -> f64 {
    let tiny = 1e-9;
    let is_regular = |start: &State| {
        let orbit = bounces(billiard, *start, 2 * collisions);
        let beside = State { v: start.v.map(|v| v + tiny), ..*start };
        let other = bounces(billiard, beside, 2 * collisions);
        let whole = orbit.len() == 2 * collisions && other.len() == 2 * collisions;
        let apart: Vec<f64> = orbit.iter().zip(&other).map(|(a, b)| distance(a.state.v, b.state.v)).collect();
        // what has grown to the size of the velocities cannot grow on
        whole && {
            let [early, late] = [&apart[..collisions], &apart[collisions..]].map(|part| worst(part.iter().copied()));
            late <= 3.0 * early && late < 1e-3
        }
    };
    (0..orbits).map(canonical(billiard, 199)).filter(is_regular).count() as f64 / orbits as f64
}

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(400, 4000), effort.of(500, 2000));
    let share = |billiard: &Billiard| regular(billiard, orbits, collisions);
    let label = |what: &str| {
        format!(
            "{what}: share of orbits whose neighbours part no faster than linearly in {collisions} hits and as many more"
        )
    };
    let unperturbed = share(&no_slip(tables::polygon(5, 1.0), UNIFORM));
    let mut quantities = vec![Quantity::at_least(label("pentagon"), unperturbed, 0.5, 0.0)];
    // the more bent the less is left; the control has none
    for amount in [0.005, 0.02] {
        let bent = share(&no_slip(tables::perturbed_polygon(5, 1.0, amount), UNIFORM));
        // a count of k² is k standard errors above none
        let certain = STANDARD_ERRORS * STANDARD_ERRORS / orbits as f64;
        quantities.push(Quantity::at_least(label(&format!("amount {amount}")), bent, certain, 0.0));
    }
    let chaotic = share(&specular(tables::sinai(1.0, 0.25)));
    quantities.push(Quantity::at_most(label("control, smooth disk on the Sinai table"), chaotic, 0.0, 0.0));
    quantities.into()
}

//! Small smooth perturbations of the pentagon.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::UNIFORM,
    motion::{Billiard, bounces, canonical_start, distance, no_slip},
    random::Stream,
};
use billiards::geometry::tables;

pub(super) const CLAIM: Claim = Claim {
    name: "perturbed-pentagon",
    place: "Figure 21",
    statement: "Small C² perturbations of the regular pentagon keep the structure of its phase portrait: parts of positive measure where the motion is regular.",
    verdict: Verdict::Holds,
    general_gamma: None,
    measure,
};

/// The share of orbits on which neighbours at 10⁻⁹ separate by less than a factor of `slow` in so many collisions.
fn regular(billiard: &Billiard, orbits: usize, collisions: usize, slow: f64) -> f64 {
    let tiny = 1e-9;
    let is_regular = |sample: &usize| {
        let mut start = canonical_start(billiard, &mut Stream::new(199, *sample));
        let orbit = bounces(billiard, start, collisions);
        start.v[0] += tiny;
        let other = bounces(billiard, start, collisions);
        let last = collisions - 1;
        let (Some(a), Some(b)) = (orbit.get(last), other.get(last)) else { return false };
        a.piece == b.piece && distance(a.state.v, b.state.v) < slow * tiny
    };
    (0..orbits).filter(is_regular).count() as f64 / orbits as f64
}

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(400, 4000), effort.of(500, 2000));
    let mut quantities = vec![];
    for amount in [0.0, 0.005, 0.02, 0.05] {
        let table = if amount == 0.0 { tables::polygon(5, 1.0) } else { tables::perturbed_polygon(5, 1.0, amount) };
        let share = regular(&no_slip(table, UNIFORM), orbits, collisions, 100.0 * collisions as f64);
        quantities.push(Quantity::at_least(
            format!(
                "amount {amount}: share of orbits whose neighbours part no faster than linearly in {collisions} hits"
            ),
            share,
            0.01,
            0.0,
        ));
    }
    quantities.into()
}

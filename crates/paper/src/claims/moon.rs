//! The moon is not ergodic.
use super::corner_components::{Corner, corner};
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{OTHERS, UNIFORM},
    statistics::worst,
};
use billiards::geometry::{Landing, Vector2, tables};

pub(super) const CLAIM: Claim = Claim {
    name: "moon",
    place: "Section 3.3, Figure 20",
    statement: "The no-slip moon does not appear to be ergodic.",
    verdict: Verdict::Holds,
    general_gamma: Some(
        "For every γ. Its two corners are less than π, and near such a corner between smooth sides there are always elliptic orbits of period two (proved by \
         Cox, Feres and Zhang). What starts near them stays, as in a straight corner. (Measured.)",
    ),
    measure,
};

/// How far from their corner points of the tangents are taken: orbits get two fifths as far, and a bit more.
const SIDE: f64 = 0.001;

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(20, 100), effort.of(2000, 20_000));
    let mut quantities = vec![];
    // the moon of the figure, with corners of 0.38π, and one with corners of 0.65π
    for distance in [1.0, 1.5] {
        let table = tables::moon(1.0, 0.75, distance).expect("a moon");
        let [outer, bite] = [0, 1].map(|piece| table.pieces()[piece].clone());
        let mut corners: Vec<Corner> = vec![];
        for (before, after) in [(&bite, &outer), (&outer, &bite)] {
            // the sides run along ν turned clockwise
            let along = |landing: Landing| Vector2::new(landing.normal.y, -landing.normal.x) * SIDE;
            let tip = after.point_at(0.0);
            let from = tip - along(before.landing_at(before.length()));
            let to = tip + along(after.landing_at(0.0));
            for gamma_squared in [UNIFORM, OTHERS[0], OTHERS[1], OTHERS[2]] {
                corners.push(corner(&table, gamma_squared, [from, tip, to], orbits, collisions, 200));
            }
        }
        // both walls are sides of a corner: an orbit that leaves tells by its distance only
        quantities.push(Quantity::count(
            format!("bite at {distance}: orbits of {} that end before {collisions} collisions", corners.len() * orbits),
            corners.iter().map(|corner| corner.left).sum(),
            0,
        ));
        quantities.push(Quantity::at_most(
            format!(
                "bite at {distance}: greatest distance from the corner over the bound I/sin(ρ−r) of straight sides"
            ),
            worst(corners.iter().map(|corner| corner.reach)),
            // no theorem: bent sides let orbits a little farther than straight ones, 1.3 times in the full sample; what leaves gets much farther
            2.0,
            0.0,
        ));
    }
    quantities.into()
}

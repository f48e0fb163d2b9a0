//! A gnat and a planet.

use billiards::collision_laws::bodies::Ball;
use billiards::collision_laws::laws::{NoSlip, Specular};
use billiards::collision_laws::{Body, CollisionLaw, Contact, Pair, Twist};
use billiards::geometry::Vector3;

use super::super::Effort;
use super::super::state::worse;
use super::{Entry, Tally};

pub(super) const ENTRY: Entry = Entry {
    name: "mass ratios",
    summary: "two balls with mass ratios 1e-12 ... 1e12: contact velocity and energy after the collision",
    run,
};

fn run(_: Effort) -> Result<Tally, Box<dyn std::error::Error>> {
    let mut tally = Tally { known: "contact velocity, energy", ..Tally::default() };
    for exponent in [-12, -6, 0, 6, 12] {
        let masses = [1.0, libm::pow(10.0, f64::from(exponent))];
        for angle in super::directions(20) {
            let (sin, cos) = libm::sincos(angle);
            let normal = Vector3::new(0.6 * cos, 0.6 * sin, 0.8);
            let [first, second] = [Ball::<3>::uniform(masses[0], 0.5)?, Ball::<3>::uniform(masses[1], 0.25)?];
            let contact = Contact::new(Vector3::zeros(), normal, 0)?;
            let pair = Pair::new(contact, (first, normal * -0.5), (second, normal * 0.25));
            let before = (
                Twist::spatial(normal * -1.0 + Vector3::new(sin, 0.3, cos), Vector3::new(0.3, cos, -0.7)),
                Twist::spatial(normal * 0.5 + Vector3::new(0.2, cos, sin), Vector3::new(sin, 0.1, 0.5)),
            );
            for rough in [false, true] {
                let off =
                    if rough { off(&pair, &NoSlip, &before, true) } else { off(&pair, &Specular, &before, false) };
                tally.collision(off);
            }
        }
    }
    Ok(tally)
}

/// The contact velocity must be reversed, all of it or its normal part, and the energy kept.
fn off(
    pair: &Pair<Ball<3>, Ball<3>, 3>,
    law: &impl CollisionLaw<3>,
    before: &(Twist<3>, Twist<3>),
    whole: bool,
) -> f64 {
    let normal = pair.contact.normal.into_inner();
    let after = pair.collide(law, before).velocities;
    let [u, u_after] = [before, &after].map(|v| pair.contact_velocity(v));
    let left = u + u_after;
    let reversed = if whole { left.norm() } else { left.dot(&normal).abs() } / u.norm();
    let energy = |v: &(Twist<3>, Twist<3>)| pair.first.kinetic_energy(&v.0) + pair.second.kinetic_energy(&v.1);
    worse(reversed, (energy(&after) / energy(before) - 1.0).abs())
}

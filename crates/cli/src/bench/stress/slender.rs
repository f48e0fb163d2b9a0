//! Bodies with hardly any rotational inertia: needles and rods beside a wall.

use billiards::collision_laws::bodies::{Inertia, RigidBody};
use billiards::collision_laws::laws::{NoSlip, RoughPlane, Specular};
use billiards::collision_laws::{Contact, Fixed, Pair, StrictLaw, Twist};
use nalgebra::{Matrix3, Vector3};

use super::super::Effort;
use super::super::state::worse;
use super::{Entry, Tally};

pub(super) const ENTRY: Entry = Entry {
    name: "slender bodies",
    summary: "moments of inertia 1, 1 and 1e-12 ... 1, and all three 1e-12 ... 1: contact velocity and energy after the collision, for every k",
    run,
};

fn run(_: Effort) -> Result<Tally, Box<dyn std::error::Error>> {
    let mut tally = Tally { known: "contact velocity, energy", ..Tally::default() };
    for exponent in [-12, -9, -6, -3, 0] {
        let small = libm::pow(10.0, f64::from(exponent));
        for angle in super::directions(20) {
            let (sin, cos) = libm::sincos(angle);
            let axis = Vector3::new(0.6 * cos, 0.6 * sin, 0.8);
            let rod = Matrix3::identity() - axis * axis.transpose() * (1.0 - small);
            for tensor in [rod, Matrix3::identity() * small] {
                let body = RigidBody::<3>::new(1.0, Inertia::Tensor(tensor))?;
                let contact = Contact::new(Vector3::zeros(), Vector3::new(0.0, -0.28, 0.96), 0)?;
                let pair = Pair::new(contact, (body, Vector3::new(0.3, sin, -0.7)), (Fixed, Vector3::zeros()));
                let before = (Twist::spatial(Vector3::new(sin, 0.3, -1.0), Vector3::new(0.3, cos, -0.7)), ());
                let combed = RoughPlane::new(&[Vector3::new(1.0, cos, 0.0)])?;
                tally.collision(off(&pair, &Specular, &before));
                tally.collision(off(&pair, &combed, &before));
                tally.collision(off(&pair, &NoSlip, &before));
            }
        }
    }
    Ok(tally)
}

/// The normal and the rough part of the contact velocity must be reversed, and the energy kept.
fn off(pair: &Pair<RigidBody<3>, Fixed, 3>, law: &impl StrictLaw<3>, before: &(Twist<3>, ())) -> f64 {
    let normal = pair.contact.normal;
    let after = pair.collide(law, before).velocities;
    let [u, u_after] = [before, &after].map(|v| pair.contact_velocity(v));
    let left = u + u_after;
    let pushes = law.roughness(&pair.contact).projector(&normal) + normal.as_ref() * normal.transpose();
    worse((pushes * left).norm() / u.norm(), (pair.kinetic_energy(&after) / pair.kinetic_energy(before) - 1.0).abs())
}

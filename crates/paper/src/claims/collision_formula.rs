//! The collision in vectors.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{ALL, cos_beta, sin_beta},
    random::Stream,
    statistics::worst,
};
use billiards::{
    collision_laws::{Contact, Fixed, Pair, bodies::Ball, laws::NoSlip},
    geometry::Vector2,
};

pub(super) const CLAIM: Claim = Claim {
    name: "collision-formula",
    place: "eq. (2.1)",
    statement: "With ν the inward normal and t = Jν, a uniform disk leaves a fixed wall with v₀⁺ = −v₀/3 + (2√2/3) v·t and \
                v⁺ = ((2√2/3) v₀ + (1/3) v·t) t − (v·ν) ν.",
    verdict: Verdict::HoldsCorrected("The v of the first line must be v⁻, the velocity before the collision."),
    general_gamma: Some("cos β and sin β in place of 1/3 and 2√2/3."),
    measure,
};

/// Against the law of rigid bodies: a disk and a wall as two bodies in contact, whose contact velocity is reversed.
fn measure(effort: Effort) -> Measurement {
    let (mut formula, mut contact, mut energy) = (vec![], vec![], vec![]);
    for sample in 0..effort.of(1000, 100_000) {
        let mut stream = Stream::new(208, sample);
        let gamma_squared = ALL[sample % 4];
        let (mass, radius) = (stream.between(0.1, 10.0), stream.between(0.1, 10.0));
        let disk = Ball::<2>::with_gamma_squared(mass, radius, gamma_squared).expect("a disk");
        let angle = stream.between(0.0, core::f64::consts::TAU);
        let nu = Vector2::new(libm::cos(angle), libm::sin(angle));
        let t = Vector2::new(-nu.y, nu.x);
        let [v0, v1, v2] = stream.on_sphere();
        let v = Vector2::new(v1, v2);

        let at_wall = Contact::new(Vector2::zeros(), nu, 0).expect("a normal");
        let pair = Pair::new(at_wall, (disk, -nu * radius), (Fixed, Vector2::zeros()));
        let before = (disk.with_scaled_spin(v, v0), ());
        let after = pair.collide(&NoSlip, &before).velocities;
        let (v0_after, v_after) = (disk.scaled_spin(&after.0), after.0.linear);

        let (c, s) = (cos_beta(gamma_squared), sin_beta(gamma_squared));
        let expected = t * (s * v0 + c * v.dot(&t)) - nu * v.dot(&nu);
        formula.push((v_after - expected).amax().max((v0_after + c * v0 - s * v.dot(&t)).abs()));
        contact.push((pair.contact_velocity(&before) + pair.contact_velocity(&after)).amax());
        energy.push((v0_after * v0_after + v_after.norm_squared() - 1.0).abs());
    }
    // some tens of roundings of velocities of size 1; a contact velocity is v + v₀/γ, up to four times as large
    let rounding = 32.0 * f64::EPSILON;
    [
        Quantity::residual("velocities of random disks at random walls, against the formula", worst(formula), rounding),
        Quantity::residual("contact velocity after, plus that before", worst(contact), 4.0 * rounding),
        Quantity::residual("change of energy, over energy", worst(energy), rounding),
    ]
    .into()
}

//! What does one no-slip collision do to a spinning disk?
//!
//! A uniform disk (γ² = 1/2) drops straight onto a floor, spinning. Expected: the contact velocity reverses, energy is kept,
//! and spin and tangential velocity mix by an angle β with cos β = 1/3, sin β = 2√2/3.
//! Reference: Cox and Feres, *No-slip billiards in dimension two*, equation (2.1).
use billiards::collision_laws::{Contact, Error, Fixed, Pair, bodies::Ball, laws::NoSlip};
use billiards::geometry::Vector2;

fn main() -> Result<(), Error> {
    // the floor pushes up; the centre of the disk is one radius above the contact
    let floor = Contact::new(Vector2::zeros(), Vector2::new(0.0, 1.0), 0)?;
    let disk = Ball::<2>::uniform(1.0, 0.25)?;
    let pair = Pair::new(floor, (disk, Vector2::new(0.0, -0.25)), (Fixed, Vector2::zeros()));

    let v0 = 0.6; // scaled spin γ R θ̇: the energy is (m/2)(v0² + v1² + v2²)
    let before = (disk.with_scaled_spin(Vector2::new(0.0, -0.8), v0), ());
    let collision = pair.try_collide(&NoSlip, &before)?;
    let (after, ()) = collision.velocities;

    let [v1, v2] = [after.linear.x, after.linear.y];
    println!("spin {v0} -> {:.6}, velocity (0, -0.8) -> ({v1:.6}, {v2:.6})", disk.scaled_spin(&after));
    println!("impulse {:.6?}", collision.impulse.as_slice());

    // v0⁺ = −cos β v0, and v·t = sin β v0 along t = J ν = (−1, 0)
    let (cos, sin) = (1.0 / 3.0, 2.0 * 2.0_f64.sqrt() / 3.0);
    let expected = [-cos * v0, -sin * v0, 0.8];
    let error = [disk.scaled_spin(&after), v1, v2].iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let energy = pair.kinetic_energy(&collision.velocities) / pair.kinetic_energy(&before);
    let reversed = (pair.contact_velocity(&collision.velocities) + collision.u_minus).norm();
    assert!(error < 1e-15 && (energy - 1.0).abs() < 1e-15 && reversed < 1e-15); // a few roundings
    Ok(())
}

//! Does a superball between two parallel planes stay near where it is thrown?
//!
//! Expected: yes, for every throw that is not parallel to the planes. The contact points of a uniform ball (γ² = 2/5) lie in a
//! region of diameter at most √(7/2) √((1 − s²)/v3² − 1) at unit speed and unit distance of the planes, with s the spin
//! about the normal, which never changes. Reference: Cox and Feres, *No-slip billiards in dimension two*, §3.2, made sharp.
use billiards::{
    Collision, Collisions, Conserved, Error, Orbit, Spatial, geometry::tables, laws::RoughBall, observe::Watch,
};
use std::ops::ControlFlow;

/// The diameter of the contact points of a thousand collisions.
fn diameter(velocity: [f64; 3], spin: [f64; 3]) -> Result<f64, Error> {
    let slab = Spatial { table: tables::slab(1.0)?, law: RoughBall::no_slip(0.4_f64.sqrt())? };
    let mut orbit = Orbit::<_, 3, 3, Conserved<_, 3>>::new([0.0; 3], velocity, spin, ());
    let mut contacts = vec![];
    let mut watch = Watch::new(|c: &Collision<'_, 3, 3, _, _>| {
        contacts.push([c.orbit.position[0], c.orbit.position[1]]);
        ControlFlow::Continue(())
    });
    slab.run(&mut orbit, &Collisions(1000), &mut watch);
    let pairs = contacts.iter().flat_map(|a| contacts.iter().map(move |b| libm::hypot(a[0] - b[0], a[1] - b[1])));
    Ok(pairs.fold(0.0, f64::max))
}

fn main() -> Result<(), Error> {
    // unit speed: 0.36² + 0.48² + 0.64² + 0.48² = 1; in the second throw the spin drives both directions alike
    let throws = [
        ([0.36, 0.48, 0.64], [0.0, 0.0, 0.48]),
        ([0.6, 0.0, 0.64], [0.0, 0.48, 0.0]),
        ([0.48, 0.0, 0.8], [0.36, 0.0, 0.0]),
    ];
    for (velocity, spin) in throws {
        let (v3, s): (f64, f64) = (velocity[2], spin[2]);
        let bound = 3.5_f64.sqrt() * ((1.0 - s * s) / (v3 * v3) - 1.0).sqrt();
        let diameter = diameter(velocity, spin)?;
        println!("thrown with {velocity:?} and spin {spin:?}: {diameter:.6} wide, bound {bound:.6}");
        assert!(diameter <= bound * (1.0 + 1e-12));
    }
    Ok(())
}

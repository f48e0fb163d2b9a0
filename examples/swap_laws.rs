//! What changes when only the law changes?
//!
//! The same disk in the same strip, once under the specular and once under the no-slip law. Expected: specular, it
//! travels |v1/v2| per collision for ever; no-slip, it never leaves an interval of width √3 √(1/v2² − 1) at unit speed.
//! Reference: Broomhead and Gutkin, *The dynamics of billiards with no-slip collisions* (1993), with the constant corrected.
use billiards::{
    BallLaw, Collision, Collisions, Conserved, Error, Orbit, Planar,
    collision_laws::laws::{NoSlip, Specular},
    geometry::{Table, tables},
    laws::Disk,
    observe::Watch,
};
use std::ops::ControlFlow;

/// The width of the interval of x1 that the orbit visits.
fn width(table: &Table, law: impl BallLaw<2, 1>) -> f64 {
    let billiard = Planar { table: table.clone(), law };
    let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>>::new([0.0, 0.5], [0.36, 0.8], [0.48], ());
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut watch = Watch::new(|c: &Collision<'_, 2, 1, _, _>| {
        low = low.min(c.orbit.position[0]);
        high = high.max(c.orbit.position[0]);
        ControlFlow::Continue(())
    });
    billiard.run(&mut orbit, &Collisions(100_000), &mut watch);
    high - low
}

fn main() -> Result<(), Error> {
    let strip = tables::strip(1.0)?;
    let gamma = 0.5_f64.sqrt(); // a uniform disk
    let specular = width(&strip, Disk::new(&Specular, gamma)?);
    let no_slip = width(&strip, Disk::new(&NoSlip, gamma)?);
    let bound = 3.0_f64.sqrt() * (1.0 / (0.8 * 0.8) - 1.0_f64).sqrt();
    println!("100 000 collisions: specular {specular:.1}, no-slip {no_slip:.9}, bound {bound:.9}");

    assert!((specular - 99_999.0 * 0.36 / 0.8).abs() < 1e-6);
    // the bound is sharp: the orbit comes as near to it as the square of the largest gap it leaves in an angle
    assert!(no_slip < bound && no_slip > bound * (1.0 - 1e-6));
    Ok(())
}

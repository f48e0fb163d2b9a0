//! Can a room in space be bounded by several shapes?
//!
//! A rounded brick and a ball in a can, and a rough ball in between. Expected: over the invariant measure the mean path between
//! collisions is 4V/S, for any room and any strict law. References: Santaló, *Integral geometry and geometric probability*; volume
//! and area of the brick by Steiner's formula.
use billiards::{
    Billiard, CanonicalSpatial, Collisions, Ensemble, Starts,
    geometry::{
        parry::{Room, Side, SolidSpec},
        walls::ByLane,
    },
    laws::RoughBall,
    observe::FreePath,
    run,
};
use core::f64::consts::PI;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let can = SolidSpec::Cylinder { radius: 2.0, height: 3.0, rounding: 0.0 };
    let brick = SolidSpec::Cuboid { size: [0.5, 1.0, 0.25], rounding: 0.125 };
    let ball = SolidSpec::Ball { radius: 0.5 };
    let room = Room::new(vec![
        can.solid([0.0; 3], Side::Inside)?,
        brick.solid([-0.75, 0.25, 0.5], Side::Outside)?,
        ball.solid([0.75, 0.0, -0.5], Side::Outside)?,
    ]);

    // a uniform ball that does not slip; where it starts is drawn uniformly from all walls
    let law = RoughBall::no_slip(0.4_f64.sqrt())?;
    let billiard = Billiard { walls: &ByLane(&room), law: &law };
    let canonical = CanonicalSpatial::new(room.surface()?, 1.0, 1)?;
    // one flight of each of 20 000 orbits, after five collisions
    let paths = Ensemble::of(20_000).run(FreePath::<3, 3>::new, |i, paths| {
        let mut orbit = canonical.start(i).orbit::<(), ()>(());
        run(&billiard, &mut orbit, &Collisions(5), &mut ());
        paths.follow(&orbit);
        run(&billiard, &mut orbit, &Collisions(1), paths);
    });

    let sphere = |r: f64| [4.0 / 3.0 * PI * r * r * r, 4.0 * PI * r * r];
    let ([inner, skin], r) = ([0.125, 1.75], 0.125);
    let bend = PI * (0.5 + 1.0 + 0.25); // the integral of the brick's mean curvature
    let volume = 12.0 * PI - (inner + skin * r + bend * r * r + sphere(r)[0]) - sphere(0.5)[0];
    let area = 20.0 * PI + (skin + 2.0 * bend * r + sphere(r)[1]) + sphere(0.5)[1];
    let (length, expected) = (paths.length(), 4.0 * volume / area);
    println!("mean path between collisions: {:.4}, standard error {:.4}", length.mean, length.standard_error);
    println!("4 volume/area:                {expected:.4}");
    assert!((length.mean - expected).abs() < 5.0 * length.standard_error);
    Ok(())
}

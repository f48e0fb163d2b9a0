//! Can the table be any shape?
//!
//! Two shapes of parry, a rectangle and in it a tilted obstacle with rounded corners, make a table of exact segments and
//! arcs. Expected: over the invariant measure the mean time between collisions is 4A/P at unit speed, for any shape and
//! any strict law. Reference: Santaló, *Integral geometry and geometric probability*; spin makes π into 4.
use billiards::{
    Canonical, Collisions, Ensemble, Orbit, Planar, Starts,
    collision_laws::laws::NoSlip,
    geometry::{
        Table,
        parry::{
            Side,
            parry2d_f64::shape::{Cuboid, RoundShape},
            pieces,
        },
    },
    laws::Disk,
    observe::FreePath,
};
use nalgebra::{Isometry2, Vector2};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let room = Cuboid::new([2.0, 1.0].into());
    let obstacle = RoundShape { inner_shape: Cuboid::new([0.5, 0.25].into()), border_radius: 0.125 };
    let mut boundary = pieces(&room, &Isometry2::identity(), Side::Inside)?;
    boundary.extend(pieces(&obstacle, &Isometry2::new(Vector2::new(0.25, -0.125), 0.5), Side::Outside)?);
    let table = Table::new(boundary)?;

    let billiard = Planar { table: table.clone(), law: Disk::new(&NoSlip, 0.5_f64.sqrt())? };
    let canonical = Canonical::new(&table, 1.0, 1)?;
    // one flight of each of 20 000 orbits, after five collisions
    let paths = Ensemble::of(20_000).run(FreePath::new, |i, paths| {
        let start = canonical.start(i);
        let mut orbit = Orbit::<_, 2, 1>::new(start.position, start.velocity, start.spin, ());
        billiard.run(&mut orbit, &Collisions(5), &mut ());
        paths.follow(&orbit);
        billiard.run(&mut orbit, &Collisions(1), paths);
    });

    let (time, expected) = (paths.time(), 4.0 * table.area() / table.perimeter());
    println!("{} pieces, area {:.6}, perimeter {:.6}", table.pieces().len(), table.area(), table.perimeter());
    println!("mean free time {:.5} ± {:.5}, expected {expected:.5}", time.mean, time.standard_error);
    assert!((time.mean - expected).abs() < 5.0 * time.standard_error); // a false alarm once in two million seeds
    Ok(())
}

//! What does a no-slip orbit look like in velocity phase space?
//!
//! In a polygon an orbit draws closed curves around the points of a periodic one, and visits few cells of the disk of velocities
//! (v0, v·t), however long it runs. In a square with a scattering disk an orbit goes nearly everywhere. Expected: below 20 % of the cells
//! in an isosceles triangle, above 90 % with the scattering disk.
//! Reference: Cox and Feres, *No-slip billiards in dimension two*, section on phase portraits.
use billiards::{
    Collisions, Conserved, Error, Orbit, Planar,
    collision_laws::laws::NoSlip,
    geometry::{Table, tables},
    laws::Disk,
    observe::{Density, VelocityPortrait},
};

const SIZE: usize = 48;

/// Draws the portrait of an orbit, v·t upwards over v0, and returns the share of the disk that it visits.
fn portrait(table: Table) -> Result<f64, Error> {
    let billiard = Planar { table, law: Disk::new(&NoSlip, 0.5_f64.sqrt())? };
    let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>>::new([0.1, 0.2], [0.6, 0.3], [0.1], ());
    let mut portrait = VelocityPortrait::new(Density::disk(SIZE));
    billiard.run(&mut orbit, &Collisions(200_000), &mut portrait);

    let counts = portrait.into_points().counts(0);
    for rows in counts.chunks(2 * SIZE).rev() {
        let (low, high) = rows.split_at(SIZE); // a character is about two cells high
        println!("{}", low.iter().zip(high).map(|(a, b)| if a + b > 0 { '*' } else { '.' }).collect::<String>());
    }
    let middle = |i: usize| (i as f64 + 0.5) / SIZE as f64 * 2.0 - 1.0;
    let in_disk = |(cell, _): &(usize, &u64)| libm::hypot(middle(cell % SIZE), middle(cell / SIZE)) < 1.0;
    let (visited, all) = counts
        .iter()
        .enumerate()
        .filter(in_disk)
        .fold((0.0, 0.0), |(visited, all), (_, &n)| (if n > 0 { visited + 1.0 } else { visited }, all + 1.0));
    println!("{:.1} % of the disk\n", 100.0 * visited / all);
    Ok(visited / all)
}

fn main() -> Result<(), Error> {
    let triangle = portrait(tables::isosceles(1.0, 1.25)?)?;
    let sinai = portrait(tables::sinai(1.0, 0.25)?)?;
    assert!(triangle < 0.2 && sinai > 0.9);
    Ok(())
}

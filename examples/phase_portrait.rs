//! What does a no-slip orbit look like in velocity phase space?
//!
//! In a polygon an orbit draws closed curves around periodic points: of the disk of velocities (v0, v·t) it visits few cells,
//! however long it runs. Under the specular law v0 never changes at all. A scattering disk in the same square spreads the
//! no-slip orbit over most of the disk. Expected: below 10 % of the cells, and above 50 %.
//! Reference: Cox and Feres, *No-slip billiards in dimension two*, Figures 3 and 17.
use billiards::{
    Collisions, Conserved, Orbit, Planar,
    collision_laws::laws::NoSlip,
    geometry::{Error, Table, tables},
    laws::Disk,
    observe::{Density, VelocityPortrait},
};

const SIZE: usize = 48;

fn portrait(table: Table) -> Density {
    let billiard = Planar { table, law: Disk::new(&NoSlip, 0.5_f64.sqrt()) };
    let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>>::new([0.1, 0.2], [0.6, 0.3], [0.1], ());
    let mut portrait = VelocityPortrait::new(Density::disk(SIZE));
    billiard.run(&mut orbit, &Collisions(200_000), &mut portrait);
    portrait.into_points()
}

/// Draws the portrait, v·t upwards over v0, and returns the share of the disk that was visited.
fn draw(density: &Density) -> f64 {
    for row in density.counts().chunks(SIZE).rev().step_by(2) {
        println!("{}", row.iter().map(|&count| if count > 0 { '*' } else { '.' }).collect::<String>());
    }
    let visited = density.counts().iter().filter(|&&count| count > 0).count() as f64;
    visited / (core::f64::consts::PI / 4.0 * (SIZE * SIZE) as f64)
}

fn main() -> Result<(), Error> {
    let square = draw(&portrait(tables::square(1.0)?));
    println!("square: {:.1} % of the disk\n", 100.0 * square);
    let sinai = draw(&portrait(tables::sinai(1.0, 0.25)?));
    println!("square with a scattering disk: {:.1} % of the disk", 100.0 * sinai);
    assert!(square < 0.1 && sinai > 0.5);
    Ok(())
}

//! How do I add a collision law of my own?
//!
//! A floor of rough and smooth tiles: one type, one function that says which directions are rough at a contact.
//! Expected: on each kind of tile this is a strict law: it keeps energy and momenta, is its own inverse, and preserves the billiard
//! measure, whatever the pattern. Reference: Cox, Feres and Ward, arXiv:1501.06536, and `collision_laws::check`.
use billiards::{
    Collisions, Orbit, Planar, Stop,
    collision_laws::{
        Contact, Fixed, Pair, Roughness, StrictLaw,
        bodies::Ball,
        check::{self, Samples},
    },
    geometry::{Vector2, tables},
    laws::Custom,
    observe::EnergyDrift,
};

/// Rough on every other tile of the boundary, smooth between.
struct Tiles {
    width: f64,
}

impl StrictLaw<2> for Tiles {
    fn roughness(&self, contact: &Contact<2>) -> Roughness<2> {
        let tile = (contact.point.x / self.width).floor();
        if tile.rem_euclid(2.0) == 0.0 { Roughness::Rough } else { Roughness::Smooth }
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // the axioms, tried on random velocities at a contact on a tile of each kind
    let disk = Ball::<2>::uniform(1.0, 1.0)?;
    for (x, rank) in [(0.05, 1), (0.15, 0)] {
        let contact = Contact::new(Vector2::new(x, 0.0), Vector2::new(0.0, 1.0), 0)?;
        assert_eq!(Tiles { width: 0.1 }.roughness(&contact).rank(), rank);
        let pair = Pair::new(contact, (disk, Vector2::new(0.0, -1.0)), (Fixed, Vector2::zeros()));
        let report = check::law(&pair, &Tiles { width: 0.1 }, Samples::default());
        print!("at x = {x}:\n{report}");
        assert!(report.is_strict(check::TOLERANCE));
    }

    // the law in a table
    let law = Custom::disk(Tiles { width: 0.1 }, 0.5_f64.sqrt())?;
    let stadium = Planar { table: tables::stadium(1.0, 1.0)?, law };
    let mut orbit = Orbit::<_, 2, 1>::new([0.1, 0.2], [0.6, 0.3], [0.4], ());
    let mut drift = EnergyDrift::of(&orbit);
    let outcome = stadium.run(&mut orbit, &Collisions(10_000), &mut drift);
    println!("{} collisions, energy kept to {:.1e}", outcome.collisions, drift.largest());

    assert_eq!(outcome.stop, Stop::Finished);
    assert!(drift.largest() < 1e-11); // a few roundings per collision
    Ok(())
}

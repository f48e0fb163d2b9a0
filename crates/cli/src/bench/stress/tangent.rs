//! Arcs that nearly touch, or do.

use billiards::geometry::shapes::Circle;
use billiards::geometry::{Table, Vector2, tables};

use super::super::Effort;
use super::super::law::Law;
use super::{Entry, Tally, Trial, directions, start};

pub(super) const GAPS: Entry = Entry {
    name: "narrow gaps",
    summary: "a square with a disk that leaves gaps of 1e-9 on each side",
    run: |effort| Ok(on(&tables::sinai(1.0, 0.5 - 1e-9)?, [0.03, 0.04], effort)),
};

pub(super) const HORNS: Entry = Entry {
    name: "thin horns",
    summary: "a moon whose arcs meet at an angle of 1e-4 rad",
    run: |effort| Ok(on(&tables::moon(1.0, 0.5, 0.5 + 1e-8)?, [-0.5, 0.1], effort)),
};

pub(super) const CUSP: Entry = Entry {
    name: "cusp",
    summary: "between two circles, one touching the other from inside",
    run: |effort| {
        let outer = Circle::new(Vector2::zeros(), 1.0, true)?;
        let inner = Circle::new(Vector2::new(0.5, 0.0), 0.5, false)?;
        Ok(on(&Table::new(vec![Box::new(outer), Box::new(inner)])?, [0.0, 0.7], effort))
    },
};

fn on(table: &Table, from: [f64; 2], effort: Effort) -> Tally {
    let collisions = if effort == Effort::Quick { 1000 } else { 100_000 };
    let mut tally = Tally::default();
    for law in [Law::NoSlip, Law::Specular] {
        let starts: Vec<_> = directions(64).map(|angle| start(from, angle)).collect();
        tally.join(Trial { table, law: law.planar(), collisions, open: false }.run(&starts));
    }
    tally
}

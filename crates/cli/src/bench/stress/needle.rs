//! A triangle like a needle.

use billiards::geometry::tables;

use super::super::Effort;
use super::super::law::Law;
use super::{Entry, Tally, Trial, directions, start};

pub(super) const ENTRY: Entry =
    Entry { name: "needle", summary: "an isosceles triangle of base 1e-6 and height 1", run };

fn run(effort: Effort) -> Result<Tally, Box<dyn std::error::Error>> {
    let table = tables::isosceles(1e-6, 1.0)?;
    let collisions = if effort == Effort::Quick { 10_000 } else { 100_000 };
    let mut tally = Tally::default();
    for law in [Law::NoSlip, Law::Specular] {
        let starts: Vec<_> = directions(16).map(|angle| start([0.0, 0.5], angle)).collect();
        tally.join(Trial { table: &table, law: law.planar(), collisions, open: false }.run(&starts));
    }
    Ok(tally)
}

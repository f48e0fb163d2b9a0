//! An outline of a million pieces.

use billiards::geometry::tables;

use super::super::Effort;
use super::super::law::Law;
use super::{Entry, Tally, Trial, directions, start};

pub(super) const ENTRY: Entry = Entry {
    name: "a million pieces",
    summary: "a regular polygon with 1e6 sides (--quick 1e5): built, validated and played on",
    run,
};

fn run(effort: Effort) -> Result<Tally, Box<dyn std::error::Error>> {
    let (sides, collisions) = if effort == Effort::Quick { (100_000, 3) } else { (1_000_000, 10) };
    let table = tables::polygon(sides, 1.0)?;
    table.validate()?;
    let radius = table.extent().max.x;
    let starts: Vec<_> = directions(4).map(|angle| start([0.1 * radius, 0.2 * radius], angle)).collect();
    Ok(Trial { table: &table, law: Law::NoSlip.planar(), collisions, open: false }.run(&starts))
}

//! An outline of a million pieces.

use billiards::geometry::{Line, Table, Vector2, Walls, WithWalls, tables};

use super::super::Effort;
use super::super::law::Law;
use super::{Entry, Tally, Trial, directions, start};

pub(super) const ENTRY: Entry = Entry {
    name: "a million pieces",
    summary: "a polygon with 1e6 sides (--quick 1e5): built, validated, run, and first hits compared with a search of all sides",
    run,
};

fn run(effort: Effort) -> Result<Tally, Box<dyn std::error::Error>> {
    let (sides, collisions) = if effort == Effort::Quick { (100_000, 3) } else { (1_000_000, 10) };
    let table = tables::polygon(sides, 1.0)?;
    table.validate()?;
    let radius = table.extent().max.x;
    let starts: Vec<_> = directions(4).map(|angle| start([0.1 * radius, 0.2 * radius], angle)).collect();
    let mut tally = Trial { table: &table, law: Law::NoSlip.planar(), collisions, open: false }.run(&starts);
    tally.lost += table.with_walls(AskAll { table: &table, from: Vector2::new(0.1, 0.2) * radius });
    Ok(tally)
}

/// How many paths have another first hit than the one found by testing every piece: paths at vertices, along the axes and
/// in other directions, each starting where the last one ends.
struct AskAll<'a> {
    table: &'a Table,
    from: Vector2<f64>,
}

impl WithWalls<2> for AskAll<'_> {
    type Output = u64;
    fn run<W: Walls<2>>(self, walls: &W) -> u64 {
        let AskAll { table, mut from } = self;
        let pieces = table.pieces();
        let mut wrong = 0;
        for (k, angle) in directions(32).enumerate() {
            let velocity = match k % 4 {
                0 => pieces[k * pieces.len() / 32].point_at(0.0) - from,
                1 => Vector2::new(if from.x > 0.0 { -1.0 } else { 1.0 }, 0.0),
                2 => Vector2::new(-0.0, if from.y > 0.0 { -1.0 } else { 1.0 }),
                _ => Vector2::new(libm::cos(angle), libm::sin(angle)),
            };
            let path = Line { point: from, velocity };
            let times = pieces.iter().map(|piece| piece.crossing(&path).time()).enumerate();
            let first = times.fold((0, f64::INFINITY), |first, other| if other.1 < first.1 { other } else { first });
            let found = walls.hit(&path).map_or((0, f64::INFINITY), |hit| (hit.piece, hit.time));
            wrong += u64::from((found.0, found.1.to_bits()) != (first.0, first.1.to_bits()));
            if first.1 < f64::INFINITY {
                from = pieces[first.0].landing(&path, first.1).point;
            }
        }
        wrong
    }
}

//! The largest disk in a table against a search of every place.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]

use geometry::{
    Lattice, Outline, Piece, Table, Vector2,
    shapes::{Circle, FullLine, Ray},
    tables,
};
use proptest::prelude::*;

fn v(x: f64, y: f64) -> Vector2<f64> {
    Vector2::new(x, y)
}

fn disks(at: &[(f64, f64, f64)]) -> impl Iterator<Item = Box<dyn Piece>> {
    at.iter().map(|&(x, y, r)| Box::new(Circle::new(v(x, y), r, false).unwrap()) as Box<dyn Piece>)
}

/// No place of so many by so many in a box is farther from all walls, but for what may be another place as good.
fn has_no_larger(table: &Table, low: Vector2<f64>, sides: [Vector2<f64>; 2], name: &str) {
    let disk = table.largest_disk();
    let count = 150;
    for i in 0..count {
        for k in 0..count {
            let [a, b] = [i, k].map(|k| (f64::from(k) + 0.5) / f64::from(count));
            let place = low + sides[0] * a + sides[1] * b;
            let distance = table.signed_distance(&place);
            assert!(distance <= disk.radius * (1.0 + 1.0 / 1024.0), "{name}: {place} is {distance} off, not {disk:?}");
        }
    }
    let there = table.signed_distance(&disk.center);
    assert!((there - disk.radius).abs() <= 1e-14 * disk.center.amax().max(disk.radius), "{name}: {there}, {disk:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(25))]

    #[test]
    fn no_place_of_a_room_is_farther_from_its_walls(
        width in 1.0..6.0, height in 1.0..6.0, far in prop_oneof![Just(0.0), -30.0..30.0_f64],
        at in prop::collection::vec((0.0..1.0, 0.0..1.0, 0.02..0.3), 0..5),
    ) {
        let corners = [v(far, 0.0), v(far + width, 0.3), v(far + width, height), v(far - 0.2, height)];
        let outline = Outline::from(corners[0]);
        let around = corners[1..].iter().chain(&corners[..1]);
        let outline = around.fold(outline, |outline, &corner| outline.line_to(corner).unwrap());
        let at: Vec<_> = at.into_iter().map(|(x, y, r)| (far + x * width, 0.3 + y * (height - 0.3), r)).collect();
        let table = Table::new(outline.close().unwrap().into_iter().chain(disks(&at)).collect()).unwrap();
        // disks may lie across walls: distances are the same
        prop_assume!(table.validate().is_ok());
        has_no_larger(&table, v(far - 0.2, 0.0), [v(width + 0.2, 0.0), v(0.0, height)], "room");
    }

    #[test]
    fn no_place_of_a_torus_is_farther_from_its_disks(
        skew in -8.0..8.0, height in 0.3..3.0,
        at in prop::collection::vec((0.0..1.0, 0.0..1.0, 0.02..0.2), 1..4),
    ) {
        let cell = [v(1.0, 0.0), v(skew, height)];
        let at: Vec<_> = at.into_iter().map(|(a, b, r)| (a + b * skew, b * height, r)).collect();
        let table = Table::periodic(disks(&at).collect(), Some(Lattice::new(&cell).unwrap())).unwrap();
        prop_assume!(table.validate().is_ok());
        has_no_larger(&table, v(0.0, 0.0), cell, "torus");
    }

    #[test]
    fn no_place_of_a_channel_is_farther_from_its_walls(
        length in 0.5..4.0, slope in -1.0..1.0, at in prop::collection::vec((0.0..1.0, 0.0..1.0, 0.02..0.2), 1..4),
    ) {
        let along = v(length, slope * length);
        let wall = |y: f64, sign: f64| Box::new(FullLine::new(v(0.0, y), along * sign).unwrap()) as Box<dyn Piece>;
        let at: Vec<_> = at.into_iter().map(|(a, b, r)| (a * along.x, a * along.y + b, r)).collect();
        let walls = [wall(0.0, 1.0), wall(1.0, -1.0)].into_iter().chain(disks(&at)).collect();
        let table = Table::periodic(walls, Some(Lattice::new(&[along]).unwrap())).unwrap();
        prop_assume!(table.validate().is_ok());
        has_no_larger(&table, v(0.0, 0.0), [along, v(0.0, 1.0)], "channel");
    }
}

#[test]
fn where_every_disk_fits_its_centre_is_in_the_table() {
    let line = |y: f64, x: f64| Box::new(FullLine::new(v(3.0, y), v(x, 0.5 * x)).unwrap()) as Box<dyn Piece>;
    let wide = |x: f64| {
        let [first, last] = [(x, 4.0, true), (-1.0, 4.0, false)]
            .map(|(x, y, left)| Box::new(Ray::new(v(7.0, 5.0), v(x, y), left).unwrap()) as Box<dyn Piece>);
        Table::new(vec![first, last]).unwrap()
    };
    let posts = Lattice::new(&[v(2.0, 1.0)]).unwrap();
    for table in [
        wide(1.0),
        wide(0.3),
        wide(-0.9),
        tables::wedge(0.02).unwrap(),
        Table::new(vec![line(2.0, 1.0)]).unwrap(),
        Table::new(vec![line(2.0, -1.0)]).unwrap(),
        // above and below a strip
        Table::new(vec![line(2.0, 1.0), line(1.0, -1.0)]).unwrap(),
        Table::periodic(disks(&[(1.0, 3.0, 0.5)]).collect(), Some(posts)).unwrap(),
    ] {
        let disk = table.largest_disk();
        assert!(disk.radius.is_infinite() && table.signed_distance(&disk.center) > 0.0, "{disk:?}: {table:?}");
    }
}

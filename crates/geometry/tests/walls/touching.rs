//! Rooms that touch one another, and rooms beside infinite walls.

use super::*;

/// Paths from points of the table against the pieces asked one by one.
#[track_caller]
fn hits_what_the_list_of_pieces_says(name: &str, table: &Table, from: &[Vector2<f64>]) {
    assert_eq!(table.validate(), Ok(()), "{name}");
    let list = table.list(0..table.pieces().len());
    let mut random = Random(59);
    for point in from {
        assert!(table.contains(point), "{name}: {point}");
        for _ in 0..200 {
            let path = Line { point: *point, velocity: random.velocity() };
            let (found, expected) = (table.with_walls(Ask(path)), list.hit(&path));
            match (found, expected) {
                (None, None) => {}
                (Some(a), Some(b)) => {
                    assert_eq!(a.piece, b.piece, "{name}: {path:?} {a:?} {b:?}");
                    assert!((a.time - b.time).abs() <= 1e-13 * b.time, "{name}: {path:?} {a:?} {b:?}");
                }
                _ => panic!("{name}: {path:?} {found:?} {expected:?}"),
            }
        }
    }
}

fn v(x: f64, y: f64) -> Vector2<f64> {
    Vector2::new(x, y)
}

fn disk(x: f64, y: f64, radius: f64) -> Box<dyn Piece> {
    Box::new(Circle::new(v(x, y), radius, true).unwrap())
}

fn square() -> Vec<Box<dyn Piece>> {
    let sides = polygon([v(0.0, 0.0), v(1.0, 0.0), v(1.0, 1.0), v(0.0, 1.0)]);
    sides.into_iter().map(|side| Box::new(side) as Box<dyn Piece>).collect()
}

fn ray(direction: Vector2<f64>, left: bool) -> Box<dyn Piece> {
    Box::new(Ray::new(v(0.0, -5.0), direction, left).unwrap())
}

fn floor() -> Box<dyn Piece> {
    Box::new(FullLine::new(v(0.0, -5.0), v(-1.0, 0.0)).unwrap())
}

fn both(mut room: Vec<Box<dyn Piece>>, beside: Vec<Box<dyn Piece>>) -> Table {
    room.extend(beside);
    Table::new(room).unwrap()
}

#[test]
fn no_path_passes_from_a_room_to_another_that_touches_it() {
    let disks = both(vec![disk(0.0, 0.0, 1.0)], vec![disk(2.0, 0.0, 1.0)]);
    hits_what_the_list_of_pieces_says("disks", &disks, &[v(0.0, 0.0), v(0.5, 0.1), v(2.0, 0.0), v(1.2, -0.1)]);
    let beside = both(square(), vec![disk(1.25, 0.5, 0.25)]);
    hits_what_the_list_of_pieces_says("square and disk", &beside, &[v(0.5, 0.5), v(0.9, 0.4), v(1.25, 0.5)]);
}

#[test]
fn a_room_beside_an_infinite_wall_does_not_enclose_it() {
    let below = [v(0.0, -7.0), v(0.5, -9.0)];
    let places = [&below[..], &[v(0.25, 0.5), v(0.5, 0.25)]].concat();
    let wedge = || vec![ray(v(1.0, -1.0), false), ray(v(-1.0, -1.0), true)];
    let round = || vec![disk(0.0, 0.0, 1.0)];
    hits_what_the_list_of_pieces_says("disk and half-plane", &both(round(), vec![floor()]), &places);
    hits_what_the_list_of_pieces_says("disk and wedge", &both(round(), wedge()), &places);
    hits_what_the_list_of_pieces_says("square and half-plane", &both(square(), vec![floor()]), &places);
    hits_what_the_list_of_pieces_says("square and wedge", &both(square(), wedge()), &places);
}

//! Sides and caps of composite walls that are several pieces.
use super::*;

/// An outline of lines and of arcs about a centre, counter-clockwise, as a table.
fn outline(
    at: impl Fn(f64, f64) -> Vector2<f64>,
    from: [f64; 2],
    edges: &[([f64; 2], Option<[f64; 2]>)],
) -> Vec<Box<dyn Piece>> {
    let mut outline = Outline::from(at(from[0], from[1]));
    for (to, center) in edges {
        let to = at(to[0], to[1]);
        outline = match center {
            Some(center) => outline.arc_to(to, at(center[0], center[1]), Turn::CounterClockwise),
            None => outline.line_to(to),
        }
        .unwrap();
    }
    outline.close().unwrap()
}

/// A table each with vertices where the boundary goes on as it was, moved and magnified.
pub(super) fn seamed(by: Vector2<f64>, size: f64) -> Vec<(&'static str, Table)> {
    let level = move |x: f64, y: f64| by + Vector2::new(x, y) * size;
    // 3, 4, 5: turned, but for rounding
    let askew = move |x: f64, y: f64| by + Vector2::new(0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y) * size;
    let line = |x: f64, y: f64| ([x, y], None);
    let table = |pieces: Vec<Box<dyn Piece>>| Table::new(pieces).unwrap();
    let square = [
        line(0.25, -1.0),
        line(0.75, -1.0),
        line(1.0, -1.0),
        line(1.0, 1.0),
        line(-1.0, 1.0),
        line(-1.0, 0.5),
        line(-1.0, -1.0),
    ];
    // from the middle of a side
    let middle = [line(1.0, -1.0), line(1.0, 1.0), line(-1.0, 1.0), line(-1.0, -1.0), line(0.0, -1.0)];
    let triangle = [line(0.3, -1.0), line(1.0, -1.0), line(0.0, 1.0), line(-1.0, -1.0)];
    let arc = |to: [f64; 2], center: [f64; 2]| (to, Some(center));
    let stadium = [
        line(0.5, -1.0),
        line(1.0, -1.0),
        arc([2.0, 0.0], [1.0, 0.0]),
        arc([1.6, 0.8], [1.0, 0.0]),
        arc([1.0, 1.0], [1.0, 0.0]),
        line(-1.0, 1.0),
        arc([-1.0, -1.0], [-1.0, 0.0]),
    ];
    let circle =
        [arc([0.0, 1.0], [0.0; 2]), arc([-0.6, 0.8], [0.0; 2]), arc([0.8, -0.6], [0.0; 2]), arc([1.0, 0.0], [0.0; 2])];
    let disk = |x: f64, y: f64| Box::new(Circle::new(level(x, y), 0.25 * size, false).unwrap()) as Box<dyn Piece>;
    let (one, two) = (vec![disk(0.1, 0.2)], vec![disk(0.1, 0.2), disk(-0.5, -0.5)]);
    let with =
        |pieces: Vec<Box<dyn Piece>>, others: Vec<Box<dyn Piece>>| table(pieces.into_iter().chain(others).collect());
    vec![
        ("square with vertices in its sides", table(outline(level, [-1.0, -1.0], &square))),
        ("the same askew", table(outline(askew, [-1.0, -1.0], &square))),
        ("square from the middle of a side", table(outline(level, [0.0, -1.0], &middle))),
        ("the same about a disk", with(outline(level, [0.0, -1.0], &middle), one)),
        ("the same about two disks", with(outline(level, [0.0, -1.0], &middle), two)),
        ("triangle with a vertex in a side", table(outline(askew, [-1.0, -1.0], &triangle))),
        ("stadium in parts", table(outline(level, [-1.0, -1.0], &stadium))),
        ("stadium in parts, askew", table(outline(askew, [-1.0, -1.0], &stadium))),
        ("circle of arcs", table(outline(level, [1.0, 0.0], &circle))),
    ]
}

#[test]
fn sides_of_several_pieces_are_one_wall() {
    for (name, table) in seamed(Vector2::new(0.125, -0.75), 1.0) {
        let walls = table.with_walls(NameOf);
        assert!(walls.contains("Enclosure"), "{name}: {walls}");
    }
}

#[test]
fn each_piece_of_a_side_is_hit() {
    let mut random = Random(21);
    for (name, table) in seamed(Vector2::new(0.125, -0.75), 1.0) {
        let hits: Vec<_> =
            paths(&table, 2000, &mut random).iter().filter_map(|path| table.with_walls(Ask(*path))).collect();
        for piece in 0..table.pieces().len() {
            let of_piece = hits.iter().filter(|hit| hit.piece == piece);
            assert!(of_piece.count() > 20, "{name}: {piece}");
        }
    }
}

#[test]
fn a_side_that_bends_is_several_walls() {
    let v = Vector2::new;
    let walls = |depth: f64| {
        let sides = polygon([v(0.0, 0.0), v(0.5, -depth), v(1.0, 0.0), v(1.0, 1.0), v(0.0, 1.0)]);
        Table::new(sides.into_iter().map(|s| Box::new(s) as _).collect()).unwrap().with_walls(NameOf)
    };
    // rounding of a vertex is within 16 units in the last place of the side
    assert!(walls(0.0).contains("Enclosure") && walls(1e-15).contains("Enclosure"));
    assert!(!walls(1e-14).contains("Enclosure") && !walls(1e-11).contains("Enclosure"));
    // bends away from there and back again
    let sides = polygon([v(0.0, 0.0), v(0.3, 3e-15), v(0.6, -3e-15), v(1.0, 0.0), v(1.0, 1.0), v(0.0, 1.0)]);
    let table = Table::new(sides.into_iter().map(|s| Box::new(s) as _).collect()).unwrap();
    assert!(table.with_walls(NameOf).contains("Enclosure"));
}

#[test]
fn walls_without_seams_know_of_none() {
    for entry in tables::all().iter().filter(|entry| entry.dimension() == 2) {
        let walls = entry.planar(&entry.typical()).unwrap().with_walls(NameOf);
        assert!(!walls.contains("Enclosure"), "{}: {walls}", entry.name);
    }
}

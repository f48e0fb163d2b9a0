//! Walls of the plane modulo a lattice.

use super::*;
use geometry::walls::Periodic;
use std::sync::atomic::{AtomicU64, Ordering};

/// Lattice walls against all translates of the pieces around the origin.
struct CompareLifted<'a> {
    name: &'a str,
    table: &'a Table,
    paths: &'a [Line<2>],
}

impl WithWalls<2> for CompareLifted<'_> {
    type Output = ();
    fn run<W: Walls<2>>(self, walls: &W) {
        let lattice = self.table.cell().unwrap().lattice();
        let mut pieces: Vec<(usize, std::sync::Arc<dyn Piece>)> = vec![];
        let second = if lattice.vectors().len() == 2 { -9..=9 } else { 0..=0 };
        for (i, piece) in self.table.pieces().iter().enumerate() {
            for (a, b) in (-9..=9).flat_map(|a| second.clone().map(move |b| (a, b))) {
                let by = lattice.translation([f64::from(a), f64::from(b)]);
                pieces.push((i, std::sync::Arc::new(Translated::new(piece.clone(), by))));
            }
        }
        let lifted = List::new(pieces, &[]);
        let mut compared = 0;
        for path in self.paths {
            let speed = path.velocity.norm();
            let Some(a) = lifted.hit(path).filter(|a| a.time * speed < 5.0) else { continue };
            let b = walls.hit(path).unwrap();
            let cos = path.velocity.dot(&a.normal).abs() / speed;
            // as for composite walls, and at each of at most 12 crossings of a cell's edge 2 ulp more
            let bound = (16.0 + 24.0) * f64::EPSILON * 5.0 / cos;
            let context = || format!("{}: {path:?} {a:?} {b:?}", self.name);
            assert_eq!(a.piece, b.piece, "{}", context());
            assert!((a.time - b.time).abs() * speed <= bound, "{}", context());
            let apart = a.point - b.point;
            assert!((apart - lattice.translation(lattice.rounded(&apart))).norm() <= bound, "{}", context());
            compared += 1;
        }
        assert!(compared * 2 > self.paths.len());
    }
}

#[test]
fn lattice_walls_agree_with_all_translates() {
    let mut random = Random(8);
    for name in ["sinai-torus", "lorentz", "channel"] {
        let entry = tables::find(name).unwrap();
        let table = entry.planar(&entry.typical()).unwrap();
        let paths = orbit_starts(&table, 1000, &mut random);
        table.with_walls(CompareLifted { name, table: &table, paths: &paths });
    }
}

#[test]
fn walls_in_any_cell_of_any_basis_agree_with_all_translates() {
    let v = Vector2::new;
    let disk = |x: f64, y: f64, r: f64| Box::new(Circle::new(v(x, y), r, false).unwrap()) as Box<dyn Piece>;
    let mut random = Random(21);
    for (name, vectors, disks) in [
        ("a lean cell", [v(1.0, 0.0), v(20.0, 1.0)], vec![disk(0.5, 0.5, 0.25)]),
        ("a disk about the origin", [v(1.0, 0.0), v(0.0, 1.0)], vec![disk(0.0, 0.0, 0.25)]),
        ("both", [v(0.9, 0.1), v(-7.3, 0.25)], vec![disk(0.0, 0.0, 0.1), disk(0.25, 0.5, 0.05)]),
        ("a disk that any cell cuts", [v(1.0, 0.0), v(0.5, 1.0)], vec![disk(0.3, 0.0, 0.45), disk(0.8, 0.5, 0.05)]),
    ] {
        let table = Table::periodic(disks, Some(Lattice::new(&vectors).unwrap())).unwrap();
        table.validate().unwrap();
        let paths = orbit_starts(&table, 1000, &mut random);
        table.with_walls(CompareLifted { name, table: &table, paths: &paths });
        table.with_walls(side_by_side::SameBits { name, paths: &paths });
    }
}

#[test]
fn a_basis_costs_no_more_than_the_shortest_one() {
    let copies = |second: Vector2<f64>| {
        let disk = Circle::new(Vector2::new(0.5, 0.5), 0.25, false).unwrap();
        let lattice = Lattice::new(&[Vector2::new(1.0, 0.0), second]).unwrap();
        let table = Table::periodic(vec![Box::new(disk)], Some(lattice)).unwrap();
        table.validate().unwrap();
        assert!((table.largest_disk().radius - (0.5_f64.sqrt() - 0.25)).abs() < 1e-15, "{second}");
        table.nearby().count()
    };
    for skew in [20.0, 1000.0, 1e9] {
        assert_eq!(copies(Vector2::new(skew, 1.0)), copies(Vector2::new(0.0, 1.0)), "{skew:e}");
    }
}

#[test]
fn a_basis_too_lean_to_count_the_cells_is_refused() {
    let disk = Circle::new(Vector2::new(0.5, 0.5), 0.25, false).unwrap();
    let lattice = Lattice::new(&[Vector2::new(1.0, 0.0), Vector2::new(1e17, 1.0)]).unwrap();
    let table = Table::periodic(vec![Box::new(disk)], Some(lattice));
    assert!(matches!(table, Err(geometry::Error::FarFromCell { piece: 0, .. })));
}

/// Walls that count how often they are asked.
struct Counting<'a, W>(W, &'a AtomicU64);

impl<W: Walls<2>> Walls<2> for Counting<'_, W> {
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.first_hit(x, v)
    }
}

#[test]
fn flights_that_leave_a_grating_sideways_end_at_once_and_no_hit_is_lost() {
    let v = Vector2::new;
    let along = v(0.8, 0.6);
    let lattice = Lattice::new(&[along]).unwrap();
    let mut pieces: Vec<Box<dyn Piece>> = vec![Box::new(Circle::new(v(7.3, 5.4), 0.2, false).unwrap())];
    let triangle = polygon([v(0.1, 0.7), v(0.2, 1.0), v(0.4, 0.8)]);
    pieces.extend(triangle.into_iter().map(|s| Box::new(s) as Box<dyn Piece>));
    let table = Table::periodic(pieces, Some(lattice.clone())).unwrap();
    let translates = table.pieces().iter().enumerate().flat_map(|(i, piece)| {
        let moved = |k: i32| Translated::new(piece.clone(), along * f64::from(k));
        (-40..=30).map(move |k| (i, std::sync::Arc::new(moved(k)) as std::sync::Arc<dyn Piece>))
    });
    let (lifted, asked) = (List::new(translates.collect(), &[]), AtomicU64::new(0));
    let boxes = table.pieces().iter().map(Piece::extent);
    let walls = Periodic::new(Counting(&lifted, &asked), &lattice).within(&lattice, boxes);
    let across = v(-0.6, 0.8);
    let mut random = Random(9);
    let (mut hits, mut escapes) = (0, 0);
    for _ in 0..2000 {
        // from the obstacles' height and from far above and below them
        let point = along * random.uniform() + across * random.between(-5.0, 5.0);
        let path = Line { point, velocity: random.velocity() };
        let slope = path.velocity.dot(&across).abs() / path.velocity.norm();
        if slope < 0.25 {
            continue;
        }
        let (before, expected) = (asked.load(Ordering::Relaxed), lifted.hit(&path));
        let hit = walls.hit(&path);
        assert_eq!(hit.map(|hit| hit.piece), expected.map(|hit| hit.piece), "{path:?}");
        assert!(asked.load(Ordering::Relaxed) - before < 64, "{path:?}");
        if hit.is_some() { hits += 1 } else { escapes += 1 }
    }
    assert!(hits > 300 && escapes > 300, "{hits} {escapes}");
}

#[test]
fn pieces_too_far_away_to_count_the_cells_are_refused() {
    let lattice = |second: f64| Lattice::new(&[Vector2::new(1.0, 0.0), Vector2::new(0.0, second)]).unwrap();
    for (far, second) in [(1e16, 1.0), (1e19, 1.0), (1.6e16, 1e9)] {
        for center in [Vector2::new(far, 0.0), Vector2::new(-far, 0.5)] {
            let disk = Box::new(Circle::new(center, 0.25, false).unwrap()) as Box<dyn Piece>;
            let table = Table::periodic(vec![disk], Some(lattice(second)));
            assert!(matches!(table, Err(geometry::Error::FarFromCell { piece: 0, .. })), "{center} {second}");
        }
    }
}

/// Tables on lattices with walls along the edges of cells.
fn walled() -> Vec<(&'static str, Table)> {
    let v = Vector2::new;
    let boxed = |pieces: Vec<Segment>| pieces.into_iter().map(|s| Box::new(s) as Box<dyn Piece>).collect::<Vec<_>>();
    let torus = |a, b| Some(Lattice::new(&[a, b]).unwrap());
    let upright = || torus(v(1.0, 0.0), v(0.0, 1.0));
    // up to an edge, and from an edge on
    let right = boxed(polygon([v(0.5, 0.25), v(0.5, 0.75), v(1.0, 0.75), v(1.0, 0.25)]));
    let low = boxed(polygon([v(0.25, 0.0), v(0.25, 0.5), v(0.5, 0.5), v(0.5, 0.0)]));
    let both = boxed(polygon([v(0.25, 0.0), v(0.25, 1.0 / 3.0), v(0.5, 1.0 / 3.0), v(0.5, 0.0)]).into_iter().collect());
    // a wall with two sides along an edge, and part of one along a slanted edge
    let two = |a, b| boxed(polygon([a, b]));
    let (e, f) = (v(0.7, 0.1), v(-0.2, 0.9));
    let thirds = two(f / 3.0, f * (2.0 / 3.0));
    let channel = boxed(vec![
        Segment::new(v(0.0, 0.0), v(0.7, 0.0)).unwrap(),
        Segment::new(v(0.7, 1.0), v(0.0, 1.0)).unwrap(),
        Segment::new(v(0.0, 0.25), v(0.0, 0.6)).unwrap(),
        Segment::new(v(0.0, 0.6), v(0.0, 0.25)).unwrap(),
    ]);
    vec![
        ("an obstacle up to an edge", Table::periodic(right, upright()).unwrap()),
        ("an obstacle from an edge on", Table::periodic(low, upright()).unwrap()),
        ("another one", Table::periodic(both, upright()).unwrap()),
        ("a wall along an edge", Table::periodic(two(v(0.0, 0.0), v(0.0, 0.01)), upright()).unwrap()),
        ("a wall along a slanted edge", Table::periodic(thirds, torus(e, f)).unwrap()),
        ("a wall along the edge of a long cell", {
            let (sin, cos) = libm::sincos(0.53);
            let (long, short) = (v(cos, sin) * 256.0, v(-sin, cos));
            Table::periodic(two(v(0.0, 0.0), long), torus(long, short)).unwrap()
        }),
        ("a channel with a baffle", Table::periodic(channel, Some(Lattice::new(&[v(0.7, 0.0)]).unwrap())).unwrap()),
    ]
}

#[test]
fn no_path_passes_a_wall_along_an_edge_of_cells() {
    let mut random = Random(12);
    for (name, table) in &walled() {
        table.validate().unwrap();
        let mut paths = vec![];
        while paths.len() < 4000 {
            let lattice = table.lattice().unwrap();
            let mut at = || random.uniform();
            let point = lattice.translation([at(), at()]) + Vector2::new(0.0, at());
            let point = table.home(&point);
            let piece = &table.pieces()[paths.len() % table.pieces().len()];
            let cell = [at(), at()].map(|a| f64::from(a < 0.5));
            let near = piece.arc_length_at(&point) + 4.0 * (at() - 0.5);
            let aim = piece.point_at(near.clamp(0.001 * piece.length(), 0.999 * piece.length()))
                + lattice.translation(cell)
                - point;
            if table.contains(&point) && aim.norm() < 2.5 {
                paths.push(Line { point, velocity: aim * at() });
            }
        }
        table.with_walls(CompareLifted { name, table, paths: &paths });
    }
}

#[test]
fn single_paths_and_lanes_agree_on_lattices_with_many_translates() {
    let mut random = Random(13);
    let disk = |k: i32| Circle::new(Vector2::new(0.98, 0.05 + 0.1 * f64::from(k)), 0.04, false).unwrap();
    let pieces = (0..10).map(|k| Box::new(disk(k)) as Box<dyn Piece>).collect();
    let lattice = Lattice::new(&[Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0)]).unwrap();
    let table = Table::periodic(pieces, Some(lattice)).unwrap();
    let paths = orbit_starts(&table, 4096, &mut random);
    table.with_walls(side_by_side::SameBits { name: "ten disks on a torus", paths: &paths });
}

#[test]
fn a_hit_at_a_joint_of_the_lattice_is_a_corner() {
    // the cusps of a channel with dispersing walls, where one cell meets the next
    let table = tables::channel(1.0, 1.0, 0.25).unwrap();
    assert_eq!(table.corners().len(), 4);
    let hit =
        table.with_walls(Ask(Line { point: Vector2::new(0.75, 0.5), velocity: Vector2::new(0.25, -0.5) })).unwrap();
    assert!(hit.corner, "{hit:?}");
    // and where an arc meets an arc of its own circle there is none
    let circle = Outline::from(Vector2::new(1.0, 0.0))
        .arc_to(Vector2::new(-1.0, 0.0), Vector2::zeros(), Turn::CounterClockwise)
        .and_then(|o| o.arc_to(Vector2::new(1.0, 0.0), Vector2::zeros(), Turn::CounterClockwise));
    assert!(Table::new(circle.unwrap().close().unwrap()).unwrap().corners().is_empty());
    assert!(Arc::new(Vector2::zeros(), Vector2::new(1.0, 0.0), Vector2::new(1.0, 0.0), true).is_err());
}

/// Asks for the first hits of paths.
struct AskEach<'a>(&'a [Line<2>]);

impl WithWalls<2> for AskEach<'_> {
    type Output = Vec<Option<geometry::Hit<2>>>;
    fn run<W: Walls<2>>(self, walls: &W) -> Self::Output {
        self.0.iter().map(|path| walls.hit(path)).collect()
    }
}

#[test]
fn a_flight_through_hundreds_of_cells_ends_where_its_time_says() {
    let table = tables::sinai_torus(0.005, 1.0).unwrap();
    let mut random = Random(11);
    let mut paths = vec![];
    for _ in 0..1000 {
        let (sin, cos) = libm::sincos(random.between(0.0, core::f64::consts::TAU));
        let point = Vector2::new(random.uniform(), 0.4 * random.uniform());
        paths.push(Line { point, velocity: Vector2::new(cos, sin) });
    }
    let (mut hits, mut longest) = (0, 0.0_f64);
    for (path, hit) in paths.iter().zip(table.with_walls(AskEach(&paths))) {
        let Some(hit) = hit.filter(|hit| hit.time < 1000.0) else { continue };
        let mut off = 0.0_f64;
        for i in 0..2 {
            // in twice the digits, but for whole cells
            let mut flown = lanes::Double::product(hit.time, path.velocity[i]);
            flown = flown.plus(lanes::Double::new(path.point[i])).plus(lanes::Double::new(-hit.point[i]));
            let rest = flown.plus(lanes::Double::new(-libm::round(flown.value()))).value();
            off = off.max(rest.abs());
        }
        // a unit of rounding of the time, one for each unit of length, and a few for the hit
        let bound = (16.0 + 2.0 * hit.time) * 0.5 * f64::EPSILON;
        assert!(off <= bound, "{path:?}: {hit:?} is {off:e} off");
        (hits, longest) = (hits + 1, longest.max(hit.time));
    }
    assert!(hits > 900 && longest > 500.0, "{hits} {longest}");
}

#[test]
fn a_path_through_a_joint_on_the_edge_of_a_cell_hits_one_of_the_pieces_there() {
    // widths and offsets that are not exact in binary: the end of a wall and the start of its translate differ by an ulp or so
    let mut random = Random(2);
    for k in 1..200 {
        let width = 0.1 * f64::from(k);
        let start = if k % 2 == 0 { 0.0 } else { random.between(-1.0, 1.0) };
        let end = start + width;
        for second in [None, Some(Vector2::new(0.0, 3.0))] {
            let segment = |a: [f64; 2], b: [f64; 2]| -> Box<dyn Piece> {
                Box::new(geometry::shapes::Segment::new(a.into(), b.into()).unwrap())
            };
            let walls = vec![segment([start, 0.0], [end, 0.0]), segment([end, 1.0], [start, 1.0])];
            let vectors: Vec<_> = [Vector2::new(width, 0.0)].into_iter().chain(second).collect();
            let table = Table::periodic(walls, Some(Lattice::new(&vectors).unwrap())).unwrap();
            for (x, v) in [(start, 1.0), (start, -1.0), (end, 1.0), (end, -1.0)] {
                let path = Line { point: table.home(&Vector2::new(x, 0.5)), velocity: Vector2::new(0.0, v) };
                let hit = table.with_walls(Ask(path)).map(|hit| (hit.piece, hit.time));
                assert_eq!(hit, Some((usize::from(v > 0.0), 0.5)), "{width} from {start}, {second:?}: {path:?}");
            }
        }
    }
}

//! Boundaries that stand on one another.
mod formulas;

use core::f64::consts::PI;
use formulas::Parabola;
use geometry::{
    Error, Lattice, Piece, Table, Vector2,
    parry::{Placed, ShapeSpec, Side},
    shapes::{self, Circle, Ellipse, EllipticArc, FullLine, Ray, Segment, curve::ParametricCurve},
};
use std::sync::Arc;

fn v(x: f64, y: f64) -> Vector2<f64> {
    Vector2::new(x, y)
}
/// The polygon with the given vertices.
fn polygon(vertices: &[[f64; 2]]) -> Vec<Box<dyn Piece>> {
    let next = |i: usize| vertices[(i + 1) % vertices.len()];
    let side = |(i, &a): (usize, &[f64; 2])| Segment::new(a.into(), next(i).into()).unwrap();
    vertices.iter().enumerate().map(side).map(|s| Box::new(s) as Box<dyn Piece>).collect()
}
/// A rectangle with the table inside.
fn room([x, y]: [f64; 2], [u, w]: [f64; 2]) -> Vec<Box<dyn Piece>> {
    polygon(&[[x, y], [u, y], [u, w], [x, w]])
}
/// One with the table outside.
fn block([x, y]: [f64; 2], [u, w]: [f64; 2]) -> Vec<Box<dyn Piece>> {
    polygon(&[[x, y], [x, w], [u, w], [u, y]])
}
fn table(loops: impl IntoIterator<Item = Vec<Box<dyn Piece>>>) -> Table {
    Table::new(loops.into_iter().flatten().collect()).unwrap()
}
/// The table that is told to have a spike, joined.
fn joined(table: &Table) -> (Table, Vec<usize>) {
    assert!(matches!(table.validate(), Err(Error::Spike { .. })), "{:?}", table.validate());
    let (joined, origins) = table.joined().unwrap();
    assert_eq!(joined.validate(), Ok(()));
    assert_eq!(joined.pieces().len(), origins.len());
    assert!(joined.joined().is_none());
    (joined, origins)
}
/// Area, perimeter, parts, largest disk, and the same with a disk of this radius: what does not depend on numbers.
fn measures(table: &Table, radius: f64) -> Vec<f64> {
    [table.clone(), table.offset(radius).unwrap().table]
        .iter()
        .flat_map(|t| [t.area(), t.perimeter(), t.components().len() as f64, t.largest_disk().radius])
        .collect()
}
fn assert_alike(a: &Table, b: &Table, radius: f64) {
    let [a, b] = [a, b].map(|t| measures(t, radius));
    // sums of a few terms of order 10
    assert!(a.iter().zip(&b).all(|(x, y)| (x - y).abs() <= 1e-13 * y.abs()), "{a:?} {b:?}");
}

#[test]
fn a_box_on_a_floor_and_a_loop_around_both_are_one_table() {
    let (desk, origins) = joined(&table([room([-2.0; 2], [2.0; 2]), block([-0.5, -2.0], [0.5, -1.0])]));
    assert_eq!(origins, [0, 0, 1, 2, 3, 4, 5, 6]);
    let around = [[-2., -2.], [-0.5, -2.], [-0.5, -1.], [0.5, -1.], [0.5, -2.], [2., -2.], [2., 2.], [-2., 2.]];
    assert_alike(&desk, &table([polygon(&around)]), 0.25);
    for (point, within) in [([0.0, -1.5], false), ([0.0, -2.5], false), ([0.0, -0.5], true), ([1.0, -1.5], true)] {
        assert_eq!(desk.contains(&point.into()), within, "{point:?}");
    }
    // in a corner, where the two have a vertex in common and seem to be one loop
    let (corner, origins) = joined(&table([room([-2.0; 2], [2.0; 2]), block([-2.0; 2], [-1.0; 2])]));
    assert_eq!(origins, [0, 1, 2, 3, 5, 6]);
    assert_alike(
        &corner,
        &table([polygon(&[[-1., -2.], [2., -2.], [2., 2.], [-2., 2.], [-2., -1.], [-1., -1.]])]),
        0.25,
    );
}

#[test]
fn a_bar_from_wall_to_wall_parts_a_room() {
    let (halves, _) = joined(&table([room([-2.0; 2], [2.0; 2]), block([-2.0, -0.5], [2.0, 0.5])]));
    assert_eq!(halves.components().iter().map(|part| part.area).collect::<Vec<_>>(), [6.0, 6.0]);
    let (lower, _) = joined(&table([room([-2.0; 2], [2.0; 2]), block([-2.0, 0.5], [2.0, 2.0])]));
    assert_alike(&lower, &table([room([-2.0; 2], [2.0, 0.5])]), 0.25);
}

#[test]
fn obstacles_side_by_side_are_one() {
    let both = [block([0.0; 2], [1.0; 2]), block([1.0, 0.25], [3.0, 2.0])];
    let (step, _) = joined(&table(both).unbounded());
    assert_eq!((step.pieces().len(), step.area()), (8, -4.5));
    assert_eq!(step.components().len(), 1);
    // around a court, in two pieces with two stretches in common
    let court = [
        polygon(&[[0., 0.], [0., 1.], [2., 1.], [2., 2.], [0., 2.], [0., 3.], [3., 3.], [3., 0.]]),
        block([-1.0, 0.0], [0.0, 3.0]),
    ];
    let (court, _) = joined(&table(court.into_iter().chain([room([-9.0; 2], [9.0; 2])])));
    assert_eq!(court.components().iter().map(|part| part.area).collect::<Vec<_>>(), [2.0, 312.0]);
}

#[test]
fn boxes_stand_on_walls_without_end() {
    let ends = |table: &Table| table.pieces().iter().map(|p| p.length().is_finite()).collect::<Vec<_>>();
    let floor = || Box::new(FullLine::new(v(0.0, 0.0), v(1.0, 0.0)).unwrap()) as Box<dyn Piece>;
    let (line, origins) = joined(&table([vec![floor()], block([0.0; 2], [1.0; 2])]));
    assert_eq!((ends(&line), origins), (vec![false, false, true, true, true], vec![0, 0, 1, 2, 3]));
    assert!(line.contains(&v(2.0, 0.5)) && !line.contains(&v(0.5, 0.5)) && !line.contains(&v(0.5, -0.5)));
    // two walls of a corner, and a box in it
    let ray = |x: f64, y: f64, left: bool| Box::new(Ray::new(v(0.0, 0.0), v(x, y), left).unwrap()) as Box<dyn Piece>;
    let (corner, _) = joined(&table([vec![ray(1.0, 0.0, true), ray(0.0, 1.0, false)], block([0.0; 2], [1.0; 2])]));
    assert_eq!(ends(&corner), [false, false, true, true]);
    assert!(!corner.contains(&v(0.5, 0.5)) && corner.contains(&v(2.0, 0.5)));
}

#[test]
fn boxes_stand_on_the_walls_of_a_channel() {
    let side = |a: [f64; 2], b: [f64; 2]| Box::new(Segment::new(a.into(), b.into()).unwrap()) as Box<dyn Piece>;
    let walls = vec![side([0.0, 0.0], [4.0, 0.0]), side([4.0, 2.0], [0.0, 2.0])];
    let lattice = Lattice::new(&[v(4.0, 0.0)]).unwrap();
    let pieces = walls.into_iter().chain(block([1.0, 0.0], [2.0, 1.0])).collect();
    let (channel, origins) = joined(&Table::periodic(pieces, Some(lattice)).unwrap());
    assert_eq!((origins, channel.area()), (vec![0, 0, 1, 2, 3, 4], 7.0));
    assert!(channel.contains(&v(4.5, 0.5)) && !channel.contains(&v(5.5, 0.5)));
}

#[test]
fn obstacles_that_touch_their_copies_on_a_lattice_are_walls_along_it() {
    let one = || vec![block([0.0, 0.0], [0.7, 1.0])];
    let two = || vec![block([0.1, 0.0], [0.3, 1.0]), block([0.3, 0.2], [0.8, 1.3])];
    let (square, askew) = ([v(0.7, 0.0), v(0.0, 2.0)], [v(0.7, 0.1), v(2.8, 2.4)]);
    // where they are not of one height, or the next one stands higher, there are steps
    for (vectors, blocks, [area, perimeter]) in [
        (square, one(), [0.7, 1.4]),
        (square, two(), [0.65, 1.4 + 0.5 + 0.5]),
        (askew, one(), [0.7, 1.4 + 0.1 + 0.1]),
        (askew, two(), [0.65, 1.4 + 0.5 + 0.3]),
    ] {
        let pieces = blocks.into_iter().flatten().collect();
        let (walls, _) = joined(&Table::periodic(pieces, Some(Lattice::new(&vectors).unwrap())).unwrap());
        assert!((walls.area() - area).abs() < 1e-14, "{}", walls.area());
        assert!((walls.perimeter() - perimeter).abs() < 1e-14, "{}", walls.perimeter());
        assert_eq!(walls.components().len(), 1);
    }
}

#[test]
fn a_disk_in_its_socket_is_part_of_the_wall() {
    let arc = |a, b| Box::new(shapes::Arc::new(v(0.0, 0.0), a, b, true).unwrap()) as Box<dyn Piece>;
    let side = |a: [f64; 2], b: [f64; 2]| Box::new(Segment::new(a.into(), b.into()).unwrap()) as Box<dyn Piece>;
    let socket = vec![
        side([-2.0, 0.0], [-1.0, 0.0]),
        arc(v(-1.0, 0.0), v(1.0, 0.0)),
        side([1.0, 0.0], [2.0, 0.0]),
        side([2.0, 0.0], [2.0, 3.0]),
        side([2.0, 3.0], [-2.0, 3.0]),
        side([-2.0, 3.0], [-2.0, 0.0]),
    ];
    let disk = vec![Box::new(Circle::new(v(0.0, 0.0), 1.0, false).unwrap()) as Box<dyn Piece>];
    let (joined, origins) = joined(&table([socket, disk]));
    assert_eq!(origins, [0, 2, 3, 4, 5, 6]);
    assert!((joined.area() - (12.0 - 0.5 * PI)).abs() < 1e-14);
    assert!((joined.perimeter() - (12.0 + PI)).abs() < 1e-14);
}

/// The arc of an ellipse about the origin with semi-axes 2 and 1, between two eccentric angles in the sense of traversal.
fn elliptic(inside: bool, angles: [f64; 2]) -> Box<dyn Piece> {
    let ellipse = Ellipse::new(v(0.0, 0.0), [2.0, 1.0], 0.0, inside).unwrap();
    let [a, b] = angles.map(on_ellipse);
    Box::new(EllipticArc::new(ellipse, a, b).unwrap())
}
fn on_ellipse(angle: f64) -> Vector2<f64> {
    v(2.0 * libm::cos(angle), libm::sin(angle))
}
fn side(a: Vector2<f64>, b: Vector2<f64>) -> Box<dyn Piece> {
    Box::new(Segment::new(a, b).unwrap())
}

#[test]
fn what_stands_in_an_elliptic_hollow_is_part_of_the_wall() {
    let [a, b, c] = [-PI, -2.0, -1.0].map(on_ellipse);
    let hollow = || {
        let right = on_ellipse(0.0);
        vec![
            elliptic(true, [-PI, 0.0]),
            side(right, v(2.0, 3.0)),
            side(v(2.0, 3.0), v(-2.0, 3.0)),
            side(v(-2.0, 3.0), a),
        ]
    };
    // all of it
    let plug = vec![Box::new(Ellipse::new(v(0.0, 0.0), [2.0, 1.0], 0.0, false).unwrap()) as Box<dyn Piece>];
    let (filled, origins) = joined(&table([hollow(), plug]));
    assert_eq!(origins, [1, 2, 3, 4]);
    assert!((filled.area() - (12.0 - PI)).abs() < 1e-13, "{}", filled.area());
    // from end to end
    let lid = vec![elliptic(false, [0.0, -PI]), side(a, v(0.0, 1.0)), side(v(0.0, 1.0), on_ellipse(0.0))];
    let (filled, origins) = joined(&table([hollow(), lid]));
    assert_eq!(origins, [1, 2, 3, 5, 6]);
    assert!((filled.area() - 10.0).abs() < 1e-13, "{}", filled.area());
    // part of it: the hollow is cut in two
    let step = vec![elliptic(false, [-1.0, -2.0]), side(b, v(0.0, 1.0)), side(v(0.0, 1.0), c)];
    let (standing, origins) = joined(&table([hollow(), step]));
    assert_eq!(origins, [0, 0, 1, 2, 3, 5, 6]);
    let segment = 1.0 - libm::sin(1.0); // a b (φ − sin φ)/2 of the angle 1
    let area = 12.0 + PI - segment - 0.5 * ((v(0.0, 1.0) - c).perp(&(b - c)));
    assert!((standing.area() - area).abs() < 1e-13, "{} {area}", standing.area());
    assert!(!standing.contains(&v(-0.1, -0.9)) && standing.contains(&v(1.5, -0.2)));
    // with the table on both sides of it
    let room = vec![
        elliptic(false, [0.0, -PI]),
        side(a, v(-2.0, -3.0)),
        side(v(-2.0, -3.0), v(2.0, -3.0)),
        side(v(2.0, -3.0), on_ellipse(0.0)),
    ];
    let both = table([hollow(), room]);
    assert_eq!(both.validate(), Ok(()));
    assert!(both.joined().is_none());
}

/// The parabola from one parameter to another.
fn parabola(from: f64, to: f64) -> Box<dyn Piece> {
    let ends = [from, to].map(|t| v(t, t * t));
    Box::new(ParametricCurve::along(Parabola, [from, to], ends).unwrap().remove(0))
}

#[test]
fn curves_by_formulas_are_left_out_as_a_whole() {
    let stone = || vec![parabola(1.0, -1.0), side(v(-1.0, 1.0), v(0.0, 2.0)), side(v(0.0, 2.0), v(1.0, 1.0))];
    let rest = || vec![side(v(2.0, 4.0), v(-2.0, 4.0))];
    let cut = [vec![parabola(-2.0, -1.0), parabola(-1.0, 1.0), parabola(1.0, 2.0)], rest()].into_iter().flatten();
    let (joined, origins) = joined(&table([cut.collect(), stone()]));
    assert_eq!(origins, [0, 2, 3, 5, 6]);
    assert!((joined.area() - (32.0 / 3.0 - 4.0 / 3.0 - 1.0)).abs() < 1e-13, "{}", joined.area());
    // they are not cut
    let whole = table([[vec![parabola(-2.0, 2.0)], rest()].into_iter().flatten().collect(), stone()]);
    assert!(matches!(whole.validate(), Err(Error::Spike { .. })), "{:?}", whole.validate());
    assert!(whole.joined().is_none());
}

#[test]
fn rounded_shapes_stand_on_a_floor_as_cusps() {
    // above (−0.5, −2) and (0.5, −2) begin quarters of circles
    let capsule = ShapeSpec::Capsule { a: [-0.5, -1.5], b: [0.5, -1.5], radius: 0.5 };
    let capsule = Placed::from(capsule).pieces(Side::Outside).unwrap();
    let (joined, _) = joined(&table([room([-2.0; 2], [2.0; 2]), capsule]));
    assert!((joined.area() - (15.0 - 0.25 * PI)).abs() < 1e-14);
    assert!((joined.perimeter() - (16.0 + PI)).abs() < 1e-14);
    assert_eq!(joined.components().len(), 1);
    for (x, y, within) in [(0.0, -1.5, false), (0.1, -1.999, false), (0.1, -2.001, false), (0.9, -1.9, true)] {
        assert_eq!(joined.contains(&v(x, y)), within, "{x} {y}");
    }
    // the disk stays out of the cusps: where it touches floor and capsule, the centres are 0.5 + r apart and 0.5 − r in height
    let centres = joined.offset(0.125).unwrap().table;
    let half = 0.5 + (libm::pow(0.625_f64, 2.0) - libm::pow(0.375_f64, 2.0)).sqrt();
    let on_floor = |piece: &&Arc<dyn Piece>| piece.ends().is_some_and(|ends| ends.iter().all(|end| end.y == -1.875));
    let floor: Vec<f64> = centres.pieces().iter().filter(on_floor).map(Piece::length).collect();
    assert!(floor.len() == 2 && floor.iter().all(|length| (length - (1.875 - half)).abs() < 1e-14), "{floor:?}");
}

#[test]
fn a_wall_with_the_table_on_both_sides_stays() {
    let rooms = || [room([0.0; 2], [1.0; 2]), room([1.0, 0.0], [2.0, 1.0])];
    assert!(table(rooms()).joined().is_none());
    let twice = [true, false].map(|inside| Box::new(Circle::new(v(0.0, 0.0), 1.0, inside).unwrap()) as Box<dyn Piece>);
    assert!(table([room([-2.0; 2], [2.0; 2]), twice.into()]).joined().is_none());
}

#[test]
fn one_loop_that_runs_there_and_back_is_left_as_it_is() {
    let spike = table([polygon(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])]);
    assert!(matches!(spike.validate(), Err(Error::Spike { .. })));
    assert!(spike.joined().is_none());
}

/// Squares in a room of `N` × `N`; those around it are full.
const N: usize = 5;
type Grid = [[bool; N + 2]; N + 2];

/// The places in the room.
fn places() -> impl Iterator<Item = [usize; 2]> {
    (1..=N).flat_map(|i| (1..=N).map(move |j| [i, j]))
}
fn beside([i, j]: [usize; 2]) -> [[usize; 2]; 4] {
    [[i + 1, j], [i - 1, j], [i, j + 1], [i, j - 1]]
}
/// How many parts there are of free squares with sides in common.
fn parts(full: &Grid) -> usize {
    let mut open: Vec<[usize; 2]> = vec![];
    let mut seen = *full;
    let mut count = 0;
    for [i, j] in places() {
        count += usize::from(!seen[i][j]);
        open.push([i, j]);
        while let Some([i, j]) = open.pop() {
            if !core::mem::replace(&mut seen[i][j], true) {
                open.extend(beside([i, j]));
            }
        }
    }
    count
}

#[test]
fn of_any_blocks_in_a_grid_the_rest_is_the_table() {
    let mut state: u64 = 11;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mut plain, mut parted) = (0, 0);
    for round in 0..200 {
        let share = 0.2 + 0.5 * random();
        let mut full: Grid = [[true; N + 2]; N + 2];
        places().for_each(|[i, j]| full[i][j] = random() < share);
        let free: Vec<_> = places().filter(|&[i, j]| !full[i][j]).collect();
        if free.is_empty() || free.len() == N * N {
            continue;
        }
        // sides that coincide but for rounding, and elsewhere than at the origin
        let at = |i: usize, j: usize| [0.3 + 0.1 * i as f64, -0.7 + 0.1 * j as f64];
        let square = |[i, j]: [usize; 2]| {
            let [x, y] = at(i, j).map(|x| x + 0.05);
            block([x - 0.05, y - 0.05], [x + 0.05, y + 0.05])
        };
        let blocks = places().filter(|&[i, j]| full[i][j]).map(square);
        let blocks = table([room(at(1, 1), at(N + 1, N + 1))].into_iter().chain(blocks));
        let table = match blocks.validate() {
            Ok(()) => blocks,
            Err(Error::Spike { .. }) => blocks.joined().unwrap().0,
            Err(error) => panic!("{round}: {error} {full:?}"),
        };
        assert_eq!(table.validate(), Ok(()), "{round} {full:?}");
        let sides = free.iter().flat_map(|&at| beside(at)).filter(|&[i, j]| full[i][j]).count();
        assert!((table.area() - 0.01 * free.len() as f64).abs() < 1e-14, "{round}: {} {full:?}", table.area());
        assert!((table.perimeter() - 0.1 * sides as f64).abs() < 1e-13, "{round}: {} {full:?}", table.perimeter());
        for [i, j] in places() {
            let [x, y] = at(i, j);
            assert_eq!(table.contains(&v(x + 0.045, y + 0.055)), !full[i][j], "{round}: {i} {j} {full:?}");
        }
        // parts that touch in a point, between two blocks that do, may count as one
        let pinched = (0..=N).flat_map(|i| (0..=N).map(move |j| (i, j))).any(|(i, j)| {
            let [a, b, c, d] = [full[i][j], full[i + 1][j], full[i + 1][j + 1], full[i][j + 1]];
            a == c && b == d && a != b
        });
        let (found, expected) = (table.components().len(), parts(&full));
        assert!(found == expected || (pinched && found < expected), "{round}: {found} {expected} {full:?}");
        plain += usize::from(!pinched);
        parted += usize::from(!pinched && expected > 1);
    }
    assert!(plain > 20 && parted > 5, "{plain} {parted}");
}

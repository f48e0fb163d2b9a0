//! The connected parts of tables whose walls touch.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]

mod random;

use core::f64::consts::PI;
use geometry::{
    Lattice, Outline, Piece, Table, Turn, Vector2,
    parry::{Placed, ShapeSpec, Side},
    shapes::{Circle, FullLine, Segment},
};
use random::Random;

fn v(x: f64, y: f64) -> Vector2<f64> {
    Vector2::new(x, y)
}

fn closed(corners: &[Vector2<f64>]) -> Vec<Box<dyn Piece>> {
    let outline = Outline::from(corners[0]);
    let around = corners[1..].iter().chain(&corners[..1]);
    around.fold(outline, |outline, &corner| outline.line_to(corner).unwrap()).close().unwrap()
}

fn room(width: f64, height: f64) -> Vec<Box<dyn Piece>> {
    closed(&[v(0.0, 0.0), v(width, 0.0), v(width, height), v(0.0, height)])
}

fn disk(x: f64, y: f64, r: f64) -> Vec<Box<dyn Piece>> {
    vec![Box::new(Circle::new(v(x, y), r, false).unwrap())]
}

fn screen(a: Vector2<f64>, b: Vector2<f64>) -> Vec<Box<dyn Piece>> {
    Placed::from(ShapeSpec::Segment { a: a.into(), b: b.into() }).pieces(Side::Outside).unwrap()
}

#[track_caller]
fn table(walls: impl IntoIterator<Item = Vec<Box<dyn Piece>>>) -> Table {
    let table = Table::new(walls.into_iter().flatten().collect()).unwrap();
    assert_eq!(table.validate(), Ok(()), "{:?}", table.pieces());
    table
}

fn on(lattice: &[Vector2<f64>], walls: Vec<Box<dyn Piece>>) -> Table {
    let table = Table::periodic(walls, Some(Lattice::new(lattice).unwrap())).unwrap();
    table.validate().unwrap();
    table
}

/// The areas of the parts, in rising order, which are as expected to rounding.
#[track_caller]
fn has_parts(table: &Table, expected: &[f64]) {
    let mut found: Vec<f64> = table.components().iter().map(|part| part.area).collect();
    found.sort_by(f64::total_cmp);
    let near = |(a, b): (&f64, &f64)| a == b || (a - b).abs() < 1e-12;
    assert!(found.len() == expected.len() && found.iter().zip(expected).all(near), "{found:?}, not {expected:?}");
}

#[test]
fn walls_of_two_sides_part_a_room_where_they_reach_across() {
    let across = |a, b| table([room(2.0, 1.0), screen(a, b)]);
    has_parts(&across(v(0.5, 0.0), v(0.5, 1.0)), &[0.5, 1.5]);
    has_parts(&across(v(0.0, 0.0), v(2.0, 1.0)), &[1.0, 1.0]);
    has_parts(&across(v(0.0, 0.25), v(1.0, 1.0)), &[0.375, 1.625]);
    // a baffle, and one that stands alone
    has_parts(&across(v(0.5, 0.0), v(0.5, 0.75)), &[2.0]);
    has_parts(&across(v(0.5, 0.25), v(0.5, 0.75)), &[2.0]);
    // two that cross are four
    let cross = [
        screen(v(0.5, 0.0), v(0.5, 0.5)),
        screen(v(0.5, 0.5), v(0.5, 1.0)),
        screen(v(0.0, 0.5), v(0.5, 0.5)),
        screen(v(0.5, 0.5), v(2.0, 0.5)),
    ];
    has_parts(&table([room(2.0, 1.0)].into_iter().chain(cross)), &[0.25, 0.25, 0.75, 0.75]);
    // an arc there and back
    let arc = Outline::from(v(1.0, 0.0)).arc_to(v(0.0, 1.0), v(0.0, 0.0), Turn::CounterClockwise).unwrap();
    let arc = arc.arc_to(v(1.0, 0.0), v(0.0, 0.0), Turn::Clockwise).unwrap().close().unwrap();
    has_parts(&table([room(2.0, 1.0), arc]), &[0.25 * PI, 2.0 - 0.25 * PI]);
}

#[test]
fn walls_of_two_sides_make_a_cage_in_the_open_plane() {
    let corners = [v(0.0, 0.0), v(1.0, 0.0), v(1.0, 1.0), v(0.0, 1.0)];
    let side = |k: usize| screen(corners[k], corners[(k + 1) % 4]);
    has_parts(&table([0, 1, 2, 3].map(side)), &[1.0, f64::INFINITY]);
    has_parts(&table([0, 1, 2].map(side)), &[f64::INFINITY]);
}

#[test]
fn obstacles_part_a_room_where_they_touch_it_and_each_other() {
    // sides of 2 touched by a disk in the middle
    let corner = 1.0 - 0.25 * PI;
    has_parts(&table([room(2.0, 2.0), disk(1.0, 1.0, 1.0)]), &[corner; 4]);
    has_parts(&table([room(2.0, 4.0), disk(1.0, 1.0, 1.0)]), &[corner, corner, 6.0 - 0.5 * PI]);
    has_parts(&table([room(4.0, 4.0), disk(1.0, 1.0, 1.0)]), &[corner, 15.0 - 0.75 * PI]);
    has_parts(&table([room(4.0, 4.0), disk(2.0, 1.0, 1.0)]), &[16.0 - PI]);
    let wall = [disk(1.0, 0.5, 0.5), disk(1.0, 1.5, 0.5)];
    let half = 1.0 * 2.0 - 0.25 * PI;
    has_parts(&table([room(2.0, 2.0)].into_iter().chain(wall)), &[half, half]);
    // a diamond with its corners on the walls
    let diamond = closed(&[v(1.0, 0.0), v(0.0, 1.0), v(1.0, 2.0), v(2.0, 1.0)]);
    has_parts(&table([room(2.0, 2.0), diamond]), &[0.5; 4]);
}

#[test]
fn parts_do_not_depend_on_where_and_how_a_table_lies() {
    for k in 0..100 {
        let (sin, cos) = libm::sincos(0.37 * f64::from(k));
        let (dx, dy) = (3.1 * f64::from(k % 7), -7.7 * f64::from(k % 5));
        let at = |x: f64, y: f64| v(x * cos - y * sin + dx, x * sin + y * cos + dy);
        let room = || closed(&[at(0.0, 0.0), at(2.0, 0.0), at(2.0, 2.0), at(0.0, 2.0)]);
        let disk = |x: f64, y: f64, r: f64| disk(at(x, y).x, at(x, y).y, r);
        let [corner, half] = [1.0 - 0.25 * PI, 2.0 - 0.25 * PI];
        has_parts(&table([room(), disk(1.0, 1.0, 1.0)]), &[corner; 4]);
        has_parts(&table([room(), disk(1.0, 0.5, 0.5), disk(1.0, 1.5, 0.5)]), &[half; 2]);
        has_parts(&table([room(), screen(at(0.5, 0.0), at(0.5, 2.0))]), &[1.0, 3.0]);
        let diamond = closed(&[at(1.0, 0.0), at(0.0, 1.0), at(1.0, 2.0), at(2.0, 1.0)]);
        has_parts(&table([room(), diamond]), &[0.5; 4]);
    }
}

#[test]
fn three_disks_that_touch_enclose_a_triangle() {
    let top = 0.75_f64.sqrt();
    let disks = [disk(0.0, 0.0, 0.5), disk(1.0, 0.0, 0.5), disk(0.5, top, 0.5)];
    has_parts(&table(disks), &[0.5 * top - PI / 8.0, f64::INFINITY]);
}

#[test]
fn disks_that_touch_on_a_lattice_leave_pores() {
    let top = 0.75_f64.sqrt();
    let pore = 0.5 * top - PI / 8.0;
    for (turn, x, y) in
        [(0.0, 0.0, 0.0), (0.3, 0.1, 0.7), (1.0, -3.3, 20.0), (2.5, 1.0 / 3.0, -0.9), (-0.7, 150.0, 0.2)]
    {
        let (sin, cos) = libm::sincos(turn);
        let turned = |a: f64, b: f64| v(a * cos - b * sin, a * sin + b * cos);
        let packed = on(&[turned(1.0, 0.0), turned(0.5, top)], disk(x, y, 0.5));
        has_parts(&packed, &[pore, pore]);
        let packed = packed.describe();
        assert_eq!((packed.corners, packed.re_entrant_corners), (6, 0), "{turn}"); // three cusps each
    }
    let square = on(&[v(1.0, 0.0), v(0.0, 1.0)], disk(0.25, 0.75, 0.5));
    has_parts(&square, &[1.0 - 0.25 * PI]);
    assert_eq!(square.describe().corners, 4);
    // rows that touch, with channels between them
    has_parts(&on(&[v(1.0, 0.0), v(0.0, 2.0)], disk(0.0, 0.0, 0.5)), &[2.0 - 0.25 * PI]);
    let rows: Vec<_> = [disk(0.0, 0.0, 0.5), disk(0.0, 2.0, 0.5)].into_iter().flatten().collect();
    has_parts(&on(&[v(1.0, 0.0), v(0.0, 5.0)], rows), &[2.0 - 0.25 * PI, 3.0 - 0.25 * PI]);
    let channel = || {
        let lines = [(0.0, 1.0), (1.0, -1.0)];
        lines.map(|(y, x)| Box::new(FullLine::new(v(0.0, y), v(x, 0.0)).unwrap()) as Box<dyn Piece>).into_iter()
    };
    has_parts(&on(&[v(2.0, 0.0)], channel().chain(disk(0.5, 0.5, 0.5)).collect()), &[2.0 - 0.25 * PI]);
    let both = disk(0.5, 0.5, 0.5).into_iter().chain(disk(1.5, 0.5, 0.5));
    let pore = 0.5 * (1.0 - 0.25 * PI);
    has_parts(&on(&[v(3.0, 0.0)], channel().chain(both).collect()), &[pore, pore, 2.0 - 0.25 * PI]);
}

#[test]
fn a_band_has_its_area_whichever_translates_of_its_walls_are_drawn() {
    let wall = |y: f64, forward: bool| {
        let [from, to] = if forward { [0.0, 1.0] } else { [1.0, 0.0] };
        Box::new(Segment::new(v(from, y), v(to, y)).unwrap()) as Box<dyn Piece>
    };
    for row in [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0] {
        let band = on(&[v(1.0, 0.0), v(0.0, 1.0)], vec![wall(0.25, true), wall(0.75 + row, false)]);
        has_parts(&band, &[0.5]);
        assert!((band.area() - 0.5).abs() < 1e-14);
    }
}

#[test]
fn a_piece_that_bounds_two_parts_is_named_in_both() {
    let parts = table([room(2.0, 1.0), screen(v(0.5, 0.0), v(0.5, 1.0))]).components();
    let pieces: Vec<_> = parts.into_iter().map(|part| part.pieces).collect();
    assert_eq!(pieces, [vec![0, 1, 2, 4], vec![0, 2, 3, 4]]);
    let sinai = table([room(2.0, 2.0), disk(1.0, 1.0, 1.0)]).describe();
    assert_eq!((sinai.components.len(), sinai.corners, sinai.re_entrant_corners), (4, 12, 0));
}

#[test]
fn corners_are_counted_on_both_sides_of_what_stands_on_a_wall() {
    let counts = |walls: Vec<Vec<Box<dyn Piece>>>| {
        let described = table(walls).describe();
        (described.corners, described.re_entrant_corners)
    };
    let circle = || vec![Box::new(Circle::new(v(0.0, 0.0), 1.0, true).unwrap()) as Box<dyn Piece>];
    let there_and_back = |a, b| closed(&[a, b]);
    for angle in [0.0, 0.5, 2.0, 3.0, 6.0] {
        let (sin, cos) = libm::sincos(angle);
        let rim = v(cos, sin);
        let beside = |s: f64| rim * 0.5 + v(-sin, cos) * s;
        // two right angles and a tip
        assert_eq!(counts(vec![circle(), screen(v(0.0, 0.0), rim)]), (3, 1), "{angle}");
        assert_eq!(counts(vec![circle(), there_and_back(v(0.0, 0.0), rim)]), (3, 1), "{angle}");
        assert_eq!(counts(vec![circle(), screen(-rim, rim)]), (4, 0), "{angle}");
        assert_eq!(counts(vec![circle(), closed(&[rim, beside(-0.2), beside(0.2)])]), (4, 2), "{angle}");
        // alone, two tips
        assert_eq!(counts(vec![circle(), screen(rim * 0.5, v(0.0, 0.0))]), (2, 2), "{angle}");
        assert_eq!(counts(vec![circle(), there_and_back(rim * 0.5, v(0.0, 0.0))]), (2, 2), "{angle}");
    }
    let around = |slits: Vec<Vec<Box<dyn Piece>>>| {
        counts([room(2.0, 2.0), disk(1.0, 1.0, 0.5)].into_iter().chain(slits).collect())
    };
    assert_eq!(around(vec![screen(v(1.5, 1.0), v(2.0, 1.0))]), (8, 0));
    assert_eq!(around(vec![screen(v(1.5, 1.0), v(1.7, 1.0))]), (7, 1));
    assert_eq!(around(vec![screen(v(1.5, 1.0), v(2.0, 1.2)), screen(v(1.5, 1.0), v(2.0, 0.8))]), (11, 0));
    assert_eq!(counts(vec![room(2.0, 1.0), screen(v(0.5, 0.5), v(1.0, 0.5))]), (6, 2));
}

#[test]
fn what_stands_in_a_pocket_of_an_obstacle_does_not_hide_what_lies_around() {
    let corners =
        [v(1.0, 1.0), v(4.0, 1.0), v(4.0, 0.0), v(0.0, 0.0), v(0.0, 5.0), v(4.0, 5.0), v(4.0, 4.0), v(1.0, 4.0)];
    for turn in 0..8 {
        // open in each of the four directions, and drawn from each of its corners
        let turned = |p: Vector2<f64>| [p, v(-p.y, p.x), -p, v(p.y, -p.x)][turn % 4];
        let c = || {
            let mut corners = corners.map(turned);
            corners.rotate_left(turn);
            closed(&corners)
        };
        let disk = |x: f64, y: f64, r: f64| disk(turned(v(x, y)).x, turned(v(x, y)).y, r);
        let square = |r: f64, x: f64, y: f64| {
            closed(&[v(-r, -r), v(r, -r), v(r, r), v(-r, r)].map(|corner| corner + turned(v(x, y))))
        };
        let around = || square(10.0, 0.0, 0.0);
        has_parts(&table([around(), c(), disk(2.2, 2.0, 0.5)]), &[389.0 - 0.25 * PI]);
        let slit = screen(turned(v(2.0, 2.0)), turned(v(2.5, 2.1)));
        has_parts(&table([c(), around(), slit, disk(3.0, 3.0, 0.5)]), &[389.0 - 0.25 * PI]);
        // a room in its wall, with something in it
        let (room, pillar, small) = (|| square(0.25, 0.5, 2.5), || disk(0.5, 2.5, 0.125), 0.25 - PI / 64.0);
        let circle = vec![Box::new(Circle::new(v(0.0, 0.0), 20.0, true).unwrap()) as Box<dyn Piece>];
        has_parts(&table([circle, c(), room(), pillar()]), &[small, 400.0 * PI - 11.0]);
        let all = [pillar(), c(), room(), disk(2.2, 2.0, 0.5), around()];
        has_parts(&table(all), &[small, 389.0 - 0.25 * PI]);
        // two that reach into each other
        let hook: Vec<_> = corners.iter().rev().map(|p| turned(v(5.5 - p.x, p.y + 2.5))).collect();
        has_parts(&table([around(), c(), closed(&hook), disk(2.2, 1.75, 0.125)]), &[378.0 - PI / 64.0]);
    }
}

/// Squares of side 1, some of them table and the others solid, no two of a kind touching at a point only.
struct Maze {
    side: i32,
    table: Vec<bool>,
    /// What lies beyond the outermost squares: more of the same (`None`), table, or solid.
    beyond: Option<bool>,
}

/// One step to the right, up, to the left and down.
const STEPS: [[i32; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

impl Maze {
    fn random(side: i32, beyond: Option<bool>, filling: f64, random: &mut Random) -> Maze {
        let mut maze = Maze { side, table: vec![], beyond };
        maze.table = (0..side * side).map(|_| random.unit() < filling).collect();
        // until no squares touch at a point only
        loop {
            let all = || (-1..=side).flat_map(|x| (-1..=side).map(move |y| [x, y]));
            let touch = |[x, y]: &[i32; 2]| {
                let [a, b, c, d] = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[i, j]| maze.is_table([x + i, y + j]));
                a == d && b == c && a != b
            };
            let Some([x, y]) = all().find(touch) else { return maze };
            let solid = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[i, j]| [x + i, y + j]);
            let place = solid.into_iter().find_map(|at| maze.place(at).filter(|&at| !maze.table[at]));
            let other = solid.into_iter().find_map(|at| maze.place(at));
            if let Some(at) = place.or(other) {
                maze.table[at] = !maze.table[at];
            }
        }
    }
    fn place(&self, [x, y]: [i32; 2]) -> Option<usize> {
        let [i, j] = [x, y].map(|c| c.rem_euclid(self.side));
        (self.beyond.is_none() || [i, j] == [x, y]).then(|| usize::try_from(i + self.side * j).unwrap())
    }
    fn is_table(&self, at: [i32; 2]) -> bool {
        self.place(at).map_or(self.beyond == Some(true), |place| self.table[place])
    }
    /// The square on the left of a side from a vertex on, and the one on its right.
    fn beside([x, y]: [i32; 2], direction: usize) -> [[i32; 2]; 2] {
        let [a, b] = [[x, y], [x, y - 1]];
        let [c, d] = [[x - 1, y], [x - 1, y - 1]];
        [[a, b], [c, a], [d, c], [b, d]][direction]
    }
    /// The sides of the table, loop by loop, each from one of its vertices on.
    fn walls(&self, random: &mut Random) -> Vec<Box<dyn Piece>> {
        let reach = if self.beyond.is_none() { self.side - 1 } else { self.side };
        let mut seen = std::collections::HashSet::new();
        let mut walls = vec![];
        let every = (0..=reach).flat_map(|x| (0..=reach).flat_map(move |y| (0..4).map(move |turn| ([x, y], turn))));
        let mut starts: Vec<([i32; 2], usize)> = every.collect();
        for k in 1..starts.len() {
            starts.swap(k, random.below(k + 1));
        }
        for start in starts {
            let (mut at, mut direction) = start;
            loop {
                let key = if self.beyond.is_none() { at.map(|c| c.rem_euclid(self.side)) } else { at };
                let [left, right] = Maze::beside(at, direction).map(|square| self.is_table(square));
                if !(left && !right && seen.insert((key, direction))) {
                    break;
                }
                let next = [0, 1].map(|i| at[i] + STEPS[direction][i]);
                let [a, b] = [at, next].map(|[x, y]| v(f64::from(x), f64::from(y)));
                walls.push(Box::new(Segment::new(a, b).unwrap()) as Box<dyn Piece>);
                at = next;
                let turns = [0, 1, 3].map(|turn| (direction + turn) % 4);
                direction = *turns
                    .iter()
                    .find(|&&turn| {
                        let [left, right] = Maze::beside(at, turn).map(|square| self.is_table(square));
                        left && !right
                    })
                    .unwrap();
            }
        }
        walls
    }
    /// For each square that is table, the number of its part: the least of its places, or that of what lies beyond.
    fn parts(&self) -> Vec<Option<usize>> {
        let count = self.table.len();
        let mut parts: Vec<Option<usize>> = (0..count).map(|k| self.table[k].then_some(k)).collect();
        loop {
            let before = parts.clone();
            for at in (0..self.side).flat_map(|x| (0..self.side).map(move |y| [x, y])) {
                let here = self.place(at).unwrap();
                for step in STEPS {
                    let next = [0, 1].map(|i| at[i] + step[i]);
                    let there = match self.place(next) {
                        Some(place) => parts[place],
                        None => (self.beyond == Some(true)).then_some(count),
                    };
                    // what lies beyond comes first
                    let first = |a: usize, b: usize| if a == count || b == count { count } else { a.min(b) };
                    if let (Some(a), Some(b)) = (parts[here], there) {
                        parts[here] = Some(first(a, b));
                    }
                }
            }
            if parts == before {
                return parts;
            }
        }
    }
}

#[test]
fn the_parts_of_a_maze_are_those_that_a_walk_finds() {
    let mut random = Random(31);
    let mut counts = [0; 6];
    for k in 0..300 {
        let side = 4 + k % 9;
        let beyond = [Some(false), Some(true), None][usize::try_from(k).unwrap() / 9 % 3];
        let maze = Maze::random(side, beyond, random.between(0.2, 0.7), &mut random);
        let parts = maze.parts();
        let mut walls = maze.walls(&mut random);
        if walls.is_empty() {
            continue;
        }
        let mut areas = vec![0.0; parts.len() + 1];
        areas[parts.len()] = if beyond == Some(true) { f64::INFINITY } else { 0.0 };
        for (place, part) in parts.iter().enumerate() {
            let Some(part) = part else { continue };
            areas[*part] += 1.0;
            // something stands in some of the squares
            let place = i32::try_from(place).unwrap();
            let [x, y] = [place % side, place / side].map(|c| f64::from(c) + 0.5);
            let what = random.unit();
            if what < 0.2 {
                walls.extend(disk(x, y, 0.25));
                areas[*part] -= PI / 16.0;
            } else if what < 0.3 {
                walls.extend(screen(v(x - 0.3, y + 0.1), v(x + 0.3, y)));
            } else if what < 0.4 {
                walls.extend(closed(&[v(x - 0.3, y + 0.1), v(x + 0.3, y)]));
            }
        }
        areas.retain(|area| *area > 0.0);
        areas.sort_by(f64::total_cmp);
        let table = match beyond {
            None => on(&[v(f64::from(side), 0.0), v(0.0, f64::from(side))], walls),
            Some(false) => table([walls]),
            Some(true) => {
                let table = Table::new(walls).unwrap().unbounded();
                table.validate().unwrap();
                table
            }
        };
        has_parts(&table, &areas);
        counts[areas.len().min(5)] += 1;
    }
    assert!(counts[1..].iter().all(|count| *count > 10), "{counts:?}");
}

fn segments(ends: &[[[f64; 2]; 2]]) -> Vec<Box<dyn Piece>> {
    ends.iter().map(|[a, b]| Box::new(Segment::new((*a).into(), (*b).into()).unwrap()) as Box<dyn Piece>).collect()
}

#[test]
fn a_half_plane_above_a_periodic_floor_has_no_finite_area() {
    let channel = || Some(Lattice::new(&[v(1.0, 0.0)]).unwrap());
    let pits = [[[0.0, 0.5], [0.5, 0.0]], [[0.5, 0.0], [1.0, 0.5]]];
    let hills = [[[0.0, 0.0], [0.5, 0.5]], [[0.5, 0.5], [1.0, 0.0]]];
    for floor in [pits, hills] {
        let open = Table::periodic(segments(&floor), channel()).unwrap();
        assert_eq!(open.area(), f64::INFINITY, "{floor:?}");
        let walls = segments(&[floor[0], floor[1], [[1.0, 2.0], [0.0, 2.0]]]);
        let closed = Table::periodic(walls, channel()).unwrap();
        assert!((closed.area() - 1.75).abs() < 1e-15, "{floor:?}");
    }
}

#[test]
fn an_area_does_not_depend_on_the_cells_in_which_sides_are_drawn() {
    let mut random = Random(3);
    for _ in 0..300 {
        let vectors =
            [v(random.between(1.0, 2.0), 0.3 * random.unit()), v(0.3 * random.unit(), random.between(1.0, 2.0))];
        let lattice = Lattice::new(&vectors).unwrap();
        let center = vectors[0] * random.unit() + vectors[1] * random.unit();
        let sides = 3 + random.below(5);
        let corner = |i: usize| {
            let (sin, cos) = libm::sincos(-2.0 * PI * (i % sides) as f64 / sides as f64);
            center + v(cos, sin) * 0.4
        };
        let mut cells = || (vectors[0] * random.below(3) as f64) + vectors[1] * random.below(3) as f64;
        let walls = (0..sides).map(|i| {
            let side = Segment::new(corner(i), corner(i + 1)).unwrap();
            Box::new(geometry::shapes::Translated::new(std::sync::Arc::new(side), cells())) as Box<dyn Piece>
        });
        let table = Table::periodic(walls.collect(), Some(lattice.clone())).unwrap();
        let obstacle = 0.5 * sides as f64 * 0.16 * libm::sin(2.0 * PI / sides as f64);
        let expected = lattice.cell_area() - obstacle;
        assert!((table.area() - expected).abs() < 1e-12, "{} {expected}", table.area());
    }
}

//! Scatterers that touch: no path passes between them.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
use geometry::{
    Lattice, Outline, Piece, Table, Turn, Vector2, WallHit, Walls, WithWalls,
    shapes::{Circle, Ellipse},
};

fn v(x: f64, y: f64) -> Vector2<f64> {
    Vector2::new(x, y)
}

fn turned(p: Vector2<f64>, angle: f64) -> Vector2<f64> {
    let (sin, cos) = libm::sincos(angle);
    v(cos * p.x - sin * p.y, sin * p.x + cos * p.y)
}

fn disk(center: Vector2<f64>, radius: f64) -> Box<dyn Piece> {
    Box::new(Circle::new(center, radius, false).unwrap())
}

/// The first hit of a path.
struct First(Vector2<f64>, Vector2<f64>);

impl WithWalls<2> for First {
    type Output = WallHit<f64, 2>;
    fn run<W: Walls<2>>(self, walls: &W) -> Self::Output {
        walls.first_hit(&self.0.into(), &self.1.into())
    }
}

/// Paths towards the place where two walls touch, along their common tangent there: from both sides, near and far, aimed as well as may
/// be and beside it by so many roundings.
fn all_end_in(table: &Table, place: Vector2<f64>, tangent: Vector2<f64>, far: f64) {
    let across = v(-tangent.y, tangent.x);
    for (k, from) in [0.03, 0.4, 0.9].into_iter().flat_map(|part| [(part, 1.0), (part, -1.0)]).enumerate() {
        let start = place - tangent * (from.0 * far * from.1);
        for aside in [0.0, 1.0, -1.0, 2.0, -3.0] {
            let start = start + across * (aside * f64::EPSILON * far);
            let hit = table.with_walls(First(start, tangent * from.1));
            // beside it, one of the two may be met, the root of rounding before
            assert!(hit.time < (from.0 + 1e-6) * far, "{k}: aside {aside}: {hit:?}");
            let is_cusp = (Vector2::from(hit.point) - place).amax() <= 1e-14 * far;
            assert!(hit.corner || !is_cusp, "{k}: aside {aside}: {hit:?}");
            assert!(aside != 0.0 || hit.corner || hit.time < from.0 * far, "{k}: {hit:?}");
        }
    }
}

#[test]
fn a_path_between_disks_that_touch_ends_in_the_cusp() {
    for k in 0..40 {
        let (angle, center) = (0.3 * f64::from(k), v(0.1 * f64::from(k), -0.2));
        let [a, b] = [v(-1.0, 0.0), v(0.5, 0.0)].map(|p| center + turned(p, angle));
        let mut pieces: Vec<Box<dyn Piece>> = vec![disk(a, 1.0), disk(b, 0.5)];
        let open = Table::new(pieces).unwrap().unbounded();
        all_end_in(&open, center, turned(v(0.0, 1.0), angle), 10.0);
        pieces = vec![Box::new(Circle::new(center, 12.0, true).unwrap()), disk(a, 1.0), disk(b, 0.5)];
        all_end_in(&Table::new(pieces).unwrap(), center, turned(v(0.0, 1.0), angle), 10.0);
    }
}

#[test]
fn a_path_between_ellipses_that_touch_ends_in_the_cusp() {
    for [a, b] in [[1.0, 0.5], [0.7, 0.3], [1.0, 1.5], [0.9, 0.9]] {
        for turn in 0..12 {
            let (angle, center) = (0.7 * f64::from(turn), v(0.1 * f64::from(turn), 0.2));
            let oval = |x: f64| {
                let center = center + turned(v(x, 0.0), angle);
                Box::new(Ellipse::new(center, [a, b], angle, false).unwrap()) as Box<dyn Piece>
            };
            let around: Box<dyn Piece> = Box::new(Circle::new(center, 6.0, true).unwrap());
            let table = Table::new(vec![around, oval(-a), oval(a)]).unwrap();
            all_end_in(&table, center, turned(v(0.0, 1.0), angle), 4.0);
        }
    }
}

#[test]
fn a_path_into_a_cusp_between_arcs_ends_there_though_another_room_lies_beyond() {
    for turn in 0..20 {
        let (angle, center) = (0.37 * f64::from(turn), v(0.3, 0.1 * f64::from(turn)));
        let at = |x: f64, y: f64| center + turned(v(x, y), angle);
        let room = |s: f64| {
            let outline =
                Outline::from(at(0.0, 0.0)).arc_to(at(2.0 * s, 2.0 * s), at(2.0 * s, 0.0), Turn::Clockwise).unwrap();
            let outline = outline.line_to(at(-2.0 * s, 2.0 * s)).unwrap();
            outline.arc_to(at(0.0, 0.0), at(-2.0 * s, 0.0), Turn::Clockwise).unwrap().close().unwrap()
        };
        let table = Table::new(room(1.0).into_iter().chain(room(-1.0)).collect()).unwrap();
        all_end_in(&table, center, turned(v(0.0, 1.0), angle), 1.5);
    }
}

#[test]
fn disks_that_touch_on_a_lattice_leave_no_way_out() {
    let square = Lattice::new(&[v(1.0, 0.0), v(0.0, 1.0)]).unwrap();
    for center in [v(0.5, 0.5), v(0.0, 0.0), v(0.3, 0.7)] {
        let table = Table::periodic(vec![disk(center, 0.5)], Some(square.clone())).unwrap();
        for tangent in [v(1.0, 0.0), v(0.0, 1.0), v(-1.0, 0.0), v(0.0, -1.0)] {
            let start = table.home(&(center + v(0.5, 0.5)));
            let hit = table.with_walls(First(start, tangent));
            assert!(hit.corner && (hit.time - 0.5).abs() < 1e-14, "{center} {tangent}: {hit:?}");
        }
    }
    for angle in [0.0, 0.2, 0.7, 1.3] {
        let vectors = [v(1.0, 0.0), v(0.5, 0.75_f64.sqrt())].map(|vector| turned(vector, angle));
        let radius = 0.5 * vectors.iter().map(|a| libm::hypot(a.x, a.y)).fold(1.0, f64::min);
        let table = Table::periodic(vec![disk(v(0.0, 0.0), radius)], Some(Lattice::new(&vectors).unwrap())).unwrap();
        let room = (vectors[0] + vectors[1]) / 3.0;
        for way in [vectors[0], vectors[1], vectors[0] + vectors[1]] {
            // from the middle of the room to the middle of a side of its triangle
            let middle = way * 0.5;
            let hit = table.with_walls(First(table.home(&room), (middle - room) / (middle - room).norm()));
            assert!(hit.time < (middle - room).norm() + 1e-6, "{angle}: {hit:?}");
        }
    }
}

#[test]
fn where_scatterers_do_not_touch_paths_pass() {
    let gap = 1e-13;
    let pieces = vec![disk(v(-1.0, 0.0), 1.0), disk(v(1.0 + gap, 0.0), 1.0)];
    let table = Table::new(pieces).unwrap().unbounded();
    let hit = table.with_walls(First(v(0.5 * gap, -3.0), v(0.0, 1.0)));
    assert!(hit.time == f64::INFINITY, "{hit:?}");
    // and a lone disk on a lattice, however near its translates, is the fastest
    let square = Lattice::new(&[v(1.0, 0.0), v(0.0, 1.0)]).unwrap();
    let near = Table::periodic(vec![disk(v(0.5, 0.5), 0.5 - gap)], Some(square)).unwrap();
    assert!(near.with_walls(First(v(0.0, 0.0), v(1.0, 0.0))).time == f64::INFINITY);
}

fn loop_of(corners: &[[f64; 2]]) -> Vec<Box<dyn Piece>> {
    let start = Vector2::from(corners[0]);
    let mut outline = Outline::from(start);
    for corner in corners[1..].iter().chain([&corners[0]]) {
        outline = outline.line_to(Vector2::from(*corner)).unwrap();
    }
    outline.close().unwrap()
}

#[test]
fn a_path_to_where_a_vertex_stands_on_a_wall_ends_there() {
    let box_around = || loop_of(&[[0.0, -1.0], [1.0, -1.0], [1.0, 1.0], [0.0, 1.0]]);
    let obstacle = || loop_of(&[[1.0, 0.0], [0.5, -0.2], [0.5, 0.2]]);
    let circle = || vec![Box::new(Circle::new(v(0.0, 0.0), 1.0, true).unwrap()) as Box<dyn Piece>];
    let halved = || loop_of(&[[0.0, -1.0], [1.0, -1.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    // walls beside, so that there are too many for a list of few
    let many = || {
        (0..40).flat_map(|k| {
            let (x, y) = (0.02 + 0.01 * f64::from(k), -0.9);
            loop_of(&[[x, y], [x, y + 0.005], [x + 0.005, y + 0.005], [x + 0.005, y]])
        })
    };
    let tables = [
        box_around().into_iter().chain(obstacle()).collect(),
        obstacle().into_iter().chain(box_around()).collect(),
        circle().into_iter().chain(obstacle()).collect(),
        halved().into_iter().chain(obstacle()).collect(),
        box_around().into_iter().chain(obstacle()).chain(many()).collect(),
        circle().into_iter().chain(obstacle()).chain(many()).collect::<Vec<_>>(),
    ];
    for (k, pieces) in tables.into_iter().enumerate() {
        let table = Table::new(pieces).unwrap();
        for up in [1.0, -1.0] {
            for (x, y) in [(0.75, 0.5), (0.5, 0.5), (0.9, 0.125)] {
                let (from, to) = (v(x, up * y), v(1.0 - x, -up * y));
                let hit = table.with_walls(First(from, to));
                assert!(hit.corner && (hit.time - 1.0).abs() < 1e-14, "{k}: {from} {hit:?}");
                // not beside it
                let aside = table.with_walls(First(from, to + v(0.0, 1e-12 * up)));
                assert!(!aside.corner, "{k}: {from} {aside:?}");
            }
        }
    }
}

#[test]
fn so_it_does_where_rounding_has_taken_the_vertex_off_the_wall() {
    for k in 1..60 {
        let (angle, far) = (0.1 * f64::from(k), v(0.3 * f64::from(k), -f64::from(k * k)));
        let at = |x: f64, y: f64| (far + turned(v(x, y), angle)).into();
        let mut pieces = loop_of(&[at(0.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(0.0, 1.0)]);
        pieces.extend(loop_of(&[at(1.0, 0.0), at(0.5, -0.2), at(0.5, 0.2)]));
        let table = Table::new(pieces).unwrap();
        for (x, y) in [(0.75, 0.5), (0.5, 0.5), (0.75, -0.5), (0.5, -0.5)] {
            let (from, to): (Vector2<f64>, Vector2<f64>) = (Vector2::from(at(x, y)), Vector2::from(at(1.0, 0.0)));
            let hit = table.with_walls(First(from, to - from));
            assert!(hit.corner && (hit.time - 1.0).abs() < 1e-14 * far.norm().max(1.0) / 0.5, "{k}: {hit:?}");
        }
    }
}

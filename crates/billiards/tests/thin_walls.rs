//! Both faces of a wall without thickness are parts of the boundary: ensembles start on them, and the billiard map keeps them apart.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
use billiards::{
    Canonical, Grid, Planar, ReducedState, Starts,
    laws::{Disk, Specular},
};
use collision_laws::laws::NoSlip;
use core::f64::consts::{FRAC_1_SQRT_2, PI};
use geometry::{
    Piece, Table, Vector2,
    shapes::{Circle, Screen},
};

/// In a circle of radius 2, a wall from one point to another: piece 1.
fn table([a, b]: [[f64; 2]; 2]) -> Table {
    let circle = Circle::new(Vector2::zeros(), 2.0, true).unwrap();
    Table::new(vec![Box::new(circle) as Box<dyn Piece>, Box::new(Screen::new(a.into(), b.into()).unwrap())]).unwrap()
}

const WALLS: [[[f64; 2]; 2]; 2] = [[[-0.5, 0.0], [0.5, 0.0]], [[0.02, 0.9], [-0.1, 0.16]]];

/// Starts on the left and on the right face of the wall.
fn by_face([a, b]: [[f64; 2]; 2], starts: &impl Starts<2, 1>, count: u32) -> [f64; 2] {
    let (a, along) = (Vector2::from(a), Vector2::from(b) - Vector2::from(a));
    let mut faces = [0.0; 2];
    for i in 0..count {
        let start = starts.start(u64::from(i));
        let from = Vector2::from(start.position) - a;
        let beside = along.perp(&from).abs() < 1e-12;
        if beside && (0.0..=along.norm_squared()).contains(&from.dot(&along)) {
            faces[usize::from(along.perp(&Vector2::from(start.velocity)) < 0.0)] += 1.0;
        }
    }
    faces
}

#[test]
fn as_many_orbits_start_on_one_face_of_a_thin_wall_as_on_the_other() {
    for wall in WALLS {
        let table = table(wall);
        let n = 100_000;
        let each = f64::from(n) * 0.5 * table.pieces()[1].length() / (table.pieces()[1].length() + 4.0 * PI);
        let [left, right] = by_face(wall, &Canonical::new(&table, 1.0, 9).unwrap(), n);
        for face in [left, right] {
            assert!((face - each).abs() < 4.0 * each.sqrt(), "{wall:?}: {left} and {right}, not {each}");
        }
        // of a grid all arcs have the same number of starts, and each face a whole number of arcs but for two
        let grid = Grid::new(&table, 1.0, [1000, 10, 10]).unwrap();
        for face in by_face(wall, &grid, n) {
            assert!((face - each).abs() <= 200.0, "{wall:?}: {face} for {each}");
        }
    }
}

/// How far apart two states are on one piece, which is closed.
fn distance(table: &Table, a: &ReducedState, b: &ReducedState) -> f64 {
    assert_eq!(a.piece, b.piece);
    let s = (a.s - b.s).abs();
    s.min(table.pieces()[a.piece].length() - s).max((a.v0 - b.v0).abs()).max((a.vt - b.vt).abs())
}

#[test]
fn the_billiard_map_and_its_inverse_know_both_faces_of_a_thin_wall() {
    for wall in WALLS {
        let table = table(wall);
        let rough = Planar { table: table.clone(), law: Disk::new(&NoSlip, FRAC_1_SQRT_2).unwrap() };
        let smooth = Planar { table, law: Specular };
        let table = &smooth.table;
        let length = table.pieces()[1].length();
        let mut faces = [0; 2];
        for k in 0..400 {
            let vt = if k % 2 == 0 { 0.2 } else { -0.2 };
            let place = (f64::from(k) + 0.5) / 400.0;
            let [on_wall, on_circle] = [(1, length), (0, 4.0 * PI)].map(|(piece, of)| ReducedState {
                piece,
                s: place * of,
                v0: 0.1,
                vt,
                speed: 1.0,
            });
            for state in [on_wall, on_circle] {
                let images = [smooth.map(&state).unwrap(), rough.map(&state).unwrap()];
                let back = [smooth.inverse(&images[0]).unwrap(), rough.inverse(&images[1]).unwrap()];
                for (image, back) in images.iter().zip(&back) {
                    // some ten operations each way on numbers of up to 4π, stretched by flat angles
                    assert!(distance(table, back, &state) < 1e-12, "{wall:?}: {state:?} by {image:?} to {back:?}");
                    if image.piece == 1 {
                        faces[usize::from(image.s > 0.5 * length)] += 1;
                    }
                }
            }
        }
        assert!(faces.iter().all(|&hits| hits > 10), "{wall:?}: {faces:?}");
    }
}

#[test]
fn a_state_on_a_thin_wall_starts_into_its_own_side() {
    for wall in WALLS {
        let table = table(wall);
        let along = Vector2::from(wall[1]) - Vector2::from(wall[0]);
        for k in 0..400 {
            let s = table.pieces()[1].length() * (f64::from(k) + 0.5) / 400.0;
            let start = ReducedState { piece: 1, s, v0: 0.0, vt: 0.1, speed: 1.0 }.start(&table).unwrap();
            assert_eq!(along.perp(&Vector2::from(start.velocity)) > 0.0, k < 200, "{wall:?} at {s}");
        }
    }
}

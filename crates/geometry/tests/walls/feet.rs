//! Where obstacles stand on walls and on each other.

use super::rooms::{AsSolids, First, Wall, room};
use super::side_by_side::SameBits;
use super::*;
use geometry::parry::{
    Side, Solid, SolidSpec as S,
    parry3d_f64::{
        math::Pose,
        shape::{Compound, Cuboid, SharedShape},
    },
};
use geometry::{Boundary, Vector3};
use nalgebra::Isometry3;

/// Obstacles with a place of their foot on the negative side of the first axis, at a height, each in a form of its own.
fn standing(height: f64) -> Vec<(&'static str, Wall)> {
    let [a, b] = [-0.5, 0.5];
    let pyramid = [[a, a, 0.0], [b, a, 0.0], [b, b, 0.0], [a, b, 0.0], [0.0, 0.0, 0.25]];
    let on = |half: f64| [0.0, 0.0, height + half];
    let outside = |spec: S, half: f64| (spec, on(half), Side::Outside);
    vec![
        ("pyramid", outside(S::ConvexHull { points: pyramid.into(), rounding: 0.0 }, 0.0)),
        ("cuboid", outside(S::Cuboid { size: [1.0; 3], rounding: 0.0 }, 0.5)),
        ("cylinder", outside(S::Cylinder { radius: 0.5, height: 1.0, rounding: 0.0 }, 0.5)),
        ("flat cone", outside(S::Cone { radius: 0.5, height: 0.25, rounding: 0.0 }, 0.125)),
        ("steep cone", outside(S::Cone { radius: 0.5, height: 2.0, rounding: 0.0 }, 1.0)),
    ]
}

/// Grounds whose top is the plane across the third axis at −1, in one wall or several.
fn grounds() -> Vec<(&'static str, Vec<Wall>)> {
    let container = (S::Cuboid { size: [8.0, 8.0, 6.0], rounding: 0.0 }, [0.0; 3], Side::Inside);
    let vertices = [[-3.0, -3.0, -1.0], [3.0, -3.0, -1.0], [3.0, 3.0, -1.0], [-3.0, 3.0, -1.0]];
    let sheet = S::TriMesh { vertices: vertices.into(), triangles: vec![[0, 1, 2], [0, 2, 3]], margin: 0.0 };
    let block = S::Cuboid { size: [6.0, 6.0, 1.0], rounding: 0.0 };
    let plane = S::HalfSpace { normal: [0.0, 0.0, 1.0] };
    vec![
        ("room", vec![(S::Cuboid { size: [4.0, 4.0, 2.0], rounding: 0.0 }, [0.0; 3], Side::Inside)]),
        ("plane", vec![(plane, [0.0, 0.0, -1.0], Side::Outside)]),
        ("block", vec![container.clone(), (block, [0.0, 0.0, -1.5], Side::Outside)]),
        ("mesh", vec![container, (sheet, [0.0; 3], Side::Outside)]),
    ]
}

/// Paths to a place from places above it with short coordinates.
fn paths_to(place: [f64; 3], by: f64) -> Vec<Line<3>> {
    let place = Vector3::from(place) + Vector3::x() * by;
    let ways = [[0.25, 0.0, -1.0], [1.0, 0.25, -1.0], [0.5, -0.5, -0.25], [0.125, 0.0, -0.75]];
    ways.map(|way| Line { point: place - Vector3::from(way), velocity: Vector3::from(way) }).into()
}

#[test]
fn a_path_to_the_foot_of_an_obstacle_ends_in_a_corner_whatever_it_stands_on() {
    for (on, ground) in grounds() {
        for (what, obstacle) in standing(-1.0) {
            for walls in [[ground.clone(), vec![obstacle.clone()]].concat(), [vec![obstacle], ground.clone()].concat()]
            {
                let (name, room) = (&format!("{what} on a {on}"), room(&walls));
                for by in [0.0, -1e-12] {
                    let paths = paths_to([-0.5, 0.0, -1.0], by);
                    for path in &paths {
                        let [exact, fast] = [room.first_hit(path).unwrap(), room.with_walls(First(*path))];
                        assert_eq!([exact.corner, fast.corner], [by == 0.0; 2], "{name}: {path:?} {exact:?} {fast:?}");
                    }
                    let many: Vec<_> = paths.iter().cycle().take(64).copied().collect();
                    room.with_walls(AsSolids { name, room: &room, paths: &many });
                    room.with_walls(SameBits { name, paths: &many });
                }
            }
        }
    }
}

#[test]
fn an_obstacle_behind_a_wall_that_it_continues_makes_no_corner() {
    let plane = (S::HalfSpace { normal: [0.0, 0.0, 1.0] }, [0.0; 3], Side::Outside);
    let sunk = (S::Cuboid { size: [1.0; 3], rounding: 0.0 }, [0.0, 0.0, -0.5], Side::Outside);
    let room = room(&[plane, sunk]);
    for at in [[0.0; 3], [0.25, 0.125, 0.0], [0.75, 0.0, 0.0]] {
        for path in paths_to(at, 0.0) {
            let [exact, fast] = [room.first_hit(&path).unwrap(), room.with_walls(First(path))];
            assert!(!exact.corner && !fast.corner, "{path:?}: {exact:?} {fast:?}");
        }
    }
}

#[test]
fn an_edge_between_two_walls_is_a_corner_where_a_third_continues_one_of_them_an_ulp_in_front() {
    let plane = |normal: [f64; 3], height: f64| (S::HalfSpace { normal }, [0.0, 0.0, height], Side::Outside);
    let [floor, side, third] =
        [plane([0.0, 0.0, 1.0], 0.0), plane([1.0, 0.0, 0.0], 0.0), plane([0.0, 0.0, 1.0], 0.5 * f64::EPSILON)];
    let path = Line { point: Vector3::new(1.0, 0.25, 1.0), velocity: Vector3::new(-1.0, 0.0, -1.0) };
    let [a, b, c] = [&floor, &side, &third];
    for order in [[a, b, c], [a, c, b], [b, a, c], [b, c, a], [c, a, b], [c, b, a]] {
        let room = room(&order.map(Wall::clone));
        for hit in [room.first_hit(&path).unwrap(), room.with_walls(First(path))] {
            assert!(hit.time < 1.0 && hit.corner, "{order:?}: {hit:?}");
        }
    }
}

#[test]
fn a_path_to_where_members_of_a_union_meet_ends_in_a_corner() {
    // a step on a block
    let step = |half: [f64; 3], at: [f64; 3]| {
        (Pose::translation(at[0], at[1], at[2]), SharedShape::new(Cuboid::new(half.into())))
    };
    let members = vec![step([2.0, 2.0, 0.5], [0.0, 0.0, -0.5]), step([0.5; 3], [0.0, 0.0, 0.5])];
    let far = members.clone().into_iter().rev().collect();
    for members in [members, far] {
        let outside = Solid::new(&Compound::new(members.clone()), &Isometry3::identity(), Side::Outside).unwrap();
        let inside = Solid::new(&Compound::new(members), &Isometry3::identity(), Side::Inside).unwrap();
        for path in paths_to([-0.5, 0.25, 0.0], 0.0) {
            assert!(outside.first_hit(&path).unwrap().corner, "{path:?}");
            let clear = Line { point: path.point - Vector3::x() * 1e-12, ..path };
            assert!(!outside.first_hit(&clear).unwrap().corner, "{path:?}");
        }
        for way in [[-0.25, 0.125, 0.25], [-0.125, 0.0, 0.125]] {
            let velocity = Vector3::from(way);
            let path = Line { point: Vector3::new(-0.5, 0.25, 0.0) - velocity, velocity };
            assert!(inside.first_hit(&path).unwrap().corner, "{path:?}");
        }
    }
}

#[test]
fn rooms_whose_obstacles_stand_answer_in_lanes_as_their_solids_do() {
    let mut random = Random(29);
    for (on, ground) in grounds() {
        for (what, obstacle) in standing(-1.0) {
            let (name, room) = (&format!("{what} on a {on}"), room(&[ground.clone(), vec![obstacle]].concat()));
            let mut paths = vec![];
            while paths.len() < 256 {
                let quarter = |x: f64| libm::rint(4.0 * x) / 4.0;
                let point =
                    Vector3::from_fn(|i, _| quarter(random.between(-1.7, 1.7) * if i == 2 { 0.5 } else { 1.0 }));
                let velocity = Vector3::from_fn(|_, _| libm::rint(random.between(-3.4, 3.4)));
                if room.distance(&point) > 0.1 && velocity.amax() > 0.0 {
                    paths.push(Line { point, velocity });
                }
            }
            room.with_walls(SameBits { name, paths: &paths });
            room.with_walls(AsSolids { name, room: &room, paths: &paths });
        }
    }
}

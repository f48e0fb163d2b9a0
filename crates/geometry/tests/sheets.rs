//! Walls of triangles with the table on both sides.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
mod random;

use geometry::{
    Boundary, Line, Surface, Vector3,
    parry::{Room, Side, Solid, SolidSpec},
};
use random::Random;

type Triangles = (Vec<[f64; 3]>, Vec<[usize; 3]>);

/// A box, counter-clockwise from outside.
fn cuboid(low: [f64; 3], high: [f64; 3]) -> Triangles {
    let vertices = (0..8).map(|k| [0, 1, 2].map(|i| if k >> i & 1 == 1 { high[i] } else { low[i] })).collect();
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    (vertices, sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect())
}
/// A square across the first axis at x = 1/2, there and back; the triangles of the back have the same corners but
/// another diagonal, or are those about the middle.
fn sheet(low: f64, high: f64, about_middle: bool) -> Triangles {
    let middle = 0.5 * (low + high);
    let corners = [[low, low], [high, low], [high, high], [low, high], [middle, middle]].map(|[y, z]| [0.5, y, z]);
    let mut triangles = vec![[0, 1, 2], [0, 2, 3]];
    if about_middle {
        triangles.extend([[1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]]);
    } else {
        triangles.extend([[3, 2, 1], [3, 1, 0]]);
    }
    (corners.into(), triangles)
}
fn together(parts: &[Triangles]) -> SolidSpec {
    let (mut vertices, mut triangles) = (vec![], vec![]);
    for (points, numbers) in parts {
        let first = vertices.len();
        vertices.extend(points);
        triangles.extend(numbers.iter().map(|t| t.map(|v| v + first)));
    }
    SolidSpec::TriMesh { vertices, triangles, margin: 0.0 }
}
fn unit_cube() -> Triangles {
    cuboid([0.0; 3], [1.0; 3])
}
fn random_direction(random: &mut Random) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.between(-1.0, 1.0))
}

/// The path after a reflection.
fn reflected(hit: &geometry::Hit<3>, v: &Vector3<f64>) -> Line<3> {
    Line { point: hit.point, velocity: v - hit.normal * (2.0 * hit.normal.dot(v)) }
}

#[test]
fn a_sheet_drawn_from_both_sides_is_a_wall_on_both() {
    let room =
        |about_middle: bool| together(&[unit_cube(), sheet(0.0, 1.0, about_middle)]).solid([0.0; 3], Side::Inside);
    // two rooms side by side, one of them smaller
    let rooms = together(&[cuboid([0.0; 3], [0.5, 1.0, 1.0]), cuboid([0.5, 0.25, 0.0], [1.0, 0.75, 0.5])]);
    let scenes = [room(true), room(false), rooms.solid([0.0; 3], Side::Inside)];
    for (scene, solid) in scenes.into_iter().enumerate() {
        let solid = solid.unwrap();
        let mut random = Random(3);
        for side in [0.0, 0.5] {
            for _ in 0..200 {
                let point = Vector3::from_fn(|i, _| random.between(0.3, 0.45) + if i == 0 { side } else { 0.0 });
                let mut path = Line { point, velocity: random_direction(&mut random) };
                for bounce in 0..50 {
                    let hit = solid.first_hit(&path).unwrap_or_else(|| panic!("{scene}: lost after {bounce}"));
                    assert!(hit.time > 0.0, "{scene}: {bounce} {path:?}");
                    assert!((side..=side + 0.5).contains(&hit.point.x), "{scene}: {bounce} {path:?}");
                    if hit.corner {
                        break;
                    }
                    path = reflected(&hit, &path.velocity);
                }
            }
        }
    }
}

#[test]
fn nothing_slips_through_where_a_sheet_stands_on_a_wall() {
    let sheets = |about_middle| together(&[sheet(0.0, 1.0, about_middle)]).solid([0.0; 3], Side::Outside).unwrap();
    let cube = || SolidSpec::Cuboid { size: [1.0; 3], rounding: 0.0 }.solid([0.5; 3], Side::Inside).unwrap();
    let one = |about_middle: bool| {
        together(&[unit_cube(), sheet(0.0, 1.0, about_middle)]).solid([0.0; 3], Side::Inside).unwrap()
    };
    let rooms: Vec<Room> = [false, true]
        .into_iter()
        .flat_map(|about_middle| [Room::new(vec![one(about_middle)]), Room::new(vec![cube(), sheets(about_middle)])])
        .collect();
    let mut random = Random(5);
    for (scene, room) in rooms.iter().enumerate() {
        let mut corners = 0;
        for k in 0..20_000 {
            // at a place of the floor just left of the sheet
            let away = f64::from(k % 200) * 2e-16;
            let aim = Vector3::new(0.5 - away, random.between(0.1, 0.9), 0.0);
            let from = Vector3::new(random.between(0.1, 0.49), random.between(0.1, 0.9), random.between(0.1, 0.9));
            let path = Line { point: from, velocity: aim - from };
            let hit = room.first_hit(&path).unwrap();
            corners += u32::from(hit.corner);
            // a rough floor sends it anywhere
            let velocity = Vector3::new(random.between(0.0, 1.0), random.between(-0.1, 0.1), random.between(0.2, 1.0));
            if hit.corner || hit.normal.z < 0.9 {
                continue;
            }
            let next = room.first_hit(&Line { point: hit.point, velocity }).unwrap();
            assert!(next.point.x <= 0.5, "{scene}: {path:?} {hit:?} {next:?}");
        }
        assert!((1000..20_000).contains(&corners), "{scene}: {corners}");
        let beside = Vector3::new(0.5 - 1e-12, 0.5, 0.0);
        let path = Line { point: Vector3::new(0.25, 0.5, 0.5), velocity: beside - Vector3::new(0.25, 0.5, 0.5) };
        assert!(!room.first_hit(&path).unwrap().corner);
    }
}

#[test]
fn a_point_beside_a_sheet_is_on_the_side_of_the_face_that_looks_at_it() {
    for about_middle in [false, true] {
        let sheet = || sheet(0.2, 0.8, about_middle);
        let alone = together(&[sheet()]);
        let wall = together(&[unit_cube(), sheet()]);
        let (around, room) =
            (alone.solid([0.0; 3], Side::Outside).unwrap(), wall.solid([0.0; 3], Side::Inside).unwrap());
        let kept = |spec: &SolidSpec, side| spec.parallel(side, 0.01).unwrap().0.solid([0.0; 3], side).unwrap();
        let balls = [kept(&alone, Side::Outside), kept(&wall, Side::Inside)];
        let mut random = Random(7);
        for k in 0..20_000 {
            let mut point = Vector3::from_fn(|_, _| random.between(0.01, 0.99));
            if k % 2 == 0 {
                let near = libm::exp2(random.between(-40.0, -2.0));
                point.x = if random.unit() < 0.5 { 0.5 - near } else { 0.5 + near };
            }
            let out = [point.y, point.z].map(|x| (0.2 - x).max(x - 0.8).max(0.0));
            let off = libm::hypot(point.x - 0.5, libm::hypot(out[0], out[1]));
            let to_cube = point.iter().map(|x| x.min(1.0 - x)).fold(1.0, f64::min);
            for (solid, expected) in [(&around, off), (&room, off.min(to_cube))] {
                let seen = solid.closest(&point);
                assert!((seen.distance - expected).abs() < 1e-14, "{point} {expected} {seen:?}");
                let foot = point - seen.normal * seen.distance;
                assert!((foot - seen.point).norm() < 1e-14, "{point} {seen:?}");
                assert!(solid.contains(&point));
            }
            for (solid, expected) in balls.iter().zip([off, off.min(to_cube)]) {
                assert!((solid.distance(&point) - (expected - 0.01)).abs() < 1e-14, "{point}");
            }
        }
    }
}

#[test]
fn inside_of_solid_bodies_that_touch_there_is_no_table() {
    let low = cuboid([0.0; 3], [0.5, 1.0, 1.0]);
    let bodies = together(&[low, cuboid([0.5, 0.25, 0.0], [1.0, 0.75, 0.5])]);
    let [inside, outside] = [Side::Inside, Side::Outside].map(|side| bodies.solid([0.0; 3], side).unwrap());
    let mut random = Random(11);
    for k in 0..20_000 {
        let mut point = Vector3::from_fn(|_, _| random.between(-0.2, 1.2));
        if k % 2 == 0 {
            point.x = 0.5 + libm::exp2(random.between(-40.0, -3.0)) * if random.unit() < 0.5 { -1.0 } else { 1.0 };
        }
        let within = |low: [f64; 3], high: [f64; 3]| (0..3).all(|i| low[i] < point[i] && point[i] < high[i]);
        let is_inside = within([0.0; 3], [0.5, 1.0, 1.0]) || within([0.5, 0.25, 0.0], [1.0, 0.75, 0.5]);
        assert_eq!((inside.contains(&point), outside.contains(&point)), (is_inside, !is_inside), "{point}");
        assert!((inside.distance(&point) + outside.distance(&point)).abs() < 1e-15, "{point}");
    }
}

#[test]
fn sheets_in_general_position_are_walls_on_both_sides() {
    let mut random = Random(13);
    let mut corners = 0;
    for scene in 0..60 {
        // turned about two axes, moved, and of any size
        let turn = |random: &mut Random| {
            let angle = random.between(0.0, 6.0);
            (libm::cos(angle), libm::sin(angle))
        };
        let (a, b) = (turn(&mut random), turn(&mut random));
        let size = libm::exp2(random.between(-30.0, 30.0));
        let shift = Vector3::from_fn(|_, _| random.between(-3.0, 3.0));
        let place = |p: Vector3<f64>| {
            let p = Vector3::new(a.0 * p.x - a.1 * p.y, a.1 * p.x + a.0 * p.y, p.z);
            (Vector3::new(p.x, b.0 * p.y - b.1 * p.z, b.1 * p.y + b.0 * p.z) + shift) * size
        };
        let (low, high) = if scene % 2 == 0 { (0.0, 1.0) } else { (0.2, 0.7) };
        let parts = match scene % 3 {
            0 => [unit_cube(), sheet(low, high, scene % 4 < 2)],
            _ => [cuboid([0.0; 3], [0.5, 1.0, 1.0]), cuboid([0.5, low, 0.2], [1.0, high, 0.7])],
        };
        // whole sheets, and rooms, part one half from the other
        let parted = low == 0.0 || scene % 3 > 0;
        let SolidSpec::TriMesh { vertices, triangles, .. } = together(&parts) else { panic!() };
        let vertices = vertices.into_iter().map(|p| place(p.into()).into()).collect();
        let room = SolidSpec::TriMesh { vertices, triangles, margin: 0.0 };
        let room = room.solid([0.0; 3], Side::Inside).unwrap();
        let across = (place(Vector3::x()) - place(Vector3::zeros())) / size;
        let height = |p: &Vector3<f64>| (p / size - shift).dot(&across);
        for side in [-1.0, 1.0] {
            for _ in 0..100 {
                let start = Vector3::new(0.5 + side * 0.1, random.between(0.3, 0.6), random.between(0.3, 0.6));
                let mut path = Line { point: place(start), velocity: random_direction(&mut random) * size };
                assert!(room.contains(&path.point), "{scene}");
                for bounce in 0..60 {
                    let hit = room.first_hit(&path).unwrap_or_else(|| panic!("{scene}: lost after {bounce}"));
                    assert!(hit.time > 0.0, "{scene}: {bounce}");
                    assert!(!parted || (height(&hit.point) - 0.5) * side > -1e-12, "{scene}: {bounce} {path:?}");
                    if hit.corner {
                        corners += 1;
                        break;
                    }
                    // a rough wall
                    let d = random_direction(&mut random);
                    let along = d - hit.normal * hit.normal.dot(&d);
                    path = Line { point: hit.point, velocity: (along + hit.normal * random.between(0.0, 1.0)) * size };
                }
            }
        }
    }
    assert!(corners < 10, "{corners}");
}

/// A large ball around a wall, with the centre of a particle of some radius between.
fn in_a_ball(wall: &SolidSpec, radius: f64) -> Room {
    let around = SolidSpec::Ball { radius: 4.0 - radius }.solid([0.0; 3], Side::Inside).unwrap();
    Room::new(vec![around, kept_off(wall, Side::Outside, radius)])
}
fn kept_off(wall: &SolidSpec, side: Side, radius: f64) -> Solid {
    if radius == 0.0 {
        return wall.solid([0.0; 3], side).unwrap();
    }
    wall.parallel(side, radius).unwrap().0.solid([0.0; 3], side).unwrap()
}

/// Whether a point with its normal belongs to a part of a boundary.
type IsPart<'a> = &'a dyn Fn(&Vector3<f64>, &Vector3<f64>) -> bool;

/// The numbers of random points of a boundary in some parts of it.
fn drawn<const N: usize>(room: &Room, parts: [IsPart; N]) -> [f64; N] {
    let (surface, mut random) = (room.surface().unwrap(), Random(17));
    let mut counts = [0.0; N];
    for _ in 0..40_000 {
        let (point, normal) = surface.random_point(&mut || random.unit());
        for (count, part) in counts.iter_mut().zip(parts) {
            *count += f64::from(u8::from(part(&point, &normal)));
        }
    }
    counts
}
/// Whether two counts of random points differ by less than five standard deviations.
fn alike(a: f64, b: f64) -> bool {
    a > 200.0 && b > 200.0 && (a - b) * (a - b) < 25.0 * (a + b)
}

#[test]
fn the_two_faces_of_a_sheet_are_drawn_equally_often() {
    for (about_middle, radius) in [(false, 0.0), (true, 0.0), (false, 0.125), (true, 0.125)] {
        let room = in_a_ball(&together(&[sheet(-1.0, 1.0, about_middle)]), radius);
        let [left, right] = drawn(
            &room,
            [&|p, n| n.x == -1.0 && (p.x - (0.5 - radius)).abs() < 1e-12, &|p, n| {
                n.x == 1.0 && (p.x - (0.5 + radius)).abs() < 1e-12
            }],
        );
        assert!(alike(left, right), "{about_middle} {radius}: {left} and {right}");
        let area = 4.0 * std::f64::consts::PI * (4.0 - radius) * (4.0 - radius);
        let rims = std::f64::consts::PI * radius * (8.0 + 4.0 * radius);
        let expected = 40_000.0 * 8.0 / (area + 8.0 + rims);
        assert!((left + right - expected).abs() < 5.0 * expected.sqrt(), "{left} and {right}, expected {expected}");
    }
}

#[test]
fn both_sides_of_a_wall_between_two_rooms_of_one_mesh_are_drawn() {
    // the triangles of either may come first
    let [one, other] = [cuboid([0.5, 0.25, 0.0], [1.5, 1.25, 1.0]), cuboid([-0.5, 0.0, 0.0], [0.5, 1.0, 1.0])];
    for parts in [[one.clone(), other.clone()], [other, one]] {
        for radius in [0.0, 0.125] {
            let room = Room::new(vec![kept_off(&together(&parts), Side::Inside, radius)]);
            let [left, right] = drawn(
                &room,
                [&|p, n| n.x == -1.0 && (p.x - (0.5 - radius)).abs() < 1e-12, &|p, n| {
                    n.x == 1.0 && (p.x - (0.5 + radius)).abs() < 1e-12
                }],
            );
            // of twelve equal sides
            for side in [left, right] {
                assert!((side - 40_000.0 / 12.0).abs() < 5.0 * (40_000.0_f64 / 12.0).sqrt(), "{radius}: {side}");
            }
        }
    }
}

type Motion<'a> = &'a dyn Fn(Vector3<f64>) -> Vector3<f64>;

/// Two boxes that touch at x = 0 on a part of their sides, and a fin that reaches into the left one.
fn touching(place: impl Fn(Vector3<f64>) -> Vector3<f64>) -> SolidSpec {
    let fin = [[-1.5, -0.25, 0.0], [-0.5, -0.25, 0.0], [-0.5, 0.5, 0.0], [-1.5, 0.5, 0.0]];
    let fin = (fin.into(), vec![[0, 1, 2], [0, 2, 3], [3, 2, 1], [3, 1, 0]]);
    let parts = together(&[cuboid([-1.0; 3], [0.0, 1.0, 1.0]), cuboid([0.0, -0.5, -0.5], [1.0, 1.5, 0.5]), fin]);
    let SolidSpec::TriMesh { vertices, triangles, margin } = parts else { panic!() };
    SolidSpec::TriMesh { vertices: vertices.into_iter().map(|p| place(p.into()).into()).collect(), triangles, margin }
}

#[test]
fn nothing_is_drawn_where_two_parts_of_a_mesh_hide_one_another() {
    // as they are, and turned twice
    let about = |[i, j]: [usize; 2], mut p: Vector3<f64>, sine: f64| {
        (p[i], p[j]) = (0.8 * p[i] - sine * p[j], sine * p[i] + 0.8 * p[j]);
        p
    };
    let turned = |p: Vector3<f64>| about([1, 2], about([0, 1], p, 0.6), 0.6);
    let back = |p: Vector3<f64>| about([0, 1], about([1, 2], p, -0.6), -0.6);
    let as_is = |p: Vector3<f64>| p;
    for [there, back] in [[&as_is as Motion, &as_is], [&turned, &back]] {
        let room = in_a_ball(&touching(there), 0.0);
        let on = |x: f64| x.abs() < 1e-12;
        let between = |p: &Vector3<f64>| on(p.x) && p.y > -0.5 && p.y < 1.0 && p.z.abs() < 0.5;
        let [hidden, left, right, buried, upper, lower] = drawn(
            &room,
            [
                &|p, _| between(&back(*p)),
                &|p, n| on(back(*p).x) && back(*n).x > 0.99,
                &|p, n| on(back(*p).x) && back(*n).x < -0.99,
                &|p, _| on(back(*p).z) && back(*p).x > -1.0 && back(*p).x < 0.0 && back(*p).y.abs() < 1.0,
                &|p, n| on(back(*p).z) && back(*p).x < -1.0 && back(*n).z > 0.99,
                &|p, n| on(back(*p).z) && back(*p).x < -1.0 && back(*n).z < -0.99,
            ],
        );
        assert_eq!([hidden, buried], [0.0; 2]);
        let area = 64.0 * std::f64::consts::PI + (16.0 - 1.5) + (10.0 - 1.5) + 0.75;
        for (count, part) in [(left, 4.0 - 1.5), (right, 2.0 - 1.5), (upper, 0.375), (lower, 0.375)] {
            let expected = 40_000.0 * part / area;
            assert!((count - expected).abs() < 5.0 * expected.sqrt(), "{count} for {expected}");
        }
    }
}

#[test]
fn a_point_where_parts_of_a_mesh_touch_is_not_on_the_side_of_either() {
    let solid = touching(|p| p).solid([0.0; 3], Side::Outside).unwrap();
    for [x, y, z] in [
        [0.0, 0.25, 0.125],
        [0.0, 0.5, 0.0],
        [-0.0, -0.4, 0.3],
        [1e-16, 0.3, 0.2],
        [-1e-16, 0.3, 0.2],
        [-0.75, 0.1, 0.0],
    ] {
        let seen = solid.closest(&Vector3::new(x, y, z));
        assert!(seen.distance <= 0.0 && seen.distance >= -1e-15, "{x} {y} {z}: {seen:?}");
        assert_eq!(seen.normal, Vector3::zeros(), "{x} {y} {z}: {seen:?}");
    }
    // beside the places where they touch, and on the fin outside of them
    for ([x, y, z], axis) in
        [([0.0, -0.75, 0.1], Vector3::x()), ([0.0, 1.25, 0.1], -Vector3::x()), ([-1.25, 0.1, 0.0], Vector3::z())]
    {
        let seen = solid.closest(&Vector3::new(x, y, z));
        assert_eq!(seen.normal.cross(&axis), Vector3::zeros(), "{seen:?}");
        assert_eq!(seen.normal.norm(), 1.0, "{seen:?}");
    }
}

#[test]
fn above_a_face_of_a_mesh_the_normal_is_exactly_that_of_the_face() {
    let cube = together(&[cuboid([-1.0; 3], [1.0; 3])]);
    let sheet = together(&[sheet(-1.0, 1.0, false)]);
    let mut random = Random(19);
    for radius in [0.0, 0.125] {
        let [cube, sheet] = [&cube, &sheet].map(|wall| kept_off(wall, Side::Outside, radius));
        for _ in 0..1000 {
            let height = if random.unit() < 0.5 { radius } else { random.between(0.0, 0.5) };
            let mut point = Vector3::from_fn(|_, _| random.between(-0.99, 0.99));
            point.x = 0.5 - height;
            assert_eq!(sheet.closest(&point).normal.map(f64::abs), Vector3::x(), "{radius} {height}");
            let axis = random.below(3);
            point = Vector3::from_fn(|_, _| random.between(-0.99, 0.99));
            point[axis] = -1.0 - height;
            assert_eq!(cube.closest(&point).normal, -Vector3::ith(axis, 1.0), "{radius} {height}");
        }
    }
}

#[test]
fn a_box_no_thicker_than_rounding_is_a_wall_on_both_sides() {
    let about = |[i, j]: [usize; 2], mut p: Vector3<f64>| {
        (p[i], p[j]) = (0.8 * p[i] - 0.6 * p[j], 0.6 * p[i] + 0.8 * p[j]);
        p
    };
    let turned = |p: Vector3<f64>| about([1, 2], about([0, 1], p));
    let as_is = |p: Vector3<f64>| p;
    for (which, place) in [&as_is as Motion, &turned].into_iter().enumerate() {
        for k in 1..80 {
            let (vertices, triangles) = cuboid([-0.5, -0.5, 0.0], [0.5, 0.5, 1e-16 * f64::from(k)]);
            let vertices = vertices.into_iter().map(|p| place(p.into()).into()).collect();
            let Ok(thin) = (SolidSpec::TriMesh { vertices, triangles, margin: 0.0 }).solid([0.0; 3], Side::Outside)
            else {
                continue;
            };
            for side in [-1.0, 1.0] {
                let start = Vector3::new(0.1, 0.2, 0.6 * side);
                let path = Line { point: place(start), velocity: place(Vector3::new(0.05, 0.1, -side)) };
                let hit = thin.first_hit(&path).unwrap();
                assert!((hit.time - 0.6).abs() < 1e-14 && !hit.corner, "{which} {k} {side}: {hit:?}");
                let next = thin.first_hit(&reflected(&hit, &path.velocity));
                assert!(next.is_none(), "{which} {k} {side}: {hit:?} {next:?}");
            }
        }
    }
}

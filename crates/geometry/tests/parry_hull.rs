//! Tables inside and outside of convex hulls.
#![allow(clippy::float_cmp, clippy::unwrap_used, reason = "tests panic where they fail, and claim exact values")]
mod random;

use geometry::{
    Boundary, Line, Vector3,
    parry::{Side, Solid, SolidSpec},
};
use random::Random;

fn hull(points: &[Vector3<f64>], side: Side) -> Solid {
    let points = points.iter().map(|p| (*p).into()).collect();
    SolidSpec::ConvexHull { points, rounding: 0.0 }.solid([0.0; 3], side).unwrap()
}
fn vector(random: &mut Random) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.between(-1.0, 1.0))
}
fn turned(p: &Vector3<f64>, axis: &Vector3<f64>, angle: f64) -> Vector3<f64> {
    let (sin, cos) = libm::sincos(angle);
    p * cos + axis.cross(p) * sin + axis * (axis.dot(p) * (1.0 - cos))
}
fn cube() -> Vec<Vector3<f64>> {
    (0..8).map(|k| Vector3::from_fn(|i, _| if k >> i & 1 == 1 { 1.0 } else { -1.0 })).collect()
}

#[test]
fn a_room_with_points_on_its_faces_and_edges_is_closed() {
    let mut random = Random(21);
    let cells = || (0..27).filter(|k| *k != 13).map(|k| [k % 3, k / 3 % 3, k / 9].map(|i| f64::from(i) - 1.0));
    for _ in 0..60 {
        let axis = vector(&mut random).normalize();
        let angle = random.between(0.0, 6.0);
        let points: Vec<_> = cells().map(|p| turned(&p.into(), &axis, angle)).collect();
        let room = hull(&points, Side::Inside);
        let mut path = Line { point: vector(&mut random) * 0.5, velocity: vector(&mut random) };
        for _ in 0..100 {
            let hit = room.first_hit(&path).unwrap();
            let upright = turned(&hit.point, &axis, -angle);
            assert!((upright.amax() - 1.0).abs() < 1e-14, "{upright:?}");
            path = Line {
                point: hit.point,
                velocity: path.velocity - hit.normal * (2.0 * path.velocity.dot(&hit.normal)),
            };
        }
    }
}

#[test]
fn faces_that_are_flat_to_some_digits_have_no_edges_within() {
    // the corner that is not one digit's rounding off lies above the lid, which has a crease along its diagonal
    for digits in 6..17 {
        let mut points = cube();
        points[7].z += libm::pow(10.0, -f64::from(digits));
        for side in [Side::Inside, Side::Outside] {
            let (cube, [from, up]) = (hull(&points, side), if side == Side::Inside { [0.0, 1.0] } else { [2.0, -1.0] });
            let hit = |x: f64, y: f64| {
                let path = Line { point: Vector3::new(x, y, from), velocity: Vector3::new(0.01, 0.02, up) };
                cube.first_hit(&path).unwrap()
            };
            for k in 1..100 {
                let x = 0.015 * f64::from(k) - 0.75;
                for beside in [0.0, 1e-9, 1e-6, 1e-3] {
                    // within rounding of the crease itself there is an edge, if it is one at all
                    if digits > 9 || beside > 1e-8 {
                        assert!(!hit(x, -x + beside).corner, "{digits} {side:?} {x} {beside:e}");
                    }
                }
            }
            // onto the edge of the lid opposite to that corner
            let way = Vector3::new(-0.7 * up, -0.3 * up, up);
            let path = Line { point: Vector3::new(-1.0, -0.1, 1.0) - way, velocity: way };
            assert!(cube.first_hit(&path).unwrap().corner, "{digits} {side:?}");
        }
    }
}

#[test]
fn edges_of_flat_roofs_and_cones_are_corners_and_what_lies_beside_them_is_none() {
    let mut points = cube();
    points.push(Vector3::new(0.0, 0.0, 1.0 + 1e-7));
    let roof = hull(&points, Side::Outside);
    let cone = SolidSpec::Cone { radius: 1.0, height: 1e-5, rounding: 0.0 };
    let cone = cone.solid([0.0; 3], Side::Inside).unwrap();
    let is_corner = |solid: &Solid, x: f64, y: f64| {
        let path = Line { point: Vector3::new(x, y, 3.0), velocity: -Vector3::z() };
        solid.first_hit(&path).unwrap().corner
    };
    for k in 1..50 {
        let x = 0.0175 * f64::from(k);
        assert!(is_corner(&roof, x, x) && is_corner(&roof, x, -x), "{x}");
        assert!(!is_corner(&roof, x, x + 1e-14) && !is_corner(&roof, x + 1e-10, x), "{x}");
    }
    for beside in [4e-16, 1e-13, 1e-11] {
        let onto_the_base = Vector3::new(0.6 * (1.0 - beside), 0.8 * (1.0 - beside), -5e-6);
        let hit = cone.first_hit(&Line { point: Vector3::zeros(), velocity: onto_the_base }).unwrap();
        assert_eq!(hit.corner, beside < 1e-15, "{beside:e} {hit:?}");
    }
}

#[test]
fn points_beside_the_corners_do_not_move_the_faces() {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vector3::from);
    let mut random = Random(22);
    for exponent in 6..14 {
        let little = libm::pow(10.0, -f64::from(exponent));
        for count in [8, 12, 16, 20, 40] {
            let beside = (0..count).map(|k| corners[k % 4] + vector(&mut random) * little);
            let points: Vec<_> = corners.into_iter().chain(beside).collect();
            let [plain, room] = [&corners[..], &points].map(|points| hull(points, Side::Inside));
            for _ in 0..20 {
                let path = Line { point: Vector3::repeat(0.2), velocity: vector(&mut random) };
                let [a, b] = [&plain, &room].map(|room| room.first_hit(&path).unwrap());
                // towards corners obliquely, by somewhat more than they are moved
                assert!((a.point - b.point).norm() < 20.0 * little, "{little:e} {count} {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn a_flat_roof_and_a_thin_plate_are_hit_where_they_are() {
    let mut points = cube();
    points.push(Vector3::new(0.0, 0.0, 1.0001));
    let house = hull(&points, Side::Outside);
    let hit = house.first_hit(&Line { point: Vector3::new(0.5, 0.1, 3.0), velocity: -Vector3::z() }).unwrap();
    assert!((hit.time - 1.99995).abs() < 1e-15 && (hit.normal.x - 1e-4).abs() < 1e-11, "{hit:?}");
    for half in [1e-4, 1e-6, 1e-9] {
        let plate: Vec<_> = cube().iter().map(|p| p.component_mul(&Vector3::new(1.0, 1.0, half))).collect();
        let plate = hull(&plate, Side::Outside);
        for z in [3.0, -3.0] {
            let path = Line { point: Vector3::new(0.1, 0.2, z), velocity: Vector3::new(0.0, 0.0, -z) };
            assert_eq!(plate.first_hit(&path).unwrap().point.z, half.copysign(z));
        }
        let rod: Vec<_> = cube().iter().map(|p| p.component_mul(&Vector3::new(half, half, 1.0))).collect();
        let across = Line { point: Vector3::new(2.0, 0.0, 0.3), velocity: -Vector3::x() };
        assert_eq!(hull(&rod, Side::Outside).first_hit(&across).unwrap().point.x, half);
    }
    let square = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    assert!(SolidSpec::ConvexHull { points: square, rounding: 0.0 }.solid([0.0; 3], Side::Outside).is_err());
}

#[test]
fn ten_thousand_points_on_a_sphere_have_a_hull_at_once() {
    let mut random = Random(23);
    let points: Vec<_> = (0..10_000).map(|_| vector(&mut random).normalize()).collect();
    let ball = hull(&points, Side::Outside);
    let hit = ball.first_hit(&Line { point: Vector3::x() * 3.0, velocity: -Vector3::x() }).unwrap();
    assert!((hit.time - 2.0).abs() < 1e-2);
}

#[test]
fn beside_an_edge_of_a_rounded_hull_the_normal_is_that_of_the_face() {
    let points = cube().iter().map(|p| (*p).into()).collect();
    let tile = SolidSpec::ConvexHull { points, rounding: 0.125 }.solid([0.0; 3], Side::Outside).unwrap();
    for axis in 0..3 {
        for (sign, beside) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            for across in [(axis + 1) % 3, (axis + 2) % 3] {
                for exponent in 1..52 {
                    let mut point = Vector3::repeat(0.3);
                    point[axis] = 1.75 * sign;
                    point[across] = beside * (1.0 - libm::ldexp(1.0, -exponent));
                    let mut normal = Vector3::zeros();
                    normal[axis] = sign;
                    assert_eq!(tile.closest(&point).normal, normal, "{point:?}");
                }
            }
        }
    }
}

/// The corner is farther away than its edge by less than rounding, but its normal differs in half of the digits.
#[test]
fn beside_a_corner_of_what_is_rounded_the_normal_is_that_of_the_edge() {
    let points: Vec<[f64; 3]> = cube().iter().map(|p| (*p).into()).collect();
    let sides = [[0, 2, 3, 1], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5], [4, 5, 7, 6]];
    let triangles = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    let mesh = SolidSpec::TriMesh { vertices: points.clone(), triangles, margin: 0.125 };
    let hull = SolidSpec::ConvexHull { points, rounding: 0.125 };
    for solid in [mesh, hull].map(|spec| spec.solid([0.0; 3], Side::Outside).unwrap()) {
        for (axis, corner) in (0..3).flat_map(|axis| cube().into_iter().map(move |corner| (axis, corner))) {
            for (turn, exponent) in (1..24).flat_map(|turn| (1..52).map(move |exponent| (turn, exponent))) {
                let (sin, cos) = libm::sincos(core::f64::consts::FRAC_PI_2 * f64::from(turn) / 24.0);
                let mut normal = Vector3::zeros();
                normal[(axis + 1) % 3] = corner[(axis + 1) % 3] * cos;
                normal[(axis + 2) % 3] = corner[(axis + 2) % 3] * sin;
                let mut foot = corner;
                foot[axis] *= 1.0 - libm::ldexp(1.0, -exponent);
                let hit = solid.first_hit(&Line { point: foot + normal, velocity: -normal }).unwrap();
                assert!((hit.normal - normal).amax() <= 32.0 * f64::EPSILON, "{foot:?} {normal:?}: {:?}", hit.normal);
            }
        }
    }
}

//! Tables inside and outside of shapes in space.
#![allow(clippy::float_cmp, clippy::unwrap_used, reason = "tests panic where they fail, and claim exact values")]
mod random;

use core::f64::consts::PI;
use geometry::{
    Boundary, Error, Extent, Line, Vector3,
    parry::{
        Room, Side, Solid, SolidSpec,
        parry3d_f64::{
            bounding_volume::{Aabb, BoundingSphere},
            mass_properties::MassProperties,
            math::{IVector, Pose, Vector},
            query::{
                PointProjection, PointQuery, Ray, RayCast, RayIntersection,
                details::local_point_projection_on_support_map, gjk::VoronoiSimplex,
            },
            shape::{
                Ball, Capsule, Compound, Cone, ConvexPolyhedron, Cuboid, Cylinder, FeatureId, HalfSpace, HeightField,
                RoundShape, Shape, ShapeType, SharedShape, SupportMap, TriMesh, Triangle, TypedShape, Voxels,
            },
            utils::Array2,
        },
    },
};
use lanes::Double;
use nalgebra::Isometry3;
use random::Random;

fn here() -> Isometry3<f64> {
    Isometry3::identity()
}
fn direction(random: &mut Random) -> Vector3<f64> {
    let (z, turn) = (random.between(-1.0, 1.0), random.between(0.0, 2.0 * PI));
    let r = libm::sqrt(1.0 - z * z);
    Vector3::new(r * libm::cos(turn), r * libm::sin(turn), z)
}
fn tetrahedron() -> Vec<Vector> {
    [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(Vector::from).to_vec()
}
/// A ball of triangles, counter-clockwise from outside.
fn faceted() -> TriMesh {
    let (vertices, triangles) = Ball::new(1.0).to_trimesh(24, 16);
    TriMesh::new(vertices, triangles).unwrap()
}
fn bodies() -> Vec<(&'static str, Box<dyn Shape>)> {
    let r = 0.25;
    vec![
        ("ball", Box::new(Ball::new(1.2))),
        ("cuboid", Box::new(Cuboid::new(Vector::new(1.0, 0.5, 0.75)))),
        ("capsule", Box::new(Capsule::new(Vector::new(-0.5, 0.0, 0.2), Vector::new(0.5, 0.3, 0.0), 0.6))),
        ("cylinder", Box::new(Cylinder::new(0.7, 0.9))),
        ("cone", Box::new(Cone::new(0.8, 1.1))),
        ("polyhedron", Box::new(ConvexPolyhedron::from_convex_hull(&tetrahedron()).unwrap())),
        ("mesh", Box::new(faceted())),
        (
            "round cuboid",
            Box::new(RoundShape { inner_shape: Cuboid::new(Vector::new(0.8, 0.3, 0.5)), border_radius: r }),
        ),
        ("round cylinder", Box::new(RoundShape { inner_shape: Cylinder::new(0.5, 0.7), border_radius: r })),
        ("round cone", Box::new(RoundShape { inner_shape: Cone::new(0.6, 0.8), border_radius: r })),
        (
            "round triangle",
            Box::new(RoundShape {
                inner_shape: Triangle::new(
                    Vector::new(-1.0, -0.5, 0.0),
                    Vector::new(1.0, -0.5, 0.3),
                    Vector::new(0.0, 1.0, 0.0),
                ),
                border_radius: r,
            }),
        ),
        (
            "round polyhedron",
            Box::new(RoundShape {
                inner_shape: ConvexPolyhedron::from_convex_hull(&tetrahedron()).unwrap(),
                border_radius: r,
            }),
        ),
        (
            "voxels",
            Box::new(Voxels::new(
                Vector::new(0.5, 0.6, 0.7),
                &[[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1], [-1, 0, 0]].map(|[i, j, k]| IVector::new(i, j, k)),
            )),
        ),
        (
            "compound",
            Box::new(Compound::new(vec![
                (Pose::translation(-0.4, 0.0, 0.0), SharedShape::ball(0.8)),
                (Pose::translation(0.4, 0.2, 0.0), SharedShape::cuboid(0.6, 0.5, 0.4)),
                (Pose::translation(0.0, 0.0, 0.5), SharedShape::cylinder(0.6, 0.3)),
            ])),
        ),
    ]
}

#[test]
fn hits_lie_on_the_boundary_and_nothing_lies_before_them() {
    let mut random = Random(11);
    for (name, shape) in bodies() {
        let pose = Isometry3::new(Vector3::new(0.3, -0.2, 0.1), Vector3::new(0.4, 0.1, -0.6));
        for side in [Side::Inside, Side::Outside] {
            let solid = Solid::new(&*shape, &pose, side).unwrap();
            let (mut hits, mut worst) = (0, 0.0_f64);
            while hits < 300 {
                let p = Vector3::from_fn(|_, _| random.between(-3.0, 3.0));
                let away = solid.distance(&p);
                if away < 1e-3 {
                    continue;
                }
                let path = Line { point: p, velocity: direction(&mut random) * 2.0 };
                let Some(hit) = solid.first_hit(&path) else {
                    assert_eq!(side, Side::Outside, "{name}: lost {path:?}");
                    continue;
                };
                hits += 1;
                assert!(2.0 * hit.time >= away * (1.0 - 1e-12), "{name}: nearer than the distance");
                worst = worst.max(solid.distance(&hit.point).abs());
                assert!((hit.normal.norm() - 1.0).abs() < 1e-12);
                assert!(hit.normal.dot(&path.velocity) < 0.0, "{name}: {hit:?}");
                let landed = (path.at(hit.time) - hit.point).norm();
                let sine = -hit.normal.dot(&path.velocity) / 2.0;
                assert!(landed < 1e-14 / sine, "{name}: {landed:e} at {sine}");
                // the way there is free
                for k in 1..20 {
                    let at = path.at(hit.time * f64::from(k) / 20.0);
                    assert!(solid.distance(&at) > -1e-14, "{name}: through a wall");
                }
            }
            // 1e-12 is asked for; all of these are exact to a few ulp of coordinates of order 3
            assert!(worst < 1e-14, "{name}: {worst:e}");
        }
    }
}

#[test]
fn a_particle_bounces_forever_inside_of_anything() {
    let mut random = Random(12);
    for (name, shape) in bodies() {
        let solid = Solid::new(&*shape, &here(), Side::Inside).unwrap();
        for _ in 0..5 {
            let start = loop {
                let p = Vector3::from_fn(|_, _| random.between(-1.5, 1.5));
                if solid.distance(&p) > 0.05 {
                    break p;
                }
            };
            let mut path = Line { point: start, velocity: direction(&mut random) };
            for n in 0..400 {
                let hit = solid.first_hit(&path).unwrap_or_else(|| panic!("{name}: lost after {n} at {path:?}"));
                assert!(solid.distance(&hit.point).abs() < 1e-14, "{name}: {:e} {hit:?}", solid.distance(&hit.point));
                let velocity = path.velocity - hit.normal * (2.0 * path.velocity.dot(&hit.normal));
                path = Line { point: hit.point, velocity };
            }
        }
    }
}

#[test]
fn a_start_on_the_outside_leaves() {
    let mut random = Random(13);
    for (name, shape) in bodies() {
        let solid = Solid::new(&*shape, &here(), Side::Outside).unwrap();
        let convex = !matches!(name, "voxels" | "compound");
        for _ in 0..300 {
            let from = direction(&mut random) * 4.0;
            let aim = Vector3::from_fn(|_, _| random.between(-0.3, 0.3));
            let Some(hit) = solid.first_hit(&Line { point: from, velocity: aim - from }) else { continue };
            let mut away = direction(&mut random);
            if away.dot(&hit.normal) < 0.05 {
                away += hit.normal * (0.1 - away.dot(&hit.normal));
            }
            let next = solid.first_hit(&Line { point: hit.point, velocity: away });
            assert!(next.is_none_or(|h| !convex && h.time > 1e-9), "{name}: {next:?}");
            // and straight back in is a hit at once
            let back = solid.first_hit(&Line { point: hit.point, velocity: -away });
            assert!(back.is_some_and(|h| h.time < 1e-13), "{name}: {back:?} of {hit:?}");
        }
    }
}

#[test]
fn paths_aimed_at_vertices_and_edges_of_a_mesh_do_not_leak() {
    // parry loses 3–6 % of them
    let mesh = faceted();
    let inside = Solid::new(&mesh, &here(), Side::Inside).unwrap();
    let points: Vec<Vector3<f64>> = mesh.vertices().iter().map(|v| Vector3::new(v.x, v.y, v.z)).collect();
    let mut random = Random(14);
    for k in 0..100_000 {
        let p = direction(&mut random) * random.between(0.0, 0.9);
        let t = mesh.indices()[random.below(mesh.indices().len())].map(|v| points[v as usize]);
        let aim = if k % 2 == 0 { t[0] } else { t[0] + (t[1] - t[0]) * random.unit() };
        let hit = inside.first_hit(&Line { point: p, velocity: aim - p });
        let hit = hit.unwrap_or_else(|| panic!("lost path {k} from {p:?} to {aim:?}"));
        assert!((hit.time - 1.0).abs() < 1e-13);
        assert!(hit.corner);
    }
}

#[test]
fn the_inner_diagonals_of_flat_faces_are_no_edges() {
    let (vertices, triangles) = Cuboid::new(Vector::new(1.0, 1.0, 1.0)).to_trimesh();
    let cube = Solid::new(&TriMesh::new(vertices, triangles).unwrap(), &here(), Side::Inside).unwrap();
    let down = Line { point: Vector3::zeros(), velocity: Vector3::new(0.0, 0.0, -1.0) };
    let hit = cube.first_hit(&down).unwrap();
    assert_eq!((hit.time, hit.corner), (1.0, false));
    let at_edge = Line { point: Vector3::zeros(), velocity: Vector3::new(1.0, 0.0, 1.0) };
    assert!(cube.first_hit(&at_edge).unwrap().corner);
}

#[test]
fn no_place_is_so_far_from_a_solid_that_it_seems_to_lie_inside() {
    let tetrahedron = TriMesh::new(
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vector::from).to_vec(),
        vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    );
    let tetrahedron: Box<dyn Shape> = Box::new(tetrahedron.unwrap());
    for (name, shape) in bodies().into_iter().chain([("tetrahedron", tetrahedron)]) {
        let solid = Solid::new(&*shape, &here(), Side::Inside).unwrap();
        if !solid.extent().is_finite() {
            continue;
        }
        for far in [1e8, 1e10, 1e12, 1e16, 1e100, 1e150] {
            for direction in [[1.0, 0.0, 0.0], [0.1, -1.0, 0.3], [-0.7, 0.2, 1.0], [1.0, 1.0, 1.0]] {
                let at = Vector3::from(direction) * far;
                assert!(!solid.contains(&at), "{name} {at}");
                let distance = solid.distance(&at);
                assert!(!(distance >= 0.0), "{name} {at}: {distance}");
            }
        }
    }
}

#[test]
fn a_mesh_inside_out_is_turned_round_and_a_mixed_one_is_refused() {
    let (vertices, triangles) = Cuboid::new(Vector::new(1.0, 1.0, 1.0)).to_trimesh();
    let flipped: Vec<[u32; 3]> = triangles.iter().map(|t| [t[0], t[2], t[1]]).collect();
    let solid = Solid::new(&TriMesh::new(vertices.clone(), flipped).unwrap(), &here(), Side::Inside).unwrap();
    let path = Line { point: Vector3::new(0.1, 0.2, 0.3), velocity: Vector3::x() };
    assert_eq!(solid.first_hit(&path).unwrap().normal, -Vector3::x());
    assert!(solid.contains(&Vector3::zeros()));
    let mut mixed = triangles;
    mixed[0].swap(0, 1);
    let mixed = TriMesh::new(vertices, mixed).unwrap();
    assert!(matches!(Solid::new(&mixed, &here(), Side::Inside), Err(Error::Triangle { .. })));
}

#[test]
fn triangles_with_a_corner_twice_close_nothing() {
    let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let rims = |more: &[[usize; 3]]| {
        let triangles = [&[[0, 2, 1], [0, 1, 3], [0, 3, 2]], more].concat();
        SolidSpec::TriMesh { vertices: vertices.clone(), triangles, margin: 0.0 }.rims()
    };
    assert_eq!(rims(&[[1, 2, 3]]), 0);
    assert_eq!(rims(&[[1, 1, 2], [2, 3, 3], [3, 1, 3]]), 3);
}

#[test]
fn a_mesh_closed_by_triangles_without_area_is_closed_for_all() {
    // a cube, of whose top one side is two: what lies between has no area
    let mut vertices: Vec<[f64; 3]> = (0..8).map(|k| [0, 1, 2].map(|i| f64::from(k >> i & 1))).collect();
    vertices.push([0.5, 0.0, 1.0]);
    let sides = [[0, 2, 3, 1], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let top = [[4, 8, 6], [8, 7, 6], [8, 5, 7], [4, 5, 8]];
    let outwards: Vec<_> = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).chain(top).collect();
    let inwards = outwards.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    for triangles in [outwards, inwards] {
        let mesh = SolidSpec::TriMesh { vertices: vertices.clone(), triangles, margin: 0.0 };
        assert_eq!(mesh.rims(), 0);
        // whichever way round
        let room = mesh.solid([0.0; 3], Side::Inside).unwrap();
        let path = Line { point: Vector3::new(0.3, 0.4, 0.5), velocity: Vector3::new(0.1, 0.2, 1.0) };
        assert_eq!(room.first_hit(&path).unwrap().normal, -Vector3::z());
    }
}

#[test]
fn no_path_leaves_beside_a_triangle_without_area() {
    // a box whose floor is cut along its diagonal; on one side of that there are vertices in the middle, and triangles
    // without area between these and the diagonal
    let corner = |k: usize| [0, 1, 2].map(|i| if k >> i & 1 == 1 { [1.0, 0.75, 1.0][i] } else { 0.0 });
    let sides = [[4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let sides: Vec<_> = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    let one = vec![[0, 3, 1], [0, 2, 8], [8, 2, 3], [0, 8, 3]];
    // two of them, one on the other
    let two = vec![[0, 3, 1], [0, 2, 9], [9, 2, 8], [8, 2, 3], [0, 9, 8], [0, 8, 3]];
    for floor in [one, two] {
        let mut vertices: Vec<[f64; 3]> = (0..8).map(corner).collect();
        vertices.extend([[0.5, 0.375, 0.0], [0.25, 0.1875, 0.0]]);
        let mesh = SolidSpec::TriMesh { vertices, triangles: [floor, sides.clone()].concat(), margin: 0.0 };
        assert_eq!(mesh.rims(), 0);
        let room = mesh.solid([0.0; 3], Side::Inside).unwrap();
        let mut random = Random(23);
        for _ in 0..20_000 {
            let point = Vector3::from_fn(|i, _| random.between(0.05, 0.95) * if i == 1 { 0.75 } else { 1.0 });
            let t = random.between(0.05, 0.95);
            let path = Line { point, velocity: Vector3::new(t, 0.75 * t, 0.0) - point };
            let hit = room.first_hit(&path).unwrap_or_else(|| panic!("{path:?}"));
            assert!((hit.time - 1.0).abs() < 1e-12 && hit.normal == Vector3::z() && !hit.corner, "{path:?} {hit:?}");
        }
    }
}

#[test]
fn between_hundreds_of_planes_a_room_has_the_box_of_its_corners() {
    let mut random = Random(19);
    // all of them touch the unit ball
    let planes = (0..700).map(|_| direction(&mut random));
    let plane = |n: Vector3<f64>| SolidSpec::HalfSpace { normal: (-n).into() }.solid(n.into(), Side::Outside).unwrap();
    let Extent { min: low, max: high } = Room::new(planes.map(plane).collect()).extent();
    assert!(
        low.iter().all(|x| (-1.1..-1.0).contains(x)) && high.iter().all(|x| (1.0..1.1).contains(x)),
        "{low} {high}"
    );
}

type Pair = (&'static str, Box<dyn Shape>, Box<dyn Shape>);

#[test]
fn tiny_solids_work() {
    // parry fails below 1e-8
    for exponent in [-40, -100] {
        let s = libm::ldexp(1.0, exponent);
        let shapes: [Pair; 4] = [
            ("cylinder", Box::new(Cylinder::new(0.7, 0.9)), Box::new(Cylinder::new(0.7 * s, 0.9 * s))),
            ("cone", Box::new(Cone::new(0.8, 1.1)), Box::new(Cone::new(0.8 * s, 1.1 * s))),
            (
                "round cuboid",
                Box::new(RoundShape { inner_shape: Cuboid::new(Vector::new(0.8, 0.3, 0.5)), border_radius: 0.25 }),
                Box::new(RoundShape {
                    inner_shape: Cuboid::new(Vector::new(0.8 * s, 0.3 * s, 0.5 * s)),
                    border_radius: 0.25 * s,
                }),
            ),
            ("mesh", Box::new(faceted()), Box::new(faceted().scaled(Vector::splat(s)))),
        ];
        let mut random = Random(15);
        for (name, large, small) in shapes {
            let large = Solid::new(&*large, &here(), Side::Inside).unwrap();
            let small = Solid::new(&*small, &here(), Side::Inside).unwrap();
            for _ in 0..100 {
                let path = Line {
                    point: Vector3::from_fn(|_, _| random.between(-0.2, 0.2)),
                    velocity: direction(&mut random),
                };
                let tiny = Line { point: path.point * s, velocity: path.velocity * s };
                let (a, b) = (large.first_hit(&path).unwrap(), small.first_hit(&tiny).unwrap());
                assert_eq!((a.time, a.normal, a.point * s), (b.time, b.normal, b.point), "{name}");
            }
        }
    }
}

#[test]
fn distances_are_those_of_the_formulas() {
    let solid = |shape: &dyn Shape| Solid::new(shape, &here(), Side::Outside).unwrap();
    let p = Vector3::new(3.0, 4.0, 0.0);
    assert!((solid(&Ball::new(1.0)).distance(&p) - 4.0).abs() < 1e-15);
    assert!((solid(&Cuboid::new(Vector::new(1.0, 1.0, 1.0))).distance(&p) - libm::sqrt(13.0)).abs() < 1e-15);
    assert!((solid(&Cylinder::new(1.0, 1.0)).distance(&p) - libm::sqrt(13.0)).abs() < 1e-15);
    assert_eq!(solid(&HalfSpace::new(Vector::Y)).distance(&Vector3::new(0.0, -2.0, 5.0)), -2.0);
    let hull = ConvexPolyhedron::from_convex_hull(&tetrahedron()).unwrap();
    let inside = Solid::new(&hull, &here(), Side::Inside).unwrap();
    // inradius of the regular tetrahedron of edge 2√2
    assert!((inside.distance(&Vector3::zeros()) - 1.0 / libm::sqrt(3.0)).abs() < 1e-15);
    let seen = inside.closest(&Vector3::new(0.1, 0.1, -0.1));
    let n = Vector3::new(-1.0, -1.0, 1.0) / libm::sqrt(3.0);
    assert!((seen.normal - n).norm() < 1e-15);
    // from outside, nearest to a vertex
    assert!((inside.distance(&Vector3::new(2.0, 2.0, 2.0)) + libm::sqrt(3.0)).abs() < 1e-15);
}

#[test]
fn grazing_chords_of_a_ball_come_back_within_conditioning() {
    let ball = Solid::new(&Ball::new(1.0), &here(), Side::Inside).unwrap();
    for k in 0..8 {
        let theta = libm::pow(10.0, -f64::from(k));
        let path = Line {
            point: Vector3::x(),
            velocity: Vector3::new(-libm::sin(theta), 0.6 * libm::cos(theta), 0.8 * libm::cos(theta)),
        };
        let hit = ball.first_hit(&path).unwrap();
        assert!((hit.time - 2.0 * libm::sin(theta)).abs() < 8.0 * f64::EPSILON * (1.0 + 1.0 / theta), "{theta:e}");
    }
}

#[test]
fn a_path_hits_a_cone_where_that_is_at_every_angle() {
    // half the height is the apex's, and the slope is exact
    let cone = Solid::new(&Cone::new(0.5, 0.75), &here(), Side::Outside).unwrap();
    let slope = 0.75;
    let mut random = Random(17);
    let (mut hits, mut worst) = (0, 0.0_f64);
    while hits < 6000 {
        let path = if hits % 2 == 0 {
            let from = direction(&mut random) * 2.0;
            let aim = Vector3::from_fn(|_, _| random.between(-0.5, 0.5));
            Line { point: from, velocity: aim - from }
        } else {
            // through a place of the cone, almost along a tangent there
            let (angle, height) = (random.between(-3.0, 3.0), random.between(-0.4, 0.4));
            let out = Vector3::new(libm::cos(angle), 0.0, libm::sin(angle));
            let place = out * (slope * (0.5 - height)) + Vector3::y() * height;
            let generator = (Vector3::y() - out * slope) * random.between(-1.0, 1.0);
            let inwards = out * -libm::exp2(random.between(-16.0, -2.0));
            let velocity = Vector3::new(-out.z, 0.0, out.x) + generator + inwards;
            Line { point: place - velocity * 1.5, velocity }
        };
        let Some(hit) = cone.first_hit(&path).filter(|hit| hit.piece == 0) else { continue };
        hits += 1;
        // |x − a axis|² − slope² g² at the very time of the hit, of which the distance is a part
        let at = |i: usize| Double::new(path.point[i]).plus(Double::product(path.velocity[i], hit.time));
        let below = Double::new(0.5).plus(-at(1));
        let steep = below.times(Double::new(slope));
        let off = at(0).times(at(0)).plus(at(2).times(at(2))).plus(-steep.times(steep)).value();
        worst = worst.max((off / (2.0 * steep.value() * libm::hypot(1.0, slope))).abs());
    }
    // half an ulp of the time and about two of the distance, at coordinates of order 2
    assert!(worst <= 2.5 * f64::EPSILON, "{:.2} ulp", worst / f64::EPSILON);
}

#[test]
fn a_path_parallel_to_a_generator_meets_the_cone_and_not_its_mirror_image() {
    // the slope is 3/4 to the last bit
    let cone = Solid::new(&Cone::new(0.5, 0.75), &here(), Side::Outside).unwrap();
    let around = Solid::new(&Cone::new(0.5, 0.75), &here(), Side::Inside).unwrap();
    let mut random = Random(18);
    let (mut hits, mut misses) = (0, 0);
    for out in [Vector3::x(), -Vector3::x(), Vector3::z(), -Vector3::z()] {
        for sign in [-1.0, 1.0] {
            let velocity = (out * 0.75 - Vector3::y()) * sign;
            for _ in 0..500 {
                let aim = Vector3::from_fn(|_, _| random.between(-1.0, 1.0));
                let path = Line { point: aim - velocity * 4.0, velocity };
                let hit = cone.first_hit(&path);
                let depth = (0..800).map(|k| cone.distance(&path.at(f64::from(k) * 0.01))).fold(1.0, f64::min);
                if let Some(hit) = hit {
                    let [off, away] = [cone.distance(&hit.point).abs(), (path.at(hit.time) - hit.point).norm()];
                    // parry's own projections
                    assert!(off < 1e-12 && away < 1e-14, "{path:?} {hit:?} {off:e} {away:e}");
                    hits += 1;
                } else {
                    assert!(depth >= 0.0, "{path:?} goes {depth} deep");
                    misses += 1;
                }
                // and out of it again
                if around.contains(&aim) {
                    let hit = around.first_hit(&Line { point: aim, velocity }).unwrap();
                    assert!(around.distance(&hit.point).abs() < 1e-12, "{path:?} {hit:?}");
                }
            }
        }
    }
    assert!(hits > 500 && misses > 500, "{hits} {misses}");
}

#[test]
fn thin_and_small_solids_are_hit_from_afar() {
    let plate = Solid::new(&Cuboid::new(Vector::new(1.0, 1.0, 0.5e-12)), &here(), Side::Outside).unwrap();
    let down = Line { point: Vector3::new(0.1, 0.2, 900.0), velocity: -Vector3::z() };
    assert_eq!(plate.first_hit(&down).unwrap().piece, 5);
    // the ball is smaller than 16 ulp of where the path starts
    let grain = Solid::new(&Ball::new(1e-3), &here(), Side::Outside).unwrap();
    let aimed = Line { point: Vector3::new(1e12, 0.0, 0.0), velocity: -Vector3::x() };
    assert_eq!(grain.first_hit(&aimed).unwrap().point, Vector3::new(1e-3, 0.0, 0.0));
}

#[test]
fn shapes_without_volume_say_what_to_use_instead() {
    let refused = |shape: &dyn Shape| matches!(Solid::new(shape, &here(), Side::Outside), Err(Error::Shape { .. }));
    let (a, b, c) = (Vector::X, Vector::Y, Vector::Z);
    assert!(refused(&Triangle::new(a, b, c)));
    assert!(refused(&geometry::parry::parry3d_f64::shape::Segment::new(a, b)));
    assert!(matches!(Solid::new(&Ball::new(-1.0), &here(), Side::Inside), Err(Error::Length { .. })));
}

#[test]
fn solids_whose_squares_are_no_numbers_are_refused() {
    for size in [1e-151, 1e151, 1e-200, 1e200] {
        let ([x, y, z], half) = ([size, 0.3 * size, 0.7 * size], 0.5 * size);
        let hull = [[x, 0.0, 0.0], [0.0, x, 0.0], [0.0, 0.0, x], [0.0; 3]];
        let (vertices, triangles) = (hull.to_vec(), vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]);
        let described = [
            SolidSpec::Ball { radius: size },
            SolidSpec::Cuboid { size: [x, y, z], rounding: 0.0 },
            SolidSpec::Capsule { from: [0.0; 3], to: [1.0; 3], radius: size },
            SolidSpec::Cylinder { radius: size, height: 1.0, rounding: 0.0 },
            SolidSpec::Cone { radius: 1.0, height: size, rounding: 0.0 },
            SolidSpec::ConvexHull { points: hull.to_vec(), rounding: 0.0 },
            SolidSpec::TriMesh { vertices, triangles, margin: 0.0 },
        ];
        for spec in described {
            let error = spec.solid([0.0; 3], Side::Outside).err();
            assert!(matches!(error, Some(Error::Field { .. } | Error::Length { .. })), "{spec:?}: {error:?}");
        }
        let of_parry: [Box<dyn Shape>; 4] = [
            Box::new(Ball::new(size)),
            Box::new(Cuboid::new([half; 3].into())),
            Box::new(Cone::new(half, 1.0)),
            Box::new(RoundShape { inner_shape: Cylinder::new(half, 1.0), border_radius: 0.1 }),
        ];
        for shape in of_parry {
            let error = Solid::new(&*shape, &here(), Side::Inside).err();
            assert!(matches!(error, Some(Error::Length { .. })), "{:?}: {error:?}", shape.shape_type());
        }
    }
    // a border may be narrow, but not as wide as that
    for (rounding, fits) in [(1e-200, true), (1e151, false)] {
        let brick = SolidSpec::Cuboid { size: [1.0; 3], rounding }.solid([0.0; 3], Side::Outside);
        let inner = Cuboid::new([0.5; 3].into());
        let round = Solid::new(&RoundShape { inner_shape: inner, border_radius: rounding }, &here(), Side::Outside);
        assert!(brick.is_ok() == fits && round.is_ok() == fits, "{rounding}");
    }
    // a far centre, too; but planes through the origin have no size
    let (ball, plane) = (SolidSpec::Ball { radius: 1.0 }, SolidSpec::HalfSpace { normal: [0.0, 1e150, 1e150] });
    assert!(matches!(ball.solid([0.0, 1e200, 0.0], Side::Outside), Err(Error::Field { .. })));
    assert_eq!(plane.solid([0.0; 3], Side::Outside).unwrap().distance(&Vector3::y()), libm::sqrt(0.5));
}

/// An ellipsoid of which only the support map is known.
#[derive(Clone, Copy)]
struct Ellipsoid(Vector3<f64>);

impl SupportMap for Ellipsoid {
    fn local_support_point(&self, d: Vector) -> Vector {
        let scaled = Vector3::new(d.x, d.y, d.z).component_mul(&self.0);
        let p = self.0.component_mul(&(scaled / scaled.norm()));
        Vector::new(p.x, p.y, p.z)
    }
}
impl PointQuery for Ellipsoid {
    fn project_local_point(&self, point: Vector, solid: bool) -> PointProjection {
        local_point_projection_on_support_map(self, &mut VoronoiSimplex::new(), point, solid)
    }
    fn project_local_point_and_get_feature(&self, point: Vector) -> (PointProjection, FeatureId) {
        (self.project_local_point(point, false), FeatureId::Unknown)
    }
}
impl RayCast for Ellipsoid {
    fn cast_local_ray_and_get_normal(&self, _: &Ray, _: f64, _: bool) -> Option<RayIntersection> {
        unimplemented!("rays are not parry's business here")
    }
}
impl Shape for Ellipsoid {
    fn compute_local_aabb(&self) -> Aabb {
        let half = Vector::new(self.0.x, self.0.y, self.0.z);
        Aabb::new(-half, half)
    }
    fn compute_local_bounding_sphere(&self) -> BoundingSphere {
        BoundingSphere::new(Vector::ZERO, self.0.norm())
    }
    fn clone_dyn(&self) -> Box<dyn Shape> {
        Box::new(*self)
    }
    fn scale_dyn(&self, scale: Vector, _: u32) -> Option<Box<dyn Shape>> {
        Some(Box::new(Ellipsoid(self.0 * scale.x)))
    }
    fn mass_properties(&self, _: f64) -> MassProperties {
        MassProperties::from_ball(1.0, 1.0)
    }
    fn as_support_map(&self) -> Option<&dyn SupportMap> {
        Some(self)
    }
    fn shape_type(&self) -> ShapeType {
        ShapeType::Custom
    }
    fn as_typed_shape(&self) -> TypedShape<'_> {
        TypedShape::Custom(self)
    }
    fn ccd_thickness(&self) -> f64 {
        0.0
    }
    fn ccd_angular_thickness(&self) -> f64 {
        0.0
    }
}

#[test]
fn an_ellipsoid_known_by_its_support_map_is_hit_exactly() {
    let half = Vector3::new(1.5, 1.0, 0.75);
    for scale in [1.0, 1e-12] {
        let half = half * scale;
        for side in [Side::Inside, Side::Outside] {
            let solid = Solid::new(&Ellipsoid(half), &here(), side).unwrap();
            let mut random = Random(16);
            let mut hits = 0;
            while hits < 200 {
                let p = Vector3::from_fn(|_, _| random.between(-2.0, 2.0)) * scale;
                let v = direction(&mut random) * scale;
                let (x, w) = (p.component_div(&half), v.component_div(&half));
                if (x.norm() < 1.0) != (side == Side::Inside) {
                    continue;
                }
                let (a, b, c) = (w.norm_squared(), x.dot(&w), x.norm_squared() - 1.0);
                let root = b * b - a * c;
                let hit = solid.first_hit(&Line { point: p, velocity: v });
                if side == Side::Outside && (root < 0.0 || b > 0.0) {
                    assert_eq!(hit, None);
                    continue;
                }
                hits += 1;
                let hit = hit.unwrap_or_else(|| panic!("lost {p:?} {v:?}"));
                let exact = if side == Side::Inside {
                    if b > 0.0 { -c / (b + libm::sqrt(root)) } else { (libm::sqrt(root) - b) / a }
                } else {
                    c / (libm::sqrt(root) - b)
                };
                let gradient = hit.point.component_div(&half).component_div(&half);
                let normal = gradient / if side == Side::Inside { -gradient.norm() } else { gradient.norm() };
                let sine = -normal.dot(&v) / v.norm();
                // a dozen ulp of a distance of order 3, over the sine of the angle of incidence
                assert!((hit.time - exact).abs() < 1e-14 / sine, "{:e} at {sine}", hit.time - exact);
                assert!((hit.normal - normal).norm() < 1e-12, "{:e}", (hit.normal - normal).norm());
            }
        }
    }
}

#[test]
fn a_ball_is_kept_off_voxels_and_height_fields() {
    let voxels = Voxels::new(
        Vector::new(0.5, 0.6, 0.7),
        &[[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1], [-1, 0, 0]].map(|[i, j, k]| IVector::new(i, j, k)),
    );
    let heights = Array2::new(3, 3, vec![0.0, 0.3, 0.1, 0.5, 0.9, 0.2, 0.1, 0.4, 0.0]);
    let hills = HeightField::new(heights, Vector::new(2.0, 1.0, 2.0));
    let margin = 0.15;
    let mut random = Random(31);
    for (name, shape) in [("voxels", &voxels as &dyn Shape), ("hills", &hills)] {
        let wall = Solid::new(shape, &here(), Side::Outside).unwrap();
        let centres = Solid::new(shape, &here(), Side::Outside).unwrap().kept_off(margin).unwrap();
        let mut hits = 0;
        for _ in 0..3000 {
            let point = Vector3::from_fn(|i, _| if i == 1 { 2.5 } else { random.between(-0.8, 0.8) });
            let aim = Vector3::from_fn(|_, _| random.between(-0.6, 0.6));
            let path = Line { point, velocity: aim - point };
            let Some(hit) = centres.first_hit(&path) else { continue };
            for k in 0..50 {
                let before = path.at(hit.time * f64::from(k) / 50.0);
                assert!(wall.distance(&before) > margin - 1e-12, "{name} {path:?}");
            }
            assert!((wall.distance(&hit.point) - margin).abs() < 1e-12, "{name} {path:?}");
            hits += 1;
        }
        assert!(hits > 2000, "{name}: {hits}");
    }
    let ball = Solid::new(&Ball::new(1.0), &here(), Side::Outside).unwrap();
    assert!(matches!(ball.kept_off(margin), Err(Error::Shape { .. })));
    assert!(Solid::new(&voxels, &here(), Side::Outside).unwrap().kept_off(-1.0).is_err());
}

#[test]
fn obstacles_with_edges_no_thicker_than_rounding_are_refused_and_no_path_passes_thicker_ones() {
    use geometry::parry::SolidSpec as S;
    let thin = |t: f64| {
        [
            S::Cuboid { size: [1.0, 1.0, t], rounding: 0.0 },
            S::Cylinder { radius: 0.5, height: t, rounding: 0.0 },
            S::Cone { radius: 0.5, height: t, rounding: 0.0 },
            S::Cuboid { size: [1.0, t, 1.0], rounding: 0.0 },
            S::Cylinder { radius: 0.5 * t, height: 1.0, rounding: 0.0 },
        ]
    };
    for t in [1e-100, 1e-16, 1e-15] {
        for spec in thin(t) {
            let error = spec.solid([0.0; 3], Side::Outside).unwrap_err();
            assert!(matches!(error, Error::Shape { .. }), "{spec:?}: {error:?}");
            // as a room it is narrow but exact
            assert!(spec.solid([0.0; 3], Side::Inside).is_ok(), "{spec:?}");
        }
    }
    for t in [1e-13, 1e-9] {
        for (k, spec) in thin(t).into_iter().enumerate() {
            let solid = spec.solid([0.0; 3], Side::Outside).unwrap();
            let (point, velocity) =
                if k < 3 { ([0.05, 0.1, 0.6], [0.05, 0.1, -1.0]) } else { ([0.05, 0.6, 0.1], [-0.05, -0.6, 0.1]) };
            let hit = solid.first_hit(&Line { point: point.into(), velocity: velocity.into() });
            assert!(hit.is_some_and(|hit| !hit.corner), "{spec:?}");
        }
    }
}

#[test]
fn a_path_from_an_edge_leads_into_the_room_on_one_side_of_the_edge_and_not_on_the_other() {
    use geometry::parry::SolidSpec as S;
    let (vertices, triangles) = Cuboid::new([1.0; 3].into()).to_trimesh();
    let vertices = vertices.iter().map(|v| (*v).into()).collect();
    let triangles = triangles.iter().map(|t| t.map(|k| k as usize)).collect();
    let hull = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let (past, into) = ([-1.0, 2.0, -1.0], [-1.0, -2.0, -1.0]);
    // a start on an edge, a way past it into the room, and one into the solid
    let cases = [
        (S::Cuboid { size: [2.0; 3], rounding: 0.0 }, [1.0, 1.0, 0.5], past, into),
        (S::TriMesh { vertices, triangles, margin: 0.0 }, [1.0, 1.0, 0.5], past, into),
        (S::Cylinder { radius: 1.0, height: 2.0, rounding: 0.0 }, [1.0, 0.0, 1.0], [1.0, 0.5, -1.0], [-1.0, 0.5, -1.0]),
        (S::Cone { radius: 1.0, height: 2.0, rounding: 0.0 }, [0.0, 0.0, 1.0], [-1.0, 0.0, -1.0], [-0.25, 0.0, -1.0]),
        (S::ConvexHull { points: hull, rounding: 0.0 }, [0.5, 0.0, 0.0], [0.2, -1.0, 0.3], [0.2, 1.0, 0.3]),
    ];
    for (spec, point, past, into) in cases {
        for shift in [[0.0; 3], [0.3, -0.7, 0.1]] {
            let container = S::Ball { radius: 5.0 }.solid([0.0; 3], Side::Inside).unwrap();
            let room = Room::new(vec![container, spec.solid(shift, Side::Outside).unwrap()]);
            let path = |velocity: [f64; 3]| Line {
                point: Vector3::from(point) + Vector3::from(shift),
                velocity: Vector3::from(velocity),
            };
            let time = room.time_to_leave(&path(past)).unwrap();
            assert!(time > 0.0 && time < 1e-12, "{spec:?}: {time}");
            let away = Line { point: path(past).at(time), ..path(past) };
            assert_eq!(room.first_hit(&away).unwrap().piece, 0, "{spec:?}");
            assert_eq!(room.time_to_leave(&path(into)), None, "{spec:?}");
        }
    }
    // between two cubes that share a part of a side there is no table
    let corners = |low: [f64; 3]| (0..8).map(move |k| [0, 1, 2].map(|i| low[i] + f64::from(k >> i & 1)));
    let vertices = corners([0.0; 3]).chain(corners([1.0, 0.25, 0.25])).collect();
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let cube = |first: usize| {
        sides.iter().flat_map(move |[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]].map(|t| t.map(|k| k + first)))
    };
    let cubes = S::TriMesh { vertices, triangles: cube(0).chain(cube(8)).collect(), margin: 0.0 };
    let cubes = Room::new(vec![cubes.solid([0.0; 3], Side::Outside).unwrap()]);
    for velocity in [[1.0, 0.1, 0.1], [-1.0, 0.1, 0.1], [0.0, 0.3, -0.2]] {
        let path = Line { point: Vector3::new(1.0, 0.65, 0.6), velocity: velocity.into() };
        assert_eq!(cubes.time_to_leave(&path), None);
    }
    // along a wall there is no way off
    let floor = S::HalfSpace { normal: [0.0, 0.0, 1.0] }.solid([0.0; 3], Side::Outside).unwrap();
    let along = Line { point: Vector3::new(1.0, 2.0, 0.0), velocity: Vector3::new(1.0, -0.5, 0.0) };
    assert_eq!(Room::new(vec![floor]).time_to_leave(&along), None);
}

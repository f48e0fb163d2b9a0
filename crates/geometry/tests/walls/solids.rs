//! Rooms between convex solids of any kind, against their exact answers.

use super::leaks::Bounce;
use super::rooms::{AsSolids, First, Name, Wall, paths_in, room};
use super::side_by_side::SameBits;
use super::*;
use geometry::parry::{Room, Side, SolidSpec as S};
use geometry::{Boundary, Vector3};

/// A point of the cube between `±size`.
fn point(size: f64, random: &mut Random) -> [f64; 3] {
    core::array::from_fn(|_| random.between(-size, size))
}

/// The table on one side of a plane: all with `n·x > −5`, for a unit vector along `n`.
fn above(n: [f64; 3]) -> Wall {
    let unit = Vector3::from(n).normalize();
    (S::HalfSpace { normal: (-unit).into() }, (unit * -5.0).into(), Side::Inside)
}

/// A tetrahedron of triangles, of which the last may be missing or have a dent, and how far the table keeps off.
fn mesh(size: f64, faces: usize, dent: bool, margin: f64) -> S {
    let mut vertices =
        [[-1.0; 3], [1.0, 1.0, -1.0], [1.0, -1.0, 1.0], [-1.0, 1.0, 1.0]].map(|p| p.map(|x| x * size)).to_vec();
    let mut triangles = vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
    triangles.truncate(faces);
    if dent {
        vertices.push([0.1 * size; 3]);
        triangles.splice(3.., [[1, 3, 4], [3, 2, 4], [2, 1, 4]]);
    }
    S::TriMesh { vertices, triangles, margin }
}

/// What is around the origin, in one wall or several.
fn containers(random: &mut Random) -> Vec<(&'static str, Vec<Wall>)> {
    let at = [0.25, -0.125, 0.375];
    let inside = |spec: S| vec![(spec, at, Side::Inside)];
    let hull = |points: &[[f64; 3]]| S::ConvexHull { points: points.into(), rounding: 0.0 };
    let [a, b] = [12.0, 7.0];
    let octahedron = [[a, 0.0, 0.0], [-a, 0.0, 0.0], [0.0, b, 0.0], [0.0, -b, 0.0], [0.0, 0.0, a], [0.0, 0.0, -a]];
    let tetrahedron = [[-9.0, -9.0, -5.0], [25.0, -9.0, -5.0], [-9.0, 25.0, -5.0], [-9.0, -9.0, 40.0]];
    let any: Vec<[f64; 3]> = (0..9).map(|_| point(9.0, random)).chain(octahedron.map(|p| p.map(|x| 0.5 * x))).collect();
    let planes = |normals: &[[f64; 3]]| normals.iter().map(|n| above(*n)).collect::<Vec<_>>();
    let lens = [12.0, 11.0]
        .map(|radius| (S::Ball { radius }, [0.75 * (radius - 9.0) * (2.0 * radius - 23.0), 0.5, 0.0], Side::Inside));
    vec![
        ("octahedron", inside(hull(&octahedron))),
        ("tetrahedron", inside(hull(&tetrahedron))),
        ("polyhedron", inside(hull(&any))),
        ("mesh", inside(mesh(6.0, 4, false, 0.0))),
        ("mesh kept off", inside(mesh(8.0, 4, false, 0.75))),
        ("capsule", inside(S::Capsule { from: [-3.0, 1.0, -2.0], to: [3.0, 0.5, 1.0], radius: 6.0 })),
        ("upright capsule", inside(S::Capsule { from: [0.0, 0.0, -3.0], to: [0.0, 0.0, 3.0], radius: 5.0 })),
        ("cone", inside(S::Cone { radius: 8.0, height: 12.0, rounding: 0.0 })),
        ("flat cone", inside(S::Cone { radius: 15.0, height: 6.0, rounding: 0.0 })),
        ("half a ball", [inside(S::Ball { radius: 9.0 }), planes(&[[0.3, -0.2, 1.0]])].concat()),
        ("lens", lens.into()),
        (
            "half a can",
            [inside(S::Cylinder { radius: 6.0, height: 9.5, rounding: 0.0 }), planes(&[[1.0, 0.5, 0.3]])].concat(),
        ),
        ("wedge", planes(&[[1.0, 0.2, 0.0], [0.0, 0.1, 1.0]])),
        ("channel", planes(&[[1.0, 0.0, 0.0], [-1.0, 0.1, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])),
        ("prism", planes(&[[1.0, 0.0, 0.0], [-0.5, 1.0, 0.0], [-0.5, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])),
        (
            "cut cube",
            [inside(S::Cuboid { size: [9.0, 10.0, 8.5], rounding: 0.0 }), planes(&[[1.0, 1.0, 1.0]])].concat(),
        ),
        ("open space", vec![]),
    ]
}

/// An obstacle of any kind anywhere; some of them meet.
fn obstacle(random: &mut Random) -> Wall {
    let size = |random: &mut Random| random.between(0.3, 2.5);
    let kind = random.uniform();
    let spec = if kind < 0.2 {
        S::Ball { radius: size(random) }
    } else if kind < 0.4 {
        S::Cuboid { size: core::array::from_fn(|_| size(random)), rounding: 0.0 }
    } else if kind < 0.6 {
        S::Cylinder { radius: size(random), height: size(random), rounding: 0.0 }
    } else if kind < 0.8 {
        let to = if kind < 0.65 { [0.0, 1.5, 0.0] } else { point(1.5, random) };
        S::Capsule { from: if kind < 0.65 { [0.0; 3] } else { point(1.5, random) }, to, radius: size(random) }
    } else if kind < 0.82 {
        mesh(size(random), 4, false, 0.0)
    } else if kind < 0.86 {
        mesh(size(random), 4, random.uniform() < 0.5, if random.uniform() < 0.5 { 0.0 } else { 0.25 })
    } else if kind < 0.88 {
        mesh(size(random), 3, false, 0.0)
    } else if kind < 0.95 {
        S::ConvexHull { points: (0..6).map(|_| point(2.0, random)).collect(), rounding: 0.0 }
    } else if kind < 0.975 {
        S::Cone { radius: size(random), height: size(random), rounding: 0.0 }
    } else {
        S::Cuboid { size: core::array::from_fn(|_| size(random)), rounding: 0.25 }
    };
    (spec, point(4.0, random), Side::Outside)
}

/// Paths of specular orbits from places in a room, as far as they go.
fn orbits_in(room: &Room, count: usize, random: &mut Random) -> Vec<Line<3>> {
    let mut all = vec![];
    for mut path in paths_in(room, count, random) {
        for _ in 0..16 {
            all.push(path);
            let Some(hit) = room.first_hit(&path).filter(|hit| !hit.corner && hit.point.amax() < 1e3) else { break };
            let v = path.velocity;
            path = Line { point: hit.point, velocity: v - hit.normal * (2.0 * v.dot(&hit.normal)) };
        }
    }
    all
}

#[test]
fn convex_solids_in_lanes_answer_as_they_do_alone() {
    let mut random = Random(29);
    for round in 0..24 {
        for (name, container) in containers(&mut random) {
            let obstacles: Vec<Wall> = (0..round % 6).map(|_| obstacle(&mut random)).collect();
            // numbers follow the order, whichever comes first
            let walls = if round < 12 { [container, obstacles].concat() } else { [obstacles, container].concat() };
            if walls.is_empty() {
                continue;
            }
            let room = room(&walls);
            let paths = orbits_in(&room, 32, &mut random);
            let name = &format!("{name} {round}");
            room.with_walls(AsSolids { name, room: &room, paths: &paths });
            room.with_walls(SameBits { name, paths: &paths });
            let found = room.with_walls(Name);
            assert!(found.starts_with("solids::Solids") || name.starts_with("open"), "{name}: {found}");
        }
    }
}

#[test]
fn nothing_leaks_from_rooms_between_convex_solids() {
    let mut random = Random(37);
    for (name, container) in containers(&mut random) {
        if ["wedge", "channel", "open space"].contains(&name) {
            continue;
        }
        let obstacles: Vec<Wall> = (0..3).map(|_| obstacle(&mut random)).collect();
        let room = room(&[container, obstacles].concat());
        let starts = paths_in(&room, 64, &mut random);
        let mut k = 0;
        room.with_walls(Bounce {
            name,
            bounces: 20_000,
            start: || {
                k += 1;
                starts[k % starts.len()]
            },
            distance: |p: &Vector3<f64>| room.distance(p),
            size: 40.0,
        });
    }
}

/// A place on an edge for a number from 0 to 1, and the normals of both faces.
type Place<'a> = &'a dyn Fn(f64) -> (Vector3<f64>, [Vector3<f64>; 2]);

#[test]
fn edges_and_corners_are_told_in_lanes_as_alone() {
    let mut random = Random(31);
    let solid = |spec: S, side| (spec, [0.0; 3], side);
    let cube = S::Cuboid { size: [2.0; 3], rounding: 0.0 };
    let drum = S::Cylinder { radius: 1.0, height: 2.0, rounding: 0.0 };
    let tetrahedron =
        S::ConvexHull { points: vec![[-1.0; 3], [1.0, 1.0, -1.0], [1.0, -1.0, 1.0], [-1.0, 1.0, 1.0]], rounding: 0.0 };
    // no walls in lanes know it
    let cone = S::Cone { radius: 1.0, height: 2.0, rounding: 0.0 };
    let planes = [[3.0, 0.0, -1.0], [-1.0, 3.0, 0.0], [0.0, -1.0, 3.0]].map(above);
    let floor = (S::HalfSpace { normal: [0.0, 0.0, 1.0] }, [0.0, 0.0, -1.0], Side::Outside);
    let on_cube = |u: f64| (Vector3::new(1.0, 2.0 * u - 1.0, -1.0), [Vector3::x(), -Vector3::z()]);
    let on_rim = |u: f64| {
        let out = Vector3::new(libm::cos(7.0 * u), libm::sin(7.0 * u), 0.0);
        (out + Vector3::z(), [out, Vector3::z()])
    };
    let on_foot = |u: f64| {
        let out = Vector3::new(libm::cos(7.0 * u), libm::sin(7.0 * u), 0.0);
        (out - Vector3::z(), [out * 2.0 + Vector3::z(), Vector3::z()].map(|n| n.normalize()))
    };
    let on_base = |u: f64| {
        let out = Vector3::new(libm::cos(7.0 * u), libm::sin(7.0 * u), 0.0);
        (out - Vector3::z(), [out * 2.0 + Vector3::z(), -Vector3::z()].map(|n| n.normalize()))
    };
    let on_tetrahedron = |u: f64| {
        let faces = [[1.0, -1.0, -1.0], [1.0, 1.0, 1.0]].map(|n| Vector3::from(n).normalize());
        (Vector3::new(1.0, 2.0 * u - 1.0, 1.0 - 2.0 * u), faces)
    };
    let on_planes = |u: f64| {
        let [a, b] = [[3.0, 0.0, -1.0], [-1.0, 3.0, 0.0]].map(|n| Vector3::from(n).normalize());
        ((a + b) * (-5.0 / (1.0 + a.dot(&b))) + a.cross(&b) * (20.0 * u), [a, b])
    };
    let cases: [(&str, Vec<Wall>, Place<'_>); 9] = [
        ("in a cube and half a space", vec![solid(cube.clone(), Side::Inside), above([1.0, 2.0, 8.0])], &on_cube),
        ("around a cube", vec![solid(cube, Side::Outside)], &on_cube),
        ("in a drum and half a space", vec![solid(drum.clone(), Side::Inside), above([1.0, 2.0, 8.0])], &on_rim),
        ("around a drum", vec![solid(drum, Side::Outside)], &on_rim),
        ("in a tetrahedron", vec![solid(tetrahedron.clone(), Side::Inside)], &on_tetrahedron),
        ("around a tetrahedron", vec![solid(tetrahedron, Side::Outside)], &on_tetrahedron),
        ("between planes", planes.into(), &on_planes),
        ("beside a cone on a plane", vec![solid(cone.clone(), Side::Outside), floor], &on_foot),
        ("in a cone", vec![solid(cone, Side::Inside)], &on_base),
    ];
    for (name, walls, place) in cases {
        let room = room(&walls);
        let mut paths = vec![];
        while paths.len() < 2000 {
            // on the edge, or some ulp beside it, or farther
            let aside = Vector3::from(point(1.0, &mut random)) * libm::exp2(-random.between(40.0, 56.0));
            let end = if random.uniform() < 0.25 { 0.0 } else { random.uniform() };
            let (to, faces) = place(end);
            let from = Vector3::from(point(4.0, &mut random));
            let velocity = to + aside - from;
            // along a face, its crossing is known to no such digit; nor is whether an edge is met or passed by
            let [a, b] = faces.map(|face| face.dot(&velocity) / velocity.norm());
            if room.distance(&from) > 0.0 && a.abs().min(b.abs()) > 0.1 && a * b > 0.0 {
                paths.push(Line { point: from, velocity });
            }
        }
        let corners = paths.iter().filter(|path| room.first_hit(path).is_some_and(|hit| hit.corner)).count();
        assert!((20..1980).contains(&corners), "{name}: {corners}");
        room.with_walls(AsSolids { name, room: &room, paths: &paths });
        room.with_walls(SameBits { name, paths: &paths });
        let found = room.with_walls(Name);
        assert!(found.starts_with("solids::Solids"), "{name}: {found}");
    }
}

#[test]
fn a_path_along_a_wall_of_two_sides_ends_in_the_corner_at_its_foot() {
    // a triangle that stands on the floor of a cube, and another one in its middle
    let sheet = S::TriMesh {
        vertices: [[0.0, -0.5, -1.0], [0.0, 0.5, -1.0], [0.0, 0.0, 0.5]]
            .into_iter()
            .chain([[0.5, -0.5, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5]])
            .collect(),
        triangles: vec![[0, 1, 2], [0, 2, 1], [3, 4, 5], [3, 5, 4]],
        margin: 0.0,
    };
    let cube = S::Cuboid { size: [2.0; 3], rounding: 0.0 };
    let room = room(&[(cube, [0.0; 3], Side::Inside), (sheet, [0.0; 3], Side::Outside)]);
    for (x, corner) in [(0.0, true), (1e-12, false)] {
        let path = Line { point: Vector3::new(x, 0.1, 0.0), velocity: -Vector3::z() };
        let hit = room.with_walls(First(path));
        assert_eq!((hit.point, hit.corner), (Vector3::new(x, 0.1, -1.0), corner));
    }
}

#[test]
fn the_apex_of_a_cone_is_a_corner() {
    let cone = S::Cone { radius: 1.0, height: 2.0, rounding: 0.0 };
    let room = room(&[(cone, [0.0; 3], Side::Inside)]);
    for (aside, corner) in [(0.0, true), (1e-16, true), (1e-12, false)] {
        let path = Line { point: Vector3::new(0.25, 0.0, -0.5), velocity: Vector3::new(aside - 0.25, 0.0, 1.5) };
        let hit = room.with_walls(First(path));
        assert!((hit.point - Vector3::z()).norm() <= 4.0 * aside + 4.0 * f64::EPSILON, "{hit:?}");
        assert_eq!(hit.corner, corner, "{hit:?}");
    }
}

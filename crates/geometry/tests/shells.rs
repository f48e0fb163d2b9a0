//! Closed meshes, of several parts and of thin triangles.
#![allow(clippy::unwrap_used, reason = "tests panic where they fail")]
use geometry::{
    Boundary, Error, Line, Vector3,
    parry::{Side, SolidSpec},
};

type Triangles = (Vec<[f64; 3]>, Vec<[usize; 3]>);

/// A cube about a point of the first axis, counter-clockwise from outside.
fn cube(at: f64, half: f64) -> Triangles {
    let corner = |k: usize| [0, 1, 2].map(|i| if k >> i & 1 == 1 { half } else { -half });
    let vertices = (0..8).map(corner).map(|[x, y, z]| [x + at, y, z]).collect();
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    (vertices, sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect())
}
fn turned((vertices, triangles): Triangles) -> Triangles {
    (vertices, triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect())
}
fn together(parts: Vec<Triangles>) -> SolidSpec {
    let (mut vertices, mut triangles) = (vec![], vec![]);
    for (points, numbers) in parts {
        let first = vertices.len();
        vertices.extend(points);
        triangles.extend(numbers.iter().map(|t| t.map(|v| v + first)));
    }
    SolidSpec::TriMesh { vertices, triangles, margin: 0.0 }
}
/// The triangle named in the error, for either side, also if all of it is turned round.
fn refused(parts: &[Triangles]) -> Option<usize> {
    let all = [parts.to_vec(), parts.iter().cloned().map(turned).collect()];
    let mut found = vec![];
    for parts in all {
        for side in [Side::Inside, Side::Outside] {
            found.push(match together(parts.clone()).solid([0.0; 3], side) {
                Err(Error::Triangle { triangle, .. }) => Some(triangle),
                other => other.map(|_| None).unwrap(),
            });
        }
    }
    assert!(found.iter().all(|one| *one == found[0]), "{found:?}");
    found[0]
}

#[test]
fn a_part_that_is_inside_out_is_refused_by_a_triangle_of_its_own() {
    assert_eq!(refused(&[cube(0.0, 1.0), cube(4.0, 0.5)]), None);
    assert_eq!(refused(&[cube(0.0, 1.0), turned(cube(4.0, 0.5))]), Some(12));
    assert_eq!(refused(&[turned(cube(4.0, 0.5)), cube(0.0, 1.0)]), Some(0));
    // one that touches the other
    assert_eq!(refused(&[cube(0.0, 1.0), cube(1.5, 0.5)]), None);
    assert_eq!(refused(&[cube(0.0, 1.0), turned(cube(1.5, 0.5))]), Some(12));
    // numbers are those given, also after a triangle without area
    let (mut vertices, mut triangles) = cube(0.0, 1.0);
    vertices.push([0.0, -1.0, -1.0]);
    triangles[4] = [0, 8, 5];
    triangles.insert(4, [8, 1, 5]);
    triangles.insert(0, [0, 1, 8]);
    assert_eq!(refused(&[(vertices, triangles), turned(cube(4.0, 0.5))]), Some(14));
}

#[test]
fn parts_in_one_another_are_by_turns_bodies_and_cavities() {
    let nested = |turns: &[bool]| {
        let half = |k: usize| [4.0, 2.0, 1.0, 0.5][k];
        let one = |(k, turn): (usize, &bool)| if *turn { turned(cube(0.0, half(k))) } else { cube(0.0, half(k)) };
        turns.iter().enumerate().map(one).collect::<Vec<_>>()
    };
    assert_eq!(refused(&nested(&[false, true])), None);
    assert_eq!(refused(&nested(&[false, true, false])), None);
    assert_eq!(refused(&nested(&[false, true, false, true])), None);
    assert_eq!(refused(&nested(&[false, false])), Some(12));
    assert_eq!(refused(&nested(&[false, true, true])), Some(24));
    let hollow = together(nested(&[false, true, false])).solid([0.0; 3], Side::Inside).unwrap();
    let there = [0.5, 1.5, 3.0, 5.0].map(|x| hollow.contains(&Vector3::new(x, 0.1, 0.2)));
    assert_eq!(there, [true, false, true, false]);
    // parts that overlap: of the first, the middle of this triangle lies in the second
    assert_eq!(refused(&[cube(0.0, 1.0), cube(1.25, 0.75)]), Some(10));
}

#[test]
fn a_surface_that_is_none_says_what_is_wrong_with_it() {
    let problem = |vertices: Vec<[f64; 3]>, triangles: Vec<[usize; 3]>| {
        let mesh = SolidSpec::TriMesh { vertices, triangles, margin: 0.0 };
        mesh.solid([0.0; 3], Side::Outside).unwrap_err().to_string()
    };
    let (vertices, triangles) = cube(0.0, 1.0);
    let twice = [&triangles[..], &[[triangles[3][1], triangles[3][2], triangles[3][0]]]].concat();
    assert_eq!(
        problem(vertices.clone(), twice),
        "triangle mesh: triangle 12, counted from 0, occurs twice: remove one of the two"
    );
    // cubes that touch along an edge
    let SolidSpec::TriMesh { vertices: two, triangles: of_both, .. } = together(vec![cube(0.0, 1.0), cube(0.0, 1.0)])
    else {
        panic!()
    };
    let moved = |(k, [x, y, z]): (usize, [f64; 3])| if k < 8 { [x, y, z] } else { [x + 2.0, y + 2.0, z] };
    let touching = problem(two.into_iter().enumerate().map(moved).collect(), of_both);
    assert!(touching.contains("an edge that belongs to more than two triangles"), "{touching}");
    let mut mixed = triangles;
    mixed[0].swap(0, 1);
    let mixed = problem(vertices, mixed);
    assert!(mixed.contains("triangle 0, counted from 0, runs along an edge in the same direction"), "{mixed}");
    // a Möbius strip
    let strip: Vec<[f64; 3]> = (0..16)
        .map(|k| {
            let angle = f64::from(k / 2) * core::f64::consts::PI / 4.0;
            let across = if k % 2 == 0 { -0.3 } else { 0.3 };
            let r = 1.0 + across * libm::cos(0.5 * angle);
            [r * libm::cos(angle), r * libm::sin(angle), across * libm::sin(0.5 * angle)]
        })
        .collect();
    let vertex = |k: usize| if k < 16 { k } else { 17 - (k - 16) - 16 };
    let along = (0..16).map(|k| if k % 2 == 0 { [k, k + 1, k + 2] } else { [k + 1, k, k + 2] });
    let moebius = problem(strip, along.map(|t| t.map(vertex)).collect());
    assert!(moebius.contains("has only one side"), "{moebius}");
}

#[test]
fn parts_that_stand_on_one_another_are_no_contradiction_however_they_are_turned() {
    // three stacks of three boxes; as they are turned, all floors run along the first axis, but for rounding
    let one = |low: [f64; 3], high: [f64; 3]| {
        let (vertices, triangles) = cube(0.0, 0.5);
        let place = |v: [f64; 3]| [0, 1, 2].map(|i| low[i] + (v[i] + 0.5) * (high[i] - low[i]));
        (vertices.into_iter().map(place).collect::<Vec<_>>(), triangles)
    };
    for k in 0..100 {
        let (sin, cos) = libm::sincos(0.1 + 0.06 * f64::from(k));
        let (s, c) = libm::sincos(0.7 + 0.01 * f64::from(k));
        let boxes = (0..3).flat_map(|column| {
            let x = 0.4 * f64::from(column);
            [
                one([x, 0.1 + 0.2 * x, 0.0], [x + 0.3, 0.9, 0.35]),
                one([x + 0.1, 0.3, 0.35], [x + 0.35, 0.7 + 0.2 * x, 0.8]),
                one([x - 0.1, 0.2, 0.8], [x + 0.25, 0.6 + 0.1 * x, 1.4]),
            ]
        });
        let turn = |[x, y, z]: [f64; 3]| {
            let [x, y] = [c * x - s * y, s * x + c * y];
            [x + 2.0, cos * y - sin * z, sin * y + cos * z - 1.0]
        };
        let parts = boxes.map(|(vertices, triangles)| (vertices.into_iter().map(turn).collect(), triangles));
        assert_eq!(refused(&parts.collect::<Vec<_>>()), None, "{k}");
    }
}

#[test]
fn a_part_with_a_dent_of_small_triangles_is_a_body() {
    // a cube from whose top a wide pit of many small triangles goes down, beside another cube
    let (mut vertices, mut triangles) = cube(0.0, 1.0);
    triangles.retain(|t| !t.iter().all(|v| vertices[*v][2] == 1.0));
    let first = vertices.len();
    let (sides, levels) = (32, 12);
    for level in 0..=levels {
        for k in 0..sides {
            let (sin, cos) = libm::sincos(core::f64::consts::TAU * k as f64 / sides as f64);
            vertices.push([0.9 * cos, 0.9 * sin, 1.0 - 1.9 * level as f64 / levels as f64]);
        }
    }
    let ring = |level: usize, k: usize| first + level * sides + k % sides;
    for (level, k) in (0..levels).flat_map(|level| (0..sides).map(move |k| (level, k))) {
        let [a, b, c, d] = [ring(level, k), ring(level, k + 1), ring(level + 1, k + 1), ring(level + 1, k)];
        triangles.extend([[a, c, b], [a, d, c]].map(|[a, b, c]| [a, c, b]));
    }
    triangles.extend((1..sides - 1).map(|k| [ring(levels, 0), ring(levels, k), ring(levels, k + 1)]));
    // the rim of the pit, eight of its sides to each corner of the top
    let corners = [7, 6, 4, 5];
    for (quarter, &corner) in corners.iter().enumerate() {
        let at = 8 * quarter;
        triangles.extend((0..8).map(|k| [corner, ring(0, at + k + 1), ring(0, at + k)]));
        triangles.push([corner, corners[(quarter + 1) % 4], ring(0, at + 8)]);
    }
    // seen from a corner in the pit, most triangles look down
    let walls = 10;
    triangles.rotate_left(walls + 2 * sides * levels);
    assert_eq!(refused(&[(vertices.clone(), triangles.clone()), cube(4.0, 0.5)]), None);
    let beside = triangles.len();
    assert_eq!(refused(&[(vertices, triangles), turned(cube(4.0, 0.5))]), Some(beside));
}

#[test]
fn a_triangle_that_runs_the_wrong_way_is_named_whichever_the_check_meets_first() {
    let (vertices, triangles) = cube(0.0, 1.0);
    for wrong in 0..triangles.len() {
        let mut triangles = triangles.clone();
        triangles[wrong].swap(1, 2);
        let mesh = SolidSpec::TriMesh { vertices: vertices.clone(), triangles, margin: 0.0 };
        match mesh.solid([0.0; 3], Side::Inside) {
            Err(Error::Triangle { triangle, problem }) => {
                assert!(
                    triangle == wrong && problem.contains("in the opposite order"),
                    "{wrong}: {triangle} {problem}"
                );
            }
            other => panic!("{wrong}: {other:?}"),
        }
    }
}

/// What rounds differences of coordinates turned the normal of a thin triangle by 10⁻¹⁶ over its thinness, and where a mesh was far away,
/// by the rounding of its vertices there.
#[test]
fn the_normal_of_a_thin_triangle_is_that_of_its_own_coordinates_wherever_the_mesh_lies() {
    // whole numbers below 2⁴¹, whose products are exact in 128 bits, in units of 2⁻⁴⁰
    const UNIT: f64 = 1.0 / (1_u64 << 40) as f64;
    for thinness in [1_i64 << 38, 1 << 30, 1 << 20] {
        let corners = [
            [3, 7, 1],
            [(1 << 40) + 12_345, 98_765_432_101, 4_321_098_765],
            [(1 << 39) + 999, 49_382_716_050 + thinness, 2_160_549_383 + thinness / 3],
            [412_316_860_416, 300_000_000_007, 900_000_000_001],
        ];
        let [u, v] = [1, 2].map(|k| [0, 1, 2].map(|i| i128::from(corners[k][i] - corners[0][i])));
        let exact = Vector3::from_fn(|i, _| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            (u[j] * v[k] - u[k] * v[j]) as f64 * (UNIT * UNIT)
        });
        let vertices: Vec<[f64; 3]> = corners.iter().map(|p| p.map(|x| x as f64 * UNIT)).collect();
        let inwards = exact * exact.dot(&Vector3::from(vertices[3])).signum() / exact.norm();
        let middle = vertices[..3].iter().map(|p| Vector3::from(*p)).sum::<Vector3<f64>>() / 3.0;
        let spec =
            SolidSpec::TriMesh { vertices, triangles: vec![[0, 1, 2], [0, 2, 3], [1, 0, 3], [2, 1, 3]], margin: 0.0 };
        for center in [[0.0; 3], [1000.1, -2000.7, 300.3], [1e6 + 0.1, 0.3, -3e5]] {
            let room = spec.solid(center, Side::Inside).unwrap();
            let aim = middle + Vector3::from(center);
            let path = Line { point: aim + inwards * 0.01, velocity: -inwards };
            let hit = room.first_hit(&path).unwrap();
            let off = (hit.normal - inwards).amax();
            assert!(off <= 2.0 * f64::EPSILON, "{thinness} {center:?}: {off:e}");
        }
    }
}

/// A block about the origin.
fn block(half: [f64; 3]) -> Triangles {
    let (vertices, triangles) = cube(0.0, 1.0);
    (vertices.into_iter().map(|v| [0, 1, 2].map(|i| v[i] * half[i])).collect(), triangles)
}

/// A closed beam of rectangular section along a polygon about the third axis, each of whose vertices is `step` fifths of a turn from the
/// last.
fn ring(step: usize) -> Triangles {
    let station = |k: usize| {
        let (sin, cos) = libm::sincos(core::f64::consts::TAU * ((k * step) % 5) as f64 / 5.0);
        [[0.9, -0.1], [1.0, -0.1], [1.0, 0.1], [0.9, 0.1]].map(|[r, z]| [r * cos, r * sin, z])
    };
    let side = |(k, i): (usize, usize)| {
        let at = |k: usize, i: usize| 4 * (k % 5) + i % 4;
        let [a, b, c, d] = [at(k, i), at(k + 1, i), at(k + 1, i + 1), at(k, i + 1)];
        [[a, b, c], [a, c, d]]
    };
    let sides = (0..5).flat_map(|k| (0..4).map(move |i| (k, i)));
    ((0..5).flat_map(station).collect(), sides.flat_map(side).collect())
}

#[test]
fn a_surface_that_runs_through_itself_is_refused() {
    // a rod through a plate: all vertices, and the middles of all triangles, lie outside of the other
    let [rod, plate] = [block([0.1, 0.1, 1.0]), block([1.0, 1.0, 0.05])];
    assert_eq!(refused(&[plate.clone(), rod.clone()]), Some(0));
    assert_eq!(refused(&[rod, plate]), Some(12));
    // one part: a pentagram, whose beams run through one another, and a pentagon
    assert!(refused(&[ring(2)]).is_some());
    assert_eq!(refused(&[ring(1)]), None);
    // a sheet across a wall, and across another sheet, has table on both sides
    let flat = |[a, b]: [usize; 2]| {
        let corners = [[0.5, 0.5], [1.5, 0.5], [1.5, -0.5], [0.5, -0.5]].map(|way| {
            let mut v = [0.0, 0.25, 0.0];
            (v[a], v[b]) = (way[0], way[1]);
            v
        });
        (corners.into(), vec![[0, 1, 2], [0, 2, 3], [3, 2, 1], [3, 1, 0]])
    };
    assert_eq!(refused(&[cube(0.0, 1.0), flat([0, 2])]), None);
    assert_eq!(refused(&[flat([0, 1]), flat([0, 2])]), None);
}

/// A path from one point towards another.
fn towards(from: [f64; 3], to: [f64; 3]) -> Line<3> {
    Line { point: from.into(), velocity: Vector3::from(to) - Vector3::from(from) }
}

#[test]
fn whether_a_vertex_is_a_corner_does_not_depend_on_the_order_of_triangles() {
    // a cube with a triangle of its lid that meets the edges in vertices only
    let (mut vertices, mut triangles) = cube(0.0, 1.0);
    triangles.retain(|t| !t.contains(&7) && !t.iter().all(|v| vertices[*v][2] > 0.0));
    vertices.extend([[1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]);
    triangles.extend([[4, 8, 9], [4, 5, 8], [8, 7, 9], [4, 9, 6]]);
    triangles.extend([[1, 3, 8], [1, 8, 5], [3, 7, 8], [3, 2, 9], [3, 9, 7], [2, 6, 9]]);
    for first in 0..triangles.len() {
        triangles.rotate_left(1);
        let room = together(vec![(vertices.clone(), triangles.clone())]).solid([0.0; 3], Side::Inside).unwrap();
        for to in [[-1.0, -1.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]] {
            assert!(room.first_hit(&towards([0.25, -0.5, 0.125], to)).unwrap().corner, "{first} {to:?}");
        }
        assert!(!room.first_hit(&towards([0.25, -0.5, 0.125], [0.0, 0.0, 1.0])).unwrap().corner);
    }
    // a wedge, and a pyramid, that stand on a cube by an edge or a vertex
    let wedge =
        [[0.0, -0.5, 1.0], [0.3, -0.5, 1.3], [-0.3, -0.5, 1.3], [0.0, 0.5, 1.0], [0.3, 0.5, 1.3], [-0.3, 0.5, 1.3]];
    let wedge: Triangles =
        (wedge.into(), vec![[0, 1, 2], [3, 5, 4], [0, 3, 4], [0, 4, 1], [1, 4, 5], [1, 5, 2], [2, 5, 3], [2, 3, 0]]);
    let pyramid = [[0.0, 0.125, 1.0], [0.2, -0.075, 1.3], [0.2, 0.325, 1.3], [-0.2, 0.125, 1.3]];
    let pyramid: Triangles = (pyramid.into(), vec![[0, 1, 3], [0, 2, 1], [0, 3, 2], [1, 2, 3]]);
    for upon in [wedge, pyramid] {
        for parts in [vec![cube(0.0, 1.0), upon.clone()], vec![upon, cube(0.0, 1.0)]] {
            let solid = together(parts).solid([0.0; 3], Side::Outside).unwrap();
            assert!(solid.first_hit(&towards([-0.5, 0.125, 1.25], [0.0, 0.125, 1.0])).unwrap().corner);
            assert!(!solid.first_hit(&towards([-0.5, 0.125, 1.25], [-1e-9, 0.125, 1.0])).unwrap().corner);
        }
    }
}

/// A prism, turned, whose ends are fans of triangles about one of their vertices.
fn prism(sides: usize) -> Triangles {
    let turned =
        |[x, y, z]: [f64; 3]| [0.36 * x + 0.48 * y - 0.8 * z, -0.8 * x + 0.6 * y, 0.48 * x + 0.64 * y + 0.6 * z];
    let ring = |z: f64| {
        (0..sides).map(move |k| {
            let (sin, cos) = libm::sincos(core::f64::consts::TAU * k as f64 / sides as f64);
            turned([cos, sin, z])
        })
    };
    let ends = (1..sides - 1).flat_map(|k| [[0, k + 1, k], [sides, sides + k, sides + k + 1]]);
    let walls = (0..sides).flat_map(|k| {
        let next = (k + 1) % sides;
        [[k, next, sides + next], [k, sides + next, sides + k]]
    });
    (ring(-0.5).chain(ring(0.5)).collect(), ends.chain(walls).collect())
}

#[test]
fn the_point_of_a_collision_is_on_the_surface_however_narrow_its_triangles_are() {
    let room = together(vec![prism(512)]).solid([0.0; 3], Side::Inside).unwrap();
    let mut path = towards([0.01, 0.02, 0.03], [0.61, 0.39, 0.73]);
    for k in 0..1000 {
        let hit = room.first_hit(&path).unwrap();
        assert!(!hit.corner, "{k}");
        let off = room.distance(&hit.point);
        assert!(off.abs() <= room.slack(&hit.point), "{k}: {off:e}");
        let v = path.velocity;
        path = Line { point: hit.point, velocity: (v - hit.normal * (2.0 * hit.normal.dot(&v))).normalize() };
    }
}

#[test]
fn where_a_small_ball_touches_an_edge_the_normal_is_that_of_the_collision() {
    // a body with sharp and blunt edges
    let corners = vec![
        [-0.26, 0.04, -0.74],
        [-0.65, -0.47, -0.27],
        [-0.53, -0.33, -0.14],
        [-0.45, 0.0, 0.31],
        [0.12, 0.39, 0.81],
    ];
    let solid = (corners, vec![[1, 4, 2], [0, 1, 2], [0, 4, 1], [3, 2, 4], [3, 0, 2], [3, 4, 0]]);
    let edges = [[0, 1], [0, 2], [0, 3], [0, 4], [1, 2], [1, 4], [2, 3], [2, 4], [3, 4]];
    for radius in [1e-3, 1e-5, 1e-7] {
        let spec = together(vec![solid.clone()]);
        let kept = spec.parallel(Side::Outside, radius).unwrap().0.solid([0.0; 3], Side::Outside).unwrap();
        for (edge, ends) in edges.into_iter().enumerate() {
            let [a, b] = ends.map(|k: usize| Vector3::from(solid.0[k]));
            for k in 0..200 {
                let aim = a + (b - a) * (0.1 + 0.004 * f64::from(k));
                let (sin, cos) = libm::sincos(f64::from(k));
                let from = aim * 10.0 + Vector3::new(cos, sin, 0.5 * (sin - cos));
                let Some(hit) = kept.first_hit(&Line { point: from, velocity: aim - from }) else { continue };
                let seen = kept.closest(&hit.point);
                // a rounding of the point turns the normal by that over the radius
                let turned = (seen.normal - hit.normal).norm();
                assert!(turned <= 16.0 * f64::EPSILON / radius, "{radius:e} {edge} {k}: {turned:e}");
            }
        }
    }
}

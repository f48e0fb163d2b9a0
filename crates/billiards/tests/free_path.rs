//! Mean free times and paths over the canonical measure, at the first flight and after several collisions.
use billiards::{
    BallLaw, Billiard, Canonical, CanonicalSpatial, Collisions, Ensemble, Free, Orbit, Planar, Spatial, Starts,
    laws::{Disk, RoughBall, Specular},
    observe::{FreePath, Mean},
    run,
};
use collision_laws::laws::NoSlip;
use core::f64::consts::{FRAC_1_SQRT_2, PI};
use geometry::{
    Table, Walls,
    parry::{
        Room,
        Side::{Inside, Outside},
        Solid, SolidSpec,
        parry3d_f64::{
            math::Pose,
            shape::{Ball, Compound, SharedShape},
        },
    },
    tables::{self, SpatialTable},
    walls::ByLane,
};
use serde_json::Value;
use std::path::Path;

/// Orbits per comparison. The standard error of a mean is its own estimate from the sample.
const ORBITS: u64 = 20_000;

/// A sample mean of 20 000 independent flights is normal to good accuracy: 5 standard errors are exceeded with probability
/// 6e-7, so that all 60 comparisons of this file together raise a false alarm with probability 4e-5. The seeds are fixed.
fn close(what: &str, got: Mean, expected: f64) {
    assert_eq!(got.count, ORBITS);
    let errors = (got.mean - expected) / got.standard_error;
    assert!(errors.abs() < 5.0, "{what}: {got:?} for {expected}, {errors} standard errors off");
}

/// The flight after `n` collisions of each orbit: independent of one another, and distributed alike for all n.
fn planar<L: BallLaw<2, 1>>(table: &Table, law: L, n: u64) -> FreePath<2, 1> {
    let billiard = Planar { table: table.clone(), law };
    let canonical = Canonical::new(table, 1.0, 11 + n).unwrap();
    Ensemble::of(ORBITS).run(FreePath::new, |i, paths| {
        let start = canonical.start(i);
        let mut orbit = Orbit::<_, 2, 1>::new(start.position, start.velocity, start.spin, ());
        billiard.run(&mut orbit, &Collisions(n), &mut ());
        paths.follow(&orbit);
        billiard.run(&mut orbit, &Collisions(1), paths);
    })
}

fn spatial<L: BallLaw<3, 3>>(table: &SpatialTable, law: L, n: u64) -> FreePath<3, 3> {
    let canonical = CanonicalSpatial::new(table, 1.0, 11 + n).unwrap();
    let billiard = Spatial { table: table.clone(), law };
    Ensemble::of(ORBITS).run(FreePath::new, |i, paths| {
        let start = canonical.start(i);
        let mut orbit = Orbit::<_, 3, 3>::new(start.position, start.velocity, start.spin, ());
        billiard.run(&mut orbit, &Collisions(n), &mut ());
        paths.follow(&orbit);
        billiard.run(&mut orbit, &Collisions(1), paths);
    })
}

#[test]
fn the_mean_free_time_is_four_areas_over_the_perimeter() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/closed_forms.json");
    let forms: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    // no torus with free corridors: there the variance of the flights is infinite
    let tables = [
        ("square", tables::square(1.0)),
        ("equilateral", tables::equilateral(1.0)),
        ("hexagon", tables::hexagon(1.0)),
        ("isosceles", tables::isosceles(1.0, 1.25)),
        ("circle", tables::circle(1.0)),
        ("stadium", tables::stadium(1.0, 1.0)),
        ("mushroom", tables::mushroom(1.0, 0.5, 0.75)),
        ("sinai_square", tables::sinai(1.0, 0.25)),
    ];
    for (name, table) in tables {
        let table = table.unwrap();
        let number = |key: &str| forms["mean_free"][name][key].as_str().unwrap().parse::<f64>().unwrap();
        let time = number("noslip_or_specular_mean_dt_unit_speed_in_x0x1x2");
        let length = number("mean_planar_path");
        assert!((time - 4.0 * table.area() / table.perimeter()).abs() < 1e-14 * time);
        for (law, n, paths) in [
            ("specular", 5, planar(&table, Specular, 5)),
            ("no-slip", 0, planar(&table, Disk::new(&NoSlip, FRAC_1_SQRT_2).unwrap(), 0)),
            ("no-slip", 5, planar(&table, Disk::new(&NoSlip, FRAC_1_SQRT_2).unwrap(), 5)),
        ] {
            close(&format!("time, {name}, {law}, after {n}"), paths.time(), time);
            close(&format!("length, {name}, {law}, after {n}"), paths.length(), length);
        }
    }
}

#[test]
fn in_space_it_is_fifteen_pi_eighths_of_volume_over_surface() {
    for table in [tables::cuboid([1.0, 2.0, 0.5]).unwrap(), tables::ball(1.5).unwrap()] {
        let (pieces, ratio) = (table.pieces(), table.volume() / table.surface_area());
        let rough = RoughBall::no_slip(0.4_f64.sqrt()).unwrap();
        for (law, paths) in [("specular", spatial(&table, Specular, 3)), ("no-slip", spatial(&table, rough, 3))] {
            close(&format!("time, {pieces:?}, {law}"), paths.time(), 15.0 * PI / 8.0 * ratio);
            close(&format!("length, {pieces:?}, {law}"), paths.length(), 4.0 * ratio);
        }
    }
}

#[test]
fn points_which_have_no_spin_fly_pi_areas_over_the_perimeter_or_four_volumes_over_the_surface() {
    for table in [tables::stadium(1.0, 1.0).unwrap(), tables::sinai(1.0, 0.25).unwrap()] {
        let canonical = Canonical::of_points(&table, 1.0, 5).unwrap();
        let paths = of_points(&canonical, &table.list(0..table.pieces().len()));
        close("in the plane", paths.time(), PI * table.area() / table.perimeter());
    }
    let cuboid = SolidSpec::Cuboid { size: [1.0, 2.0, 0.5], rounding: 0.0 };
    let room = Room::new(vec![cuboid.solid([0.0; 3], Inside).unwrap()]);
    let canonical = CanonicalSpatial::of_points(room.surface().unwrap(), 1.0, 5).unwrap();
    close("in space", of_points(&canonical, &ByLane(&room)).time(), 4.0 / 7.0);
}

/// The flight of a point after three collisions of each orbit.
fn of_points<const N: usize>(starts: &impl Starts<N, 0>, walls: &impl Walls<N>) -> FreePath<N, 0> {
    let billiard = Billiard { walls, law: &Specular };
    Ensemble::of(ORBITS).run(FreePath::new, |i, paths| {
        let mut orbit: Orbit<f64, N, 0, Free, ()> = starts.start(i).orbit(());
        run(&billiard, &mut orbit, &Collisions(3), &mut ());
        paths.follow(&orbit);
        run(&billiard, &mut orbit, &Collisions(1), paths);
    })
}

/// A room with its volume and the area of its boundary.
fn rooms() -> Vec<(&'static str, Room, f64, f64)> {
    use SolidSpec::{Capsule, Cone, ConvexHull, Cuboid, Cylinder, HalfSpace, TriMesh};
    let off = [0.5, -2.0, 3.0];
    let around = |spec: SolidSpec| spec.solid(off, Inside).unwrap();
    let obstacle = |spec: SolidSpec, at: [f64; 3]| spec.solid([0, 1, 2].map(|i| off[i] + at[i]), Outside).unwrap();
    let hall = || around(Cuboid { size: [2.0, 3.0, 2.5], rounding: 0.0 });
    let [hall_volume, hall_area] = [15.0, 2.0 * (6.0 + 7.5 + 5.0)];
    let ball = |r: f64| [4.0 / 3.0 * PI * r * r * r, 4.0 * PI * r * r];
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let faces = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let [corner_volume, corner_area] = [1.0 / 6.0, 1.5 + 0.75_f64.sqrt()];
    let planes = |normals: &[[f64; 3]]| {
        // as far from the middle as the normals are long
        normals.iter().map(|n| obstacle(HalfSpace { normal: *n }, n.map(|x| -x))).collect::<Vec<_>>()
    };
    let axes =
        [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let mut rooms = vec![];
    let mut add =
        |name, solids: Vec<Solid>, volume: f64, area: f64| rooms.push((name, Room::new(solids), volume, area));
    let (r, h) = (0.8, 1.5);
    let can = around(Cylinder { radius: r, height: h, rounding: 0.0 });
    let [v, s] = ball(0.3);
    let inner = obstacle(SolidSpec::Ball { radius: 0.3 }, [0.1, 0.2, -0.1]);
    add("a ball in a can", vec![can, inner], PI * r * r * h - v, 2.0 * PI * r * (r + h) + s);
    let slope = libm::hypot(r, h);
    let tent = around(Cone { radius: r, height: h, rounding: 0.0 });
    add("a cone", vec![tent], PI * r * r * h / 3.0, PI * r * (r + slope));
    let [v, s] = ball(0.25);
    let pill = obstacle(Capsule { from: [-0.4, 0.0, 0.1], to: [0.2, 0.0, 0.1], radius: 0.25 }, [0.0; 3]);
    let [v, s] = [v + PI * 0.0625 * 0.6, s + 0.5 * PI * 0.6];
    add("a capsule in a box", vec![hall(), pill], hall_volume - v, hall_area + s);
    // Steiner's formula, with the integrals of mean curvature π (a + b + c) and π h + π² r
    let steiner = |[v, s, m]: [f64; 3], r: f64| {
        let [ball, sphere] = ball(r);
        [v + s * r + m * r * r + ball, s + 2.0 * m * r + sphere]
    };
    let [v, s] = steiner([0.06, 0.94, 1.4 * PI], 0.2);
    let brick = obstacle(Cuboid { size: [0.3, 0.2, 1.0], rounding: 0.2 }, [0.2, 0.1, 0.0]);
    let [w, t] = steiner([PI * 0.09 * 0.4, 0.6 * PI * 0.7, PI * 0.4 + PI * PI * 0.3], 0.1);
    let drum = obstacle(Cylinder { radius: 0.3, height: 0.4, rounding: 0.1 }, [0.0, -1.0, 0.0]);
    add("a rounded brick and drum in a box", vec![hall(), brick, drum], hall_volume - v - w, hall_area + s + t);
    let wedge = obstacle(ConvexHull { points: corners.clone(), rounding: 0.0 }, [-0.5; 3]);
    add("a tetrahedron in a box", vec![hall(), wedge], hall_volume - corner_volume, hall_area + corner_area);
    let hull_points = corners.clone();
    let mesh = TriMesh { vertices: corners, triangles: faces, margin: 0.0 };
    let crystal = obstacle(mesh.clone(), [-0.5; 3]);
    add("a mesh in a box", vec![hall(), crystal], hall_volume - corner_volume, hall_area + corner_area);
    add("in a mesh", vec![around(mesh.clone())], corner_volume, corner_area);
    // the centre of a ball: around it, with the edges' lengths times the angles between their faces' normals in halves
    let of_ball = |spec: &SolidSpec, side, radius| spec.parallel(side, radius).unwrap().0;
    let curved = 0.5 * (3.0 * PI / 2.0 + 3.0 * 2.0_f64.sqrt() * (PI - libm::acos(1.0 / 3.0_f64.sqrt())));
    let [v, s] = steiner([corner_volume, corner_area, curved], 0.45);
    let thick = obstacle(of_ball(&mesh, Outside, 0.45), [-0.5; 3]);
    add("a ball around a mesh", vec![hall(), thick], hall_volume - v, hall_area + s);
    let thick = obstacle(of_ball(&divided(divided(mesh.clone())), Outside, 0.45), [-0.5; 3]);
    add("a ball around a mesh of small triangles", vec![hall(), thick], hall_volume - v, hall_area + s);
    // three unit cubes around an edge: at a distance r of their base, what is within r of it has the area 3 + 8 r + c r²
    let (r, c) = (0.4, 1.25 * PI - 1.0);
    let v = 3.0 + 8.0 * r + c * r * r + 6.0 * r + 4.0 * PI * r * r + 4.0 / 3.0 * c * r * r * r;
    let s = 8.0 + 2.0 * c * r + 6.0 + 8.0 * PI * r + 4.0 * c * r * r;
    let thick = obstacle(of_ball(&divided(divided(angle_iron())), Outside, r), [0.0; 3]);
    let large = around(Cuboid { size: [4.0; 3], rounding: 0.0 });
    add("a ball around an angle iron", vec![large, thick], 64.0 - v, 96.0 + s);
    // and in it, where the ball that touches all faces has a radius of three volumes over the area
    let left = 1.0 - 0.1 * corner_area / (3.0 * corner_volume);
    let [v, s] = [corner_volume * left * left * left, corner_area * left * left];
    add("a ball in a mesh", vec![around(of_ball(&mesh, Inside, 0.1))], v, s);
    let hull = ConvexHull { points: hull_points, rounding: 0.05 };
    // the rounding is used up first
    let left = 1.0 - 0.05 * corner_area / (3.0 * corner_volume);
    let [v, s] = [corner_volume * left * left * left, corner_area * left * left];
    add("a ball in a rounded hull", vec![around(of_ball(&hull, Inside, 0.1))], v, s);
    let mut crate_ = planes(&axes);
    crate_.push(obstacle(SolidSpec::Ball { radius: 0.5 }, [0.3, 0.0, 0.1]));
    let [v, s] = ball(0.5);
    add("a ball between six planes", crate_, 8.0 - v, 24.0 + s);
    let slopes = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    // a regular tetrahedron with edges of 6√2: √3 from its middle to each face
    add("between four planes", planes(&slopes), 72.0, 72.0 * 3.0_f64.sqrt());
    // what lies within 1 of either of two points at a distance of 1
    let member = |x: f64| (Pose::translation(x, 0.0, 0.0), SharedShape::new(Ball::new(1.0)));
    let two = Compound::new([-0.5, 0.5].map(member).into());
    for side in [Inside, Outside] {
        let pair = Solid::new(&two, &nalgebra::Isometry3::translation(off[0], off[1], off[2]), side).unwrap();
        let [v, s] = [PI * 9.0 / 4.0, 6.0 * PI];
        if side == Inside {
            add("in two balls", vec![pair], v, s);
        } else {
            let large = around(SolidSpec::Ball { radius: 3.0 });
            add("around two balls", vec![large, pair], 36.0 * PI - v, 36.0 * PI + s);
        }
    }
    rooms
}

/// Each triangle in four.
fn divided(mesh: SolidSpec) -> SolidSpec {
    let SolidSpec::TriMesh { mut vertices, triangles, margin } = mesh else { panic!("triangles") };
    let mut smaller = vec![];
    for [a, b, c] in triangles {
        let [x, y, z] = [[b, c], [c, a], [a, b]].map(|[p, q]| {
            vertices.push([0, 1, 2].map(|i| 0.5 * (vertices[p][i] + vertices[q][i])));
            vertices.len() - 1
        });
        smaller.extend([[a, z, y], [z, b, x], [y, x, c], [x, y, z]]);
    }
    SolidSpec::TriMesh { vertices, triangles: smaller, margin }
}

/// The unit cubes at (0, 0), (1, 0), (0, 1) less a half of each coordinate, seen from outside.
fn angle_iron() -> SolidSpec {
    let (mut vertices, mut triangles) = (vec![], vec![]);
    let full = |x: i32, y: i32, z: i32| z == 0 && [[0, 0], [1, 0], [0, 1]].contains(&[x, y]);
    for (x, y) in [(0, 0), (1, 0), (0, 1)] {
        for axis in 0..3 {
            for side in [0, 1] {
                let mut next = [x, y, 0];
                next[axis] += 2 * side - 1;
                if full(next[0], next[1], next[2]) {
                    continue;
                }
                let first = vertices.len();
                for (a, b) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
                    let mut at = [x, y, 0];
                    at[axis] += side;
                    at[(axis + 1) % 3] += a;
                    at[(axis + 2) % 3] += b;
                    vertices.push(at.map(|x| f64::from(x) - 0.5));
                }
                let order = if side == 1 { [0, 1, 2, 3] } else { [3, 2, 1, 0] };
                let [a, b, c, d] = order.map(|k| first + k);
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    SolidSpec::TriMesh { vertices, triangles, margin: 0.0 }
}

#[test]
fn in_any_room_the_mean_flight_is_four_volumes_over_the_surface() {
    for (name, room, volume, area) in rooms() {
        let surface = room.surface().unwrap_or_else(|error| panic!("{name}: {error}"));
        let canonical = CanonicalSpatial::new(&surface, 1.0, 5).unwrap();
        let law = RoughBall::no_slip(0.4_f64.sqrt()).unwrap();
        let billiard = Billiard { walls: &ByLane(&room), law: &law };
        for n in [0, 3] {
            let paths: FreePath<3, 3> = Ensemble::of(ORBITS).run(FreePath::new, |i, paths| {
                let mut orbit = canonical.start(i).orbit::<(), ()>(());
                run(&billiard, &mut orbit, &Collisions(n), &mut ());
                paths.follow(&orbit);
                run(&billiard, &mut orbit, &Collisions(1), paths);
            });
            close(&format!("{name}, after {n}"), paths.length(), 4.0 * volume / area);
        }
    }
}

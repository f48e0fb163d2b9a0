//! Rooms whose container answers in lanes, against their solids asked one by one.

use super::*;
use geometry::parry::{Room, Side, Solid, SolidSpec, parry3d_f64::shape::Cylinder};
use geometry::{Boundary, Vector3};
use nalgebra::Isometry3;
use side_by_side::SameBits;

/// A wall: what it is, where, and on which side the table lies.
pub(super) type Wall = (SolidSpec, [f64; 3], Side);

pub(super) fn room(walls: &[Wall]) -> Room {
    Room::new(walls.iter().map(|(spec, center, side)| spec.solid(*center, *side).unwrap()).collect())
}

fn ball(radius: f64, center: [f64; 3]) -> Wall {
    (SolidSpec::Ball { radius }, center, Side::Outside)
}

fn plane(normal: [f64; 3], through: [f64; 3]) -> Wall {
    (SolidSpec::HalfSpace { normal }, through, Side::Outside)
}

/// So many balls along each axis, one in each cell of the cube between ±4.
fn balls(along: u32, random: &mut Random) -> Vec<Wall> {
    let width = 8.0 / f64::from(along);
    let mut all = vec![];
    for cell in 0..along.pow(3) {
        let at = [cell % along, cell / along % along, cell / along / along];
        let radius = width * random.between(0.05, 0.45);
        let center =
            at.map(|k| -4.0 + width * (f64::from(k) + 0.5) + (0.49 * width - radius) * random.between(-1.0, 1.0));
        all.push(ball(radius, center));
    }
    all
}

/// Containers around the cube between ±4.
fn containers() -> Vec<(&'static str, Vec<Wall>)> {
    let sides = |axis: usize| {
        let (mut normal, mut through) = ([0.0; 3], [0.0; 3]);
        (normal[axis], through[axis]) = (2.0, -4.5);
        [plane(normal, through), plane(normal.map(|n| -n), through.map(|x| -x))]
    };
    let cylinder = SolidSpec::Cylinder { radius: 6.0, height: 9.0, rounding: 0.0 };
    vec![
        ("ball", vec![(SolidSpec::Ball { radius: 7.5 }, [0.125; 3], Side::Inside)]),
        ("cuboid", vec![(SolidSpec::Cuboid { size: [9.0, 10.0, 8.5], rounding: 0.0 }, [0.0; 3], Side::Inside)]),
        ("six planes", [2, 0, 1].into_iter().flat_map(sides).collect()),
        ("slab 1", sides(0).into()),
        ("slab 2", sides(1).into()),
        ("slab 3", sides(2).into()),
        ("cylinder", vec![(cylinder, [0.25, 0.0, 0.125], Side::Inside)]),
    ]
}

/// What may lie within.
fn contents(random: &mut Random) -> Vec<(&'static str, Vec<Wall>)> {
    let drum = SolidSpec::Cylinder { radius: 1.0, height: 2.0, rounding: 0.0 };
    vec![
        ("nothing", vec![]),
        ("a ball", balls(1, random)),
        ("8 balls", balls(2, random)),
        ("216 balls", balls(6, random)),
        ("two balls that meet", vec![ball(1.0, [0.0; 3]), ball(1.0, [1.5, 0.0, 0.0])]),
        ("a ball and a drum", vec![ball(1.0, [2.5, 0.0, 0.0]), (drum, [-1.0, 0.0, 0.5], Side::Outside)]),
    ]
}

/// Paths from places in a room.
pub(super) fn paths_in(room: &Room, count: usize, random: &mut Random) -> Vec<Line<3>> {
    let mut all = vec![];
    while all.len() < count {
        let point = Vector3::from_fn(|_, _| random.between(-4.2, 4.2));
        if room.distance(&point) > 0.0 {
            all.push(Line { point, velocity: random.velocity() });
        }
    }
    all
}

/// What the walls are called.
pub(super) struct Name;
impl WithWalls<3> for Name {
    type Output = String;
    fn run<W: Walls<3>>(self, _: &W) -> String {
        core::any::type_name::<W>().replace("geometry::walls::", "")
    }
}

/// The hit of one path.
pub(super) struct First(pub(super) Line<3>);
impl WithWalls<3> for First {
    type Output = geometry::Hit<3>;
    fn run<W: Walls<3>>(self, walls: &W) -> geometry::Hit<3> {
        walls.hit(&self.0).unwrap()
    }
}

/// Hits of the walls against those of the solids.
pub(super) struct AsSolids<'a> {
    pub(super) name: &'a str,
    pub(super) room: &'a Room,
    pub(super) paths: &'a [Line<3>],
}
impl WithWalls<3> for AsSolids<'_> {
    type Output = ();
    fn run<W: Walls<3>>(self, walls: &W) {
        for path in self.paths {
            let name = format!("{}: {path:?}", self.name);
            let (Some(found), Some(truth)) = (walls.hit(path), self.room.first_hit(path)) else {
                assert!(walls.hit(path).is_none() && self.room.first_hit(path).is_none(), "{name}");
                continue;
            };
            assert_eq!((found.piece, found.corner), (truth.piece, truth.corner), "{name}");
            // rounding of the point over the sine of the angle to the wall
            let size = path.point.amax().max(truth.point.amax()).max(10.0);
            let slack = 1e-15 * size / (truth.normal.dot(&path.velocity) / path.velocity.norm()).abs();
            assert!((found.point - truth.point).norm() <= slack, "{name} {found:?} {truth:?}");
            assert!((found.normal - truth.normal).norm() <= 100.0 * slack, "{name} {found:?} {truth:?}");
        }
    }
}

#[test]
fn walls_of_rooms_answer_as_their_solids_do() {
    let mut random = Random(21);
    for (within, contents) in contents(&mut random) {
        for (around, container) in containers() {
            // numbers follow the order, whichever comes first
            for walls in
                [[container.clone(), contents.clone()].concat(), [contents.clone(), container.clone()].concat()]
            {
                let room = room(&walls);
                let paths = paths_in(&room, 256, &mut random);
                let name = &format!("{within} in {around}");
                room.with_walls(AsSolids { name, room: &room, paths: &paths });
                room.with_walls(SameBits { name, paths: &paths });
            }
        }
    }
}

#[test]
fn a_cylinder_may_lie_askew() {
    let mut random = Random(23);
    for turn in [Vector3::zeros(), Vector3::x(), Vector3::new(0.3, -1.2, 0.7)] {
        let pose = Isometry3::new(Vector3::new(0.125, -0.25, 0.5), turn);
        let cylinder = Solid::new(&Cylinder::new(7.5, 7.25), &pose, Side::Inside).unwrap();
        let balls = balls(3, &mut random);
        let balls = balls.iter().map(|(spec, center, side)| spec.solid(*center, *side).unwrap());
        let room = Room::new(balls.chain([cylinder]).collect());
        let paths = paths_in(&room, 512, &mut random);
        let name = &format!("turned by {turn:?}");
        room.with_walls(AsSolids { name, room: &room, paths: &paths });
        room.with_walls(SameBits { name, paths: &paths });
        assert!(room.with_walls(Name).starts_with("around::Around<vessel::Vessel, "));
    }
}

#[test]
fn paths_along_and_across_a_cylinder_meet_its_ends_its_mantle_and_its_rims() {
    let room =
        room(&[(SolidSpec::Cylinder { radius: 1.0, height: 4.0, rounding: 0.0 }, [0.0, 0.0, 2.0], Side::Inside)]);
    // start, velocity, place, normal unless it is on a rim
    let cases = [
        ([0.5, 0.0, 1.0], [0.0, 0.0, 2.0], [0.5, 0.0, 4.0], Some([0.0, 0.0, -1.0])),
        ([0.5, 0.0, 1.0], [0.0, 0.0, -2.0], [0.5, 0.0, 0.0], Some([0.0, 0.0, 1.0])),
        ([0.5, 0.0, 1.0], [2.0, 0.0, 0.0], [1.0, 0.0, 1.0], Some([-1.0, 0.0, 0.0])),
        ([1.0, 0.0, 1.0], [-2.0, 0.0, 0.0], [-1.0, 0.0, 1.0], Some([1.0, 0.0, 0.0])),
        (
            [0.5, 0.0, 0.0],
            [0.0, 1.0, 0.5],
            [0.5, libm::sqrt(0.75), 0.5 * libm::sqrt(0.75)],
            Some([-0.5, -libm::sqrt(0.75), 0.0]),
        ),
        ([0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [1.0, 0.0, 4.0], None),
    ];
    for (point, velocity, place, normal) in cases {
        let hit = room.with_walls(First(Line { point: point.into(), velocity: velocity.into() }));
        assert!((hit.point - Vector3::from(place)).norm() <= 4.0 * f64::EPSILON, "{hit:?}");
        assert_eq!(hit.corner, normal.is_none(), "{hit:?}");
        if let Some(normal) = normal {
            assert!((hit.normal - Vector3::from(normal)).norm() <= 4.0 * f64::EPSILON, "{hit:?}");
        }
    }
}

#[test]
fn containers_and_balls_that_lie_apart_answer_in_lanes() {
    let mut random = Random(22);
    let forms = [
        "sphere::Sphere<3>",
        "cuboid::Cuboid<3>",
        "cuboid::Cuboid<3>",
        "slab::Slab<3, 0>",
        "slab::Slab<3, 1>",
        "slab::Slab<3, 2>",
        "cylinder::Cylinder",
    ];
    let contents = contents(&mut random);
    for ((around, container), form) in containers().into_iter().zip(forms) {
        for (within, walls) in &contents {
            let found = room(&[container.clone(), walls.clone()].concat()).with_walls(Name);
            let expected = match *within {
                "nothing" => form.into(),
                "two balls that meet" | "a ball and a drum" => "solids::Solids".into(),
                _ => "around::Around<vessel::Vessel, scatterers::Scatterers<3>>".to_owned(),
            };
            assert!(found.starts_with(&expected), "{within} in {around}: {found}");
        }
    }
}

#[test]
fn balls_that_are_tiny_beside_the_flights_reflect_as_well_as_others() {
    // head on, where the place is off by more than the radius
    for radius in [1e-9, 1e-12, 1e-15] {
        let cube = (SolidSpec::Cuboid { size: [2.0; 3], rounding: 0.0 }, [0.0; 3], Side::Inside);
        let room = room(&[cube, ball(radius, [0.1, 0.2, 0.3])]);
        let path = Line { point: Vector3::new(0.1, 0.2, 0.9), velocity: -Vector3::z() };
        let hit = room.with_walls(First(path));
        assert!((hit.normal - Vector3::z()).norm() <= f64::EPSILON, "{radius}: {hit:?}");
        assert!((hit.time - 0.6).abs() <= radius + 4.0 * f64::EPSILON, "{radius}: {hit:?}");
    }
}

#[test]
fn convex_solids_that_are_not_one_within_another_are_asked_one_after_another() {
    let cube = || (SolidSpec::Cuboid { size: [8.0; 3], rounding: 0.0 }, [0.0; 3], Side::Inside);
    // across a wall, touching it, and an oblique plane; planes that bound a channel, and the corner of three
    let across = |x: f64| vec![cube(), ball(1.0, [x, 0.0, 0.0])];
    let planes = [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]];
    let of_planes = |count: usize| planes[..count].iter().map(|n| plane(*n, n.map(|n| -n))).collect();
    let oblique = vec![cube(), plane([1.0, 1.0, 0.0], [-1.0, -1.0, 0.0])];
    for walls in [across(3.5), across(3.0), oblique, of_planes(1), of_planes(3), of_planes(4), of_planes(5)] {
        let found = room(&walls).with_walls(Name);
        assert!(found.starts_with("solids::Solids"), "{found}");
    }
}

//! Particles that creep along a round wall: from it to it every flight is a chord, and they never come closer to rolling, or leave it.
use billiards::geometry::{
    Piece, Table, Vector2, Vector3,
    parry::{Room, Side, SolidSpec},
    shapes::{Circle, Ellipse},
    tables,
    walls::{ByLane, Cylinder, Walls, WithWalls},
};
use billiards::laws::{Disk, RoughBall, Specular};
use billiards::{BallLaw, Billiard, Collisions, Conserved, Orbit, Planar, Spatial, collision_laws::laws::NoSlip, run};

const COLLISIONS: u64 = 20_000;
/// Of speeds about 1; the normal velocity may be off by twenty times its rounding error of 10⁻¹⁶ in each collision.
const NORMAL_SPEED: f64 = 1e-6;
const OFF: f64 = 20.0 * f64::EPSILON * COLLISIONS as f64;

fn kept(before: f64, after: f64, what: &str) {
    assert!((after - before).abs() < OFF && (before - NORMAL_SPEED).abs() < OFF, "{what}: {before:e}, then {after:e}");
}

/// The normal velocity at the wall of the unit circle about the origin.
fn in_the_plane(table: Table, law: impl BallLaw<2, 1>, what: &str) {
    let billiard = Planar { table, law };
    let normal = |orbit: &Orbit<f64, 2, 1, Conserved<f64, 2>>| {
        -Vector2::from(orbit.position).dot(&Vector2::from(orbit.velocity))
            / libm::hypot(orbit.position[0], orbit.position[1])
    };
    let velocity = [-0.6 * NORMAL_SPEED - 0.8, -0.8 * NORMAL_SPEED + 0.6];
    let mut orbit = Orbit::new([0.6, 0.8], velocity, [-0.7], ());
    assert_eq!(billiard.run(&mut orbit, &Collisions(1), &mut ()).collisions, 1, "{what}");
    let before = normal(&orbit);
    assert_eq!(billiard.run(&mut orbit, &Collisions(COLLISIONS), &mut ()).collisions, COLLISIONS, "{what}");
    kept(before, normal(&orbit), what);
}

#[test]
fn along_a_circle_the_normal_velocity_stays() {
    let ring = || {
        let wall = |radius, inside| Box::new(Circle::new(Vector2::zeros(), radius, inside).unwrap()) as Box<dyn Piece>;
        Table::new(vec![wall(1.0, true), wall(0.25, false)]).unwrap()
    };
    let oval = || Table::new(vec![Box::new(Ellipse::new(Vector2::zeros(), [1.0; 2], 0.0, true).unwrap())]).unwrap();
    let no_slip = Disk::new(&NoSlip, 0.4_f64.sqrt()).unwrap();
    for (table, what) in [(ring(), "ring"), (oval(), "ellipse")] {
        in_the_plane(table.clone(), Specular, what);
        in_the_plane(table, no_slip, what);
    }
}

type Ball = Orbit<f64, 3, 3, Conserved<f64, 3>>;

/// The orbit that starts along the wall at (1, 0, 0), and its normal velocity in a ball or, `along` the third axis, a tube.
fn ball() -> Ball {
    Orbit::new([1.0, 0.0, 0.0], [-NORMAL_SPEED, 0.9, 0.3], [0.2, 0.3, -0.4], ())
}

fn normal(orbit: &Ball, tube: bool) -> f64 {
    let mut out = Vector3::from(orbit.position);
    if tube {
        out.z = 0.0;
    }
    -out.dot(&Vector3::from(orbit.velocity)) / out.norm()
}

fn in_space(walls: &impl Walls<3>, law: &impl BallLaw<3, 3>, tube: bool, what: &str) {
    let billiard = Billiard { walls, law };
    let mut orbit = ball();
    assert_eq!(run(&billiard, &mut orbit, &Collisions(1), &mut ()).collisions, 1, "{what}");
    let before = normal(&orbit, tube);
    assert_eq!(run(&billiard, &mut orbit, &Collisions(COLLISIONS), &mut ()).collisions, COLLISIONS, "{what}");
    kept(before, normal(&orbit, tube), what);
}

/// What is done with the fastest walls of a room.
struct InRoom<L> {
    law: L,
    tube: bool,
}

impl<L: BallLaw<3, 3>> WithWalls<3> for InRoom<L> {
    type Output = ();
    fn run<W: Walls<3>>(self, walls: &W) {
        in_space(walls, &self.law, self.tube, "solids in lanes");
    }
}

#[test]
fn along_a_sphere_and_a_cylinder_the_normal_velocity_stays() {
    let no_slip = RoughBall::no_slip(0.4_f64.sqrt()).unwrap();
    let solid = |spec: SolidSpec, center, side| spec.solid(center, side).unwrap();
    let post = || solid(SolidSpec::Ball { radius: 0.25 }, [0.125, 0.0, 0.0], Side::Outside);
    let tube = SolidSpec::Cylinder { radius: 1.0, height: 100.0, rounding: 0.0 };
    for (spec, tube) in [(SolidSpec::Ball { radius: 1.0 }, false), (tube, true)] {
        let room = Room::new(vec![solid(spec, [0.0; 3], Side::Inside), post()]);
        in_space(&ByLane(&room), &no_slip, tube, "exact solids");
        in_space(&ByLane(&room), &Specular, tube, "exact solids");
        room.with_walls(InRoom { law: no_slip, tube });
        room.with_walls(InRoom { law: Specular, tube });
    }
    let cylinder = Cylinder::new(Vector3::zeros(), Vector3::z(), 1.0, 50.0, 0).unwrap();
    in_space(&cylinder, &no_slip, true, "cylinder");
    in_space(&cylinder, &Specular, true, "cylinder");
    let table = Spatial { table: tables::ball(1.0).unwrap(), law: no_slip };
    let mut orbit = ball();
    assert_eq!(table.run(&mut orbit, &Collisions(COLLISIONS), &mut ()).collisions, COLLISIONS);
    kept(NORMAL_SPEED, normal(&orbit, false), "ball");
}

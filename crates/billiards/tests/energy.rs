//! The keeper keeps the energy under any law that does, wherever the orbit goes.
use billiards::collision_laws::laws::{NoSlip, Restitution, Specular};
use billiards::collision_laws::{AnyLaw, CollisionLaw, Contact, Delassus, Roughness, reflect};
use billiards::geometry::shapes::{Circle, Ellipse};
use billiards::geometry::{Table, Vector2, Vector3, WallHit, tables};
use billiards::observe::EnergyDrift;
use billiards::{
    BallLaw, Collisions, Conserved, Orbit, Planar, Spatial, Stop,
    laws::{Custom, Disk, RoughBall},
};
use lanes::Lane;

/// Laws of one type: runs are compiled for each type of law, which takes long.
fn any(law: impl CollisionLaw<2> + Send + Sync + 'static, gamma: f64) -> Custom<AnyLaw<2>, 2> {
    Custom::disk(AnyLaw::new(law), gamma).unwrap()
}

type Disks = Orbit<f64, 2, 1, Conserved<f64, 2>>;
type Balls = Orbit<f64, 3, 3, Conserved<f64, 3>>;

/// The largest drift of the energy in 200 000 collisions in an ellipse, in parts of it.
fn drift(law: impl BallLaw<2, 1>, velocity: [f64; 2], spin: f64) -> f64 {
    let billiard = Planar { table: tables::ellipse([2.0, 1.0]).unwrap(), law };
    let mut orbit: Disks = Orbit::new([0.0, -1.0], velocity, [spin], ());
    let mut drift = EnergyDrift::of(&orbit);
    assert_eq!(billiard.run(&mut orbit, &Collisions(200_000), &mut drift).collisions, 200_000);
    drift.largest()
}

/// Takes from the normal speed at the first wall and gives it back at the third, and a little more: from below, the energy comes near to
/// that of the start again and again.
struct Active;

impl CollisionLaw<2> for Active {
    fn impulse(&self, contact: &Contact<2>, delassus: &Delassus<2>, u: &Vector2<f64>) -> Vector2<f64> {
        let restitution = [0.5, 1.0, 2.0 * (1.0 + 1e-8), 1.0][contact.surface];
        reflect(&Roughness::Smooth, contact, delassus, u) * (0.5 + 0.5 * restitution)
    }
}

#[test]
fn energy_that_a_law_has_taken_once_is_never_given_back_by_the_keeper() {
    let billiard = Planar { table: tables::square(1.0).unwrap(), law: any(Active, 0.7) };
    let (x, v) = ([0.5, 0.3], [0.31, -0.7]);
    let (mut kept, mut free) = (Disks::new(x, v, [0.0], ()), Orbit::<f64, 2, 1>::new(x, v, [0.0], ()));
    billiard.run(&mut kept, &Collisions(100_000), &mut ());
    billiard.run(&mut free, &Collisions(100_000), &mut ());
    assert_eq!((kept.position, kept.velocity), (free.position, free.velocity));
    assert_eq!(kept.restored(), (free.velocity, free.spin));
    let mut beside = (0..3).map(|_| Disks::new(x, v, [0.0], ()));
    billiard.run_side_by_side(&mut beside, &Collisions(100_000), &mut (), &mut |f| assert_eq!(f.orbit, kept));
}

/// Leaves at an angle whose sine is `2 |sin| − 1` of that of arrival, at the speed of arrival: from along the wall to along the
/// normal in a few collisions, and back.
struct Scattering;

impl BallLaw<2, 1> for Scattering {
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], _: &mut [F; 1]) {
        let [n1, n2] = hit.unit_normal();
        let [v1, v2] = *velocity;
        let (square, vt) = (v1 * v1 + v2 * v2, v2 * n1 - v1 * n2);
        let speed = square.sqrt();
        let vt = vt.abs() + vt.abs() - speed;
        let vn = (square - vt * vt).max(speed.same(0.0)).sqrt();
        *velocity = [vn * n1 - vt * n2, vn * n2 + vt * n1];
    }
}

#[test]
fn energy_is_kept_between_a_round_room_and_an_ellipse() {
    // the normals of the room are as long as its radius, those of the ellipse 1 but for rounding
    for radius in [1.5, 3.7] {
        let room = Circle::new(Vector2::zeros(), radius, true).unwrap();
        let ellipse = Ellipse::new(Vector2::new(0.2, 0.0), [0.5, 0.25], 0.0, false).unwrap();
        let table = Table::new(vec![Box::new(room), Box::new(ellipse)]).unwrap();
        let billiard = Planar { table, law: Disk::new(&NoSlip, 0.5).unwrap() };
        let mut orbit: Disks = Orbit::new([-1.0, 0.1], [0.6, 0.8], [0.3], ());
        let mut drift = EnergyDrift::of(&orbit);
        assert_eq!(billiard.run(&mut orbit, &Collisions(10_000), &mut drift).collisions, 10_000);
        assert!(drift.largest() < 1e-14, "{radius}: {:e}", drift.largest());
    }
}

#[test]
fn energy_is_kept_under_a_law_that_does_not_reverse_the_normal_component() {
    let drift = drift(Scattering, [0.3, 0.9], 0.5);
    assert!(drift < 2e-14, "{drift:e}");
}

/// No-slip as somebody would write it who knows nothing of frames.
struct Written {
    is_strict: bool,
}

impl BallLaw<2, 1> for Written {
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        BallLaw::collide(&Custom::disk(NoSlip, 0.6).unwrap(), hit, velocity, spin);
    }
    fn is_strict(&self) -> bool {
        self.is_strict
    }
}

#[test]
fn energy_is_kept_in_a_circle_under_a_law_of_ones_own() {
    for is_strict in [false, true] {
        // nothing but the normal component has energy, or a little beside
        for (velocity, spin) in [([1.0, 0.0], 0.0), ([0.8, 1e-4], 1e-4), ([0.6, 0.3], 0.2)] {
            let billiard = Planar { table: tables::circle(1.0).unwrap(), law: Written { is_strict } };
            let mut orbit: Disks = Orbit::new([0.1, 0.0], velocity, [spin], ());
            let mut drift = EnergyDrift::of(&orbit);
            assert_eq!(billiard.run(&mut orbit, &Collisions(20_000), &mut drift).collisions, 20_000);
            assert!(drift.largest() < 2e-14, "{velocity:?} {is_strict}: {:e}", drift.largest());
        }
    }
}

#[test]
fn a_spin_that_the_law_leaves_alone_is_told_as_it_was_given() {
    let tables = [tables::circle(1.0), tables::strip(1.0), tables::stadium(1.0, 1.0), tables::ellipse([2.0, 1.0])];
    for (table, spin) in tables.into_iter().flat_map(|table| [0.1, 0.3, -5.0, 1e9].map(|spin| (table.clone(), spin))) {
        let billiard = Planar { table: table.unwrap(), law: Specular };
        let mut orbit: Disks = Orbit::new([0.1, 0.2], [0.6, 0.37], [spin], ());
        let energy = 0.6 * 0.6 + 0.37 * 0.37 + spin * spin;
        for n in 0..2000 {
            billiard.run(&mut orbit, &Collisions(1), &mut ());
            let ([v1, v2], told) = orbit.restored();
            assert_eq!((orbit.spin, told), ([spin], [spin]), "{n}");
            assert!((v1 * v1 + v2 * v2 + spin * spin - energy).abs() <= 3.0 * f64::EPSILON * energy, "{n}: {spin}");
        }
    }
    let room = Spatial { table: tables::ball(1.0).unwrap(), law: Specular };
    let mut orbit: Balls = Orbit::new([0.1, 0.2, 0.3], [0.6, 0.37, 0.2], [0.3, 0.4, -0.7], ());
    for n in 0..2000 {
        room.run(&mut orbit, &Collisions(1), &mut ());
        assert_eq!(orbit.restored().1, [0.3, 0.4, -0.7], "{n}");
    }
}

#[test]
fn energy_is_kept_where_every_collision_grazes() {
    // the square of the normal component is below a thousandth of the energy
    let drift = drift(Disk::new(&Specular, 0.5).unwrap(), [1.0, 0.001], 0.1);
    assert!(drift < 1e-14, "{drift:e}");
}

#[test]
fn energy_wanders_little_where_nearly_all_of_it_is_spin() {
    // what the spin rounds is a thousand times what so slow a velocity can make up for at once
    let drift = drift(Disk::new(&NoSlip, 1e-3).unwrap(), [1e-3, 1e-4], 1.0);
    assert!(drift < 1e-12, "{drift:e}");
}

#[test]
fn energy_that_a_law_takes_is_not_given_back() {
    for (normal, tangential) in [(0.9, -1.0), (0.9, 0.25), (1.0 - 1e-6, -1.0)] {
        let law = Disk::new(&Restitution::new(normal, tangential).unwrap(), 1.0).unwrap();
        for table in [tables::strip(1.0).unwrap(), tables::circle(1.0).unwrap(), tables::ellipse([2.0, 1.0]).unwrap()] {
            let billiard = Planar { table, law };
            let (x, v, w) = ([0.1, 0.2], [0.3, 0.9], [0.5]);
            let (mut kept, mut free) = (Disks::new(x, v, w, ()), Orbit::<f64, 2, 1>::new(x, v, w, ()));
            for _ in 0..3 {
                let made = billiard.run(&mut kept, &Collisions(20), &mut ()).collisions;
                assert_eq!(billiard.run(&mut free, &Collisions(20), &mut ()).collisions, made);
                assert_eq!(kept.restored(), (kept.velocity, kept.spin), "{normal}, {tangential}");
                let [[a, b], [c, d]] = [kept.velocity, free.velocity];
                let off = [a - c, b - d, kept.spin[0] - free.spin[0]];
                // along a curve the keeper takes back what the length of normals rounds
                assert!(off.iter().all(|off| off.abs() < 1e-8), "{normal}, {tangential}: {off:?}");
            }
        }
    }
}

#[test]
fn a_particle_that_has_lost_its_speed_has_not_escaped() {
    let law = any(Restitution::new(0.5, 0.0).unwrap(), 1.0);
    for table in [tables::square(1.0).unwrap(), tables::circle(2.0).unwrap(), tables::ellipse([2.0, 1.0]).unwrap()] {
        let billiard = Planar { table, law: law.clone() };
        let start = || Disks::new([0.5, 0.25], [0.6, 0.8], [0.0], ());
        let ended = billiard.run(&mut start(), &Collisions(100_000), &mut ());
        assert!(matches!(ended.stop, Stop::Stalled | Stop::Grazing | Stop::Corner), "{ended:?}");
        let mut stops = vec![];
        let starts = &mut core::iter::repeat_n(start(), 3);
        billiard.run_side_by_side(starts, &Collisions(100_000), &mut (), &mut |finished| stops.push(finished.outcome));
        assert_eq!(stops, [ended; 3]);
    }
}

/// What the energy lacks was handed to the normal component, so that flights took other times: after 100 collisions places were off
/// twenty times as far as now.
#[test]
fn between_parallel_planes_nothing_along_the_normal_is_ever_rounded() {
    let slab = Spatial { table: tables::slab(1.0).unwrap(), law: RoughBall::no_slip(0.4_f64.sqrt()).unwrap() };
    let start = |k: u32| {
        let turn = f64::from(k);
        let (velocity, spin) = ([0.3 * libm::cos(turn), 0.4, -0.11], [0.1, libm::sin(turn), 0.7]);
        Balls::new([0.0, 0.0, 0.5], velocity, spin, ())
    };
    let square = |o: &Balls| o.velocity.iter().chain(&o.spin).map(|x| x * x).sum::<f64>();
    let check = |orbit: &Balls, k: u32| {
        assert_eq!((orbit.velocity[2].abs(), orbit.spin[2]), (0.11, 0.7), "{k}");
        assert!((square(orbit) / square(&start(k)) - 1.0).abs() < 2e-15, "{k} {orbit:?}");
    };
    let alone: Vec<_> = (0..50)
        .map(|k| {
            let mut orbit = start(k);
            slab.run(&mut orbit, &Collisions(20_000), &mut ());
            check(&orbit, k);
            (orbit.position, orbit.velocity, orbit.spin)
        })
        .collect();
    slab.run_side_by_side(&mut (0..50).map(start), &Collisions(20_000), &mut (), &mut |finished| {
        let Orbit { position, velocity, spin, .. } = finished.orbit;
        assert_eq!((position, velocity, spin), alone[usize::try_from(finished.index).unwrap()]);
    });
}

/// The coefficients were rounded to the nearest: the tangential velocity and the spin lost up to 4·10⁻¹⁷ of the energy in each collision,
/// always in the same direction, and the keeper gave it to the normal velocity.
#[test]
fn in_a_ball_the_normal_velocity_hardly_drifts_without_slip() {
    for gamma in [0.3, 0.5, 0.6] {
        let ball = Spatial { table: tables::ball(1.0).unwrap(), law: RoughBall::no_slip(gamma).unwrap() };
        let mut orbit = Balls::new([0.1, 0.2, -0.3], [0.9, 0.2, 0.7], [0.3, -0.2, 0.4], ());
        let normal_speed = |orbit: &Balls| {
            let [x, v] = [orbit.position, orbit.velocity].map(Vector3::from);
            (x.dot(&v) / x.norm()).abs()
        };
        ball.run(&mut orbit, &Collisions(1), &mut ());
        let start = normal_speed(&orbit);
        ball.run(&mut orbit, &Collisions(1_000_000), &mut ());
        let drift = (normal_speed(&orbit) / start - 1.0) / 1e6;
        assert!(drift.abs() < 2.5e-17, "{gamma} {drift:e}");
    }
}

/// A strict law but for rounding, always outwards, of what it should reverse.
struct Outwards;

impl BallLaw<3, 3> for Outwards {
    fn collide<F: Lane>(&self, hit: &WallHit<F, 3>, velocity: &mut [F; 3], _: &mut [F; 3]) {
        for (v, n) in velocity.iter_mut().zip(hit.normal) {
            *v = *v - *v * n * n * (2.0 + 2.0 * f64::EPSILON);
        }
    }
    fn is_strict(&self) -> bool {
        true
    }
}

#[test]
fn energy_is_kept_between_parallel_planes_where_nearly_none_of_it_is_along_them() {
    let slab = Spatial { table: tables::slab(1.0).unwrap(), law: Outwards };
    for along in [0.0, 1e-9, 0.01, 0.5] {
        let mut orbit = Balls::new([0.0, 0.0, 0.5], [along, 0.0, 1.0], [0.0; 3], ());
        slab.run(&mut orbit, &Collisions(20_000), &mut ());
        let energy = orbit.velocity.iter().map(|v| v * v).sum::<f64>();
        // what seventeen collisions add, four units each
        assert!((energy / (1.0 + along * along) - 1.0).abs() < 68.0 * f64::EPSILON, "{along} {energy}");
    }
}

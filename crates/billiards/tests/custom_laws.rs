//! Laws of `collision_laws`, run through `Custom`: they agree with the fast ways of the same laws, and keep the measure
//! exactly where they are linear in the velocity.
use billiards::{
    BallLaw, Clock, Collision, Collisions, Conserved, Error, Orbit, Outcome, Planar, ReducedState, Spatial, Stop, Time,
    laws::{Custom, Disk, PerPiece, RoughBall, Specular},
    observe::Watch,
};
use collision_laws::{
    AnyLaw, CollisionLaw, Contact, Delassus, Fixed, Pair, Roughness, TangentVector,
    bodies::Ball,
    check::{
        controls::{Chasing, ReversiblyChasing, slip_angle},
        jacobian_determinant,
    },
    laws::{self, Field, NoSlip, PerSurface, RoughPlane},
};
use core::ops::ControlFlow;
use geometry::{WallHit, tables};
use lanes::{Kernel, Lane, Mask};
use nalgebra::{DVector, SVector, Vector2, Vector3};
use proptest::prelude::*;

/// Laws of one type: runs are compiled for each type of law, which takes long.
fn disk(law: impl CollisionLaw<2> + Send + Sync + 'static, gamma: f64) -> Custom<AnyLaw<2>, 2> {
    Custom::disk(AnyLaw::new(law), gamma).unwrap()
}
/// The same in space.
fn ball(law: impl CollisionLaw<3> + Send + Sync + 'static, gamma: f64) -> Custom<AnyLaw<3>, 3> {
    Custom::ball(AnyLaw::new(law), gamma).unwrap()
}

/// A law of 2D or 3D, applied to a hit with a normal of any length.
fn collide<const N: usize, const S: usize>(
    law: &impl BallLaw<N, S>,
    normal: [f64; N],
    v: [f64; N],
    w: [f64; S],
) -> ([f64; N], [f64; S]) {
    let (mut velocity, mut spin) = (v, w);
    law.collide(&hit(normal, [0.0; N]), &mut velocity, &mut spin);
    (velocity, spin)
}

fn hit<const N: usize>(normal: [f64; N], point: [f64; N]) -> WallHit<f64, N> {
    let square: f64 = normal.iter().map(|n| n * n).sum();
    WallHit { time: 1.0, point, normal, inverse: 1.0 / square.sqrt(), piece: 0.0, corner: false }
}

/// Two laws do the same, within sixteen roundings: each path is about a dozen operations long. Sizes are those of the speed
/// and, where it is not taken for infinite, of the velocity of the rim, 1/γ times larger.
fn agree<const N: usize, const S: usize>(
    (a, b): (&impl BallLaw<N, S>, &impl BallLaw<N, S>),
    gamma: f64,
    normal: [f64; N],
    v: [f64; N],
    w: [f64; S],
) {
    let ((va, wa), (vb, wb)) = (collide(a, normal, v, w), collide(b, normal, v, w));
    let speed = v.iter().chain(&w).map(|x| x * x).sum::<f64>().sqrt();
    let size = if gamma < 1e-8 { speed } else { speed * (1.0 + 1.0 / gamma) };
    for (x, y) in va.iter().chain(&wa).zip(vb.iter().chain(&wb)) {
        assert!((x - y).abs() <= 16.0 * f64::EPSILON * size, "{va:?} {wa:?} against {vb:?} {wb:?}");
    }
}

fn vector<const N: usize>() -> impl Strategy<Value = [f64; N]> {
    proptest::array::uniform::<_, N>(-1.0..1.0_f64)
}
fn normal<const N: usize>() -> impl Strategy<Value = [f64; N]> {
    vector().prop_filter("long enough to have a direction", |n| n.iter().map(|x| x * x).sum::<f64>() > 0.01)
}
/// From a point to a hoop, on both sides of where the limit begins.
fn gamma() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), Just(1e-300), 1e-17..1e-8_f64, (-20.0..0.0_f64).prop_map(libm::exp2), 0.1..1.0_f64]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_law_agrees_with_the_fast_disk(n in normal(), v in vector(), w in vector(), g in gamma(), m in 0.1..9.0_f64) {
        let custom = Custom::disk(NoSlip, g).unwrap().with_mass(m).unwrap().with_radius(0.3).unwrap();
        agree((&custom, &Disk::new(&NoSlip, g).unwrap()), g, n, v, w);
        let custom = Custom::disk(Specular, g).unwrap().with_mass(m).unwrap();
        agree((&custom, &Specular), g, n, v, w);
        let lossy = laws::Restitution::new(0.7, 0.2).unwrap();
        agree((&Custom::disk(lossy, g).unwrap(), &Disk::new(&lossy, g).unwrap()), g, n, v, w);
        agree((&Custom::disk(lossy, g).unwrap().with_scaled_slip(), &Disk::new(&lossy, g).unwrap()), 0.0, n, v, w);
    }

    #[test]
    fn with_scaled_slip_strict_laws_and_restitution_are_right_to_rounding_for_any_gamma(
        n in normal(), v in vector(), w in vector(), g in gamma(),
    ) {
        // a size that does not grow with 1/γ
        let scaled = |law| Custom::ball(law, g).unwrap().with_scaled_slip();
        agree((&scaled(NoSlip), &RoughBall::no_slip(g).unwrap()), 0.0, n, v, w);
        let elastic = laws::Restitution::new(1.0, 1.0).unwrap();
        let elastic = Custom::ball(elastic, g).unwrap().with_scaled_slip();
        agree((&elastic, &RoughBall::no_slip(g).unwrap()), 0.0, n, v, w);
    }

    #[test]
    fn any_law_agrees_with_the_fast_ball(n in normal(), v in vector(), w in vector(), d in normal(), g in gamma()) {
        agree((&Custom::ball(NoSlip, g).unwrap(), &RoughBall::no_slip(g).unwrap()), g, n, v, w);
        agree((&Custom::ball(Specular, g).unwrap(), &Specular), g, n, v, w);
        // a direction near the normal is determined by its tangential part only within rounding over the length of that
        let cross = Vector3::from(n).normalize().cross(&Vector3::from(d).normalize()).norm();
        prop_assume!(cross > 0.25);
        let custom = Custom::ball(RoughPlane::new(&[d.into()]).unwrap(), g).unwrap();
        agree((&custom, &RoughBall::along(g, d.into()).unwrap()), g, n, v, w);
    }
}

/// The same through bodies and twists, for a law that is not linear.
#[test]
fn a_law_does_to_a_ball_what_it_does_to_a_pair_of_bodies() {
    let (gamma, normal) = (0.4_f64.sqrt(), Vector3::new(2.0, -1.0, 0.5).normalize());
    let ball = Ball::<3>::with_gamma_squared(3.0, 0.25, 0.4).unwrap();
    let contact = Contact::new(Vector3::zeros(), normal, 0).unwrap();
    let pair = Pair::new(contact, (ball, normal * -0.25), (Fixed, Vector3::zeros()));
    let (v, w) = (Vector3::new(-0.3, 0.4, 0.1), Vector3::new(0.2, -0.5, 0.7));
    let (after, ()) = pair.collide(&Chasing, &(ball.with_scaled_spin(v, w), ())).velocities;
    let custom = Custom::ball(Chasing, gamma).unwrap().with_mass(3.0).unwrap().with_radius(0.25).unwrap();
    let (velocity, spin) = collide(&custom, normal.into(), v.into(), w.into());
    let error =
        (after.linear - Vector3::from(velocity)).amax().max((ball.scaled_spin(&after) - Vector3::from(spin)).amax());
    assert!(error < 16.0 * f64::EPSILON, "{error:e}");
}

#[test]
fn a_law_sees_the_contact_point_and_the_piece() {
    struct Witness;
    impl CollisionLaw<2> for Witness {
        fn impulse(&self, c: &Contact<2>, _: &Delassus<2>, _: &SVector<f64, 2>) -> SVector<f64, 2> {
            // the centre is at (3, 4), one radius off the wall along the normal
            assert_eq!((c.point, c.surface), (Vector2::new(3.0, 3.75), 5));
            SVector::zeros()
        }
    }
    let law = Custom::disk(Witness, 1.0).unwrap().with_radius(0.25).unwrap();
    let at = WallHit { piece: 5.0, ..hit([0.0, 2.0], [3.0, 4.0]) };
    law.collide(&at, &mut [1.0, -1.0], &mut [0.5]);
}

#[test]
fn a_law_per_surface_is_a_law_per_piece() {
    let gamma = 0.5_f64.sqrt();
    let table = tables::square(1.0).unwrap();
    let mixed = PerSurface::new(Roughness::Smooth).with(1, Roughness::Rough);
    let field = Field::new(move |c: &Contact<2>| *mixed.on(c.surface));
    let custom = Planar { table: table.clone(), law: disk(field, gamma) };
    let (smooth, rough) = (Disk::new(&Specular, gamma).unwrap(), Disk::new(&NoSlip, gamma).unwrap());
    let per_piece = Planar { table, law: PerPiece::new(smooth, [rough, smooth]) };
    let start = || Orbit::<_, 2, 1>::new([0.3, 0.4], [0.6, 0.5], [0.2], ());
    let (mut a, mut b) = (start(), start());
    custom.run(&mut a, &Collisions(50), &mut ());
    per_piece.run(&mut b, &Collisions(50), &mut ());
    // fifty collisions with flat walls: errors grow linearly, about n roundings each
    let close = |x: f64, y: f64| (x - y).abs() < 16.0 * 50.0 * f64::EPSILON;
    assert!(a.position.iter().chain(&a.velocity).zip(b.position.iter().chain(&b.velocity)).all(|(x, y)| close(*x, *y)));
}

/// A law that did not tell that it is strict had its normal velocity rounded, off by 4·10⁻¹¹ after 10⁶ collisions.
#[test]
fn a_strict_law_of_ones_own_rounds_nothing_along_the_normal_between_parallel_planes() {
    let grooved = Field::new(|c: &Contact<3>| Roughness::of_span(&c.normal, &[Vector3::new(c.point.y, 1.0, 0.0)]));
    let slab = Spatial { table: tables::slab(1.0).unwrap(), law: ball(grooved, 0.4_f64.sqrt()) };
    let (v, w) = ([0.3, 0.4, -0.11], [0.1, 0.2, 0.7]);
    let mut orbit = Orbit::<_, 3, 3, Conserved<f64, 3>>::new([0.0, 0.0, 0.5], v, w, ());
    slab.run(&mut orbit, &Collisions(10_001), &mut ());
    assert_eq!(orbit.velocity[2], 0.11);
    let square = |v: [f64; 3], w: [f64; 3]| v.iter().chain(&w).map(|x| x * x).sum::<f64>();
    assert!((square(orbit.velocity, orbit.spin) / square(v, w) - 1.0).abs() < 4e-15);
}

#[test]
fn lanes_have_the_bits_of_single_balls() {
    struct Compare;
    impl Kernel for Compare {
        type Output = usize;
        fn run<F: Lane>(self, zero: F) -> usize {
            let law = Custom::ball(Chasing, 0.4_f64.sqrt()).unwrap();
            let value = |seed: f64, k: usize| libm::sin(seed + 1.7 * k as f64);
            let vector = |seed: f64, k: usize| [0.0, 1.0, 2.0].map(|i| value(seed + 10.0 * i, k));
            let hits = |k: usize| hit(vector(1.0, k), vector(2.0, k));
            let lane = |i: usize, f: &dyn Fn(usize) -> [f64; 3]| zero.each(|k| f(k)[i]);
            let vectors = |f: &dyn Fn(usize) -> [f64; 3]| [0, 1, 2].map(|i| lane(i, f));
            let wide = WallHit {
                time: zero,
                point: vectors(&|k| hits(k).point),
                normal: vectors(&|k| hits(k).normal),
                inverse: zero.each(|k| hits(k).inverse),
                piece: zero,
                corner: zero.never(),
            };
            let (mut v, mut w) = (vectors(&|k| vector(3.0, k)), vectors(&|k| vector(4.0, k)));
            law.collide(&wide, &mut v, &mut w);
            for k in 0..F::LANES {
                let (mut one, mut spin) = (vector(3.0, k), vector(4.0, k));
                law.collide(&hits(k), &mut one, &mut spin);
                assert_eq!((v.map(|v| v.lane(k)), w.map(|w| w.lane(k))), (one, spin));
            }
            F::LANES
        }
    }
    assert!(lanes::dispatch(Compare) >= 1);
}

#[test]
fn impossible_balls_are_refused() {
    for gamma in [-0.5, f64::NAN, f64::INFINITY] {
        assert!(matches!(Custom::disk(NoSlip, gamma), Err(Error::Ball { quantity: "γ", .. })), "{gamma}");
    }
    let disk = Custom::disk(NoSlip, 0.5).unwrap();
    assert!(matches!(disk.with_mass(0.0), Err(Error::Ball { quantity: "mass", .. })));
    for mass in [-1.0, 5e-324, 1e-308, 1e308, f64::INFINITY, f64::NAN] {
        assert!(matches!(disk.with_mass(mass), Err(Error::Ball { quantity: "mass", .. })), "{mass:e}");
    }
    assert!(matches!(disk.with_radius(-1.0), Err(Error::Ball { quantity: "radius", .. })));
}

/// No-slip depends on γ alone: every mass that is not refused leads to the same velocities.
#[test]
fn the_mass_of_a_ball_does_not_matter_to_a_strict_law() {
    let normal = [0.6, 0.8];
    let (v, w) = ([0.3, -0.9], [0.4]);
    let of = |mass| collide(&Custom::disk(NoSlip, 0.7).unwrap().with_mass(mass).unwrap(), normal, v, w);
    let (expected, spin) = of(1.0);
    for mass in [1e-300, 1e-150, 3.0, 1e150, 1e300] {
        let (velocity, turned) = of(mass);
        let error = (0..2).map(|i| (velocity[i] - expected[i]).abs()).fold((turned[0] - spin[0]).abs(), f64::max);
        assert!(error < 4.0 * f64::EPSILON, "{mass:e}: {error:e}");
    }
}

/// A contact that turns half of the slip around, `e = ½`, and hands the energy lost to the normal velocity.
///
/// Energy and momenta are conserved and the impulse acts at the contact, but the law is not linear in the velocity.
#[derive(Clone, Copy)]
struct Generous;

impl CollisionLaw<2> for Generous {
    fn impulse(&self, contact: &Contact<2>, delassus: &Delassus<2>, u: &SVector<f64, 2>) -> SVector<f64, 2> {
        let Delassus::Isotropic { normal, tangent } = *delassus else { unreachable!("a ball") };
        let nu = contact.normal.as_ref();
        let (un, ut) = (nu.dot(u), contact.tangential(u));
        let paid = 0.75 * ut.norm_squared() * normal / tangent;
        nu * (((un * un + paid).sqrt() - un) / normal) - ut * (1.5 / tangent)
    }
}

/// `|det D(s, v₀, vₜ)|` of the billiard map at unit speed.
fn planar_determinant(billiard: &Planar<Custom<AnyLaw<2>, 2>>, at: [f64; 3]) -> f64 {
    let step = |x: &DVector<f64>| {
        let state = ReducedState { piece: 0, s: x[0], v0: x[1], vt: x[2], speed: 1.0 };
        let next = billiard.map(&state).unwrap();
        DVector::from_vec(vec![next.s, next.v0, next.vt])
    };
    jacobian_determinant(step, &DVector::from_row_slice(&at), 1.0 / 512.0).abs()
}

// difference quotients of order 6: at these states the maps vary on scales of a third and more, so that the step of 1/512
// leaves (1/170)⁶ ≈ 4e-14 of the seventh derivatives, and rounding 1e-13
const TOLERANCE: f64 = 1e-9;

#[test]
fn a_law_that_pays_the_slip_it_takes_halves_the_measure() {
    let law = disk(Generous, 0.5_f64.sqrt());
    let before = (1.0_f64, 0.3);
    let (v, w) = collide(&law, [0.0, 1.0], [0.4, -before.0], [before.1]);
    let energy = v[0] * v[0] + v[1] * v[1] + w[0] * w[0];
    assert!((energy - (0.16 + 1.0 + 0.09)).abs() < 1e-15);
    // from the floor of the square to its ceiling, from one place of the circle to another
    for table in [tables::square(1.0).unwrap(), tables::circle(1.0).unwrap()] {
        let generous = planar_determinant(&Planar { table: table.clone(), law: law.clone() }, [0.4, 0.3, -0.1]);
        assert!((generous - 0.5).abs() < TOLERANCE, "{generous}");
        let strict = planar_determinant(&Planar { table, law: disk(NoSlip, 0.7) }, [0.4, 0.3, -0.1]);
        assert!((strict - 1.0).abs() < TOLERANCE, "{strict}");
    }
}

const AT: [f64; 7] = [0.1, -0.2, 0.25, 0.15, -0.2, 0.3, 0.1];
const BALL_GAMMA: f64 = 0.632_455_532_033_675_9; // √(2/5)

/// `|det D(x₁, x₂, v₁, v₂, W)|` from the floor of the unit slab to its ceiling, at unit speed.
fn slab_determinant(law: impl CollisionLaw<3> + Send + Sync + 'static) -> f64 {
    let slab = Spatial { table: tables::slab(1.0).unwrap(), law: ball(law, BALL_GAMMA) };
    let step = |x: &DVector<f64>| {
        let up = (1.0 - x.rows(2, 5).norm_squared()).sqrt();
        let mut orbit = Orbit::<_, 3, 3>::new([x[0], x[1], 0.0], [x[2], x[3], up], [x[4], x[5], x[6]], ());
        assert_eq!(slab.run(&mut orbit, &Collisions(1), &mut ()).stop, Stop::Finished);
        let (p, v, w) = (orbit.position, orbit.velocity, orbit.spin);
        DVector::from_vec(vec![p[0], p[1], v[0], v[1], w[0], w[1], w[2]])
    };
    jacobian_determinant(step, &DVector::from_row_slice(&AT), 1.0 / 512.0).abs()
}

#[test]
fn strict_laws_in_space_keep_the_measure_and_laws_that_chase_the_velocity_do_not() {
    let near = |determinant: f64, expected: f64| {
        assert!((determinant - expected).abs() < TOLERANCE, "{determinant} for {expected}");
    };
    near(slab_determinant(Specular), 1.0);
    near(slab_determinant(NoSlip), 1.0);
    near(slab_determinant(RoughPlane::new(&[Vector3::new(1.0, 2.0, -3.0)]).unwrap()), 1.0);
    near(slab_determinant(laws::Grooved::new(|c: &Contact<3>| Vector3::new(c.point.y, 1.0, 0.0))), 1.0);
    near(slab_determinant(Chasing), 0.3);

    let ceiling = Contact::new(Vector3::z(), -Vector3::z(), 1).unwrap();
    let ball = Ball::<3>::with_gamma_squared(1.0, 1.0, 0.4).unwrap();
    let up = (1.0 - AT[2..].iter().map(|x| x * x).sum::<f64>()).sqrt();
    let spin = Vector3::new(AT[4], AT[5], AT[6]);
    let slip = ball.with_scaled_spin(Vector3::new(AT[2], AT[3], up), spin).at(&Vector3::z());
    let expected = ReversiblyChasing::measure_ratio(slip_angle(&ceiling, &slip));
    assert!((expected - 1.0).abs() > 0.05, "a state at which the control shows: {expected}");
    near(slab_determinant(ReversiblyChasing), expected);
}

#[test]
fn a_random_law_runs_and_conserves_energy() {
    let law = ball(laws::RandomGrassmannian::new(1, 7).unwrap(), BALL_GAMMA);
    let cube = Spatial { table: tables::cuboid([1.0; 3]).unwrap(), law };
    let mut orbit = Orbit::<_, 3, 3>::new([0.3, 0.4, 0.5], [0.6, -0.3, 0.2], [0.1, 0.2, 0.3], ());
    let mut worst = 0.0_f64;
    let mut watch = Watch::new(|c: &Collision<'_, 3, 3, _, _>| {
        let energy: f64 = c.orbit.velocity.iter().chain(&c.orbit.spin).map(|x| x * x).sum();
        worst = worst.max((energy - 0.63).abs());
        ControlFlow::Continue(())
    });
    assert_eq!(cube.run(&mut orbit, &Collisions(1000), &mut watch).stop, Stop::Finished);
    // no keeper: at most a few roundings per collision
    assert!(worst < 1000.0 * 4.0 * f64::EPSILON, "{worst:e}");
}

/// Sends what arrives fast to the right away with a velocity that is none.
struct Broken {
    leaves: f64,
    is_strict: bool,
}

impl BallLaw<2, 1> for Broken {
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        let is_wrong = velocity[0].same(0.5).lt(velocity[0]);
        Specular.collide(hit, velocity, spin);
        for v in velocity {
            *v = is_wrong.select(v.same(self.leaves), *v);
        }
    }
    fn is_strict(&self) -> bool {
        self.is_strict
    }
}

#[test]
fn a_law_that_returns_no_velocity_is_told_as_what_it_is() {
    for (leaves, is_strict) in [f64::NAN, f64::INFINITY, -f64::INFINITY].map(|v| [(v, false), (v, true)]).concat() {
        for table in [
            tables::circle(1.0),
            tables::square(1.0),
            tables::stadium(1.0, 1.0),
            tables::sinai(1.0, 0.25),
            tables::ellipse([2.0, 1.0]),
            tables::flower(5, 1.0, 1.0),
        ] {
            let billiard = Planar { table: table.unwrap(), law: Broken { leaves, is_strict } };
            let start = || Orbit::<f64, 2, 1, Conserved<f64, 2>>::new([0.4, 0.1], [0.8, 0.6], [0.0], ());
            let mut orbit = start();
            let alone = billiard.run(&mut orbit, &Collisions(1000), &mut ());
            assert_eq!((alone.stop, alone.stop.name()), (Stop::NotFinite, "not finite"), "{alone:?} {leaves}");
            let mut starts = (0..3).map(|_| start());
            billiard.run_side_by_side(&mut starts, &Collisions(1000), &mut (), &mut |f| assert_eq!(f.outcome, alone));
            let mut timed =
                Orbit::<f64, 2, 1, Conserved<f64, 2>, Clock>::new([0.4, 0.1], [0.8, 0.6], [0.0], Clock::new(0.0));
            assert_eq!(billiard.run(&mut timed, &Time(1e3), &mut ()), alone);
        }
    }
}

/// Lets everything through, or throws it back faster than it came.
#[derive(Clone, Copy)]
struct Wrong {
    restitution: f64,
}

impl CollisionLaw<2> for Wrong {
    fn impulse(&self, contact: &Contact<2>, delassus: &Delassus<2>, u: &Vector2<f64>) -> Vector2<f64> {
        collision_laws::reflect(&Roughness::Smooth, contact, delassus, u) * (0.5 + 0.5 * self.restitution)
    }
}

/// How so many orbits end, alone and in lanes.
fn ends(table: &geometry::Table, law: &Custom<AnyLaw<2>, 2>, orbits: u32, most: u64) -> Vec<(Stop, u64)> {
    let billiard = Planar { table: table.clone(), law: law.clone() };
    let start = |k: u32| {
        let angle = 0.3 + 1.7 * f64::from(k);
        Orbit::<f64, 2, 1>::new([0.1, 0.325], [libm::cos(angle), libm::sin(angle)], [0.3], ())
    };
    let mut ended = vec![];
    for k in 0..orbits {
        let Outcome { stop, collisions } = billiard.run(&mut start(k), &Collisions(most), &mut ());
        ended.push((stop, collisions));
    }
    let mut starts = (0..orbits).map(start);
    billiard.run_side_by_side(&mut starts, &Collisions(most), &mut (), &mut |f| {
        let alone = ended[usize::try_from(f.index).unwrap()];
        assert_eq!((f.outcome.stop, f.outcome.collisions), alone, "{}", f.index);
    });
    ended
}

#[test]
fn a_law_that_does_not_throw_the_ball_back_is_told_as_that() {
    for table in [
        tables::circle(1.0),
        tables::square(1.0),
        tables::stadium(1.0, 1.0),
        tables::strip(1.0),
        tables::moon(1.0, 0.8, 1.0),
        tables::sinai_torus(0.25, 1.0),
    ] {
        for restitution in [-1.0, -0.5] {
            let law = disk(Wrong { restitution }, 0.7);
            let ended = ends(&table.clone().unwrap(), &law, 16, 1000);
            assert!(ended.iter().all(|end| *end == (Stop::IntoWall, 1)), "{ended:?}");
        }
    }
    assert_eq!(Stop::IntoWall.name(), "into the wall");
}

#[test]
fn a_ball_that_a_law_of_ones_own_brings_to_rest_across_a_round_wall_grazes() {
    for restitution in [0.0, 0.5] {
        let law = laws::Restitution::new(restitution, -1.0).unwrap();
        let own = ends(&tables::circle(1.0).unwrap(), &disk(law, 0.7), 300, 5000);
        assert!(own.iter().all(|(stop, collisions)| *stop == Stop::Grazing && *collisions < 100), "{own:?}");
    }
}

#[test]
fn a_ball_that_a_law_makes_faster_and_faster_ends_where_squares_of_speeds_do() {
    for table in [tables::circle(1.0), tables::square(1.0), tables::moon(1.0, 0.8, 0.9)] {
        let billiard = Planar { table: table.unwrap(), law: disk(Wrong { restitution: 1.5 }, 0.7) };
        for k in 0..60 {
            let angle = 0.3 + 1.7 * f64::from(k);
            let mut orbit = Orbit::<f64, 2, 1>::new([0.1, 0.325], [libm::cos(angle), libm::sin(angle)], [0.3], ());
            let outcome = billiard.run(&mut orbit, &Collisions(100_000), &mut ());
            assert!(
                matches!(outcome.stop, Stop::NotFinite | Stop::Corner | Stop::Grazing),
                "{k}: {outcome:?} {orbit:?}"
            );
        }
    }
}

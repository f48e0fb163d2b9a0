//! The axioms, for every body, every law, N = 2 … 5, all k, with random inertia and mass ratios up to 1e±12.
//!
//! Defects are compared with `ROUNDING · κ`, κ the condition number of the Delassus operator: solving for the impulse loses that
//! many digits and no more, whatever the masses, because every defect is relative in the kinetic-energy metric.

use approx::assert_abs_diff_eq;
use collision_laws::{
    Body, CollisionLaw, Contact, Delassus, Error, Fixed, Pair, Roughness, StrictLaw, TangentVector, Twist,
    bodies::{Ball, Inertia, Planar, Point, RigidBody, Spatial},
    check::{self, Axiom, Samples},
    classify,
    laws::{Field, Grooved, NoSlip, PerSurface, RandomGrassmannian, Restitution, RoughPlane, Specular},
    reflect,
};
use nalgebra::{DMatrix, Matrix3, SMatrix, SVector};
use proptest::{
    collection::vec,
    prelude::*,
    test_runner::{RngAlgorithm, TestRng, TestRunner},
};

/// 400 units in the last place: up to 30 coordinates, each the sum of up to 30 products, in six steps.
const ROUNDING: f64 = 400.0 * f64::EPSILON;

/// A difference quotient with step 1/512 multiplies rounding by 512.
const DIFFERENCES: f64 = 512.0 * ROUNDING;

/// Two bodies of any inertia at a contact, with k rough directions.
#[derive(Debug, Clone)]
struct Scene<const N: usize> {
    contact: Contact<N>,
    bodies: [RigidBody<N>; 2],
    arms: [SVector<f64, N>; 2],
    rough: Vec<SVector<f64, N>>,
    samples: Samples,
}

fn any_vector<const N: usize>() -> impl Strategy<Value = SVector<f64, N>> + Clone {
    vec(-1.0..1.0_f64, N)
        .prop_map(SVector::from_iterator)
        .prop_filter("a direction", |x: &SVector<f64, N>| x.norm() > 0.1)
}

/// A body whose principal second moments span two decades; mass from 1e-6 to 1e6, so that two masses differ by up to 1e12.
fn any_body<const N: usize>() -> impl Strategy<Value = RigidBody<N>> {
    (-6.0..6.0_f64, vec(-1.0..1.0_f64, N), vec(any_vector::<N>(), N)).prop_map(|(mass, decades, columns)| {
        let frame = SMatrix::<f64, N, N>::from_columns(&columns);
        let moments = SVector::<f64, N>::from_iterator(decades.iter().map(|d| libm::pow(10.0, *d)));
        // a random symmetric positive matrix: the frame need not be orthogonal
        let s = frame * SMatrix::from_diagonal(&moments) * frame.transpose() + SMatrix::identity() * 0.01;
        RigidBody::new(libm::pow(10.0, mass), Inertia::SecondMoments((s + s.transpose()) * 0.5)).expect("a body")
    })
}

fn scene<const N: usize>() -> impl Strategy<Value = Scene<N>> {
    let points = (any_vector(), any_vector(), any_vector(), any_vector());
    let rough = vec(any_vector(), 0..N);
    (points, any_body(), any_body(), rough, any::<u64>()).prop_filter_map(
        "independent rough directions",
        |(points, first, second, rough, seed): (_, _, _, Vec<SVector<f64, N>>, _)| {
            let (point, normal, r1, r2) = points;
            let contact = Contact::new(point, normal, 1).expect("a normal");
            // nearly dependent directions are not forbidden, but say little about the law
            let unit = DMatrix::from_fn(N, rough.len() + 1, |i, j| {
                if j == 0 { contact.normal[i] } else { rough[j - 1][i] / rough[j - 1].norm() }
            });
            let spread = unit.singular_values().min();
            (spread > 0.05).then_some(Scene {
                contact,
                bodies: [first, second],
                arms: [r1, r2],
                rough,
                samples: Samples { count: 2, seed },
            })
        },
    )
}

fn condition<A: Body<N>, B: Body<N>, const N: usize>(pair: &Pair<A, B, N>) -> f64 {
    let k = pair.delassus().to_matrix(&pair.contact.normal);
    let values = DMatrix::from_fn(N, N, |i, j| k[(i, j)]).symmetric_eigenvalues();
    values.max() / values.min()
}

/// The law is strict for this pair, and the classification recovers it from its matrix.
fn is_strict<A: Body<N>, B: Body<N>, L: CollisionLaw<N>, const N: usize>(
    pair: &Pair<A, B, N>,
    law: &L,
    roughness: &Roughness<N>,
    samples: Samples,
) {
    assert!(law.is_strict());
    let condition = condition(pair);
    let report = check::law(pair, law, samples);
    for (axiom, defect) in report.broken(0.0) {
        let tolerance = if axiom == Axiom::Measure { DIFFERENCES } else { ROUNDING };
        assert!(defect <= tolerance * condition, "{axiom}: {defect:e}, condition number {condition:e}");
    }
    let free = pair.first.degrees_of_freedom() > 0 && pair.second.degrees_of_freedom() > 0;
    assert_eq!(report.defect(Axiom::LinearMomentum).is_some(), free, "momentum is vacuous exactly against a wall");

    let space = pair.tangent_space();
    let found = classify(&space, &pair.collision_map(law), ROUNDING * condition).expect("a square matrix");
    let found = found.strict.unwrap_or_else(|| panic!("not strict:\n{}", found.report));
    assert_eq!(found.rank(), roughness.rank());
    let gap = found.projector(&pair.contact.normal) - roughness.projector(&pair.contact.normal);
    assert!(gap.norm() <= ROUNDING * condition, "another plane, by {:e}", gap.norm());
}

fn every_law_of_a_scene_is_strict<const N: usize>(scene: &Scene<N>) {
    let ([first, second], [r1, r2]) = (&scene.bodies, scene.arms);
    let free = Pair::new(scene.contact, (first, r1), (second, r2));
    let rough = RoughPlane::new(&scene.rough).expect("rough directions");
    let roughness = rough.at(&scene.contact).expect("independent directions");
    is_strict(&free, &rough, &roughness, scene.samples);
    is_strict(&free, &Specular, &Roughness::Smooth, scene.samples);
    is_strict(&free, &NoSlip, &Roughness::Rough, scene.samples);
    // a wall on either side
    is_strict(&Pair::new(scene.contact, (first, r1), (Fixed, r2)), &rough, &roughness, scene.samples);
    is_strict(&Pair::new(scene.contact, (Fixed, r1), (second, r2)), &rough, &roughness, scene.samples);
    // round bodies and points, among themselves and with others
    let (n, radius) = (scene.contact.normal.into_inner(), r1.norm());
    let ball = Ball::uniform(first.mass(), radius).expect("a ball");
    let shell = Ball::shell(second.mass(), radius).expect("a ball");
    let point = Point::new(second.mass()).expect("a point");
    is_strict(&Pair::new(scene.contact, (ball, -n * radius), (shell, n * radius)), &rough, &roughness, scene.samples);
    is_strict(&Pair::new(scene.contact, (ball, -n * radius), (second, r2)), &rough, &roughness, scene.samples);
    is_strict(&Pair::new(scene.contact, (first, r1), (point, SVector::zeros())), &rough, &roughness, scene.samples);
    is_strict(
        &Pair::new(scene.contact, (point, SVector::zeros()), (point, SVector::zeros())),
        &rough,
        &roughness,
        scene.samples,
    );
    is_strict(&Pair::new(scene.contact, (Some(first), r1), (None::<Ball<N>>, r2)), &rough, &roughness, scene.samples);
}

fn every_body_of_a_scene_keeps_its_contract<const N: usize>(scene: &Scene<N>) {
    let arm = scene.arms[0];
    let ball = Ball::with_gamma_squared(scene.bodies[1].mass(), arm.norm(), arm[0].abs() + 0.01).expect("a ball");
    let on_the_sphere = Contact::new(scene.contact.point, -arm, 0).expect("a normal");
    for report in [
        check::body(&scene.bodies[0], &scene.contact, &arm, scene.samples),
        check::body(&ball, &on_the_sphere, &arm, scene.samples),
        check::body(&Point::new(3.0).expect("a point"), &scene.contact, &SVector::zeros(), scene.samples),
    ] {
        // no system is solved here but that for the sampled velocities, whose metric has a condition number of a few thousand
        assert!(report.worst() <= 1e3 * ROUNDING, "{report:?}");
    }
}

fn fields_are_strict<const N: usize>(scene: &Scene<N>, k: usize) {
    let pair = Pair::new(scene.contact, (scene.bodies[0], scene.arms[0]), (scene.bodies[1], scene.arms[1]));
    let field = Field::new(|contact: &Contact<N>| Roughness::of_span(&contact.normal, &scene.rough));
    let roughness = Roughness::of_span(&scene.contact.normal, &scene.rough);
    is_strict(&pair, &field, &roughness, scene.samples);
    let grooved = Grooved::new(|contact: &Contact<N>| contact.point);
    is_strict(&pair, &grooved, &Roughness::of_span(&scene.contact.normal, &[scene.contact.point]), scene.samples);
    let random = RandomGrassmannian::<N>::new(k, scene.samples.seed).expect("k ≤ N−1");
    let drawn = random.roughness(&scene.contact);
    assert_eq!(drawn.rank(), k);
    let by_surface =
        PerSurface::new(RandomGrassmannian::new(0, 0).expect("rank 0")).with(scene.contact.surface, random);
    is_strict(&pair, &by_surface, &drawn, scene.samples);
}

/// Restitution conserves momentum at the contact, and loses what its documentation says; the classification blames energy.
fn restitution_loses_energy<const N: usize>(scene: &Scene<N>, normal: f64, tangential: f64) {
    let law = Restitution::new(normal, tangential).expect("coefficients in range");
    let pair = Pair::new(scene.contact, (scene.bodies[0], scene.arms[0]), (scene.bodies[1], scene.arms[1]));
    let bound = ROUNDING * condition(&pair);
    let report = check::law(&pair, &law, scene.samples);
    for axiom in [Axiom::LinearMomentum, Axiom::AngularMomentum, Axiom::ContactImpulse, Axiom::Linearity] {
        assert!(report.defect(axiom).is_some_and(|defect| defect <= bound), "{axiom}\n{report}");
    }
    let expected_ratio = normal * normal * libm::pow(tangential.abs(), (N - 1) as f64);
    assert!(
        (report.measure_ratio() - expected_ratio).abs() <= 512.0 * bound,
        "{} for {expected_ratio}",
        report.measure_ratio()
    );

    let broken = classify(&pair.tangent_space(), &pair.collision_map(&law), bound).expect("a square matrix");
    // the eigenvalues of C on C_q are −eₙ once and −eₜ N−1 times
    let squares = [1.0 - normal * normal, 1.0 - tangential * tangential];
    let expected = (squares[0] * squares[0] + (N - 1) as f64 * squares[1] * squares[1]).sqrt();
    let energy = broken.report.defect(Axiom::Energy).expect("energy is never vacuous");
    assert_abs_diff_eq!(energy, expected, epsilon = bound);
    assert_eq!(broken.strict.is_some(), expected <= bound);
    assert_eq!(CollisionLaw::<N>::is_strict(&law), expected == 0.0);
}

/// Tries `claim` on 64 random inputs, always the same.
fn for_all<S: Strategy>(inputs: S, claim: impl Fn(S::Value)) {
    let config = ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() };
    let random = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let result = TestRunner::new_with_rng(config, random).run(&inputs, |input| {
        claim(input);
        Ok(())
    });
    if let Err(failure) = result {
        panic!("{failure}");
    }
}

/// Smooth, but says other things of itself.
#[derive(Debug)]
struct Liar(&'static str);

impl<const N: usize> CollisionLaw<N> for Liar {
    fn impulse(&self, contact: &Contact<N>, delassus: &Delassus<N>, u: &SVector<f64, N>) -> SVector<f64, N> {
        let roughness = if self.0 == "pushes" { Roughness::Rough } else { Roughness::Smooth };
        reflect(&roughness, contact, delassus, u)
    }
    fn reflections(&self, _: &Contact<N>) -> Vec<(f64, Roughness<N>)> {
        match self.0 {
            "weight" => vec![(0.5, Roughness::Smooth)],
            "reflections" => vec![(1.0, Roughness::Rough)],
            "nothing" => vec![],
            _ => vec![(1.0, if self.0 == "pushes" { Roughness::Rough } else { Roughness::Smooth })],
        }
    }
    fn pushes(&self, _: &Contact<N>) -> Roughness<N> {
        Roughness::Smooth
    }
}

#[test]
fn a_law_that_tells_of_another_impulse_than_its_own_is_found() {
    let contact = Contact::new(SVector::from([0.0, 0.0]), SVector::from([0.0, 1.0]), 0).unwrap();
    let body = Ball::<2>::uniform(1.0, 1.0).unwrap();
    let pair = Pair::new(contact, (body, SVector::from([0.0, -1.0])), (Fixed, SVector::zeros()));
    for (lie, least) in [("weight", 0.4), ("reflections", 0.1), ("pushes", 0.1)] {
        let report = check::law(&pair, &Liar(lie), Samples::default());
        assert_eq!(report.broken(check::TOLERANCE).next(), None, "{lie}");
        assert!(report.told() > Some(least) && !report.is_strict(check::TOLERANCE), "{lie}: {:?}", report.told());
        // the table shows why
        let shown = format!("{:.1e}", report.told().unwrap());
        assert!(report.to_string().lines().last().unwrap().ends_with(&shown), "{report}");
    }
    for truth in ["all", "nothing"] {
        let report = check::law(&pair, &Liar(truth), Samples::default());
        assert!(report.told() < Some(1e-15) && report.is_strict(check::TOLERANCE), "{truth}: {:?}", report.told());
    }
    for factor in [0.5, 1.0] {
        let lossy = check::law(&pair, &Restitution::new(factor, 0.25).unwrap(), Samples::default());
        assert!(lossy.told() < Some(1e-15));
    }
}

#[test]
fn every_law_is_strict_for_all_bodies_and_all_k() {
    for_all(scene::<2>(), |scene| every_law_of_a_scene_is_strict(&scene));
    for_all(scene::<3>(), |scene| every_law_of_a_scene_is_strict(&scene));
    for_all(scene::<4>(), |scene| every_law_of_a_scene_is_strict(&scene));
    for_all(scene::<5>(), |scene| every_law_of_a_scene_is_strict(&scene));
}

#[test]
fn every_body_keeps_its_contract() {
    for_all(scene::<2>(), |scene| every_body_of_a_scene_keeps_its_contract(&scene));
    for_all(scene::<3>(), |scene| every_body_of_a_scene_keeps_its_contract(&scene));
    for_all(scene::<4>(), |scene| every_body_of_a_scene_keeps_its_contract(&scene));
    for_all(scene::<5>(), |scene| every_body_of_a_scene_keeps_its_contract(&scene));
}

#[test]
fn fields_over_the_boundary_are_strict() {
    for_all((scene::<2>(), 0..2_usize), |(scene, k)| fields_are_strict(&scene, k));
    for_all((scene::<3>(), 0..3_usize), |(scene, k)| fields_are_strict(&scene, k));
    for_all((scene::<4>(), 0..4_usize), |(scene, k)| fields_are_strict(&scene, k));
    for_all((scene::<5>(), 0..5_usize), |(scene, k)| fields_are_strict(&scene, k));
}

#[test]
fn restitution_conserves_momentum_and_loses_energy() {
    let coefficients = || (0.1..0.9_f64, -0.9..0.9_f64);
    for_all((scene::<2>(), coefficients()), |(scene, (n, t))| restitution_loses_energy(&scene, n, t));
    for_all((scene::<3>(), coefficients()), |(scene, (n, t))| restitution_loses_energy(&scene, n, t));
    for_all((scene::<4>(), coefficients()), |(scene, (n, t))| restitution_loses_energy(&scene, n, t));
    for_all((scene::<5>(), coefficients()), |(scene, (n, t))| restitution_loses_energy(&scene, n, t));
}

fn inertia_tensor(body: &[f64; 6]) -> Matrix3<f64> {
    let b = Matrix3::new(body[0], body[1], body[2], 0.0, body[3], body[4], 0.0, 0.0, body[5]);
    b * b.transpose() + Matrix3::identity() * 0.01
}

/// The same scene in other units: lengths in 2ᵃ, masses in 4ᵇ, times in 2ᶜ. A slim body's radius of gyration is √`slim` of its size.
fn units_do_not_matter<const N: usize>(scene: &Scene<N>, [a, b, c]: [i32; 3], slim: f64) {
    let (length, mass, speed) = (libm::ldexp(1.0, a), libm::ldexp(1.0, 2 * b), libm::ldexp(1.0, a - c));
    let law = RoughPlane::new(&scene.rough).expect("rough directions");
    let v = Twist::from_coordinates(&scene.arms[1].iter().cycle().copied().take(N * (N + 1) / 2).collect::<Vec<_>>());
    let s = SMatrix::<f64, N, N>::from_fn(|i, j| if i == j { 1.0 } else { 0.1 + 0.05 * (i + j) as f64 }) * slim;
    let collide = |length: f64, mass: f64, speed: f64| {
        let body = RigidBody::<N>::new(mass, Inertia::SecondMoments(s * length * length)).expect("a body");
        let other = Ball::uniform(3.0 * mass, length).expect("a ball");
        let n = scene.contact.normal.into_inner() * length;
        let pair = Pair::new(scene.contact, (body, scene.arms[0] * length), (other, n));
        let spin = v.spin() * (speed / length);
        let before = (Twist::new(v.linear * speed, spin).expect("a spin"), Twist::translation(n * (speed / length)));
        pair.collide(&law, &before)
    };
    let (one, scaled) = (collide(1.0, 1.0, 1.0), collide(length, mass, speed));
    assert_eq!(one.impulse * (mass * speed), scaled.impulse);
    assert_eq!(one.velocities.0.linear * speed, scaled.velocities.0.linear);
    assert_eq!(one.velocities.1.spin() * (speed / length), *scaled.velocities.1.spin());
}

#[test]
fn units_do_not_matter_to_the_last_bit() {
    let exponents = || prop::array::uniform3(-150..150_i32);
    for_all((scene::<2>(), exponents()), |(scene, exponents)| units_do_not_matter(&scene, exponents, 1.0));
    for_all((scene::<3>(), exponents()), |(scene, exponents)| units_do_not_matter(&scene, exponents, 1.0));
    for_all((scene::<4>(), exponents()), |(scene, exponents)| units_do_not_matter(&scene, exponents, 1.0));
}

#[test]
fn units_do_not_matter_to_a_slim_body_either() {
    // its impulse is found in several steps; here the square of one is out of range
    for far in [[-100, -180, 250], [100, 180, -250]] {
        for_all(scene::<2>(), |scene| units_do_not_matter(&scene, far, 1e-9));
        for_all(scene::<3>(), |scene| units_do_not_matter(&scene, far, 1e-9));
        for_all(scene::<4>(), |scene| units_do_not_matter(&scene, far, 1e-9));
    }
}

#[test]
fn planar_bodies_keep_their_contract() {
    for_all((-6.0..6.0_f64, -2.0..2.0_f64, scene::<2>()), |(mass, moment, scene)| {
        let mass = libm::pow(10.0, mass);
        let body = Planar::new(mass, mass * libm::pow(10.0, moment)).expect("a body");
        let report = check::body(&body, &scene.contact, &scene.arms[0], scene.samples);
        assert!(report.worst() <= 1e3 * ROUNDING, "{report:?}");
    });
}

#[test]
fn spatial_bodies_are_rigid_bodies_in_three_dimensions() {
    let entries = prop::array::uniform6(-1.0..1.0_f64);
    for_all((-6.0..6.0_f64, entries, scene::<3>()), |(mass, entries, scene)| {
        let mass = libm::pow(10.0, mass);
        let tensor = inertia_tensor(&entries) * mass; // its condition number is at most 600
        let spatial = Spatial::new(mass, tensor).expect("a body");
        let rigid = RigidBody::<3>::new(mass, Inertia::Tensor(tensor)).expect("a body");
        let report = check::body(&spatial, &scene.contact, &scene.arms[0], scene.samples);
        assert!(report.worst() <= 1e3 * ROUNDING, "{report:?}");
        let normal = &scene.contact.normal;
        let a = spatial.delassus(&scene.arms[0], normal).to_matrix(normal);
        let b = rigid.delassus(&scene.arms[0], normal).to_matrix(normal);
        assert!((a - b).norm() <= 1e3 * f64::EPSILON * a.norm());
    });
}

#[test]
fn only_the_span_of_the_rough_directions_with_the_normal_counts() {
    for_all((scene::<4>(), -5.0..5.0_f64), |(scene, shift)| {
        let normal = &scene.contact.normal;
        let mixed: Vec<_> = scene.rough.iter().rev().map(|t| (t + normal.into_inner() * shift) * 1e100).collect();
        let at =
            |rough: &[SVector<f64, 4>]| Roughness::spanned_by(normal, rough).expect("independent").projector(normal);
        // the shift cancels fifty-fold at worst, and the directions are up to 20 times closer to dependent than to orthogonal
        assert!((at(&mixed) - at(&scene.rough)).norm() <= 1e4 * f64::EPSILON);
    });
}

#[test]
fn nothing_to_collide_is_an_error() {
    for_all(scene::<3>(), |scene| {
        let (body, arm) = (scene.bodies[0], scene.arms[0]);
        let v = Twist::translation(scene.contact.normal.into_inner());
        let pair = Pair::new(scene.contact, (Some(body), arm), (None::<Point>, SVector::zeros()));
        let receding = pair.try_collide(&NoSlip, &(v, SVector::zeros()));
        assert!(matches!(receding, Err(Error::NotApproaching { normal_velocity }) if normal_velocity > 0.9));
        let walls = Pair::new(scene.contact, (None::<RigidBody<3>>, arm), (Fixed, arm));
        assert_eq!(walls.try_collide(&NoSlip, &(v, ())).err(), Some(Error::BothFixed));
    });
}

/// The rough direction of a floor, wherever the contact is.
struct OfTheFloor;

impl StrictLaw<3> for OfTheFloor {
    fn roughness(&self, _: &Contact<3>) -> Roughness<3> {
        Roughness::spanned_by(&nalgebra::Vector3::z_axis(), &[nalgebra::Vector3::x()]).unwrap()
    }
}

#[test]
fn the_rough_direction_of_a_floor_breaks_axioms_on_a_wall() {
    for (normal, is_strict) in [([0.0, 0.0, 1.0], true), ([0.6, 0.0, 0.8], false)] {
        let contact = Contact::new(SVector::zeros(), normal.into(), 0).unwrap();
        let ball = Ball::<3>::uniform(1.0, 1.0).unwrap();
        let pair = Pair::new(contact, (ball, -contact.normal.into_inner()), (Fixed, SVector::zeros()));
        let report = check::law(&pair, &OfTheFloor, Samples::default());
        assert_eq!(report.is_strict(check::TOLERANCE), is_strict, "{report:?}");
    }
}

#[test]
fn no_axiom_is_broken_by_what_nothing_moves() {
    let contact = Contact::new(SVector::zeros(), [0.0, 0.0, 1.0].into(), 0).unwrap();
    let walls = Pair::new(contact, (Fixed, SVector::zeros()), (Fixed, SVector::zeros()));
    assert_eq!(check::law(&walls, &NoSlip, Samples::default()).broken(check::TOLERANCE).count(), 0);
}

/// A map that breaks some axioms breaks these and no others: the identity, which goes on through the wall, and the half-turn of all velocities,
/// which keeps no momentum and pushes everywhere.
#[test]
fn each_map_that_is_no_collision_breaks_the_axioms_that_it_should() {
    for_all(scene::<3>(), |scene| {
        let pair = Pair::new(scene.contact, (scene.bodies[0], scene.arms[0]), (scene.bodies[1], scene.arms[1]));
        let space = pair.tangent_space();
        let broken = |factor: f64| -> Vec<Axiom> {
            check::map(&space, |v| v * factor, scene.samples).broken(check::TOLERANCE).map(|(axiom, _)| axiom).collect()
        };
        assert_eq!(broken(1.0), [Axiom::OutgoingToIngoing]);
        assert_eq!(broken(-1.0), [Axiom::LinearMomentum, Axiom::AngularMomentum, Axiom::ContactImpulse]);
    });
}

#[test]
fn what_recedes_came_from_what_approached() {
    for_all(scene::<3>(), |scene| {
        let pair = Pair::new(scene.contact, (scene.bodies[0], scene.arms[0]), (scene.bodies[1], scene.arms[1]));
        let space = pair.tangent_space();
        let along = space.from_unit(space.normal());
        for v in [&along, &-&along] {
            assert_abs_diff_eq!(check::axioms::outgoing_to_ingoing(&space, v, v), 1.0, epsilon = ROUNDING);
            assert_eq!(check::axioms::outgoing_to_ingoing(&space, v, &-v), 0.0);
        }
    });
}

#[test]
fn the_impulse_that_is_told_makes_the_velocities_that_are_told() {
    for slim in [1.0, 1e-6, 1e-12] {
        let body = RigidBody::<2>::new(1.0, Inertia::Moment(slim)).expect("a body");
        let contact = Contact::new(SVector::zeros(), [0.6, 0.8].into(), 0).expect("a normal");
        let pair = Pair::new(contact, (body, [-0.7, 0.3].into()), (Fixed, SVector::zeros()));
        let before = (Twist::planar([-1.3, -0.8].into(), 0.7), ());
        let collision = pair.collide(&NoSlip, &before);
        let made = pair.apply_impulse(&collision.impulse, &before).0;
        // the spin is the impulse over the moment of inertia, the velocity no larger than the impulse
        approx::assert_abs_diff_eq!(made.linear, collision.velocities.0.linear, epsilon = ROUNDING);
        let spins = [made, collision.velocities.0].map(|v| v.spin_coordinates()[0]);
        assert_abs_diff_eq!(spins[0] * slim, spins[1] * slim, epsilon = ROUNDING);
    }
}

#[test]
fn a_body_tells_the_mass_and_the_moment_of_inertia_it_was_made_of() {
    let planar = Planar::new(2.5, 0.75).expect("a body");
    assert_eq!([planar.mass(), planar.moment()], [2.5, 0.75]);
    let ball = Ball::<3>::with_gamma_squared(3.0, 2.0, 0.25).expect("a ball");
    assert_eq!([ball.mass(), ball.moment()], [3.0, 3.0]); // m γ² R²
    let spatial = Spatial::new(2.5, Matrix3::identity()).expect("a body");
    let rigid = RigidBody::<2>::new(2.5, Inertia::Moment(1.0)).expect("a body");
    assert_eq!([spatial.mass(), rigid.mass(), Point::new(2.5).expect("a point").mass()], [2.5; 3]);
}

#[test]
fn a_body_held_fixed_is_not_free_and_one_that_is_not_is_what_it_is() {
    let ball = Ball::<3>::uniform(1.0, 1.0).expect("a ball");
    assert!(ball.is_free() && Some(ball).is_free());
    assert!(!Body::<3>::is_free(&None::<Ball<3>>) && !Body::<3>::is_free(&Fixed));
}

#[test]
fn a_point_has_no_spin_so_that_a_rigid_motion_moves_it_by_the_velocity_at_its_centre() {
    let (arm, a) = (SVector::<f64, 2>::new(0.5, 2.0), SVector::<f64, 2>::new(3.0, -1.0));
    let spin = SMatrix::<f64, 2, 2>::new(0.0, -2.0, 2.0, 0.0);
    let centre = SVector::of_rigid_motion(&arm, &a, &spin);
    assert_eq!(centre, Twist::of_rigid_motion(&arm, &a, &spin).linear);
    assert_eq!(centre + spin * arm, a);
}

/// The factors of half a turn of the velocities of a disk with γ ≫ 1: `cos β = −1`, `sin β = 2/γ`.
#[test]
fn no_slip_has_a_map_for_disks_of_which_the_square_of_gamma_is_out_of_range() {
    use collision_laws::DiskLaw;
    let map = NoSlip.disk_map(1e200);
    assert_eq!([map.spin_spin, map.tangent_tangent, map.normal], [1.0, -1.0, -1.0]);
    assert_eq!([map.spin_tangent, map.tangent_spin], [2e-200, 2e-200]);
}

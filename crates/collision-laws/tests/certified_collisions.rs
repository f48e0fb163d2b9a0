//! Every certified single collision of `tests/data/collisions`, dimensions 2 to 5, all k.

use collision_laws::{
    Contact, Error, Pair, TangentVector, Twist,
    bodies::{Ball, Inertia, Planar, RigidBody, Spatial},
    check,
    laws::{NoSlip, Restitution, RoughPlane, Specular},
};
use nalgebra::{SMatrix, SVector};
use serde_json::Value;
use std::path::Path;

/// The files give 45 digits; the numbers in a case are of order 1 to 2²⁰, so 1e-12 leaves a factor of 1e3 over rounding.
const TOLERANCE: f64 = 1e-12;

type Free<const N: usize> = Option<RigidBody<N>>;

fn number(value: &Value) -> f64 {
    let text = value.get("dec").unwrap_or(value);
    text.as_str().expect("a decimal string").parse().expect("a number")
}

fn vector<const N: usize>(value: &Value) -> SVector<f64, N> {
    SVector::from_fn(|i, _| number(&value[i]))
}

fn matrix<const N: usize>(value: &Value) -> SMatrix<f64, N, N> {
    SMatrix::from_fn(|i, j| number(&value[i][j]))
}

fn body<const N: usize>(value: &Value) -> Free<N> {
    if value["mass"] == "inf" {
        return None;
    }
    let inertia = match N {
        2 => Inertia::Moment(number(&value["inertia"])),
        3 => Inertia::Tensor(matrix(&value["inertia"])),
        _ => Inertia::SecondMoments(matrix(&value["S"])),
    };
    Some(RigidBody::new(number(&value["mass"]), inertia).expect("a body"))
}

fn twist<const N: usize>(value: &Value) -> Twist<N> {
    let v = vector(&value["v"]);
    match N {
        2 => Twist::with_spin_coordinates(v, &[number(&value["w"])]),
        3 => Twist::with_spin_coordinates(v, vector::<3>(&value["w"]).as_slice()),
        _ => Twist::new(v, matrix(&value["w"])),
    }
    .expect("a velocity")
}

fn contact<const N: usize>(case: &Value) -> Contact<N> {
    Contact::new(vector(&case["contact_point"]), vector(&case["normal"]), 0).expect("a contact")
}

fn relative<const N: usize>(found: &SVector<f64, N>, expected: &SVector<f64, N>) -> f64 {
    (found - expected).norm() / expected.norm().max(f64::MIN_POSITIVE)
}

/// Largest relative error over the linear velocity and the spin of each body.
fn velocity_error<const N: usize>(found: &Twist<N>, expected: &Twist<N>) -> f64 {
    let spin = (found.spin() - expected.spin()).norm() / expected.spin().norm().max(f64::MIN_POSITIVE);
    relative(&found.linear, &expected.linear).max(spin)
}

fn cases(dimension: usize) -> Vec<Value> {
    let path = format!("{}/../../tests/data/collisions/cases_{dimension}d.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(Path::new(&path)).expect("the certified cases");
    let file: Value = serde_json::from_str(&text).expect("JSON");
    file["cases"].as_array().expect("a list of cases").clone()
}

/// Calls `f` with each case, each of its results, and the law of that result.
fn for_each_result<const N: usize>(mut f: impl FnMut(&Value, &Value, &RoughPlane<N>)) -> usize {
    let mut count = 0;
    for case in cases(N) {
        for result in case["results"].as_array().expect("results") {
            let rough: Vec<SVector<f64, N>> =
                result["rough"].as_array().expect("directions").iter().map(vector).collect();
            let law = RoughPlane::new(&rough).expect("rough directions");
            assert_eq!(law.at(&contact(&case)).expect("independent directions").rank(), rough.len());
            f(&case, result, &law);
            count += 1;
        }
    }
    count
}

fn matches_every_certified_number<const N: usize>(results: usize) {
    let mut worst = 0.0_f64;
    let count = for_each_result::<N>(|case, result, law| {
        let id = &case["id"];
        let centre = |i: usize| vector(&case["bodies"][i]["position"]);
        let [first, second]: [Free<N>; 2] = [0, 1].map(|i| body(&case["bodies"][i]));
        let pair = Pair::from_centres(contact(case), (first, centre(0)), (second, centre(1)));
        let before = (twist(&case["pre"][0]), twist(&case["pre"][1]));
        let collision = pair.try_collide(law, &before).expect("a collision");

        let k = pair.delassus().to_matrix(&pair.contact.normal);
        let expected_k = matrix::<N>(&case["K"]);
        let after = &collision.velocities;
        let errors = [
            (k - expected_k).norm() / expected_k.norm(),
            relative(&collision.impulse, &vector(&result["impulse_on_body_1"])),
            relative(&collision.u_minus, &vector(&result["u_minus"])),
            relative(&pair.contact_velocity(after), &vector(&result["u_plus"])),
            velocity_error(&after.0, &twist(&result["post"][0])),
            velocity_error(&after.1, &twist(&result["post"][1])),
            (pair.kinetic_energy(&before) / number(&case["energy"]) - 1.0).abs(),
            (pair.kinetic_energy(after) / number(&case["energy"]) - 1.0).abs(),
        ];
        for error in errors {
            assert!(error <= TOLERANCE, "{id}, k = {}: {errors:?}", result["k"]);
            worst = worst.max(error);
        }
    });
    assert_eq!(count, results, "every k from 0 to N−1 of every case");
    assert!(worst > 0.0, "exact agreement of rounded numbers: the test compared nothing");
}

#[test]
fn planar_collisions_match_the_certified_ones() {
    matches_every_certified_number::<2>(24);
}

#[test]
fn spatial_collisions_match_the_certified_ones() {
    matches_every_certified_number::<3>(36);
}

#[test]
fn collisions_in_four_dimensions_match_the_certified_ones() {
    matches_every_certified_number::<4>(20);
}

#[test]
fn collisions_in_five_dimensions_match_the_certified_ones() {
    matches_every_certified_number::<5>(15);
}

#[test]
fn a_planar_body_matches_the_certified_ones() {
    for_each_result::<2>(|case, result, law| {
        let centre = |i: usize| vector(&case["bodies"][i]["position"]);
        let [first, second] = [0, 1].map(|i| {
            let body = &case["bodies"][i];
            (body["mass"] != "inf")
                .then(|| Planar::new(number(&body["mass"]), number(&body["inertia"])).expect("a body"))
        });
        let pair = Pair::from_centres(contact(case), (first, centre(0)), (second, centre(1)));
        let after = pair.collide(law, &(twist(&case["pre"][0]), twist(&case["pre"][1]))).velocities;
        assert!(velocity_error(&after.0, &twist(&result["post"][0])) <= TOLERANCE, "{}", case["id"]);
        assert!(velocity_error(&after.1, &twist(&result["post"][1])) <= TOLERANCE, "{}", case["id"]);
    });
}

#[test]
fn a_spatial_body_matches_the_certified_ones() {
    for_each_result::<3>(|case, result, law| {
        let centre = |i: usize| vector(&case["bodies"][i]["position"]);
        let [first, second] = [0, 1].map(|i| {
            let body = &case["bodies"][i];
            (body["mass"] != "inf")
                .then(|| Spatial::new(number(&body["mass"]), matrix(&body["inertia"])).expect("a body"))
        });
        let pair = Pair::from_centres(contact(case), (first, centre(0)), (second, centre(1)));
        let after = pair.collide(law, &(twist(&case["pre"][0]), twist(&case["pre"][1]))).velocities;
        assert!(velocity_error(&after.0, &twist(&result["post"][0])) <= TOLERANCE, "{}", case["id"]);
        assert!(velocity_error(&after.1, &twist(&result["post"][1])) <= TOLERANCE, "{}", case["id"]);
    });
}

/// The cases of kind `ball_wall` and `ball_ball`, with the isotropic bodies they describe.
fn balls_match<const N: usize>(moment: impl Fn(&Value) -> f64) -> usize {
    let mut count = 0;
    for_each_result::<N>(|case, result, law| {
        if !case["kind"].as_str().is_some_and(|kind| kind.starts_with("ball")) {
            return;
        }
        count += 1;
        let contact: Contact<N> = contact(case);
        let [first, second] = [0, 1].map(|i| {
            let (body, centre): (_, SVector<f64, N>) = (&case["bodies"][i], vector(&case["bodies"][i]["position"]));
            let (mass, radius) = (&body["mass"], (contact.point - centre).norm());
            let ball = (mass != "inf").then(|| {
                Ball::<N>::with_gamma_squared(number(mass), radius, moment(body) / (number(mass) * radius * radius))
                    .expect("a ball")
            });
            (ball, centre)
        });
        let pair = Pair::from_centres(contact, first, second);
        let after = pair.collide(law, &(twist(&case["pre"][0]), twist(&case["pre"][1]))).velocities;
        assert!(velocity_error(&after.0, &twist(&result["post"][0])) <= TOLERANCE, "{}", case["id"]);
        assert!(velocity_error(&after.1, &twist(&result["post"][1])) <= TOLERANCE, "{}", case["id"]);
    });
    count
}

#[test]
fn balls_match_the_certified_ones() {
    assert!(balls_match::<2>(|body| number(&body["inertia"])) >= 8);
    assert!(balls_match::<3>(|body| number(&body["inertia"][0][0])) >= 12);
    assert!(balls_match::<4>(|body| 2.0 * number(&body["mass"]) * number(&body["S"][0][0])) >= 8);
    assert!(balls_match::<5>(|body| 2.0 * number(&body["mass"]) * number(&body["S"][0][0])) >= 5);
}

#[test]
fn coordinates_of_certified_spins_come_back() {
    let pre: Twist<5> = twist(&cases(5)[0]["pre"][0]);
    assert_eq!(Twist::from_coordinates(&pre.coordinates()), pre);
}

/// A body so slim that a push turns it rather than moves it: `K` has a condition number of up to 10¹².
#[test]
fn bodies_that_hardly_resist_turning_keep_their_energy_and_reverse_the_contact_velocity() {
    for exponent in 0..=12 {
        let moment = libm::pow(10.0, -f64::from(exponent));
        let body = Some(RigidBody::<2>::new(1.0, Inertia::Moment(moment)).unwrap());
        let normal = SVector::<f64, 2>::new(0.6, 0.8);
        let contact = Contact::new(SVector::<f64, 2>::zeros(), normal, 0).unwrap();
        let wall: Free<2> = None;
        let pair = Pair::new(contact, (body, SVector::<f64, 2>::new(-0.7, 0.3)), (wall, SVector::zeros()));
        let still = Twist::planar(SVector::<f64, 2>::zeros(), 0.0);
        let before = (Twist::planar(SVector::<f64, 2>::new(-1.3, -0.8), 0.7), still);
        let after = pair.collide(&NoSlip, &before);
        let energy = pair.kinetic_energy(&after.velocities) / pair.kinetic_energy(&before) - 1.0;
        let left = pair.contact_velocity(&after.velocities) + after.u_minus;
        assert!(energy.abs() <= TOLERANCE && left.norm() <= TOLERANCE, "{moment:e}: {energy:e}, {left}");
        let report = check::law(&pair, &NoSlip, check::Samples::default());
        let tolerance = check::tolerance(&pair);
        assert!(tolerance <= 1e-9_f64.max(2e-12 / moment.sqrt()), "{tolerance:e}");
        assert!(report.is_strict(tolerance), "{moment:e}:\n{report}");
        // and no law that loses energy passes for strict
        let report = check::law(&pair, &Restitution::new(0.999, 1.0).unwrap(), check::Samples::default());
        assert!(!report.is_strict(tolerance), "{moment:e}:\n{report}");
    }
}

/// A body so slim that its `K` has a condition number of up to 10¹⁴, in contact with a wall, and its moment of inertia.
fn slim_bodies() -> impl Iterator<Item = (f64, Pair<Free<2>, Free<2>, 2>)> {
    (0..=14).map(|exponent| {
        let moment = libm::pow(10.0, -f64::from(exponent));
        let body = Some(RigidBody::<2>::new(1.0, Inertia::Moment(moment)).unwrap());
        let contact = Contact::new(SVector::<f64, 2>::zeros(), SVector::<f64, 2>::new(0.6, 0.8), 0).unwrap();
        let pair = Pair::from_centres(contact, (body, SVector::<f64, 2>::new(0.3, 1.0)), (None, SVector::zeros()));
        (moment, pair)
    })
}

#[test]
fn restitution_of_modulus_one_is_no_slip_and_specular_also_where_bodies_hardly_resist_turning() {
    let still = Twist::planar(SVector::<f64, 2>::zeros(), 0.0);
    let before = (Twist::planar(SVector::<f64, 2>::new(1.0, -1.5), 0.0), still);
    for (moment, pair) in slim_bodies() {
        let rough = pair.collide(&Restitution::new(1.0, 1.0).unwrap(), &before);
        assert_eq!(rough, pair.collide(&NoSlip, &before), "{moment:e}");
        let smooth = pair.collide(&Restitution::new(1.0, -1.0).unwrap(), &before);
        assert_eq!(smooth, pair.collide(&Specular, &before), "{moment:e}");
    }
}

#[test]
fn restitution_loses_the_energy_it_says_also_where_bodies_hardly_resist_turning() {
    let (v, w) = (SVector::<f64, 2>::new(1.0, -1.5), 0.25);
    let before = (Twist::planar(v, w), Twist::planar(SVector::zeros(), 0.0));
    for (moment, pair) in slim_bodies() {
        let (nu, arm) = (pair.contact.normal.into_inner(), pair.arms[0]);
        let turned = SVector::<f64, 2>::new(-arm.y, arm.x);
        let u = pair.contact_velocity(&before);
        // for m = 1 K = 1 + t tᵀ/I with t = J r, so K⁻¹ = 1 − t tᵀ/(I + t·t)
        let whole = u.norm_squared() - libm::pow(turned.dot(&u), 2.0) / (moment + turned.norm_squared());
        let along = libm::pow(nu.dot(&u), 2.0) / (1.0 + libm::pow(turned.dot(&nu), 2.0) / moment);
        for (normal, tangential) in
            [(1.0, 0.5), (0.5, 0.5), (0.25, 0.75), (0.0, 0.0), (0.0, 1.0), (0.5, -0.5), (0.5, -1.0)]
        {
            let after = pair.collide(&Restitution::new(normal, tangential).unwrap(), &before);
            let u_plus = pair.contact_velocity(&after.velocities);
            let lost = pair.kinetic_energy(&before) - pair.kinetic_energy(&after.velocities);
            let expected =
                0.5 * (1.0 - normal * normal) * along + 0.5 * (1.0 - tangential * tangential) * (whole - along);
            // a spin w of which I w² is an energy moves the contact by r w, rounded accordingly: up to the root of 10¹⁴
            let tolerance = 1e-14 / moment.sqrt();
            let case = format!("{moment:e}, {normal}, {tangential}: {lost} {expected} {u_plus}");
            assert!((lost - expected).abs() <= tolerance.min(TOLERANCE) * pair.kinetic_energy(&before), "{case}");
            assert!((nu.dot(&u_plus) + normal * nu.dot(&u)).abs() <= tolerance * u.norm(), "{case}");
        }
    }
}

/// The specular law and its relative that loses energy push along the normal alone, and need of `K` only `ν·Kν`.
#[test]
fn what_pushes_along_the_normal_alone_needs_no_more_of_a_body_than_its_mass() {
    let normal = SVector::<f64, 2>::new(0.0, 1.0);
    let contact = Contact::new(SVector::zeros(), normal, 0).unwrap();
    let body: Free<2> = Some(RigidBody::new(1.0, Inertia::Moment(1e-20)).unwrap());
    let still = Twist::planar(SVector::zeros(), 0.0);
    let falling = Twist::planar(SVector::<f64, 2>::new(1.0, -1.5), 0.5);
    let pair = Pair::from_centres(contact, (body, normal), (None::<RigidBody<2>>, SVector::zeros()));
    let halved = Restitution::new(0.5, -1.0).unwrap();
    let after = pair.try_collide(&Specular, &(falling, still)).unwrap().velocities.0;
    assert_eq!(after, Twist::planar(SVector::<f64, 2>::new(1.0, 1.5), 0.5));
    let after = pair.try_collide(&halved, &(falling, still)).unwrap().velocities.0;
    assert_eq!(after, Twist::planar(SVector::<f64, 2>::new(1.0, 0.75), 0.5));
    assert_eq!(pair.try_collide(&NoSlip, &(falling, still)), Err(Error::SingularDelassus { body: 1 }));
    let flipped = Contact::new(SVector::zeros(), -normal, 0).unwrap();
    let pair = Pair::from_centres(flipped, (None::<RigidBody<2>>, SVector::zeros()), (body, normal));
    assert_eq!(pair.try_collide(&NoSlip, &(still, falling)), Err(Error::SingularDelassus { body: 2 }));

    // in space, turning easily about x: a law that is rough along x alone turns it about y
    let (x, z) = (SVector::<f64, 3>::x(), SVector::<f64, 3>::z());
    let tensor = SMatrix::<f64, 3, 3>::from_diagonal(&SVector::<f64, 3>::new(1e-20, 1e-5, 1e-5));
    let body = Some(Spatial::new(1.0, tensor).unwrap());
    let contact = Contact::new(SVector::zeros(), z, 0).unwrap();
    let pair = Pair::from_centres(contact, (body, z), (None::<Spatial>, SVector::zeros()));
    let before = (Twist::spatial(x - z, x * 0.5), Twist::spatial(SVector::zeros(), SVector::zeros()));
    let after = pair.try_collide(&Specular, &before).unwrap().velocities.0;
    assert_eq!(after, Twist::spatial(x + z, x * 0.5));
    assert!(pair.try_collide(&halved, &before).is_ok());
    let combed = pair.try_collide(&RoughPlane::new(&[x]).unwrap(), &before).unwrap();
    let reversed = pair.contact_velocity(&combed.velocities) + combed.u_minus;
    // roundings of a contact velocity of size 1
    assert!(reversed.x.abs().max(reversed.z.abs()) <= 1e-15, "{reversed}");
    assert_eq!(pair.try_collide(&NoSlip, &before), Err(Error::SingularDelassus { body: 1 }));
}

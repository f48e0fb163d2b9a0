//! Maps that are not strict collisions, and which axiom the classification blames.

use approx::assert_abs_diff_eq;
use collision_laws::{
    Contact, Error, Fixed, Pair, Roughness,
    bodies::{Inertia, Point, RigidBody},
    check::{self, Axiom, TOLERANCE},
    classify,
    laws::{NoSlip, RoughPlane, Specular},
};
use nalgebra::{DMatrix, DVector, Matrix3, Vector2, Vector3};

type Free = Pair<RigidBody<3>, RigidBody<3>, 3>;

/// Two irregular bodies in space.
fn pair() -> Free {
    let tensor = |a: f64, b: f64| Matrix3::new(3.0, a, 0.2, a, 2.0, b, 0.2, b, 2.5);
    let first = RigidBody::new(2.0, Inertia::Tensor(tensor(0.3, -0.4))).expect("a body");
    let second = RigidBody::new(0.7, Inertia::Tensor(tensor(-0.5, 0.1) * 0.4)).expect("a body");
    let contact = Contact::new(Vector3::new(0.1, 0.2, 0.3), Vector3::new(1.0, -2.0, 2.0), 0).expect("a normal");
    Pair::new(contact, (first, Vector3::new(0.4, 0.8, -0.9)), (second, Vector3::new(0.7, 0.1, 0.6)))
}

/// The axioms that a map in unit coordinates breaks.
fn broken(pair: &Free, unit: &DMatrix<f64>) -> Vec<(Axiom, f64)> {
    let space = pair.tangent_space();
    let columns: Vec<DVector<f64>> = (0..12)
        .map(|j| {
            let mut e = DVector::zeros(12);
            e[j] = 1.0;
            space.from_unit(&(unit * space.to_unit(&e)))
        })
        .collect();
    let found = classify(&space, &DMatrix::from_columns(&columns), TOLERANCE).expect("a square matrix");
    assert!(found.strict.is_none());
    found.report.broken(TOLERANCE).collect()
}

fn axioms(broken: Vec<(Axiom, f64)>) -> Vec<Axiom> {
    broken.into_iter().map(|(axiom, _)| axiom).collect()
}

fn strict_map(pair: &Free) -> DMatrix<f64> {
    pair.tangent_space().map_to_unit(&pair.collision_map(&Specular))
}

/// A unit vector of the impulse space, orthogonal to the normal.
fn tangent_impulse(pair: &Free) -> DVector<f64> {
    let space = pair.tangent_space();
    let first = space.impulse_space().column(0);
    (first - space.normal() * space.normal().dot(&first)).normalize()
}

#[test]
fn the_rank_and_the_plane_come_back() {
    let pair = pair();
    let directions = [Vector3::new(1.0, 1.0, -3.0)];
    let law = RoughPlane::new(&directions).expect("a direction");
    let found = classify(&pair.tangent_space(), &pair.collision_map(&law), TOLERANCE).expect("a square matrix");
    let Some(Roughness::Along(plane)) = found.strict else { panic!("{}", found.report) };
    let expected = pair.contact.tangential(&directions[0]).normalize();
    // the condition number of these bodies is about ten
    assert!((plane.projector() - expected * expected.transpose()).norm() < 1e-13);
    assert_eq!(plane.rank(), 1);
}

#[test]
fn doing_nothing_leaves_the_bodies_approaching() {
    let found = broken(&pair(), &DMatrix::identity(12, 12));
    assert_eq!(axioms(found.clone()), [Axiom::OutgoingToIngoing]);
    assert_abs_diff_eq!(found[0].1, 1.0, epsilon = 1e-12);
}

#[test]
fn flipping_components_of_the_contact_velocity_breaks_energy_alone() {
    // u⁺ = (1 − 2 ν νᵀ) u, the Euclidean reflection: for bodies that are not round the metric is another
    let pair = pair();
    let (space, nu) = (pair.tangent_space(), pair.contact.normal);
    let k = pair.delassus().to_matrix(&nu).try_inverse().expect("a positive matrix");
    let mut map = DMatrix::zeros(12, 12);
    for j in 0..12 {
        let mut e = DVector::zeros(12);
        e[j] = 1.0;
        let v = pair.velocities(e.as_slice());
        let flip = nu.into_inner() * (-2.0 * nu.dot(&pair.contact_velocity(&v)));
        map.set_column(j, &pair.coordinates(&pair.apply_impulse(&(k * flip), &v)));
    }
    let found = classify(&space, &map, TOLERANCE).expect("a square matrix");
    let broken: Vec<_> = found.report.broken(TOLERANCE).collect();
    assert!(matches!(broken[..], [(Axiom::Energy, defect)] if defect > 0.1), "{}", found.report);
}

#[test]
fn a_turn_within_the_impulse_space_is_not_reversible() {
    let pair = pair();
    let space = pair.tangent_space();
    let a = tangent_impulse(&pair);
    let second = space.impulse_space().column(1);
    let off = second - space.normal() * space.normal().dot(&second);
    let b = (&off - &a * a.dot(&off)).normalize();
    let (sin, cos) = (libm::sin(0.1), libm::cos(0.1));
    let turn = DMatrix::identity(12, 12)
        + (&a * a.transpose() + &b * b.transpose()) * (cos - 1.0)
        + (&b * a.transpose() - &a * b.transpose()) * sin;
    assert_eq!(axioms(broken(&pair, &(strict_map(&pair) * turn))), [Axiom::Involution]);
}

#[test]
fn a_loss_along_one_direction_breaks_energy_reversibility_and_measure_by_that_much() {
    let pair = pair();
    let a = tangent_impulse(&pair);
    let lossy = strict_map(&pair) * (DMatrix::identity(12, 12) - &a * a.transpose() * 0.5);
    let found = broken(&pair, &lossy);
    let expected = [(Axiom::Energy, 0.75), (Axiom::Involution, 0.75), (Axiom::Measure, 0.5)];
    assert_eq!(axioms(found.clone()), axioms(expected.to_vec()));
    for ((_, found), (_, expected)) in found.into_iter().zip(expected) {
        assert_abs_diff_eq!(found, expected, epsilon = 1e-12);
    }
}

#[test]
fn the_measure_is_lost_where_the_normal_velocity_takes_in_a_tangential_one() {
    // diag(−1, 1) + 0.3 e₀ e₁ᵀ for a point: a normal velocity of −1 and a tangential one of 1 leave with 1.3, so along the normal
    // alone the ratio is 1
    let contact = Contact::new(Vector2::zeros(), Vector2::new(1.0, 0.0), 0).expect("a normal");
    let point = Point::new(1.0).expect("a mass");
    let pair = Pair::new(contact, (point, Vector2::zeros()), (Fixed, Vector2::zeros()));
    let map = DMatrix::from_row_slice(2, 2, &[-1.0, 0.3, 0.0, 1.0]);
    let report = classify(&pair.tangent_space(), &map, TOLERANCE).expect("a square matrix").report;
    assert_eq!(report.measure_ratio(), 1.0);
    assert_abs_diff_eq!(report.defect(Axiom::Measure).expect("a matrix has one"), 0.3, epsilon = 1e-15);
}

#[test]
fn what_was_not_tried_is_not_strict() {
    let pair = pair();
    let none = check::law(&pair, &Specular, check::Samples { count: 0, seed: 0 });
    assert!(!none.is_strict(TOLERANCE));
    let some = check::law(&pair, &Specular, check::Samples::default());
    assert!(some.is_strict(TOLERANCE));
    assert!(!some.is_strict(f64::NAN) && some.broken(f64::NAN).count() == Axiom::ALL.len());
    let found = classify(&pair.tangent_space(), &pair.collision_map(&Specular), f64::NAN).expect("a square matrix");
    assert_eq!(found.strict, None);
}

#[test]
fn a_reflection_of_non_slipping_velocities_is_an_impulse_elsewhere() {
    // orthogonal to every impulse at the contact, and to the rigid motions: momenta are conserved all the same
    let pair = pair();
    let space = pair.tangent_space();
    let (translations, rotations) = (space.translations().expect("free"), space.rotations().expect("free"));
    let off = |x: DVector<f64>, basis: &DMatrix<f64>| &x - basis * basis.tr_mul(&x);
    let start = DVector::from_fn(12, |i, _| libm::sin(i as f64 + 0.5));
    let internal = off(off(off(start, space.impulse_space()), translations), rotations).normalize();
    let reflect = |x: &DVector<f64>| DMatrix::identity(12, 12) - x * x.transpose() * 2.0;
    let found = broken(&pair, &(strict_map(&pair) * reflect(&internal)));
    assert_eq!(axioms(found.clone()), [Axiom::ContactImpulse]);
    assert_abs_diff_eq!(found[0].1, 2.0, epsilon = 1e-12);

    // a rigid motion of the pair is not
    let moved = broken(&pair, &(strict_map(&pair) * reflect(&translations.column(0).into_owned())));
    assert_eq!(axioms(moved), [Axiom::LinearMomentum, Axiom::ContactImpulse]);
    let turned = broken(&pair, &(strict_map(&pair) * reflect(&rotations.column(0).into_owned())));
    assert_eq!(axioms(turned), [Axiom::AngularMomentum, Axiom::ContactImpulse]);
}

#[test]
fn a_matrix_of_the_wrong_size_is_an_error() {
    let pair = Pair::new(pair().contact, (pair().first, pair().arms[0]), (Fixed, Vector3::zeros()));
    let space = pair.tangent_space();
    let error = classify(&space, &DMatrix::identity(6, 5), TOLERANCE).expect_err("not square");
    assert_eq!(error, Error::WrongLength { quantity: "a side of the matrix", given: 5, expected: 6 });
    let nan = DMatrix::repeat(6, 6, f64::NAN);
    assert_eq!(classify(&space, &nan, TOLERANCE), Err(Error::NotFinite { quantity: "the matrix" }));
    assert!(classify(&space, &pair.collision_map(&NoSlip), TOLERANCE).is_ok_and(|found| found.strict.is_some()));
}

#[test]
fn where_nothing_moves_no_axiom_is_broken_and_no_map_is_strict() {
    let walls = Pair::new(pair().contact, (Fixed, Vector3::zeros()), (Fixed, Vector3::zeros()));
    let found =
        classify(&walls.tangent_space(), &walls.collision_map(&NoSlip), TOLERANCE).expect("no rows, no columns");
    assert_eq!(found.report, check::law(&walls, &NoSlip, check::Samples::default()));
    assert_eq!((found.report.broken(TOLERANCE).count(), found.strict), (0, None));
}

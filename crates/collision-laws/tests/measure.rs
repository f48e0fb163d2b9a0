//! Every field of strict laws keeps the canonical measure; directions that depend on the velocity do not.
//!
//! The map tried is a whole step of a billiard, flight and collision, in coordinates in which the measure is Lebesgue
//! measure: 3D ball between two planes, ten coordinates; disk in a circle, the three coordinates `(s, v₀, vₜ)`.

use approx::assert_abs_diff_eq;
use collision_laws::{
    CollisionLaw, Contact, Fixed, Pair, StrictLaw, Twist,
    bodies::Ball,
    check::{
        self, Axiom, LawOfOrientation, Samples, Slab, SlabState,
        controls::{Chasing, ReversiblyChasing, slip_angle},
        jacobian_determinant,
    },
    laws::{Grooved, NoSlip, RandomGrassmannian, Restitution, RoughPlane, Specular},
};
use nalgebra::{DVector, UnitQuaternion, Vector2, Vector3, dvector};

/// Central differences of order 6. The fields below vary on the scale of 0.1 (in units of speed and of the ball's radius), which
/// leaves (STEP/0.1)⁶ = 1e-12 times constants of order ten, and rounding 1e-16/STEP times as much.
const STEP: f64 = 1e-3;
const TOLERANCE: f64 = 1e-9;

fn ball() -> Ball<3> {
    Ball::uniform(2.0, 0.7).expect("a ball")
}

fn slab_determinant(law: LawOfOrientation<'_>) -> f64 {
    let slab = Slab { ball: ball(), height: 1.5 };
    let orientation = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -1.1, 0.3));
    let (tangential, spin) = (Vector2::new(0.31, -0.22), Vector3::new(0.27, 0.35, -0.18));
    slab.determinant(law, &SlabState::new(Vector2::new(0.2, -0.3), orientation, tangential, spin), STEP)
}

/// A law that knows nothing of the orientation.
fn always<L: CollisionLaw<3> + Clone + 'static>(law: L) -> impl Fn(&UnitQuaternion<f64>) -> Box<dyn CollisionLaw<3>> {
    move |_| Box::new(law.clone())
}

/// `|det| = 1`; the sign of a reflection in k+1 directions, seen without the normal, is `(−1)ᵏ`.
fn keeps_measure(law: LawOfOrientation<'_>, rank: u32) {
    let expected = if rank.is_multiple_of(2) { 1.0 } else { -1.0 };
    let determinant = slab_determinant(law);
    assert_abs_diff_eq!(determinant, expected, epsilon = TOLERANCE);
}

#[test]
fn specular_and_no_slip_keep_the_measure_of_a_slab() {
    keeps_measure(&always(Specular), 0);
    keeps_measure(&always(NoSlip), 2);
}

#[test]
fn rough_directions_that_vary_in_space_keep_the_measure() {
    keeps_measure(&always(RoughPlane::new(&[Vector3::new(1.0, 2.0, -3.0)]).expect("a direction")), 1);
    keeps_measure(&always(Grooved::new(|contact: &Contact<3>| contact.point)), 1);
    let turning = |contact: &Contact<3>| {
        let angle = 2.0 * contact.point.x - 1.5 * contact.point.y * contact.point.y;
        Vector3::new(libm::cos(angle), libm::sin(angle), 0.0)
    };
    keeps_measure(&always(Grooved::new(turning)), 1);
}

#[test]
fn rough_directions_glued_to_the_ball_keep_the_measure() {
    let glued = |turned: &UnitQuaternion<f64>| -> Box<dyn CollisionLaw<3>> {
        Box::new(RoughPlane::new(&[turned * Vector3::new(1.0, 0.2, 0.0)]).expect("a direction"))
    };
    keeps_measure(&glued, 1);
}

#[test]
fn a_rough_direction_that_chases_the_velocity_shrinks_the_measure_to_three_tenths() {
    let determinant = slab_determinant(&always(Chasing));
    assert_abs_diff_eq!(determinant.abs(), 0.3, epsilon = TOLERANCE);
}

/// A velocity of approach whose slip has the given angle.
fn approach(psi: f64) -> (Pair<Ball<3>, Fixed, 3>, (Twist<3>, ())) {
    let arm = Vector3::new(0.0, 0.0, -ball().radius());
    let contact = Contact::new(Vector3::zeros(), Vector3::z(), 0).expect("a normal");
    let pair = Pair::new(contact, (ball(), arm), (Fixed, Vector3::zeros()));
    // turn the angle of one velocity into psi
    let zero = slip_angle(&contact, &Vector3::x());
    let v = Vector3::new(libm::cos(psi - zero), libm::sin(psi - zero), -0.8);
    let slip = slip_angle(&contact, &v);
    assert!((slip - psi).abs() < 1e-14, "angles add in an oriented frame");
    (pair, (Twist::spatial(v, Vector3::zeros()), ()))
}

#[test]
fn reversibility_without_linearity_does_not_keep_the_measure() {
    for psi in [0.3, -1.2, 2.0] {
        let (pair, v) = approach(psi);
        let (space, x) = (pair.tangent_space(), pair.coordinates(&v));
        let map = |x: &DVector<f64>| {
            pair.coordinates(&pair.collide(&ReversiblyChasing, &pair.velocities(x.as_slice())).velocities)
        };
        // reversible, with the right energy, and yet
        assert!(check::axioms::involution(&space, map, &x) < 1e-14);
        assert!(check::axioms::energy(&space, &x, &map(&x)) < 1e-14);
        let ratio = check::axioms::measure_ratio(&space, map, &x);
        assert!((ratio - ReversiblyChasing::measure_ratio(psi)).abs() < TOLERANCE, "{ratio} at ψ = {psi}");
        assert!((ratio - 1.0).abs() > 0.1, "{ratio} at ψ = {psi}");
    }
}

#[test]
fn the_report_flags_exactly_what_is_wrong_with_the_controls() {
    for normal in [Vector3::z(), Vector3::x(), Vector3::new(-0.6, 0.48, 0.64)] {
        flagged_at(normal);
    }
}

fn flagged_at(normal: Vector3<f64>) {
    let contact = Contact::new(Vector3::zeros(), normal, 0).expect("a normal");
    let pair = Pair::new(contact, (ball(), normal * -ball().radius()), (Fixed, Vector3::zeros()));
    let broken = |law: &dyn CollisionLaw<3>| -> Vec<Axiom> {
        check::law(&pair, law, Samples::default()).broken(check::TOLERANCE).map(|(axiom, _)| axiom).collect()
    };
    assert_eq!(broken(&Chasing), [Axiom::Involution, Axiom::Linearity, Axiom::Measure]);
    assert_eq!(broken(&ReversiblyChasing), [Axiom::Linearity, Axiom::Measure]);
    assert_eq!(broken(&RandomGrassmannian::new(1, 3).expect("rank 1")), []);
    let report = check::law(&pair, &Chasing, Samples::default());
    // differences with step 1/512 where the slip is at least a tenth of the velocity: (10/512)⁶ times 0.35⁷·6! ≈ 1e-11, and more
    // where it is less
    assert_abs_diff_eq!(report.measure_ratio(), 0.3, epsilon = 1e-5);
}

/// One step in the unit circle, in arc length and velocities at unit 3-speed.
fn circle_step(law: &dyn CollisionLaw<2>, state: &DVector<f64>) -> DVector<f64> {
    let (disk, (s, v0, vt)) = (Ball::<2>::uniform(1.0, 0.25).expect("a disk"), (state[0], state[1], state[2]));
    let inward = |s: f64| Vector2::new(-libm::cos(s), -libm::sin(s));
    let turned = |x: Vector2<f64>| Vector2::new(-x.y, x.x);
    let vn = (1.0 - v0 * v0 - vt * vt).sqrt();
    let v = inward(s) * vn + turned(inward(s)) * vt;
    let centre = v * (2.0 * vn / (vn * vn + vt * vt)) - inward(s);

    let contact = Contact::new(centre * 1.25, -centre, 0).expect("a normal");
    let pair = Pair::new(contact, (disk, centre * 0.25), (Fixed, Vector2::zeros()));
    let after = pair.collide(law, &(disk.with_scaled_spin(v, v0), ())).velocities.0;
    let s = s + std::f64::consts::PI + 2.0 * libm::atan2(vt, vn); // v is ν turned by atan2(vₜ, vₙ)
    assert!((centre + inward(s)).norm() < 1e-14);
    dvector![s, disk.scaled_spin(&after), after.linear.dot(&turned(-centre))]
}

#[test]
fn the_reduced_map_of_a_circle_keeps_the_measure() {
    for (law, expected) in [(&Specular as &dyn StrictLaw<2>, 1.0), (&NoSlip, -1.0)] {
        let determinant = jacobian_determinant(|x| circle_step(&law, x), &dvector![0.4, 0.3, -0.45], STEP);
        assert_abs_diff_eq!(determinant, expected, epsilon = TOLERANCE);
    }
    let lossy = Restitution::new(1.0, 0.5).expect("coefficients in range");
    let determinant = jacobian_determinant(|x| circle_step(&lossy, x), &dvector![0.4, 0.3, -0.45], STEP);
    assert!((determinant.abs() - 0.5).abs() < TOLERANCE, "the slip halves: {determinant}");
}

#[test]
fn a_law_that_does_not_say_so_is_not_strict() {
    assert!(!Chasing.is_strict() && !CollisionLaw::<3>::is_strict(&ReversiblyChasing));
}

#[test]
fn the_maps_that_are_tried_see_velocities_of_approach_with_unit_energy() {
    let (pair, _) = approach(0.3);
    let space = pair.tangent_space();
    let seen = std::cell::RefCell::new(Vec::new());
    let map = |v: &DVector<f64>| {
        seen.borrow_mut().push(space.to_unit(v));
        v.clone()
    };
    check::map(&space, map, Samples { count: 8, seed: 0 });
    let unit = seen.into_inner().into_iter().filter(|y| (y.norm_squared() - 2.0).abs() < 1e-14);
    let towards: Vec<bool> = unit.map(|y| space.normal().dot(&y) < 0.0).collect();
    assert!(towards.len() >= 16 && towards.iter().all(|towards| *towards), "{towards:?}");
}

#[test]
fn a_ball_in_a_slab_meets_the_ceiling_at_unit_speed_turned_by_its_spin() {
    let slab = Slab { ball: ball(), height: 1.5 };
    let (tangential, scaled) = (Vector2::new(0.31, -0.22), Vector3::new(0.27, 0.35, -0.18));
    let start = UnitQuaternion::from_scaled_axis(Vector3::new(0.4, -1.1, 0.3));
    let state = SlabState::new(Vector2::new(0.2, -0.3), start, tangential, scaled);
    let (turned, at_contact) = slab.meeting(&state);
    let rise = (1.0 - tangential.norm_squared() - scaled.norm_squared()).sqrt();
    let velocity = Vector3::new(tangential.x, tangential.y, rise);
    let moving = ball().with_scaled_spin(velocity, scaled);
    let spin = Vector3::from_column_slice(&moving.spin_coordinates());
    let expected = UnitQuaternion::from_scaled_axis(spin * (slab.height / rise)) * start;
    assert!(turned.angle_to(&expected) < 1e-14);
    assert_abs_diff_eq!(at_contact, velocity + spin.cross(&(Vector3::z() * ball().radius())), epsilon = 1e-14);
}

#[test]
fn the_defect_of_linearity_does_not_depend_on_the_unit_of_velocity() {
    let (pair, v) = approach(0.3);
    let (space, w) = (pair.tangent_space(), approach(-1.9).1);
    let map = |x: &DVector<f64>| pair.coordinates(&pair.collide(&Chasing, &pair.velocities(x.as_slice())).velocities);
    let defect = |unit: f64| {
        check::axioms::linearity(&space, map, &(pair.coordinates(&v) * unit), &(pair.coordinates(&w) * unit))
    };
    assert!(defect(1.0) > check::TOLERANCE);
    assert_eq!([defect(1024.0), defect(1.0 / 1024.0)], [defect(1.0); 2]);
}

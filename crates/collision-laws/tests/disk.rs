//! Balls and disks: the constants of the theory, and the agreement of the fast form with the general one.

use approx::assert_abs_diff_eq;
use collision_laws::{
    AnyLaw, CollisionLaw, Contact, DiskLaw, Fixed, Pair, Roughness, StrictLaw, Twist,
    bodies::Ball,
    laws::{NoSlip, PerSurface, Restitution, RoughPlane, Specular},
};
use nalgebra::{Matrix3, SVector, Vector2, Vector3};
use proptest::prelude::*;

/// A few roundings of numbers of order one.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

fn quarter_turn(x: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-x.y, x.x)
}

/// The velocities `(v₀, vₜ, vₙ)` after a collision with a wall of the given normal, by the general code.
fn through_the_pair(law: &impl CollisionLaw<2>, gamma: f64, normal: Vector2<f64>, v: [f64; 3]) -> [f64; 3] {
    let disk = Ball::<2>::with_gamma_squared(1.7, 0.6, gamma * gamma).expect("a disk");
    let (nu, t) = (normal, quarter_turn(normal));
    let pair = Pair::new(
        Contact::new(Vector2::zeros(), nu, 0).expect("a normal"),
        (disk, -nu * disk.radius()),
        (Fixed, Vector2::zeros()),
    );
    let before = disk.with_scaled_spin(t * v[1] + nu * v[2], v[0]);
    let after = pair.collide(law, &(before, ())).velocities.0;
    [disk.scaled_spin(&after), after.linear.dot(&t), after.linear.dot(&nu)]
}

fn agrees_with_the_pair(law: &(impl DiskLaw + CollisionLaw<2>), gamma: f64, angle: f64, v: [f64; 3]) {
    let map = law.disk_map(gamma);
    let fast: [f64; 3] = map.apply(v[0], v[1], v[2]).into();
    let general = through_the_pair(law, gamma, Vector2::new(libm::cos(angle), libm::sin(angle)), v);
    for (a, b) in fast.into_iter().zip(general) {
        assert!((a - b).abs() <= ROUNDING * (1.0 + 1.0 / gamma), "{fast:?} and {general:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_disk_map_is_the_collision_of_a_disk_with_a_wall(
        gamma in 0.05..1.0_f64, angle in -3.0..3.0_f64, v in prop::array::uniform3(-1.0..1.0_f64),
        normal in 0.0..1.0_f64, tangential in -1.0..1.0_f64,
    ) {
        agrees_with_the_pair(&Specular, gamma, angle, v);
        agrees_with_the_pair(&NoSlip, gamma, angle, v);
        agrees_with_the_pair(&Restitution::new(normal, tangential).expect("in range"), gamma, angle, v);
    }

    #[test]
    fn two_free_equal_disks_obey_the_law_of_one_disk_and_a_wall(
        gamma in 0.1..1.0_f64, angle in -3.0..3.0_f64, v in prop::array::uniform6(-1.0..1.0_f64),
    ) {
        let disk = Ball::<2>::with_gamma_squared(1.3, 0.4, gamma * gamma).expect("a disk");
        let nu = Vector2::new(libm::cos(angle), libm::sin(angle));
        let contact = Contact::new(Vector2::zeros(), nu, 0).expect("a normal");
        let pair = Pair::new(contact, (disk, -nu * 0.4), (disk, nu * 0.4));
        let before = (disk.with_scaled_spin(Vector2::new(v[0], v[1]), v[2]), disk.with_scaled_spin(Vector2::new(v[3], v[4]), v[5]));
        let after = pair.collide(&NoSlip, &before).velocities;
        // relative velocity and the sum of the spins
        let reduced = |v: &(Twist<2>, Twist<2>)| {
            let w = v.0.linear - v.1.linear;
            (disk.scaled_spin(&v.0) + disk.scaled_spin(&v.1), w.dot(&quarter_turn(nu)), w.dot(&nu))
        };
        let (spin, tangent, normal) = reduced(&before);
        let (expected, found) = (NoSlip.disk_map(gamma).apply(spin, tangent, normal), reduced(&after));
        let gap = (expected.0 - found.0).abs() + (expected.1 - found.1).abs() + (expected.2 - found.2).abs();
        prop_assert!(gap <= 4.0 * ROUNDING / gamma, "{expected:?} and {found:?}");
        // the difference of the spins and the sum of the velocities stay
        let difference = |v: &(Twist<2>, Twist<2>)| v.0.angular_velocity() - v.1.angular_velocity();
        prop_assert!((difference(&after) - difference(&before)).abs() <= 4.0 * ROUNDING / (gamma * gamma));
    }

    #[test]
    fn a_no_slip_collision_of_a_disk_is_a_half_turn(gamma in 0.05..1.0_f64, angle in -3.0..3.0_f64) {
        // about e = sin(β/2) x₀ + cos(β/2) t, tan(β/2) = γ, in coordinates (v₀, v₁, v₂)
        let nu = Vector2::new(libm::cos(angle), libm::sin(angle));
        let t = quarter_turn(nu);
        let e = Vector3::new(gamma, t.x, t.y) / (1.0 + gamma * gamma).sqrt();
        let half_turn = e * e.transpose() * 2.0 - Matrix3::identity();
        for v in [Vector3::x(), Vector3::y(), Vector3::z()] {
            let plane = Vector2::new(v.y, v.z);
            let (v0, vt, vn) = NoSlip.disk_map(gamma).apply(v.x, plane.dot(&t), plane.dot(&nu));
            let after = t * vt + nu * vn;
            prop_assert!((Vector3::new(v0, after.x, after.y) - half_turn * v).norm() <= ROUNDING);
        }
    }

    #[test]
    fn a_ball_in_space_obeys_the_wall_law_in_scaled_spin(
        gamma_squared in 0.1..0.7_f64, rough in prop::array::uniform3(-1.0..1.0_f64),
        normal in prop::array::uniform3(-1.0..1.0_f64), v in prop::array::uniform3(-1.0..1.0_f64), w in prop::array::uniform3(-1.0..1.0_f64),
    ) {
        let [normal, rough, v, w] = [normal, rough, v, w].map(Vector3::from);
        prop_assume!(normal.norm() > 0.1 && normal.cross(&rough).norm() > 0.1 * normal.norm() * rough.norm());
        let ball = Ball::<3>::with_gamma_squared(2.5, 0.3, gamma_squared).expect("a ball");
        let contact = Contact::new(Vector3::zeros(), normal, 0).expect("a normal");
        let nu = contact.normal.into_inner();
        let pair = Pair::new(contact, (ball, -nu * ball.radius()), (Fixed, Vector3::zeros()));
        let combed = RoughPlane::new(&[rough]).expect("a direction");
        for roughness in [Roughness::Smooth, combed.roughness(&contact), Roughness::Rough] {
            let law = collision_laws::laws::Field::new(|_: &Contact<3>| roughness);
            let after = pair.collide(&law, &(ball.with_scaled_spin(v, w), ())).velocities.0;
            // p = −2 ν vₙ − 2γ²/(1+γ²) P u, u = v − W × ν/γ, W⁺ = W − ν × p/γ, per unit mass
            let (gamma, share) = (ball.gamma(), 2.0 * gamma_squared / (1.0 + gamma_squared));
            let u = v - w.cross(&nu) / gamma;
            let p = nu * (-2.0 * v.dot(&nu)) - roughness.projector(&contact.normal) * u * share;
            prop_assert!((after.linear - (v + p)).norm() <= 8.0 * ROUNDING);
            prop_assert!((ball.scaled_spin(&after) - (w - nu.cross(&p) / gamma)).norm() <= 8.0 * ROUNDING / gamma);
            // the spin about the normal never changes
            prop_assert!((ball.scaled_spin(&after) - w).dot(&nu).abs() <= 8.0 * ROUNDING / gamma);
        }
    }
}

/// `cos β` and `sin β` of a ball without slip.
fn angle<const N: usize>(ball: &Ball<N>) -> [f64; 2] {
    let map = NoSlip.disk_map(ball.gamma());
    [map.tangent_tangent, map.tangent_spin]
}

#[test]
fn balls_turn_by_the_angles_of_the_theory() {
    let near = |found: [f64; 2], expected: [f64; 2]| assert_abs_diff_eq!(found[..], expected[..], epsilon = ROUNDING);
    near(angle(&Ball::<2>::uniform(1.0, 2.0).unwrap()), [1.0 / 3.0, 8.0_f64.sqrt() / 3.0]);
    near(angle(&Ball::<3>::uniform(1.0, 2.0).unwrap()), [3.0 / 7.0, 40.0_f64.sqrt() / 7.0]);
    near(angle(&Ball::<3>::shell(1.0, 2.0).unwrap()), [0.2, 0.96_f64.sqrt()]);
    near(angle(&Ball::<2>::shell(1.0, 2.0).unwrap()), [0.0, 1.0]);
    near(angle(&Ball::<4>::uniform(1.0, 2.0).unwrap()), [0.5, 0.75_f64.sqrt()]);
    for (n, cos) in
        [(2, angle(&Ball::<2>::uniform(1.0, 1.0).unwrap())[0]), (5, angle(&Ball::<5>::uniform(1.0, 1.0).unwrap())[0])]
    {
        assert_abs_diff_eq!(cos, f64::from(n) / f64::from(n + 4), epsilon = ROUNDING);
    }
}

#[test]
fn no_slip_is_the_papers_update() {
    // Cox and Feres, equation (2.1): v₀⁺ = −v₀/3 + (2√2/3) v·Jν, v⁺ = [(2√2/3) v₀ + (1/3) v·Jν] Jν − (v·ν) ν
    let (third, off) = (1.0 / 3.0, 8.0_f64.sqrt() / 3.0);
    let found = through_the_pair(&NoSlip, 0.5_f64.sqrt(), Vector2::new(0.6, 0.8), [0.25, -0.5, -2.0]);
    let expected = [-0.25 * third - 0.5 * off, 0.25 * off - 0.5 * third, 2.0];
    assert_abs_diff_eq!(found[..], expected[..], epsilon = ROUNDING);
}

#[test]
fn restitution_of_modulus_one_is_strict() {
    let map = |normal, tangential| Restitution::new(normal, tangential).unwrap().disk_map(0.7);
    assert_eq!(map(1.0, 1.0), NoSlip.disk_map(0.7));
    assert_eq!(map(1.0, -1.0), Specular.disk_map(0.7));
    for (normal, tangential, strict) in [(1.0, 1.0, true), (1.0, -1.0, true), (1.0, 0.5, false), (0.5, -1.0, false)] {
        let law = AnyLaw::<3>::new(Restitution::new(normal, tangential).unwrap());
        let mixed = |other: AnyLaw<3>| PerSurface::new(law.clone()).with(3, other);
        assert_eq!(law.is_strict(), strict, "{normal} {tangential}");
        assert_eq!(mixed(AnyLaw::new(NoSlip)).is_strict(), strict, "{normal} {tangential}");
        assert!(!mixed(AnyLaw::new(Restitution::new(0.9, 1.0).unwrap())).is_strict(), "{normal} {tangential}");
    }
}

#[test]
fn a_law_chosen_at_run_time_gives_the_same_bits() {
    let v = [0.3, -0.2, -0.9];
    let normal = Vector2::new(0.6, -0.8);
    let boxed: Box<dyn StrictLaw<2>> = Box::new(NoSlip);
    let direct = through_the_pair(&NoSlip, 0.6, normal, v);
    assert_eq!(direct, through_the_pair(&boxed, 0.6, normal, v));
    assert_eq!(direct, through_the_pair(&AnyLaw::new(NoSlip), 0.6, normal, v));
}

#[test]
fn a_wall_on_either_side_is_the_same_wall() {
    let ball = Ball::<4>::uniform(2.0, 0.5).unwrap();
    let nu = SVector::<f64, 4>::new(0.5, -0.5, 0.5, 0.5);
    let v = Twist::with_spin_coordinates(SVector::<f64, 4>::new(0.1, 0.9, -0.4, 0.3), &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
        .unwrap();
    let at = |normal| Contact::new(SVector::zeros(), normal, 0).unwrap();
    let first = Pair::new(at(nu), (ball, -nu * 0.5), (Fixed, nu)).collide(&NoSlip, &(v, ()));
    let second = Pair::new(at(-nu), (Fixed, nu), (ball, -nu * 0.5)).collide(&NoSlip, &((), v));
    assert_eq!((first.velocities.0, first.impulse), (second.velocities.1, -second.impulse));
}

//! Bodies that hardly resist turning: how many digits of a collision are left, against exact solutions.

use collision_laws::{
    CollisionLaw, Contact, Fixed, Pair, Twist,
    bodies::{Inertia, RigidBody, Spatial},
    check::{self, Samples},
    laws::{NoSlip, Restitution, RoughPlane},
};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

#[test]
fn a_partly_rough_law_is_strict_however_small_the_inertia() {
    let contact = Contact::new(Vector3::zeros(), Vector3::new(1.0, 2.0, 2.0), 0).unwrap();
    let (nu, radius) = (contact.normal.into_inner(), 3.0);
    let law = RoughPlane::new(&[Vector3::new(1.0, 0.3, -0.2)]).unwrap();
    let projector = law.at(&contact).unwrap().projector(&contact.normal);
    let (v, w) = (Vector3::new(-1.0, -0.7, -0.9), Vector3::new(0.7, -0.3, 0.2));
    for exponent in 0..=12 {
        let gamma_squared = libm::exp10(-f64::from(exponent));
        let tensor = Matrix3::identity() * (gamma_squared * radius * radius);
        let body = RigidBody::<3>::new(1.0, Inertia::Tensor(tensor)).unwrap();
        let pair = Pair::new(contact, (body, -nu * radius), (Fixed, Vector3::zeros()));
        let before = (Twist::spatial(v, w), ());
        let found = pair.try_collide(&law, &before).unwrap();
        // of a ball: p = −2ν (ν·v) − 2γ²/(1+γ²) P u and w⁺ = w − ν × p/(γ² R), per unit mass
        let slip = projector * (v - w.cross(&nu) * radius) * (2.0 / (1.0 + gamma_squared));
        let (impulse, spin) = (-nu * (2.0 * v.dot(&nu)) - slip * gamma_squared, w + nu.cross(&slip) / radius);
        let (p, after) = (found.impulse, found.velocities);
        let allowed = 16.0 * f64::EPSILON;
        assert!((p - impulse).norm() <= allowed * impulse.norm(), "1e-{exponent}: {p}");
        let off = p - projector * p - nu * nu.dot(&p);
        assert!(off.norm() <= allowed * p.norm(), "1e-{exponent}: {off}");
        // a normal turned by ε turns the impulse by as much, and that the spin by ε/γ²
        let error = (after.0.angular_velocity() - spin).norm();
        assert!(error <= allowed * (1.0 + 1.0 / gamma_squared) * spin.norm(), "1e-{exponent}: {error:e}");
        let gain = pair.kinetic_energy(&after) / pair.kinetic_energy(&before) - 1.0;
        assert!(gain.abs() <= allowed, "1e-{exponent}: {gain:e}");
        let back = pair.collide(&law, &after).velocities.0.linear - v;
        assert!(back.norm() <= allowed * (1.0 + gamma_squared.sqrt().recip()), "1e-{exponent}: {back}");
        let report = check::law(&pair, &law, Samples { count: 4, seed: 0 });
        assert!(report.is_strict(check::tolerance(&pair)), "1e-{exponent}:\n{report}");
    }
}

#[test]
fn the_spin_without_slip_keeps_its_digits_however_small_the_inertia() {
    fn in_dimension<const N: usize>() {
        let of = |i: usize, j: usize| ((7 * i * i + 5 * j + 3 * i * j) % 11) as f64 / 8.0 - 0.625;
        let root = SMatrix::<f64, N, N>::from_fn(of);
        let moments = root * root.transpose() + SMatrix::identity() * 0.5;
        let arm = SVector::<f64, N>::from_fn(|i, _| of(i, i + 2) + 0.3);
        let v = SVector::<f64, N>::from_fn(|i, _| of(i + 1, 4));
        let spin = SMatrix::<f64, N, N>::from_fn(|i, j| of(i, j) - of(j, i));
        for exponent in 0..=13 {
            let s = moments * libm::exp10(-f64::from(exponent));
            let body = RigidBody::new(1.0, Inertia::SecondMoments(s)).unwrap();
            let contact = Contact::new(SVector::zeros(), SVector::from_fn(|i, _| of(2 * i, 1) + 0.1), 0).unwrap();
            let pair = Pair::new(contact, (body, arm), (Fixed, SVector::zeros()));
            let before = (Twist::from_skew(v, &spin), ());
            let half = Restitution::new(0.5, 0.5).unwrap();
            for (share, law) in [(1.0, &NoSlip as &dyn CollisionLaw<N>), (0.5, &half)] {
                let found = pair.collide(law, &before);
                let case = format!("dimension {N}, 1e-{exponent}, {share}");
                let left = pair.contact_velocity(&found.velocities) + found.u_minus * share;
                assert!(left.norm() <= 16.0 * f64::EPSILON * found.u_minus.norm(), "{case}: {left}");
                // the angular momentum that it gained is p ∧ r: none is in the planes across the arm
                let gained = found.velocities.0.spin() - before.0.spin();
                let momentum = s * gained + gained * s;
                let aside = SMatrix::identity() - arm * arm.transpose() / arm.norm_squared();
                let defect = (aside * momentum * aside).norm() / (s.norm() * gained.norm());
                assert!(defect <= 64.0 * f64::EPSILON, "{case}: {defect:e}");
            }
        }
    }
    in_dimension::<3>();
    in_dimension::<4>();
    in_dimension::<5>();
}

#[test]
fn an_impulse_does_not_turn_a_body_in_space_about_its_arm() {
    let tensor = Matrix3::new(2.0, 0.3, -0.2, 0.3, 1.5, 0.4, -0.2, 0.4, 1.7);
    let arm = Vector3::new(0.3, -0.7, 0.45);
    let contact = Contact::new(Vector3::zeros(), Vector3::new(0.1, 0.5, 0.2), 0).unwrap();
    let before = (Twist::spatial(Vector3::new(-0.4, -0.9, 0.3), Vector3::new(0.7, -0.3, 0.2)), ());
    for exponent in 0..=13 {
        let inertia = tensor * libm::exp10(-f64::from(exponent));
        let pair = Pair::new(contact, (Spatial::new(1.0, inertia).unwrap(), arm), (Fixed, Vector3::zeros()));
        let after = pair.collide(&NoSlip, &before).velocities;
        let gained = after.0.angular_velocity() - before.0.angular_velocity();
        let about = (inertia * gained).dot(&arm) / (inertia.norm() * gained.norm() * arm.norm());
        assert!(about.abs() <= 64.0 * f64::EPSILON, "1e-{exponent}: {about:e}");
    }
}

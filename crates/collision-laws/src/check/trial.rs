//! Trying laws, maps and bodies on random velocities.

use super::{Axiom, Report, TOLERANCE, axioms, report::worse};
use crate::{
    Body, CollisionLaw, Contact, Delassus, Fixed, Pair, Roughness, TangentSpace, TangentVector, random::gaussian,
    reflect,
};
use nalgebra::{DVector, SMatrix, SVector};
use rand_chacha::{ChaCha8Rng, rand_core::SeedableRng};

/// Which random velocities to try: the same for the same seed, on every machine.
///
/// A defect is found only if one of the samples shows it. For a law with one formula 16 are plenty; a law that switches between several,
/// such as no-slip here and specular there, needs some hundred, so that pairs of velocities lie on both sides of every switch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Samples {
    /// How many.
    pub count: usize,
    /// The seed.
    pub seed: u64,
}

impl Default for Samples {
    fn default() -> Self {
        Self { count: 16, seed: 0 }
    }
}

/// The defect that rounding may cause at a contact: [`TOLERANCE`] or, if that is larger, 1e-12 times the larger of two square roots: that
/// of the [condition number](crate::Delassus::condition_number) of `K`, and that of the ratio of the principal moments of a slender body
/// that lies askew.
///
/// A velocity of unit length in the metric turns a body with little inertia so fast that the contact velocity is the first root times as
/// large, and rounded accordingly. If a slender body lies along no axis of space, each coordinate of its spin is the second root times as
/// large as the spin that another body of that energy has, and rounded accordingly. The derivatives of the measure check multiply the
/// rounding by 10³. If a condition number or ratio exceeds 1/ε no tolerance would be meaningful, and this one grows no further.
pub fn tolerance<A: Body<N>, B: Body<N>, const N: usize>(pair: &Pair<A, B, N>) -> f64 {
    let roots = pair.delassus().condition_number().sqrt().max(pair.tangent_space().rounding());
    TOLERANCE.max(1e-12 * roots.min(1.0 / f64::EPSILON.sqrt()))
}

/// A velocity of unit length in the metric, uniformly distributed in direction, in unit coordinates.
fn direction(size: usize, stream: &mut ChaCha8Rng) -> DVector<f64> {
    DVector::from_fn(size, |_, _| gaussian(stream)).normalize()
}

/// A velocity of approach with `|v|² = 2` (energy 1), in coordinates.
fn approach<const N: usize>(space: &TangentSpace<N>, stream: &mut ChaCha8Rng) -> DVector<f64> {
    let mut y = direction(space.dimension(), stream) * 2.0_f64.sqrt();
    if space.normal().dot(&y) > 0.0 {
        y = -y;
    }
    space.from_unit(&y)
}

/// How far `law` is from each axiom, and from what it tells of itself ([`Report::told`]), for these two bodies at this contact.
///
/// Energy, momenta, the direction of the image, linearity and measure are tested at approaching velocities; the involution also needs the
/// law at the receding velocities that result. Two immovable bodies have no velocities, so no axiom is broken.
pub fn law<A: Body<N>, B: Body<N>, L: CollisionLaw<N> + ?Sized, const N: usize>(
    pair: &Pair<A, B, N>,
    law: &L,
    samples: Samples,
) -> Report {
    let collide = |x: &DVector<f64>| {
        let v = pair.velocities(x.as_slice());
        pair.coordinates(&pair.collide(law, &v).velocities)
    };
    let space = pair.tangent_space();
    let mut report = map(&space, collide, samples);
    let (delassus, mut stream) = (pair.delassus(), ChaCha8Rng::seed_from_u64(samples.seed));
    for _ in 0..if space.dimension() == 0 { 0 } else { samples.count } {
        let v = pair.velocities(approach(&space, &mut stream).as_slice());
        report.note_told(told(law, &pair.contact, &delassus, &pair.contact_velocity(&v)));
    }
    report
}

/// How far the impulse of a law is from the sum of the reflections that it names, and from the normal and the directions in which it
/// pushes; relative to its length.
fn told<L: CollisionLaw<N> + ?Sized, const N: usize>(
    law: &L,
    contact: &Contact<N>,
    delassus: &Delassus<N>,
    u: &SVector<f64, N>,
) -> f64 {
    let impulse = law.impulse(contact, delassus, u);
    let along = law.pushes(contact).projector(&contact.normal) * impulse;
    let aside = impulse - along - contact.normal.as_ref() * contact.normal.dot(&impulse);
    let reflections = law.reflections(contact);
    let sum = |all: SVector<f64, N>, (w, r): &(f64, Roughness<N>)| all + reflect(r, contact, delassus, u) * *w;
    let other = if reflections.is_empty() { impulse } else { reflections.iter().fold(SVector::zeros(), sum) };
    let (aside, off) = (aside.norm(), (impulse - other).norm());
    relative(if worse(off, aside) { off } else { aside }, impulse.norm())
}

/// How far a map of `T_qM`, given as a program in the coordinates of [`Pair::coordinates`], is from each axiom.
pub fn map<const N: usize>(
    space: &TangentSpace<N>,
    map: impl Fn(&DVector<f64>) -> DVector<f64>,
    samples: Samples,
) -> Report {
    let mut stream = ChaCha8Rng::seed_from_u64(samples.seed);
    let mut report = Report::EMPTY;
    if space.dimension() == 0 {
        return report;
    }
    for _ in 0..samples.count {
        let v = approach(space, &mut stream);
        let w = approach(space, &mut stream);
        let after = map(&v);
        report.note(Axiom::Energy, axioms::energy(space, &v, &after));
        if let Some(defect) = axioms::linear_momentum(space, &v, &after) {
            report.note(Axiom::LinearMomentum, defect);
        }
        if let Some(defect) = axioms::angular_momentum(space, &v, &after) {
            report.note(Axiom::AngularMomentum, defect);
        }
        report.note(Axiom::Involution, axioms::involution(space, &map, &v));
        report.note(Axiom::OutgoingToIngoing, axioms::outgoing_to_ingoing(space, &v, &after));
        report.note(Axiom::ContactImpulse, axioms::contact_impulse(space, &v, &after));
        report.note(Axiom::Linearity, axioms::linearity(space, &map, &v, &w));
        report.note_measure_ratio(axioms::measure_ratio(space, &map, &v), 0.0);
    }
    report
}

/// How well the maps of a [`Body`] fit together; all numbers are zero up to rounding, and exactly zero for an immovable body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyReport {
    /// `|J(v + G⁻¹Jᵀp) − u − K p|`, relative to the terms.
    pub contact_velocity: f64,
    /// The work of the impulse against the gain of energy: `|E⁺ − E − p·(u + u⁺)/2|`, relative to the energies.
    pub work: f64,
    /// The largest `|Kᵢⱼ − Kⱼᵢ|`, relative to the largest entry.
    pub symmetry: f64,
    /// How far the contact point of the body strays from the point of space it touches, in rigid motions of all space; 0 for a body that
    /// is not [free](Body::is_free) and takes no part in them.
    pub rigid_motion: f64,
}

impl BodyReport {
    /// The largest of the numbers.
    pub fn worst(&self) -> f64 {
        let all = [self.contact_velocity, self.work, self.symmetry, self.rigid_motion];
        all.into_iter().fold(0.0, |worst, x| if worse(x, worst) { x } else { worst })
    }
}

/// `defect / size`; 0 for 0/0.
fn relative(defect: f64, size: f64) -> f64 {
    if defect == 0.0 && size == 0.0 { 0.0 } else { defect / size }
}

/// Whether the four maps of a body belong together, at one contact with the given arm, for random velocities and impulses.
pub fn body<B: Body<N>, const N: usize>(
    body: &B,
    contact: &Contact<N>,
    arm: &SVector<f64, N>,
    samples: Samples,
) -> BodyReport {
    let mut stream = ChaCha8Rng::seed_from_u64(samples.seed);
    let pair = Pair::new(*contact, (body, *arm), (Fixed, SVector::zeros()));
    let space = pair.tangent_space();
    let delassus = pair.delassus();
    let k = delassus.to_matrix(&contact.normal);
    let moves = k != SMatrix::<f64, N, N>::zeros();
    let mut report = BodyReport {
        contact_velocity: 0.0,
        work: 0.0,
        symmetry: if moves { (k - k.transpose()).amax() / k.amax() } else { 0.0 },
        rigid_motion: 0.0,
    };
    // a spin that moves the contact about as fast as the translation does
    let spin_scale = if arm.norm() > 0.0 { 1.0 / arm.norm() } else { 1.0 };
    let raise = |worst: &mut f64, x: f64| {
        if worse(x, *worst) {
            *worst = x;
        }
    };
    for _ in 0..samples.count {
        let v = pair.velocities(approach(&space, &mut stream).as_slice());
        let p = SVector::<f64, N>::from_fn(|_, _| gaussian(&mut stream));
        // an impulse that carries about as much energy as the velocity; on an immovable body no impulse carries any
        let p = if moves { p / p.dot(&(k * p)).sqrt() } else { p };
        let after = pair.apply_impulse(&p, &v);
        let (u, u_after, change) =
            (pair.contact_velocity(&v), pair.contact_velocity(&after), delassus.apply(&contact.normal, &p));
        let gap = (u_after - u - change).norm();
        raise(&mut report.contact_velocity, relative(gap, u.norm() + u_after.norm() + change.norm()));

        let (before, gained) = (pair.kinetic_energy(&v), pair.kinetic_energy(&after));
        let work = p.dot(&(u + u_after)) * 0.5;
        raise(&mut report.work, relative((gained - before - work).abs(), gained + before));

        if !body.is_free() {
            continue;
        }
        let a = SVector::<f64, N>::from_fn(|_, _| gaussian(&mut stream));
        let turn = SMatrix::<f64, N, N>::from_fn(|_, _| gaussian(&mut stream)) * spin_scale;
        let moving = B::Velocity::of_rigid_motion(arm, &a, &(turn - turn.transpose()));
        raise(&mut report.rigid_motion, (body.contact_velocity(arm, &moving) - a).norm() / a.norm());
    }
    report
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Delassus, Twist,
        bodies::{Planar, Point},
    };
    use nalgebra::{Unit, Vector2, Vector3};

    fn tried<B: Body<3>>(body: &B) -> BodyReport {
        let contact = Contact::new(Vector3::zeros(), Vector3::z(), 0).unwrap();
        super::body(body, &contact, &Vector3::zeros(), Samples::default())
    }

    #[test]
    fn the_maps_of_a_body_that_nothing_moves_fit_together() {
        let nothing = BodyReport { contact_velocity: 0.0, work: 0.0, symmetry: 0.0, rigid_motion: 0.0 };
        assert_eq!([tried(&Fixed), tried(&None::<Point>)], [nothing; 2]);
    }

    /// A disk whose maps are off, each by a factor.
    struct Liar {
        inertia: f64,
        spin: f64,
        answer: f64,
    }

    impl Body<2> for Liar {
        type Velocity = Twist<2>;
        fn inner_product(&self, v: &Twist<2>, w: &Twist<2>) -> f64 {
            disk().inner_product(v, w) * self.inertia
        }
        fn contact_velocity(&self, arm: &Vector2<f64>, v: &Twist<2>) -> Vector2<f64> {
            v.linear + (v.at(arm) - v.linear) * self.spin
        }
        fn apply_impulse(&self, arm: &Vector2<f64>, p: &Vector2<f64>, v: &Twist<2>) -> Twist<2> {
            disk().apply_impulse(arm, &(p * self.answer), v)
        }
        fn delassus(&self, arm: &Vector2<f64>, normal: &Unit<Vector2<f64>>) -> Delassus<2> {
            disk().delassus(arm, normal)
        }
    }

    fn disk() -> Planar {
        Planar::new(2.0, 0.75).unwrap()
    }

    #[test]
    fn each_way_in_which_the_maps_of_a_body_do_not_fit_is_found_out() {
        let contact = Contact::new(Vector2::zeros(), Vector2::new(0.6, 0.8), 0).unwrap();
        for unit in [1.0, 1e-3, 1e3] {
            let tried = |inertia, spin, answer| {
                let arm = Vector2::new(-0.7, 0.3) * unit;
                super::body(&Liar { inertia, spin, answer }, &contact, &arm, Samples::default())
            };
            let wrong = |report: BodyReport| {
                [report.contact_velocity, report.work, report.symmetry, report.rigid_motion].map(|x| x > 1e-3)
            };
            // the true maps; the metric of something else; a spin that turns the arm the other way; the response to twice the impulse
            assert_eq!(wrong(tried(1.0, 1.0, 1.0)), [false, false, false, false]);
            assert_eq!(wrong(tried(2.0, 1.0, 1.0)), [false, true, false, false]);
            assert!(tried(1.0, -1.0, 1.0).rigid_motion > 0.1);
            assert_eq!(wrong(tried(1.0, 1.0, 2.0)), [true, true, false, false]);
            for report in [tried(2.0, 1.0, 1.0), tried(1.0, -1.0, 1.0), tried(1.0, 1.0, 2.0)] {
                let all = [report.contact_velocity, report.work, report.symmetry, report.rigid_motion];
                assert_eq!(report.worst(), all.into_iter().fold(0.0, f64::max));
            }
        }
    }

    #[test]
    fn what_a_body_gets_wrong_does_not_depend_on_the_unit_of_mass() {
        /// The same disk of another mass, turning the wrong way.
        struct Heavy(Planar);
        impl Body<2> for Heavy {
            type Velocity = Twist<2>;
            fn inner_product(&self, v: &Twist<2>, w: &Twist<2>) -> f64 {
                self.0.inner_product(v, w)
            }
            fn contact_velocity(&self, arm: &Vector2<f64>, v: &Twist<2>) -> Vector2<f64> {
                v.at(&-arm)
            }
            fn apply_impulse(&self, arm: &Vector2<f64>, p: &Vector2<f64>, v: &Twist<2>) -> Twist<2> {
                self.0.apply_impulse(arm, p, v)
            }
            fn delassus(&self, arm: &Vector2<f64>, normal: &Unit<Vector2<f64>>) -> Delassus<2> {
                self.0.delassus(arm, normal)
            }
        }
        let contact = Contact::new(Vector2::zeros(), Vector2::new(0.6, 0.8), 0).unwrap();
        let report = |unit: f64| {
            let body = Heavy(Planar::new(2.0 * unit, 0.75 * unit).unwrap());
            super::body(&body, &contact, &Vector2::new(-0.7, 0.3), Samples::default())
        };
        assert!(report(1.0).contact_velocity > 0.1);
        for unit in [libm::ldexp(1.0, 40), libm::ldexp(1.0, -40)] {
            assert_eq!(report(unit), report(1.0)); // a power of four changes no bit
        }
    }

    #[test]
    fn a_body_that_moves_though_its_operator_says_that_nothing_does_is_found_out() {
        struct Ghost;
        impl Body<3> for Ghost {
            type Velocity = Vector3<f64>;
            fn inner_product(&self, v: &Vector3<f64>, w: &Vector3<f64>) -> f64 {
                v.dot(w)
            }
            fn apply_impulse(&self, _: &Vector3<f64>, p: &Vector3<f64>, v: &Vector3<f64>) -> Vector3<f64> {
                v + p
            }
            fn delassus(&self, _: &Vector3<f64>, _: &Unit<Vector3<f64>>) -> Delassus<3> {
                Delassus::ZERO
            }
        }
        assert!(tried(&Ghost).contact_velocity > 0.1);
    }
}

//! Bodies that are hit far from their centres: velocities and impulse have the digits that the numbers given determine.
//!
//! The exact collision is computed in twice the precision, from the whole mass matrix of each body, and once more for each of some changes
//! of all numbers by at most half a unit in the last place. A result may be off by a few times the largest effect of such a change.

use collision_laws::{
    CollisionLaw, Contact, Error, Pair, Twist,
    bodies::{Inertia, RigidBody},
    laws::{NoSlip, Restitution, RoughPlane, Specular},
};
use lanes::Double;
use nalgebra::{SMatrix, SVector};
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{Rng, SeedableRng},
};

/// Roundings in the collision for one in the numbers given.
const ROUNDINGS: f64 = 16.0;

/// One body and its motion.
struct Moving<const N: usize> {
    mass: f64,
    /// The second moments per unit mass.
    moments: SMatrix<f64, N, N>,
    arm: SVector<f64, N>,
    velocity: SVector<f64, N>,
    spin: SMatrix<f64, N, N>,
}

/// Uniform on [−1, 1).
fn uniform(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

fn vector<const N: usize>(random: &mut ChaCha8Rng) -> SVector<f64, N> {
    SVector::from_fn(|_, _| uniform(random))
}

impl<const N: usize> Moving<N> {
    /// A body of about unit size and mass, with an arm of length `arm`.
    fn at(arm: f64, random: &mut ChaCha8Rng) -> Self {
        let root = SMatrix::<f64, N, N>::from_fn(|_, _| uniform(random));
        let turning = SMatrix::<f64, N, N>::from_fn(|_, _| uniform(random));
        let direction = vector::<N>(random);
        Self {
            mass: 1.5 + uniform(random),
            moments: root * root.transpose() + SMatrix::identity() * 0.25,
            arm: direction * (arm / direction.norm()),
            velocity: vector(random),
            spin: turning - turning.transpose(),
        }
    }

    fn body(&self) -> RigidBody<N> {
        RigidBody::new(self.mass, Inertia::SecondMoments(self.moments)).unwrap()
    }
}

/// The planes of axes i > j.
fn planes<const N: usize>() -> Vec<(usize, usize)> {
    (0..N).flat_map(|i| (0..i).map(move |j| (i, j))).collect()
}

type Matrix = Vec<Vec<Double>>;

const ZERO: Double = Double { high: 0.0, low: 0.0 };

fn sum(terms: impl Iterator<Item = Double>) -> Double {
    terms.fold(ZERO, Double::plus)
}

fn dot(a: &[Double], b: &[Double]) -> Double {
    sum(a.iter().zip(b).map(|(a, b)| a.times(*b)))
}

/// The solution of `a x = b` for a symmetric positive `a`, by elimination.
fn solve(mut a: Matrix, mut b: Vec<Double>) -> Vec<Double> {
    let size = b.len();
    for k in 0..size {
        for i in k + 1..size {
            let factor = -a[i][k].over(a[k][k]);
            for j in k..size {
                a[i][j] = a[i][j].plus(factor.times(a[k][j]));
            }
            b[i] = b[i].plus(factor.times(b[k]));
        }
    }
    for k in (0..size).rev() {
        let rest = dot(&a[k][k + 1..], &b[k + 1..]);
        b[k] = b[k].plus(-rest).over(a[k][k]);
    }
    b
}

/// A body in twice the precision: each of its numbers `x` is `change(x)`.
struct Exact {
    mass: Double,
    /// The matrix of the moments of inertia, plane by plane.
    turning: Matrix,
    arm: Vec<Double>,
    velocity: Vec<Double>,
    spin: Vec<Double>,
}

impl Exact {
    fn of<const N: usize>(it: &Moving<N>, change: &mut dyn FnMut(f64) -> Double) -> Self {
        let mass = change(it.mass);
        let mut s = vec![vec![ZERO; N]; N];
        for i in 0..N {
            for j in 0..=i {
                s[i][j] = change(it.moments[(i, j)]);
                s[j][i] = s[i][j];
            }
        }
        let planes = planes::<N>();
        // half the trace of (S A + A S) Bᵀ, A and B the unit rotations in two planes
        let entry = |(i, j): (usize, usize), (k, l): (usize, usize)| {
            let if_same = |a: usize, b: usize, x: Double| if a == b { x } else { ZERO };
            let terms =
                [if_same(j, l, s[i][k]), -if_same(j, k, s[i][l]), if_same(i, k, s[j][l]), -if_same(i, l, s[j][k])];
            sum(terms.into_iter()).times(mass)
        };
        Self {
            mass,
            turning: planes.iter().map(|a| planes.iter().map(|b| entry(*a, *b)).collect()).collect(),
            arm: it.arm.iter().map(|x| change(*x)).collect(),
            velocity: it.velocity.iter().map(|x| change(*x)).collect(),
            spin: planes.iter().map(|ij| change(it.spin[*ij])).collect(),
        }
    }

    /// The velocity of the touching point.
    fn contact_velocity<const N: usize>(&self) -> Vec<Double> {
        let mut u = self.velocity.clone();
        for ((i, j), w) in planes::<N>().into_iter().zip(&self.spin) {
            u[i] = u[i].plus(w.times(self.arm[j]));
            u[j] = u[j].plus(-w.times(self.arm[i]));
        }
        u
    }

    /// The body after the impulse `p`.
    fn pushed<const N: usize>(&self, p: &[Double]) -> Self {
        let torque =
            planes::<N>().into_iter().map(|(i, j)| p[i].times(self.arm[j]).plus(-p[j].times(self.arm[i]))).collect();
        let gained = solve(self.turning.clone(), torque);
        Self {
            mass: self.mass,
            turning: self.turning.clone(),
            arm: self.arm.clone(),
            velocity: self.velocity.iter().zip(p).map(|(v, p)| v.plus(p.over(self.mass))).collect(),
            spin: self.spin.iter().zip(gained).map(|(w, gained)| w.plus(gained)).collect(),
        }
    }

    /// The same body at rest.
    fn at_rest(&self) -> Self {
        Self {
            mass: self.mass,
            turning: self.turning.clone(),
            arm: self.arm.clone(),
            velocity: vec![ZERO; self.velocity.len()],
            spin: vec![ZERO; self.spin.len()],
        }
    }
}

fn minus(a: &[Double], b: &[Double]) -> Vec<Double> {
    a.iter().zip(b).map(|(a, b)| a.plus(-*b)).collect()
}

/// The impulse that reverses the contact velocity on the span of `directions`, in that span.
fn reversing<const N: usize>(pair: &[Exact; 2], directions: &[Vec<Double>]) -> Vec<Double> {
    let response = |p: &Vec<Double>| {
        let back: Vec<Double> = p.iter().map(|x| -*x).collect();
        let [first, second] = [pair[0].at_rest().pushed::<N>(p), pair[1].at_rest().pushed::<N>(&back)];
        minus(&first.contact_velocity::<N>(), &second.contact_velocity::<N>())
    };
    let responses: Matrix = directions.iter().map(response).collect();
    let u = minus(&pair[0].contact_velocity::<N>(), &pair[1].contact_velocity::<N>());
    let k = directions.iter().map(|a| responses.iter().map(|b| dot(a, b)).collect()).collect();
    let wanted = directions.iter().map(|a| dot(a, &u).times(Double::new(-2.0))).collect();
    let share = solve(k, wanted);
    (0..N).map(|i| sum(directions.iter().zip(&share).map(|(a, x)| a[i].times(*x)))).collect()
}

/// How a law reflects: the weight of each reflection, and what it reverses besides the normal.
type Reflections<const N: usize> = Vec<(f64, Vec<SVector<f64, N>>)>;

/// Impulse, velocity and spin of the first body, velocity and spin of the second.
type Outcome = [Vec<Double>; 5];

fn exact<const N: usize>(
    bodies: &[Moving<N>; 2],
    normal: &SVector<f64, N>,
    law: &Reflections<N>,
    change: &mut dyn FnMut(f64) -> Double,
) -> Outcome {
    let pair = [Exact::of(&bodies[0], change), Exact::of(&bodies[1], change)];
    let normal: Vec<Double> = normal.iter().map(|x| change(*x)).collect();
    let mut p = vec![ZERO; N];
    for (weight, rough) in law {
        let mut directions = vec![normal.clone()];
        directions.extend(rough.iter().map(|d| d.iter().map(|x| change(*x)).collect::<Vec<_>>()));
        let part = reversing::<N>(&pair, &directions);
        p = p.iter().zip(part).map(|(p, x)| p.plus(x.times(Double::new(*weight)))).collect();
    }
    let back: Vec<Double> = p.iter().map(|x| -*x).collect();
    let [first, second] = [pair[0].pushed::<N>(&p), pair[1].pushed::<N>(&back)];
    [p, first.velocity, first.spin, second.velocity, second.spin]
}

fn length(x: &[Double]) -> f64 {
    x.iter().map(|x| x.value() * x.value()).sum::<f64>().sqrt()
}

/// How many roundings the collision is off, by the worst of its results.
fn roundings<const N: usize>(
    bodies: &[Moving<N>; 2],
    normal: &SVector<f64, N>,
    (law, reflections): (&dyn CollisionLaw<N>, &Reflections<N>),
    random: &mut ChaCha8Rng,
) -> Result<f64, Error> {
    let contact = Contact::new(SVector::zeros(), *normal, 0)?;
    let [first, second] = bodies;
    let pair = Pair::new(contact, (first.body(), first.arm), (second.body(), second.arm));
    let before = (Twist::from_skew(first.velocity, &first.spin), Twist::from_skew(second.velocity, &second.spin));
    let found = pair.try_collide(law, &before)?;
    let list = |v: &SVector<f64, N>| v.iter().map(|x| Double::new(*x)).collect::<Vec<_>>();
    let spin = |v: &Twist<N>| planes::<N>().iter().map(|ij| Double::new(v.spin()[*ij])).collect::<Vec<_>>();
    let (a, b) = found.velocities;
    let found = [list(&found.impulse), list(&a.linear), spin(&a), list(&b.linear), spin(&b)];

    let expected = exact(bodies, normal, reflections, &mut Double::new);
    let mut allowed = expected.each_ref().map(|x| 0.5 * f64::EPSILON * length(x));
    for _ in 0..6 {
        let mut change = |x: f64| {
            let half = if uniform(random) < 0.0 { -0.5 } else { 0.5 };
            Double::new(x).plus(Double::new(half * f64::EPSILON * x))
        };
        let changed = exact(bodies, normal, reflections, &mut change);
        for ((allowed, changed), expected) in allowed.iter_mut().zip(&changed).zip(&expected) {
            *allowed = allowed.max(length(&minus(changed, expected)));
        }
    }
    let errors = found.iter().zip(&expected).map(|(found, expected)| length(&minus(found, expected)));
    Ok(errors.zip(allowed).map(|(error, allowed)| error / allowed).fold(0.0, f64::max))
}

fn is_singular(error: &Error) -> bool {
    matches!(error, Error::SingularDelassus { .. })
}

fn digits_are_kept_in_dimension<const N: usize>() {
    let mut random = ChaCha8Rng::seed_from_u64(N as u64);
    let axes: Vec<SVector<f64, N>> = (1..N).map(|i| SMatrix::<f64, N, N>::identity().column(i).into_owned()).collect();
    let restitution = Restitution::new(0.7, 0.3).unwrap();
    for exponent in 0..=8 {
        let arm = libm::exp10(f64::from(exponent));
        for sample in 0..24 {
            let bodies =
                [[1.0, arm], [arm, 0.5], [arm, 2.0 * arm]][sample % 3].map(|arm| Moving::<N>::at(arm, &mut random));
            let touching = |it: &Moving<N>| it.velocity + it.spin * it.arm;
            let u = touching(&bodies[0]) - touching(&bodies[1]);
            let mut normal = vector::<N>(&mut random);
            normal *= if normal.dot(&u) < 0.0 { 1.0 } else { -1.0 };
            let across = vector::<N>(&mut random);
            let combed = RoughPlane::new(&[across]).unwrap();
            let laws: [(&str, &dyn CollisionLaw<N>, Reflections<N>); 4] = [
                ("no-slip", &NoSlip, vec![(1.0, axes.clone())]),
                ("specular", &Specular, vec![(1.0, Vec::new())]),
                ("one rough direction", &combed, vec![(1.0, vec![across])]),
                ("restitution", &restitution, vec![(0.65, axes.clone()), (0.2, Vec::new())]),
            ];
            for (name, law, reflections) in &laws {
                let case = format!("dimension {N}, arm 1e{exponent}, sample {sample}, {name}");
                match roundings(&bodies, &normal, (*law, reflections), &mut random) {
                    Ok(roundings) => assert!(roundings <= ROUNDINGS, "{case}: {roundings}"),
                    // without the inverse of K nothing can be computed
                    Err(error) => assert!(exponent == 8 && is_singular(&error), "{case}: {error}"),
                }
            }
        }
    }
}

#[test]
fn a_body_hit_far_from_its_centre_keeps_all_digits() {
    digits_are_kept_in_dimension::<2>();
    digits_are_kept_in_dimension::<3>();
    digits_are_kept_in_dimension::<4>();
}

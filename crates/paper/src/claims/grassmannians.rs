//! The strict collision maps of two bodies.
use crate::{Claim, Effort, Measurement, Quantity, Verdict, random::Stream, statistics::worst};
use billiards::collision_laws::{
    Contact, Pair, Roughness, TangentSpace,
    bodies::{Inertia, RigidBody},
    check::TOLERANCE,
    classify,
    laws::Field,
};
use core::f64::consts::TAU;
use nalgebra::{DMatrix, DVector, SMatrix, SVector};

pub(super) const CLAIM: Claim = Claim {
    name: "grassmannians",
    place: "Theorem 1.1",
    statement: "The strict collision maps of two rigid bodies in contact are the disjoint union of the Grassmannians Gr(k, n−1), k = 0 … n−1; for \
                n = 2 there are two, the specular and the no-slip one.",
    verdict: Verdict::Holds,
    general_gamma: Some(
        "For any two bodies: C = 1 − 2P, P the orthogonal projector onto the impulses along the normal and k rough directions. \
                         The k-plane lies in the contact plane and does not depend on inertia.",
    ),
    measure,
};

type Free<const N: usize> = Pair<RigidBody<N>, RigidBody<N>, N>;

fn vector<const N: usize>(stream: &mut Stream) -> SVector<f64, N> {
    loop {
        let x: SVector<f64, N> = SVector::from_fn(|_, _| stream.between(-1.0, 1.0));
        if x.norm() > 0.3 {
            return x;
        }
    }
}

/// Two irregular bodies in contact.
fn pair<const N: usize>(stream: &mut Stream) -> Free<N> {
    let mut body = || {
        let frame = SMatrix::<f64, N, N>::from_fn(|_, _| stream.between(-1.0, 1.0));
        let moments = frame * frame.transpose() + SMatrix::identity() * 0.3;
        RigidBody::new(stream.between(0.5, 2.0), Inertia::SecondMoments((moments + moments.transpose()) * 0.5))
            .expect("a body")
    };
    let (first, second) = (body(), body());
    let contact = Contact::new(vector(stream), vector(stream), 0).expect("a normal");
    Pair::new(contact, (first, vector(stream)), (second, vector(stream)))
}

/// A matrix in unit coordinates, in coordinates.
fn in_coordinates<const N: usize>(space: &TangentSpace<N>, unit: &DMatrix<f64>) -> DMatrix<f64> {
    let size = unit.nrows();
    let column = |j| {
        let mut e = DVector::zeros(size);
        e[j] = 1.0;
        space.from_unit(&(unit * space.to_unit(&e)))
    };
    DMatrix::from_columns(&(0..size).map(column).collect::<Vec<_>>())
}

/// `1 − 2P`, `P` the orthogonal projector onto the span of the normal and of other vectors.
fn involution(normal: &DVector<f64>, others: &[DVector<f64>]) -> DMatrix<f64> {
    let mut basis = vec![normal.clone()];
    for other in others {
        let mut w = other.clone();
        for _ in 0..2 {
            for b in &basis {
                w -= b * b.dot(&w);
            }
        }
        basis.push(w.normalize());
    }
    basis.iter().fold(DMatrix::identity(normal.len(), normal.len()), |c, w| c - w * w.transpose() * 2.0)
}

/// What a sample of bodies shows in one dimension.
#[derive(Default)]
struct Tally {
    maps: usize,
    /// Involutions on the impulse space found strict, of the rank they were made with.
    strict: usize,
    /// The law of the rough directions found, against the map.
    law: Vec<f64>,
    /// Reflections in one direction more, which is no impulse at the contact, that were found strict.
    false_alarms: usize,
}

fn survey<const N: usize>(samples: usize, tally: &mut Tally) {
    for sample in 0..samples {
        let mut stream = Stream::new(100 + N as u64, sample);
        let pair = pair::<N>(&mut stream);
        let space = pair.tangent_space();
        let size = space.dimension();
        let random = |stream: &mut Stream, size| DVector::from_fn(size, |_, _| stream.between(-1.0, 1.0));
        for k in 0..N {
            let others: Vec<_> = (0..k).map(|_| space.impulse_space() * random(&mut stream, N)).collect();
            let map = in_coordinates(&space, &involution(space.normal(), &others));
            let found = classify(&space, &map, TOLERANCE).expect("a square matrix").strict;
            tally.maps += 1;
            if let Some(roughness) = found {
                tally.strict += usize::from(roughness.rank() == k);
                let law = Field::new(move |_: &Contact<N>| -> Roughness<N> { roughness });
                tally.law.push((pair.collision_map(&law) - &map).amax());
            }
            let elsewhere = [others, vec![random(&mut stream, size)]].concat();
            let map = in_coordinates(&space, &involution(space.normal(), &elsewhere));
            tally.false_alarms +=
                usize::from(classify(&space, &map, TOLERANCE).expect("a square matrix").strict.is_some());
        }
    }
}

/// In the plane: of all isometries of the impulse plane, by steps of a degree, the strict ones.
fn strict_isometries(sample: usize) -> usize {
    let pair = pair::<2>(&mut Stream::new(110, sample));
    let space = pair.tangent_space();
    let normal = space.normal();
    let first = space.impulse_space().column(0).clone_owned();
    let second = space.impulse_space().column(1).clone_owned();
    let along = [&first, &second].map(|b| normal.dot(b));
    let tangent = &second * along[0] - &first * along[1];
    let isometry = |degrees: i32, flip: f64| {
        let (sin, cos) = libm::sincos(TAU * f64::from(degrees) / 360.0);
        let images = [normal * cos + &tangent * sin, (&tangent * cos - normal * sin) * flip];
        let size = normal.len();
        DMatrix::identity(size, size)
            + (&images[0] - normal) * normal.transpose()
            + (&images[1] - &tangent) * tangent.transpose()
    };
    let is_strict = |map: &DMatrix<f64>| {
        classify(&space, &in_coordinates(&space, map), TOLERANCE).expect("a square matrix").strict.is_some()
    };
    (0..360).flat_map(|degrees| [isometry(degrees, 1.0), isometry(degrees, -1.0)]).filter(is_strict).count()
}

fn measure(effort: Effort) -> Measurement {
    let mut quantities = vec![];
    let samples = effort.of(20, 500);
    let mut note = |n: usize, tally: &Tally| {
        let label = |what: &str| format!("n = {n}, random bodies, all k: {what}");
        quantities.extend([
            Quantity::count(
                label("involutions of the impulse space found strict with their k"),
                tally.strict,
                tally.maps,
            ),
            // bodies of comparable size: condition numbers of ten to a thousand
            Quantity::residual(
                label("map against the law of the rough directions found"),
                worst(tally.law.iter().copied()),
                1e-10,
            ),
            Quantity::count(
                label("reflections in a direction that is no contact impulse, found strict"),
                tally.false_alarms,
                0,
            ),
        ]);
    };
    let mut in_dimension = |n: usize, survey: fn(usize, &mut Tally)| {
        let mut tally = Tally::default();
        survey(samples, &mut tally);
        note(n, &tally);
    };
    in_dimension(2, survey::<2>);
    in_dimension(3, survey::<3>);
    in_dimension(4, survey::<4>);
    in_dimension(5, survey::<5>);
    let pairs = effort.of(3, 30);
    let strict: usize = (0..pairs).map(strict_isometries).sum();
    quantities.push(Quantity::count(
        format!("n = 2, {pairs} pairs: strict ones among 720 isometries of the impulse plane each"),
        strict,
        2 * pairs,
    ));
    quantities.into()
}

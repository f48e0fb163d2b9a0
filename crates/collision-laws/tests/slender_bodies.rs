//! Bodies whose principal moments differ by many powers of ten: the checks must not take rounding for a broken axiom.

use collision_laws::{
    Body, CollisionLaw, Contact, Fixed, Pair,
    bodies::{Inertia, RigidBody},
    check::{self, Axiom, Samples},
    classify,
    laws::{NoSlip, Restitution, RoughPlane, Specular},
};
use nalgebra::{SMatrix, SVector};

/// A frame that is aligned with nothing: a turn in every plane of axes, by angles that `turn` sets.
fn askew<const N: usize>(turn: usize) -> SMatrix<f64, N, N> {
    let mut frame = SMatrix::identity();
    for i in 0..N {
        for j in 0..i {
            let (sin, cos) = libm::sincos((1 + 3 * turn + 5 * i + 7 * j) as f64);
            let mut rotation = SMatrix::<f64, N, N>::identity();
            (rotation[(i, i)], rotation[(j, j)]) = (cos, cos);
            (rotation[(i, j)], rotation[(j, i)]) = (sin, -sin);
            frame *= rotation;
        }
    }
    frame
}

/// `frame · diag · frameᵀ`, symmetric to the last bit.
fn turned<const N: usize>(frame: &SMatrix<f64, N, N>, diagonal: &SVector<f64, N>) -> SMatrix<f64, N, N> {
    let a = frame * SMatrix::from_diagonal(diagonal) * frame.transpose();
    (a + a.transpose()) * 0.5
}

/// A needle of length 1 and radius `radius` that touches a wall with its tip.
fn needle(radius: f64, turn: usize) -> Pair<RigidBody<3>, Fixed, 3> {
    let frame = askew::<3>(turn);
    let across = 0.25 * radius * radius;
    let moments = SVector::<f64, 3>::new(2.0 * across, 1.0 / 12.0 + across, 1.0 / 12.0 + across);
    let body = RigidBody::new(1.0, Inertia::Tensor(turned(&frame, &moments))).unwrap();
    let normal = askew::<3>(turn + 1).column(2).into_owned();
    let tip = frame.column(0) * 0.5;
    let arm = if tip.dot(&normal) > 0.0 { -tip } else { tip };
    Pair::new(Contact::new(SVector::zeros(), normal, 0).unwrap(), (body, arm), (Fixed, SVector::zeros()))
}

/// Two bodies whose second moments are `spread`, 1 and 1/`spread`, in turn.
fn slender<const N: usize>(spread: f64, turn: usize) -> Pair<RigidBody<N>, RigidBody<N>, N> {
    let [first, second] = [0, 1].map(|i| {
        let axes = SVector::from_fn(|j, _| [spread, 1.0, 1.0 / spread][(i + j + turn) % 3]);
        let s = turned(&askew::<N>(turn + 2 * i), &axes);
        let arm = askew::<N>(turn + 7 * i).column(1) * 1.5;
        (RigidBody::new(0.7 + i as f64, Inertia::SecondMoments(s)).unwrap(), arm)
    });
    let normal = askew::<N>(turn + 20).column(0).into_owned();
    Pair::new(Contact::new(SVector::zeros(), normal, 0).unwrap(), first, second)
}

/// Strict laws pass and one that loses a thousandth of the normal velocity does not, within a tolerance of at most `most`; the rank
/// of a law is read off its matrix.
fn only_strict_laws_are_strict<A: Body<N>, B: Body<N>, const N: usize>(pair: &Pair<A, B, N>, most: f64, case: &str) {
    let tolerance = check::tolerance(pair);
    assert!(tolerance <= most, "{case}: a tolerance of {tolerance:e}");
    let (normal, some) = (pair.contact.normal, Samples { count: 4, seed: 0 });
    let half = RoughPlane::new(&[askew::<N>(30).column(1).into_owned()]).unwrap();
    let laws: [(usize, &dyn CollisionLaw<N>); 3] = [(0, &Specular), (1, &half), (N - 1, &NoSlip)];
    for (rank, law) in laws {
        let report = check::law(pair, law, some);
        assert!(report.is_strict(tolerance), "{case}, rank {rank}, {tolerance:e}:\n{report}");
        let found = classify(&pair.tangent_space(), &pair.collision_map(law), tolerance).unwrap();
        let strict = found.strict.unwrap_or_else(|| panic!("{case}, rank {rank}:\n{}", found.report));
        assert_eq!(strict.rank(), rank, "{case}");
        let error = (strict.projector(&normal) - law.pushes(&pair.contact).projector(&normal)).amax();
        assert!(error <= tolerance, "{case}, rank {rank}: {error:e}");
    }
    let lossy = check::law(pair, &Restitution::new(0.999, 1.0).unwrap(), some);
    let broken: Vec<Axiom> = lossy.broken(tolerance).map(|(axiom, _)| axiom).collect();
    assert_eq!(broken, [Axiom::Energy, Axiom::Involution, Axiom::Measure], "{case}:\n{lossy}");
}

#[test]
fn strict_laws_are_strict_for_a_needle_askew() {
    for radius in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 2e-8] {
        for turn in 0..4 {
            // the root of the ratio of its moments is 0.4 / radius
            let most = 1e-9_f64.max(1e-12 / radius);
            only_strict_laws_are_strict(&needle(radius, turn), most, &format!("radius {radius:e}, turn {turn}"));
        }
    }
}

#[test]
fn strict_laws_are_strict_for_slender_bodies_in_any_dimension() {
    fn in_dimension<const N: usize>() {
        for spread in [1e2, 1e4, 1e6, 1e7] {
            for turn in 0..3 {
                let case = format!("dimension {N}, spread {spread:e}, turn {turn}");
                only_strict_laws_are_strict(&slender::<N>(spread, turn), 1e-9_f64.max(1e-12 * spread), &case);
            }
        }
    }
    in_dimension::<3>();
    in_dimension::<4>();
    in_dimension::<5>();
}

//! The axis of periodicity.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::ALL,
    motion::{State, bounces, distance},
    random::Stream,
    statistics::worst,
    wedge::{axis, billiard, two_hits},
};
use core::f64::consts::PI;
use nalgebra::{Matrix3, Vector3};

pub(super) const CLAIM: Claim = Claim {
    name: "wedge-axis",
    place: "Proposition 2.5, eq. (2.4)",
    statement: "An orbit in the wedge of angle θ has period two if and only if ẋ₀/ẋ₁ = −√2 sin(θ/2) and ẋ₂ = 0.",
    verdict: Verdict::HoldsCorrected(
        "True with the matrix T, that is, with x₀ counted clockwise; with equation (2.1) the sign is plus.",
    ),
    general_gamma: Some("ẋ₀/ẋ₁ = sin(θ/2)/γ, with x₀ counted counter-clockwise."),
    measure,
};

fn measure(effort: Effort) -> Measurement {
    let wedges = effort.of(100, 2000);
    let (mut fixed, mut clockwise, mut opposite, mut closed, mut only) =
        (vec![], vec![], f64::INFINITY, vec![], vec![]);
    for sample in 0..wedges {
        let mut stream = Stream::new(220, sample);
        let theta = stream.between(0.05, PI - 0.05);
        let gamma_squared = ALL[sample % 4];
        let (b, s) = (Vector3::from(axis(theta, gamma_squared)), two_hits(theta, gamma_squared));
        fixed.push((s * b - b).amax());

        // the paper's sign: with x₀ counter-clockwise, and with x₀ clockwise
        let mirror = Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0));
        let paper = mirror * b;
        opposite = opposite.min((s * paper - paper).norm() / (2.0 * b.x * b.y));
        clockwise.push((mirror * s * mirror * paper - paper).amax());

        let orbit = bounces(&billiard(theta, gamma_squared), State { x: [0.3, 0.0, 1.0], v: b.into() }, 201);
        let (first, last) = (orbit[0].state, orbit[orbit.len() - 1].state);
        // A wide wedge is touched far out, at l = 1/cos(θ/2), where v·ν goes like cos(θ/2): l = I/(v·ν) magnifies roundings by
        // 1/cos²(θ/2), and x₀ grows with flights as long as l.
        let cos = libm::cos(0.5 * theta);
        let off = distance(first.x, last.x) + distance(first.v, last.v);
        closed.push(if orbit.len() == 201 { off * cos * cos * cos } else { f64::INFINITY });

        // no other velocity comes back: Sv − v is as long as the part of v off the axis, times 2 sin(α/2) ≠ 0
        let v = Vector3::from(stream.on_sphere());
        let sin = libm::sqrt(1.0 - 0.25 * (s.trace() - 1.0) * (s.trace() - 1.0)); // sin α
        let half = libm::sqrt(0.5 * (1.0 - 0.5 * (s.trace() - 1.0))); // sin(α/2)
        let off_axis = (v - b * v.dot(&b)).norm();
        only.push(((s * v - v).norm() - 2.0 * half * off_axis).abs() * sin);
    }
    let rounding = 16.0 * f64::EPSILON;
    [
        Quantity::residual(
            "S b − b, b = (sin(θ/2)/γ, 1, 0), random wedges and four values of γ",
            worst(fixed),
            rounding,
        ),
        Quantity::residual("the paper's axis, with x₀ clockwise", worst(clockwise), rounding),
        Quantity::at_least(
            "the paper's axis with equation (2.1): |S b − b| over the angle from b, least",
            opposite,
            1e-3,
            0.0,
        ),
        Quantity::residual(
            "orbit on the axis: deviation after 200 collisions, x₀ included, times cos³(θ/2)",
            worst(closed),
            // some ten roundings in each of five coordinates per collision
            200.0 * 50.0 * f64::EPSILON,
        ),
        Quantity::residual(
            "|S v − v| against 2 sin(α/2) × part of v off the axis, random v",
            worst(only),
            4.0 * rounding,
        ),
    ]
    .into()
}

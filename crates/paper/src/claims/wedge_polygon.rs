//! The shape of the velocities that never escape from a wedge.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::UNIFORM,
    motion::{State, bounces, fly},
    random::Stream,
    statistics::{Range, least, worst},
    wedge::{axis, billiard, bounded_start, delta, inradius, near_axis, normals, opening, period},
};
use billiards::Stop;
use core::{
    f64::consts::{FRAC_PI_2, PI, TAU},
    ops::ControlFlow,
};
use nalgebra::Vector3;

pub(super) const CLAIM: Claim = Claim {
    name: "wedge-polygon",
    place: "Proposition 2.7",
    statement: "Orbits with a non-escape velocity keep such velocities, and are bounded. If θ is not periodic the region is bounded by a circle; if it has period \
                2n it is a regular polygon with n sides for odd n and 2n for even n.",
    verdict: Verdict::HoldsCorrected(
        "The polygon is a regular spherical q-gon, q the denominator of δ/π in lowest terms, cos δ = cos(θ/2)/√(3/2). For even n that is 2n, \
         but for odd n it may be n or 2n: θ = 1.53431 has δ = 3π/10, period 10, n = 5, and ten sides. Orbits are bounded but for a set of measure \
         zero: where θ is not periodic, one with a velocity on the circle itself never escapes, and its distance l = I/(v·ν) has no bound.",
    ),
    general_gamma: Some(
        "The q-gon, or circle, has the inradius ρ, cos ρ = sin(θ/2)·√((1+γ²)/(γ² + sin²(θ/2))) (derived; measured for γ² = 1/2).",
    ),
    measure,
};

/// How far from the axis the region reaches in each of `directions` directions, by bisection on whether orbits escape.
fn radii(theta: f64, collisions: usize, directions: u32) -> Vec<f64> {
    let wedge = billiard(theta, UNIFORM);
    let stays = |r: f64, azimuth: f64| {
        let start = State { x: [0.0, 0.0, 1.0], v: near_axis(theta, UNIFORM, r, azimuth) };
        let stop = |state| fly(&wedge, state, collisions, &mut |_| ControlFlow::Continue(()));
        stop(start) != Stop::Escaped && stop(start.reversed()) != Stop::Escaped
    };
    let radius = |k: u32| {
        let azimuth = TAU * (f64::from(k) + 0.5) / f64::from(directions);
        let (mut low, mut high) = (0.0, FRAC_PI_2);
        for _ in 0..30 {
            let middle = 0.5 * (low + high);
            if stays(middle, azimuth) { low = middle } else { high = middle }
        }
        low
    };
    (0..directions).map(radius).collect()
}

/// The least `v·ν` after so many collisions with the left wall, for velocities on the circle that bounds the region and touches `v·ν = 0`.
fn least_on_the_circle(theta: f64, hits: u32) -> f64 {
    let turn = TAU - 4.0 * delta(theta, UNIFORM);
    let [_, left] = normals(theta);
    let normal = Vector3::new(0.0, left[0], left[1]);
    let rho = inradius(theta, UNIFORM);
    least((0..hits).map(|n| Vector3::from(near_axis(theta, UNIFORM, rho, 1.0 + turn * f64::from(n))).dot(&normal)))
}

/// The number of corners of a curve: its local maxima. Flat stretches, within the error of bisection, count once.
fn corners(radii: &[f64]) -> usize {
    let n = radii.len();
    let rises: Vec<bool> =
        (0..n).map(|k| radii[(k + 1) % n] - radii[k]).filter(|d| d.abs() > 1e-6).map(|d| d > 0.0).collect();
    (0..rises.len()).filter(|&k| rises[k] && !rises[(k + 1) % rises.len()]).count()
}

fn measure(effort: Effort) -> Measurement {
    let directions = effort.of(120, 720);
    let mut quantities = vec![];
    for (p, q, claimed) in [(1, 4, 4), (1, 3, 3), (1, 5, 5), (2, 5, 5), (3, 8, 8), (3, 10, 5), (3, 7, 7), (5, 14, 7)] {
        let theta = opening(PI * f64::from(p) / f64::from(q), UNIFORM).unwrap_or(f64::NAN);
        let radii = radii(theta, 2 * period(q), directions);
        let label = |what: &str| format!("θ = {theta:.5}, period {}: {what}", period(q));
        quantities.push(Quantity::count(label("sides"), corners(&radii), q as usize));
        if claimed != q {
            quantities.push(Quantity::differs(
                label("sides, against the paper's n"),
                corners(&radii) as f64,
                f64::from(claimed),
                0.5,
            ));
        }
        // a direction may be half a step from the middle of a side: tan r = tan ρ / cos(azimuth)
        let inradius = inradius(theta, UNIFORM);
        let step = PI / f64::from(directions);
        quantities.push(Quantity::equal(label("inradius"), least(radii), inradius, step * step + 1e-8));
    }
    for theta in [0.7, FRAC_PI_2, 2.3] {
        let radii: Range = radii(theta, effort.of(400, 4000), effort.of(30, 120)).into_iter().collect();
        let inradius = inradius(theta, UNIFORM);
        // what lies ε outside escapes within about 1/√ε collisions: 10/n² covers it
        let late = 10.0 / (effort.of(400.0, 4000.0) * effort.of(400.0, 4000.0));
        quantities.push(Quantity::equal(
            format!("θ = {theta:.4}, not periodic: least radius"),
            radii.min,
            inradius,
            late,
        ));
        quantities.push(Quantity::equal(
            format!("θ = {theta:.4}, not periodic: greatest radius"),
            radii.max,
            inradius,
            late,
        ));
    }
    for theta in [0.7, FRAC_PI_2, 2.3] {
        let fall = least_on_the_circle(theta, 10_000) / least_on_the_circle(theta, 100);
        let label = format!("θ = {theta:.4}, on the circle: least v·ν of 10 000 collisions over that of 100");
        // the nearest of n places on a circle is about 1/n from a given one, and v·ν goes like the square: 10⁻⁴, give or take
        quantities.push(Quantity::at_most(label, fall, 0.1, 0.0));
    }
    // in the region for good: the angle from the axis is kept
    let mut angles = vec![];
    for sample in 0..effort.of(20, 200) {
        let mut stream = Stream::new(225, sample);
        let theta = stream.between(0.2, 2.9);
        let start = bounded_start(theta, UNIFORM, 0.99, &mut stream);
        let b = axis(theta, UNIFORM);
        let along = |v: [f64; 3]| (v[0] * b[0] + v[1] * b[1]).abs();
        let orbit = bounces(&billiard(theta, UNIFORM), start, 1000);
        angles.push(if orbit.len() == 1000 { 0.0 } else { 1.0 });
        angles.extend(orbit.iter().map(|bounce| (along(bounce.state.v) - along(start.v)).abs()));
    }
    quantities.push(Quantity::residual(
        "change of |v·b| in 1000 collisions, none escaping",
        worst(angles),
        1000.0 * 4.0 * f64::EPSILON,
    ));
    quantities.into()
}

//! The bounded component of the Sinai torus.
use super::period_two;
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::UNIFORM,
    motion::{State, fly, no_slip},
    random::Stream,
};
use billiards::{Stop, geometry::tables};
use core::{f64::consts::FRAC_PI_2, ops::ControlFlow};

pub(super) const CLAIM: Claim = Claim {
    name: "sinai-torus",
    place: "Section 1, Figure 5",
    statement: "A disk on a flat torus, a dispersing table, has a bounded component of positive measure.",
    verdict: Verdict::Holds,
    general_gamma: Some(
        "For every γ and every radius R below half the spacing, here 1. Between a disk and its translate orbits of period two go to and fro on a chord at \
         the angle a < π/2 to both normals, with the spin v₀ = v sin a/γ, where v is the speed along the chord. No other disk is in their way, and they are \
         elliptic if and only if cos a < 2(1+γ²)R (see period-two-stability): all of them if the gap between the disks is less than 2γ²R, that is, \
         R > 1/(2+2γ²), otherwise those with a near enough to π/2. Orbits near the elliptic ones stay, those near the hyperbolic ones leave exponentially fast. \
         (Measured, away from the threshold and from μ³ = 1; that elliptic orbits are surrounded by invariant surfaces is what one expects of reversible, \
         measure-preserving maps. That a no-slip Sinai billiard has elliptic orbits of period two is proved by Cox, Feres and Zhang.)",
    ),
    measure,
};

/// How orbits end that start near the period-two orbit at the angle `a` and are followed until they no longer go to and fro between the same two
/// disks: until a normal is more than half way to those of a grazing chord. They start within 10⁻³ cos⁴a: a change of velocity moves the next normal by up
/// to some `1/(R cos a)`, where there is room for about `cos a`.
fn watched(gamma_squared: f64, radius: f64, a: f64, orbits: usize, collisions: usize) -> Vec<Stop> {
    let torus = no_slip(tables::sinai_torus(radius, 1.0), gamma_squared);
    let (sin, cos) = libm::sincos(a);
    let velocity = period_two::velocity(gamma_squared, a);
    let half_way = libm::cos(0.5 * (FRAC_PI_2 - a));
    let watch = |sample: usize| {
        let mut stream = Stream::new(150, sample);
        let near: [f64; 3] = core::array::from_fn(|_| 1e-3 * cos * cos * cos * cos * stream.between(-1.0, 1.0));
        let [angle, v0, vt] = [a + near[0], velocity[0] + near[1], velocity[1] + near[2]];
        let (n1, n2, vn) = (libm::cos(angle), libm::sin(angle), libm::sqrt(1.0 - v0 * v0 - vt * vt));
        let start =
            State { x: [0.0, 0.5 + radius * n1, 0.5 + radius * n2], v: [v0, vn * n1 - vt * n2, vn * n2 + vt * n1] };
        fly(&torus, start, collisions, &mut |bounce| {
            let side = if bounce.n % 2 == 1 { -1.0 } else { 1.0 };
            let [n1, n2] = bounce.normal;
            if n1 * side * cos + n2 * sin < half_way { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
    };
    (0..orbits).map(watch).collect()
}

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(50, 200), effort.of(10_000, 100_000));
    let mut quantities = vec![];
    let mut note = |gamma_squared: f64, radius: f64, a: f64| {
        let (kind, do_so, stop) = if libm::cos(a) < 2.0 * (1.0 + gamma_squared) * radius {
            ("elliptic", "still near", Stop::Finished)
        } else {
            ("hyperbolic", "gone", Stop::Observer)
        };
        quantities.push(Quantity::count(
            format!("γ² = {gamma_squared}, R = {radius}, a = {a:.4}, {kind}: orbits of {orbits} {do_so} after {collisions} collisions"),
            watched(gamma_squared, radius, a, orbits, collisions).into_iter().filter(|s| *s == stop).count(),
            orbits,
        ));
    };
    for (gamma_squared, radii) in
        [(UNIFORM, [0.25, 0.30, 0.32, 0.35, 0.375, 0.45]), (0.15, [0.3, 0.38, 0.42, 0.445, 0.45, 0.48])]
    {
        for radius in radii {
            note(gamma_squared, radius, 0.0);
        }
    }
    // disks so small that their perpendicular orbit is hyperbolic
    for (gamma_squared, radius) in [(UNIFORM, 0.02), (UNIFORM, 0.1), (UNIFORM, 0.25), (0.15, 0.1), (0.15, 0.3)] {
        let threshold = 2.0 * (1.0 + gamma_squared) * radius;
        for cos in [1.25 * threshold, 0.8 * threshold] {
            note(gamma_squared, radius, libm::acos(cos));
        }
    }
    quantities.into()
}

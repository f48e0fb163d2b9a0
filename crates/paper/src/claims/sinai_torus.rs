//! The bounded component of the Sinai torus.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::UNIFORM,
    motion::{State, fly, no_slip},
    random::Stream,
};
use billiards::{Stop, geometry::tables};
use core::ops::ControlFlow;

pub(super) const CLAIM: Claim = Claim {
    name: "sinai-torus",
    place: "Section 1, Figure 5",
    statement: "A disk on a flat torus, a dispersing table, has a bounded component of positive measure.",
    verdict: Verdict::HoldsCorrected(
        "Near the period-two orbit between a disk and its translate it exists if and only if that orbit is elliptic, gap/R < 2γ²: for the uniform disk and \
         the unit torus R > 1/3. For smaller disks nearby orbits leave exponentially fast. (Measured; that elliptic orbits are surrounded by \
         invariant surfaces is what one expects of reversible, measure-preserving maps.)",
    ),
    general_gamma: Some("R > 1/(2 + 2γ²)."),
    measure,
};

/// How orbits end that start within 10⁻³ of the period-two orbit and are followed until they no longer go to and fro between the same two
/// disks.
fn watched(gamma_squared: f64, radius: f64, orbits: usize, collisions: usize) -> Vec<Stop> {
    let torus = no_slip(tables::sinai_torus(radius, 1.0), gamma_squared);
    let watch = |sample: usize| {
        let mut stream = Stream::new(150, sample);
        let near: [f64; 3] = core::array::from_fn(|_| 1e-3 * stream.between(-1.0, 1.0));
        let [angle, v0, vt] = near;
        let (n1, n2, vn) = (libm::cos(angle), libm::sin(angle), libm::sqrt(1.0 - v0 * v0 - vt * vt));
        let start =
            State { x: [0.0, 0.5 + radius * n1, 0.5 + radius * n2], v: [v0, vn * n1 - vt * n2, vn * n2 + vt * n1] };
        fly(&torus, start, collisions, &mut |bounce| {
            // far from the two points of the period-two orbit, or at the same one twice
            let side = if bounce.n % 2 == 1 { -1.0 } else { 1.0 };
            if bounce.normal[0] * side < 0.7 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
    };
    (0..orbits).map(watch).collect()
}

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(50, 200), effort.of(10_000, 200_000));
    let mut quantities = vec![];
    for (gamma_squared, radii) in
        [(UNIFORM, [0.25, 0.30, 0.32, 0.35, 0.375, 0.45]), (0.15, [0.3, 0.38, 0.42, 0.445, 0.45, 0.48])]
    {
        for radius in radii {
            let over = (1.0 - 2.0 * radius) / radius;
            let elliptic = over < 2.0 * gamma_squared;
            let stops = watched(gamma_squared, radius, orbits, collisions);
            let (kind, do_so, stop) = if elliptic {
                ("elliptic", "still near", Stop::Finished)
            } else {
                ("hyperbolic", "gone", Stop::Observer)
            };
            quantities.push(Quantity::count(
                format!("γ² = {gamma_squared}, R = {radius}, {kind}: orbits of {orbits} {do_so} after {collisions} collisions"),
                stops.iter().filter(|s| **s == stop).count(),
                orbits,
            ));
        }
    }
    quantities.into()
}

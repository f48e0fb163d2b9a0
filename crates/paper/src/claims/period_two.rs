//! The stability of period-two orbits.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{OTHERS, UNIFORM, cos_beta},
    motion::{Billiard, no_slip},
    wedge::axis,
};
use billiards::{ReducedState, collision_laws::check::jacobian_determinant, geometry::tables};
use core::f64::consts::PI;
use nalgebra::{DVector, dvector};

pub(super) const CLAIM: Claim = Claim {
    name: "period-two-stability",
    place: "beyond the paper",
    statement: "An orbit goes to and fro between two equal arcs of radius R on a chord of length d that makes the same angle a with both normals, with the \
                spin v₀ = sin a/γ where the speed along the chord is 1. Its half map (one collision, and the symmetry that exchanges the arcs) has \
                the eigenvalues 1, μ, 1/μ with (μ + 1/μ)/2 = (2 cos²a ± (d/R) cos a)/(1+γ²) − 1, plus for dispersing arcs, minus for focusing ones. \
                It is elliptic if and only if d/R < 2(γ² + sin²a)/cos a for dispersing arcs, and d < 2R cos a for focusing ones. For the orbit \
                perpendicular to the arcs, a = 0, that is cos β ± cos²(β/2) d/R, and d/R < 2γ² (uniform disk: d < R) or d < 2R.",
    verdict: Verdict::Holds,
    general_gamma: Some(
        "As stated, for every γ (Wojtkowski 1994 for a = 0 and dispersing arcs; focusing ones are measured for γ² = 1/2 and 0.15).",
    ),
    measure,
};

/// A period-two orbit: its billiard, and its state right after one collision.
struct Orbit<'a> {
    billiard: &'a Billiard,
    at: ReducedState,
}

impl Orbit<'_> {
    /// The orbit that starts from a piece at arc length `s`, where the normal is turned by the angle `a` from the chord.
    fn on_chord(billiard: &Billiard, gamma_squared: f64, piece: usize, s: f64, a: f64) -> Orbit<'_> {
        let [v0, vt] = velocity(gamma_squared, a);
        Orbit { billiard, at: ReducedState { piece, s, v0, vt, speed: 1.0 } }
    }

    /// `(μ + 1/μ)/2` from the derivative `D` of one collision. In the walls' own coordinates the orbit's symmetry makes `−D` the half map, whose trace is
    /// `1 + μ + 1/μ`.
    fn half_trace(&self) -> f64 {
        let step = |x: &DVector<f64>| {
            let state = ReducedState { s: self.at.s + x[0], v0: self.at.v0 + x[1], vt: self.at.vt + x[2], ..self.at };
            self.billiard.map(&state).map_or(dvector![f64::NAN, f64::NAN, f64::NAN], |y| dvector![y.s, y.v0, y.vt])
        };
        // tr D from determinants: p(λ) = det(D + λ), p(1) + p(−1) = 2 tr D + 2 det D
        let p = |lambda: f64| jacobian_determinant(|x| step(x) + x * lambda, &dvector![0.0, 0.0, 0.0], 1e-3);
        let trace = 0.5 * (p(1.0) + p(-1.0)) - p(0.0);
        0.5 * (-trace - 1.0)
    }
}

/// `(v₀, vₜ)` at unit speed of the period-two orbit on a chord from which the normal is turned by the angle `a`: as in a wedge of the angle `2a`.
pub(super) fn velocity(gamma_squared: f64, a: f64) -> [f64; 2] {
    let [v0, along, _] = axis(2.0 * a, gamma_squared);
    [v0, -libm::sin(a) * along]
}

/// `(μ + 1/μ)/2 = (2 cos²a − κd cos a)/(1+γ²) − 1`, where `over = −κd` and `κ` is the curvature, positive for focusing arcs.
///
/// A collision turns velocities by `C = 2ee′ − 1` about `e = sin(β/2) x₀ + cos(β/2) t`, to which the orbit is perpendicular. Let `y` be the distance from
/// the chord and `(η, ω)` the change of velocity, along `y` and perpendicular to it and to the orbit; `e = (p, q)` in these, `p = cos(β/2) cos a`. Flight
/// takes `y` to `y + dη`; mirror and collision take `(η, ω)` to `C (η, −ω) − 2κ cos(β/2) y e`, as `e` turns with the wall. The trace of both is
/// `4p² − 1 − 2κd cos²(β/2) cos a`, the determinant is 1, and one eigenvalue is 1.
fn formula(gamma_squared: f64, a: f64, over: f64) -> f64 {
    let cos = libm::cos(a);
    (2.0 * cos * cos + over * cos) / (1.0 + gamma_squared) - 1.0
}

fn measure(_: Effort) -> Measurement {
    let mut quantities = vec![];
    // Truncation is (1e-3/L)⁶ with L = R cos²a, a quarter at the least, times constants of order ten: rounding, 1e-16/1e-3 of
    // numbers up to ten in each of nine derivatives, is more.
    let bound = 1e-10;
    let mut note = |name: String, gamma_squared: f64, a: f64, over: f64, half: f64| {
        let kind = if half.abs() < 1.0 { "elliptic" } else { "hyperbolic" };
        let label = format!("{name}, a = {a}, γ² = {gamma_squared}: (μ + 1/μ)/2, {kind}");
        quantities.push(Quantity::equal(label, half, formula(gamma_squared, a, over), bound));
    };
    // dispersing: a disk of the lattice and the next one
    let mut dispersing = |gamma_squared: f64, radius: f64, a: f64| {
        let torus = no_slip(tables::sinai_torus(radius, 1.0), gamma_squared);
        // arc length of a scatterer runs clockwise; the place with the normal (cos a, sin a)
        let (sin, cos) = libm::sincos(a);
        let s = torus.table.pieces()[0].arc_length_at(&[0.5 + radius * cos, 0.5 + radius * sin].into());
        let half = Orbit::on_chord(&torus, gamma_squared, 0, s, a).half_trace();
        let ratio = (1.0 - 2.0 * radius * cos) / radius;
        note(format!("dispersing, d/R = {ratio:.4}"), gamma_squared, a, ratio, half);
        half
    };
    let quarter = dispersing(UNIFORM, 0.25, 0.0);
    for radius in [0.3, 0.33, 0.34, 0.375, 0.45] {
        dispersing(UNIFORM, radius, 0.0);
    }
    for gamma_squared in OTHERS {
        // on both sides of d/R = 2γ²
        let critical = 1.0 / (2.0 + 2.0 * gamma_squared);
        dispersing(gamma_squared, critical - 0.01, 0.0);
        dispersing(gamma_squared, critical + 0.01, 0.0);
    }
    // on both sides of d/R = 2(γ² + sin²a)/cos a
    for (gamma_squared, radius, a) in
        [(UNIFORM, 0.3, 0.4), (UNIFORM, 0.4, -0.6), (0.15, 0.4, 0.3), (0.15, 0.4, -0.6), (0.85, 0.4, 0.6)]
    {
        dispersing(gamma_squared, radius, a);
    }
    // focusing: a lens of two arcs, and the caps of a stadium, which are farther apart than two radii
    for (radius, side, gamma_squared, a) in [
        (1.0, 1.2, UNIFORM, 0.0),
        (1.0, 1.9, UNIFORM, 0.0),
        (2.0, 3.0, UNIFORM, 0.0),
        (1.0, 1.9, 0.15, 0.0),
        (1.0, 1.9, UNIFORM, 0.5),
        (1.0, 1.9, 0.15, -0.5),
    ] {
        let lens = no_slip(tables::flower(2, radius, side), gamma_squared);
        let middle = 0.5 * lens.table.pieces()[0].length();
        let half = Orbit::on_chord(&lens, gamma_squared, 0, middle + radius * a, a).half_trace();
        let gap = 2.0 * (radius * libm::cos(a) - libm::sqrt(radius * radius - 0.25 * side * side));
        note(format!("lens, d/R = {:.4}", gap / radius), gamma_squared, a, -gap / radius, half);
    }
    for (half_length, a) in [(0.1, 0.0), (0.5, 0.0), (0.1, 0.5)] {
        let stadium = no_slip(tables::stadium(half_length, 1.0), UNIFORM);
        let half = Orbit::on_chord(&stadium, UNIFORM, 1, 0.5 * PI + a, a).half_trace();
        let gap = 2.0 * half_length + 2.0 * libm::cos(a);
        note(format!("caps of a stadium, d/R = {gap:.4}"), UNIFORM, a, -gap, half);
    }
    // μ + 1/μ = 10/3
    let mu = quarter + libm::sqrt(quarter * quarter - 1.0);
    quantities.push(Quantity::equal("torus with R = 1/4: μ", mu, 3.0, 10.0 * bound));
    for a in [0.0, 0.4, 0.9] {
        let (sin, cos) = libm::sincos(a);
        let threshold = 2.0 * (UNIFORM + sin * sin) / cos;
        let label = format!("formula at d/R = 2(γ² + sin²a)/cos a, a = {a}, uniform disk");
        quantities.push(Quantity::equal(label, formula(UNIFORM, a, threshold), 1.0, 4.0 * f64::EPSILON));
    }
    quantities.push(Quantity::equal(
        "formula at a = 0, d/R = 1: cos β + cos²(β/2)",
        formula(0.15, 0.0, 1.0),
        cos_beta(0.15) + 1.0 / 1.15,
        4.0 * f64::EPSILON,
    ));
    quantities.into()
}

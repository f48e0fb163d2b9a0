//! The stability of period-two orbits.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{OTHERS, UNIFORM, cos_beta},
    motion::{Billiard, no_slip},
};
use billiards::{ReducedState, collision_laws::check::jacobian_determinant, geometry::tables};
use core::f64::consts::PI;
use nalgebra::{DVector, dvector};

pub(super) const CLAIM: Claim = Claim {
    name: "period-two-stability",
    place: "beyond the paper",
    statement: "For the orbit perpendicular to two equal arcs of radius R at the distance d, the half map (one collision, and the symmetry that exchanges the arcs) has \
                the eigenvalues 1, μ, 1/μ with (μ + 1/μ)/2 = cos β ± cos²(β/2) d/R, plus for dispersing arcs, minus for focusing ones. It is elliptic if \
                and only if d/R < 2γ² for dispersing arcs (uniform disk: d < R), and d < 2R for focusing ones.",
    verdict: Verdict::Holds,
    general_gamma: Some(
        "As stated, for every γ (Wojtkowski 1994 for dispersing arcs; focusing ones are measured for γ² = 1/2 and 0.15).",
    ),
    measure,
};

/// A period-two orbit: a state right after one collision; the image of the coordinates of a neighbour, about the other collision.
struct Orbit<'a> {
    billiard: &'a Billiard,
    at: ReducedState,
}

impl Orbit<'_> {
    /// `(μ + 1/μ)/2` from the derivative `D` of one collision. In the walls' own coordinates the orbit's symmetry makes `−D` the half map, whose trace is
    /// `1 + μ + 1/μ`.
    fn half_trace(&self) -> f64 {
        let step = |x: &DVector<f64>| {
            let state = ReducedState { s: self.at.s + x[0], v0: x[1], vt: x[2], ..self.at };
            self.billiard.map(&state).map_or(dvector![f64::NAN, f64::NAN, f64::NAN], |y| dvector![y.s, y.v0, y.vt])
        };
        // tr D from determinants: p(λ) = det(D + λ), p(1) + p(−1) = 2 tr D + 2 det D
        let p = |lambda: f64| jacobian_determinant(|x| step(x) + x * lambda, &dvector![0.0, 0.0, 0.0], 1e-3);
        let trace = 0.5 * (p(1.0) + p(-1.0)) - p(0.0);
        0.5 * (-trace - 1.0)
    }
}

fn measure(_: Effort) -> Measurement {
    let mut quantities = vec![];
    // Truncation is (1e-3/L)⁶ with L the radius, a quarter at the least, times constants of order ten: rounding, 1e-16/1e-3 of
    // numbers up to ten in each of nine derivatives, is more.
    let bound = 1e-10;
    let formula = |gamma_squared: f64, over: f64| cos_beta(gamma_squared) + over / (1.0 + gamma_squared);
    let mut note = |name: String, gamma_squared: f64, over: f64, half: f64| {
        let kind = if half.abs() < 1.0 { "elliptic" } else { "hyperbolic" };
        let label = format!("{name}, γ² = {gamma_squared}: (μ + 1/μ)/2, {kind}");
        quantities.push(Quantity::equal(label, half, formula(gamma_squared, over), bound));
    };
    // dispersing: a disk of the lattice and the next one
    let mut dispersing = |gamma_squared: f64, radius: f64| {
        let torus = no_slip(tables::sinai_torus(radius, 1.0), gamma_squared);
        // arc length of a scatterer runs clockwise; the place with the normal (1, 0)
        let pole = torus.table.pieces()[0].arc_length_at(&[0.5 + radius, 0.5].into());
        let half = Orbit { billiard: &torus, at: ReducedState { piece: 0, s: pole, v0: 0.0, vt: 0.0, speed: 1.0 } }
            .half_trace();
        let ratio = (1.0 - 2.0 * radius) / radius;
        note(format!("dispersing, d/R = {ratio:.4}"), gamma_squared, ratio, half);
        half
    };
    let quarter = dispersing(UNIFORM, 0.25);
    for radius in [0.3, 0.33, 0.34, 0.375, 0.45] {
        dispersing(UNIFORM, radius);
    }
    for gamma_squared in OTHERS {
        // on both sides of d/R = 2γ²
        let critical = 1.0 / (2.0 + 2.0 * gamma_squared);
        dispersing(gamma_squared, critical - 0.01);
        dispersing(gamma_squared, critical + 0.01);
    }
    // focusing: a lens of two arcs, and the caps of a stadium, which are farther apart than two radii
    for (radius, side, gamma_squared) in
        [(1.0, 1.2, UNIFORM), (1.0, 1.9, UNIFORM), (2.0, 3.0, UNIFORM), (1.0, 1.9, 0.15)]
    {
        let lens = no_slip(tables::flower(2, radius, side), gamma_squared);
        let middle = 0.5 * lens.table.pieces()[0].length();
        let half = Orbit { billiard: &lens, at: ReducedState { piece: 0, s: middle, v0: 0.0, vt: 0.0, speed: 1.0 } }
            .half_trace();
        let gap = 2.0 * (radius - libm::sqrt(radius * radius - 0.25 * side * side));
        note(format!("lens, d/R = {:.4}", gap / radius), gamma_squared, -gap / radius, half);
    }
    for half_length in [0.1, 0.5] {
        let stadium = no_slip(tables::stadium(half_length, 1.0), UNIFORM);
        let half =
            Orbit { billiard: &stadium, at: ReducedState { piece: 1, s: 0.5 * PI, v0: 0.0, vt: 0.0, speed: 1.0 } }
                .half_trace();
        let gap = 2.0 * half_length + 2.0;
        note(format!("caps of a stadium, d/R = {gap:.4}"), UNIFORM, -gap, half);
    }
    // μ + 1/μ = 10/3
    let mu = quarter + libm::sqrt(quarter * quarter - 1.0);
    quantities.push(Quantity::equal("torus with R = 1/4: μ", mu, 3.0, 10.0 * bound));
    let threshold = |gamma_squared: f64| formula(gamma_squared, 2.0 * gamma_squared);
    quantities.push(Quantity::equal("formula at d/R = 2γ², uniform disk", threshold(UNIFORM), 1.0, 4.0 * f64::EPSILON));
    quantities.into()
}

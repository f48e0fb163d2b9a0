//! How many velocities never escape from a wedge.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::UNIFORM,
    motion::{State, fly},
    random::Stream,
    statistics::standard_error_of_share,
    wedge::{billiard, non_escape_area, opening},
};
use billiards::Stop;
use core::{
    f64::consts::{FRAC_PI_2, FRAC_PI_3, PI, TAU},
    ops::ControlFlow,
};

pub(super) const CLAIM: Claim = Claim {
    name: "non-escape-area",
    place: "before Proposition 2.7",
    statement: "On the unit sphere of velocities there are two antipodal regions of velocities that do not escape; the area of each falls as θ \
                grows, from 2π as θ → 0 to 0 as θ → π/2.",
    verdict: Verdict::HoldsCorrected(
        "It goes to 0 as θ → π, but it falls only away from the periodic angles, where it is larger than at angles nearby: 2π/3 at π/3, \
         against 1.9647 at θ = 1 and 1.8403 for the caps near π/3. At π/2 it is 2π(1 − √3/2) = 0.842, since cos ρ = √3/2 there. Away from periodic θ each region is the cap of radius ρ \
         about the axis, with cos ρ = sin(θ/2)·√(3/(1 + 2 sin²(θ/2))).",
    ),
    general_gamma: Some("cos ρ = sin(θ/2)·√((1+γ²)/(γ² + sin²(θ/2))); 2π and 0 are the limits for every γ."),
    measure,
};

/// A velocity escapes at once, or came from far away, if it points away from both walls or towards both.
fn escapes_directly(theta: f64, v: [f64; 3]) -> bool {
    let [towards_right, towards_left] = crate::wedge::normals(theta).map(|n| v[1] * n[0] + v[2] * n[1] < 0.0);
    towards_right == towards_left
}

/// A wedge, with the denominator q of `δ/π` if that is rational.
struct Wedge {
    theta: f64,
    gamma_squared: f64,
    q: Option<u32>,
}

/// Half the area of all velocities that never escape, by running orbits, beside the formula's.
fn area(wedge: &Wedge, samples: usize, seed: u64) -> Quantity {
    let Wedge { theta, gamma_squared, q } = *wedge;
    let wedge = billiard(theta, gamma_squared);
    // Where δ/π = p/q an escape comes within the q directions of the rotation. Else, a velocity at ε outside the cap escapes through a
    // window of width ~√ε of its circle, which hits find after about 1/√ε of them: 400 leave an error of 1/n² ≈ 1e-5 in radius, less than
    // the sampling does.
    let collisions = q.map_or(400, |q| 4 * q as usize);
    let stays = |sample: &usize| {
        let v = Stream::new(seed, *sample).on_sphere();
        let run = || fly(&wedge, State { x: [0.0, 0.0, 1.0], v }, collisions, &mut |_| ControlFlow::Continue(()));
        !escapes_directly(theta, v) && run() != Stop::Escaped
    };
    let formula = non_escape_area(theta, gamma_squared, q);
    let share = (0..samples).filter(stays).count() as f64 / samples as f64;
    let shape = q.map_or("cap".into(), |q| format!("{q}-gon"));
    let label = format!("area of one region, θ = {theta:.5}, γ² = {gamma_squared}: {shape}");
    Quantity::sampled(label, TAU * share, TAU * standard_error_of_share(formula / TAU, samples), formula)
}

fn measure(effort: Effort) -> Measurement {
    let samples = effort.of(40_000, 1_000_000);
    let cap = |(theta, gamma_squared): (f64, f64)| Wedge { theta, gamma_squared, q: None };
    // δ = πp/q: regular polygons, larger than their inscribed caps
    let polygon = |(p, q): (u32, u32)| {
        let theta = opening(PI * f64::from(p) / f64::from(q), UNIFORM).unwrap_or(f64::NAN);
        Wedge { theta, gamma_squared: UNIFORM, q: Some(q) }
    };
    let angles = [FRAC_PI_2, 0.1, 0.5, 1.0, 2.0, 2.5, 3.0].map(|theta| (theta, UNIFORM));
    let wedges = angles.into_iter().map(cap).chain([(1, 4), (3, 10), (1, 3), (3, 8)].map(polygon));
    let wedges = wedges.chain([(1.0, 0.15), (1.7, 0.85)].map(cap));
    let mut quantities: Vec<Quantity> = wedges.zip(2240..).map(|(wedge, seed)| area(&wedge, samples, seed)).collect();
    let at_right_angle = quantities[0].measured;
    // 0.1, 0.5, 1, π/2, 2, 2.5, 3, none of them periodic; then π/3
    let falling = [1, 2, 3, 0, 4, 5, 6].map(|k| quantities[k].measured);
    let falls = falling.windows(2).filter(|two| two[1] < two[0]).count();
    let at_third = quantities[7].measured;
    let noise = quantities[7].bound;
    let formula = |theta: f64| non_escape_area(theta, UNIFORM, None);
    quantities.extend([
        Quantity::count("decreases from each of seven non-periodic angles to the next", falls, 6),
        Quantity::at_least("area of one region at π/3, above the caps nearby", at_third, formula(FRAC_PI_3), -noise),
        Quantity::at_least("area of one region at π/3, above the cap at θ = 1", at_third, formula(1.0), -noise),
    ]);
    quantities.push(Quantity::differs("area of one region at π/2, against the paper's 0", at_right_angle, 0.0, 0.5));
    // near its ends the area is 2π − √3 πθ, and π(π−θ)²/12 up to the square of π−θ relatively
    quantities.extend([
        Quantity::equal(
            "formula at π/2 against 2π(1 − √3/2)",
            formula(FRAC_PI_2),
            TAU * (1.0 - 0.5 * libm::sqrt(3.0)),
            1e-14,
        ),
        Quantity::equal("formula at θ = 10⁻⁹ against 2π", formula(1e-9), TAU, 6e-9),
        Quantity::equal("formula at θ = π − 10⁻³ against π·10⁻⁶/12", formula(PI - 1e-3), PI * 1e-6 / 12.0, 1e-12),
    ]);
    quantities.into()
}

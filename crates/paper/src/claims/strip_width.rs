//! How far an orbit of the strip goes sideways.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{ALL, UNIFORM},
    motion::{Billiard, State, fly, no_slip},
    random::Stream,
    statistics::Range,
    strip::ladder,
};
use billiards::geometry::tables;
use core::{f64::consts::PI, ops::ControlFlow};

pub(super) const CLAIM: Claim = Claim {
    name: "strip-width",
    place: "Proposition 2.1",
    statement: "In a strip of width 1, at unit speed, the horizontal displacement of an orbit is at most √(3/2)·ℓ, where \
                ℓ = √(1/ẋ₂² − 1) is the length of a flight seen along x₂.",
    verdict: Verdict::HoldsCorrected(
        "Orbits are bounded, but the width is √3·ℓ: the supremum of the width of every orbit that is neither vertical nor \
         horizontal. √(3/2)·ℓ is the width in the spin direction x₀ (the cosine and the sine of β/2 are interchanged). The flights \
         slide with their ends on two lines that cross at a point O at the angle β, bisected by the x₁ axis, so that |x₁ − O| ≤ \
         ℓ/(2 sin(β/2)), and they come as close to that as one likes.",
    ),
    general_gamma: Some("Width ℓ·√(1+γ²)/γ in x₁ and ℓ·√(1+γ²) in x₀; if β/π is rational these are bounds."),
    measure,
};

/// A random start in the strip, neither vertical nor horizontal: ℓ between 1/7 and 3.2.
pub(super) fn random_start(stream: &mut Stream) -> State {
    let v = loop {
        let v = stream.on_sphere();
        if v[2].abs() > 0.3 && v[2].abs() < 0.99 {
            break v;
        }
    };
    State { x: [0.0, 0.0, stream.between(0.1, 0.9)], v }
}

/// What rounding may do to lengths over ℓ in so many collisions from such a start.
///
/// A collision rounds the velocity along the wall, 0.14 or more, by an ulp of the speed, at worst always the same way. The engine makes
/// up for the missing energy in ẋ₂; so the relative error of ℓ is 1 + ℓ² ≤ 11 times as large.
pub(super) fn rounding(collisions: f64) -> f64 {
    32.0 * f64::EPSILON * collisions
}

/// How far in phase, in radians, the contact point of a wall that is nearest to an extreme of the orbit is from it at most.
///
/// The contact points lie where a cosine is sampled at the multiples of 2β. For the β at hand the largest gap between n such phases, n half
/// the collisions, is less than 10/n turns, so one is within 10π/n of the top of the cosine, which has fallen by (10π/n)²/2 there; and as
/// much at the bottom.
pub(super) fn phase(collisions: f64) -> f64 {
    10.0 * PI / (0.5 * collisions)
}

/// The widths of an orbit in `x₁` and `x₀`, over ℓ.
fn widths(strip: &Billiard, sample: usize, collisions: usize) -> [f64; 2] {
    let start = random_start(&mut Stream::new(201, sample));
    let mut ranges = [Range::EMPTY; 2];
    fly(strip, start, collisions, &mut |bounce| {
        ranges[0].add(bounce.state.x[1]);
        ranges[1].add(bounce.state.x[0]);
        ControlFlow::Continue(())
    });
    ranges.map(|range| range.width() / ladder(&start))
}

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(10, 100), effort.of(10_000_u32, 100_000));
    let phase = phase(f64::from(collisions));
    let short = phase * phase;
    let rounding = rounding(f64::from(collisions));
    let mut quantities = vec![];
    for gamma_squared in ALL {
        let strip = no_slip(tables::strip(1.0), gamma_squared);
        let (mut x1, mut x0) = (Range::EMPTY, Range::EMPTY);
        for sample in 0..orbits {
            let [a, b] = widths(&strip, sample, collisions as usize);
            x1.add(a);
            x0.add(b);
        }
        let wide = libm::sqrt(1.0 + gamma_squared);
        let (width1, width0) = (wide / libm::sqrt(gamma_squared), wide);
        let label = |what: &str| format!("{what}, γ² = {gamma_squared}");
        quantities.extend([
            Quantity::at_least(label("width in x₁ / ℓ, narrowest orbit"), x1.min, width1, width1 * short),
            Quantity::at_most(label("width in x₁ / ℓ, widest orbit"), x1.max, width1, width1 * rounding),
            Quantity::at_least(label("width in x₀ / ℓ, narrowest orbit"), x0.min, width0, width0 * short),
            Quantity::at_most(label("width in x₀ / ℓ, widest orbit"), x0.max, width0, width0 * rounding),
        ]);
        if gamma_squared == UNIFORM {
            quantities.push(Quantity::differs(
                "width in x₁ / ℓ, against the paper's √(3/2)",
                x1.min,
                libm::sqrt(1.5),
                0.5,
            ));
        }
    }
    quantities.into()
}

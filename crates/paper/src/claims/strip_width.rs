//! How far an orbit of the strip goes sideways.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{OTHERS, UNIFORM},
    motion::{Bounce, State, fly, no_slip},
    random::Stream,
    statistics::Range,
};
use billiards::geometry::tables;
use core::ops::ControlFlow;

pub(super) const CLAIM: Claim = Claim {
    name: "strip-width",
    place: "Proposition 2.1",
    statement: "In a strip of width 1, at unit speed, the horizontal displacement of an orbit is at most √(3/2)·ℓ, where \
                ℓ = √(1/ẋ₂² − 1) is the length of a flight seen along x₂.",
    verdict: Verdict::HoldsCorrected(
        "Orbits are bounded, but the width is √3·ℓ: the supremum of the width of every orbit that is neither vertical nor \
         horizontal. √(3/2)·ℓ is the width in the spin direction x₀ (cosine and sine of β/2 have changed places). The flights slide \
         with their ends on two lines that cross under the angle β about the x₁ axis, so that |x₁ − O| ≤ ℓ/(2 sin(β/2)).",
    ),
    general_gamma: Some("Width ℓ·√(1+γ²)/γ in x₁ and ℓ·√(1+γ²) in x₀, unless β/π is rational; then these are bounds."),
    measure,
};

/// The widths of an orbit in `x₁` and `x₀`, over ℓ.
fn widths(gamma_squared: f64, sample: usize, collisions: usize) -> [f64; 2] {
    let strip = no_slip(tables::strip(1.0), gamma_squared);
    let mut stream = Stream::new(201, sample);
    // neither vertical nor horizontal: ℓ between 1/7 and 7
    let v = loop {
        let v = stream.on_sphere();
        if v[2].abs() > 0.14 && v[2].abs() < 0.99 {
            break v;
        }
    };
    let start = State { x: [0.0, 0.0, stream.uniform()], v };
    let mut ranges = [Range::EMPTY; 2];
    fly(&strip, start, collisions, &mut |bounce: &Bounce| {
        ranges[0].add(bounce.state.x[1]);
        ranges[1].add(bounce.state.x[0]);
        ControlFlow::Continue(())
    });
    let ell = libm::sqrt(1.0 / (v[2] * v[2]) - 1.0);
    ranges.map(|range| range.width() / ell)
}

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(10, 100), effort.of(10_000, 100_000));
    // The extremes lie on a cosine, sampled at the multiples of 2β on each wall. The largest gap between `n` such points is less
    // than 10/n turns for the β at hand; half a gap away from its top a cosine has fallen by (10π/n)²/2, and twice that on
    // the two sides together.
    let half_gap = 10.0 * core::f64::consts::PI / (0.5 * f64::from(collisions));
    let resolution = half_gap * half_gap;
    let mut quantities = vec![];
    for gamma_squared in [UNIFORM].into_iter().chain(OTHERS) {
        let (mut x1, mut x0) = (Range::EMPTY, Range::EMPTY);
        for sample in 0..orbits {
            let [a, b] = widths(gamma_squared, sample, collisions as usize);
            x1.add(a);
            x0.add(b);
        }
        let wide = libm::sqrt(1.0 + gamma_squared);
        let (width1, width0) = (wide / libm::sqrt(gamma_squared), wide);
        // phases drift by an ulp per collision; near the extremes that does not show
        let rounding = 1e-11;
        let label = |what: &str| format!("{what}, γ² = {gamma_squared}");
        quantities.extend([
            Quantity::at_least(label("width in x₁ / ℓ, narrowest orbit"), x1.min, width1, width1 * resolution),
            Quantity::at_most(label("width in x₁ / ℓ, widest orbit"), x1.max, width1, rounding),
            Quantity::at_least(label("width in x₀ / ℓ, narrowest orbit"), x0.min, width0, width0 * resolution),
            Quantity::at_most(label("width in x₀ / ℓ, widest orbit"), x0.max, width0, rounding),
        ]);
        if gamma_squared == UNIFORM {
            let claimed = libm::sqrt(1.5);
            quantities.push(Quantity::differs("width in x₁ / ℓ, against the paper's", x1.min, claimed, 0.5));
        }
    }
    quantities.into()
}

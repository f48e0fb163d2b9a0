//! How long an orbit of the strip goes the same way.
use super::strip_width::random_start;
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{ALL, UNIFORM, beta},
    motion::{Bounce, bounces, no_slip},
    random::Stream,
    strip::{centre, contact_direction, seen},
};
use billiards::geometry::tables;
use core::f64::consts::PI;

pub(super) const CLAIM: Claim = Claim {
    name: "same-direction",
    place: "Remark 1",
    statement: "In the strip never more than three flights in a row go the same way horizontally. Of the four quadrants into which the \
                contact lines divide the (x₀, x₁) plane, no two flights in a row lie in the upper one, nor in the lower one, and at \
                most two in the left one, or the right one. (Left and right are those that contain the x₁ axis.)",
    verdict: Verdict::Holds,
    general_gamma: Some("The horizontal velocities are a cosine at steps of β: at most ⌈π/β⌉ in a row have one sign."),
    measure,
};

/// Upper, lower, right, left: from the signs of the ends' positions on their lines.
fn quadrant(gamma_squared: f64, o: [f64; 2], flight: &[Bounce]) -> usize {
    let ahead = |bounce: &Bounce| {
        let ([x0, x1], [d0, d1]) = (seen(bounce), contact_direction(gamma_squared, bounce.piece));
        (x0 - o[0]) * d0 + (x1 - o[1]) * d1 > 0.0
    };
    // the directions of both lines point to greater x₀; that of the lower wall to greater x₁, that of the upper wall to less
    let (a, b) = (ahead(&flight[0]), ahead(&flight[1]));
    let (lower, upper) = if flight[0].piece == 0 { (a, b) } else { (b, a) };
    match (lower, upper) {
        (true, true) => 0,
        (false, false) => 1,
        (true, false) => 2,
        (false, true) => 3,
    }
}

/// The length of the longest run of each value.
fn longest_runs<const N: usize>(values: impl IntoIterator<Item = usize>) -> [usize; N] {
    let (mut longest, mut last, mut run) = ([0; N], N, 0);
    for value in values {
        run = if value == last { run + 1 } else { 1 };
        last = value;
        longest[value] = longest[value].max(run);
    }
    longest
}

fn measure(effort: Effort) -> Measurement {
    let (orbits, collisions) = (effort.of(60, 300), effort.of(1000, 3000));
    let mut quantities = vec![];
    for gamma_squared in ALL {
        let strip = no_slip(tables::strip(1.0), gamma_squared);
        let (mut same_way, mut quadrants) = ([0; 2], [0; 4]);
        for sample in 0..orbits {
            let orbit = bounces(&strip, random_start(&mut Stream::new(204, sample)), collisions);
            let o = centre(gamma_squared, &orbit[0], &orbit[1]);
            let ways: [usize; 2] = longest_runs(orbit.iter().map(|b| usize::from(b.state.v[1] > 0.0)));
            let runs: [usize; 4] = longest_runs(orbit.windows(2).map(|flight| quadrant(gamma_squared, o, flight)));
            for (most, run) in same_way.iter_mut().zip(ways).chain(quadrants.iter_mut().zip(runs)) {
                *most = run.max(*most);
            }
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small positive number")]
        let most = libm::ceil(PI / beta(gamma_squared)) as usize;
        let label = |what: &str| format!("longest run of flights {what}, γ² = {gamma_squared}");
        quantities.push(Quantity::count(label("to the left"), same_way[0], most));
        quantities.push(Quantity::count(label("to the right"), same_way[1], most));
        if gamma_squared == UNIFORM {
            quantities.extend([
                Quantity::count(label("in the upper quadrant"), quadrants[0], 1),
                Quantity::count(label("in the lower quadrant"), quadrants[1], 1),
                Quantity::count(label("in the right quadrant"), quadrants[2], 2),
                Quantity::count(label("in the left quadrant"), quadrants[3], 2),
            ]);
        }
    }
    quantities.into()
}

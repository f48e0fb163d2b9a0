//! The velocity map of two collisions in the strip.
use super::strip_width::random_start;
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{ALL, UNIFORM, beta, no_slip},
    motion::{self, bounces},
    random::Stream,
    statistics::{Range, worst},
};
use billiards::geometry::tables;
use nalgebra::{Matrix3, Vector3};

pub(super) const CLAIM: Claim = Claim {
    name: "strip-rotation",
    place: "eq. (2.3)",
    statement: "Two collisions in the strip turn the velocity by S = (F T)², the rotation about the x₂ axis with the entries −7/9 and \
                ±4√2/9; F is the change of frame from one wall to the other.",
    verdict: Verdict::Holds,
    general_gamma: Some("S is the rotation by 2β: cosine (1 − 6γ² + γ⁴)/(1+γ²)²."),
    measure,
};

/// From right after a collision with the lower wall to right after the next one with it.
fn two_collisions(gamma_squared: f64) -> Matrix3<f64> {
    no_slip(gamma_squared, [0.0, 1.0]) * no_slip(gamma_squared, [0.0, -1.0])
}

fn measure(effort: Effort) -> Measurement {
    let (cos, sin) = (-7.0 / 9.0, 4.0 * libm::sqrt(2.0) / 9.0);
    let paper = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    // a dozen roundings of numbers of size 1
    let rounding = 16.0 * f64::EPSILON;
    let mut quantities = vec![Quantity::residual(
        "S from the law of the two walls, against the paper's",
        (two_collisions(UNIFORM) - paper).amax(),
        rounding,
    )];
    for gamma_squared in ALL {
        let strip = motion::no_slip(tables::strip(1.0), gamma_squared);
        let (mut angles, mut off) = (Range::EMPTY, vec![]);
        for sample in 0..effort.of(30, 300) {
            let orbit = bounces(&strip, random_start(&mut Stream::new(205, sample)), 100);
            for two in orbit.windows(3).filter(|two| two[0].piece == 0) {
                let [v, w] = [&two[0], &two[2]].map(|b| Vector3::from(b.state.v));
                off.push((two_collisions(gamma_squared) * v - w).amax());
                angles.add(libm::atan2(v.x * w.y - v.y * w.x, v.x * w.x + v.y * w.y));
            }
        }
        let label = |what: &str| format!("{what}, γ² = {gamma_squared}");
        // an orbit has rounded a few ulp at each of its collisions, where the angle is measured with a radius of 0.14 or more
        let rounding = 100.0 * rounding;
        quantities.extend([
            Quantity::residual(label("velocities of orbits two collisions apart, against S"), worst(off), rounding),
            Quantity::equal(label("angle of two collisions, least"), angles.min, 2.0 * beta(gamma_squared), rounding),
            Quantity::equal(
                label("angle of two collisions, greatest"),
                angles.max,
                2.0 * beta(gamma_squared),
                rounding,
            ),
        ]);
    }
    quantities.into()
}

//! The angle β of the collision cone.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{ALL, UNIFORM, beta, cos_beta, no_slip, sin_beta},
    random::Stream,
    statistics::worst,
};
use nalgebra::{Matrix3, Vector3};

pub(super) const CLAIM: Claim = Claim {
    name: "special-angle",
    place: "Figure 2",
    statement: "A no-slip collision reflects the velocity specularly, changes the sign of its spin component, and turns it about \
                the normal by the angle β with cos β = 1/3, sin β = 2√2/3.",
    verdict: Verdict::Holds,
    general_gamma: Some("tan(β/2) = γ: cos β = (1−γ²)/(1+γ²), sin β = 2γ/(1+γ²)."),
    measure,
};

/// Reflect, change the sign of the spin, turn from `t = J ν` towards `x₀` by β.
fn construction(beta: f64, normal: [f64; 2]) -> Matrix3<f64> {
    let (nu, t) = (Vector3::new(0.0, normal[0], normal[1]), Vector3::new(0.0, -normal[1], normal[0]));
    let reflect = Matrix3::identity() - nu * nu.transpose() * 2.0;
    let flip = Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0));
    let (cos, sin, up) = (libm::cos(beta), libm::sin(beta), Vector3::x());
    let turn = nu * nu.transpose()
        + (t * t.transpose() + up * up.transpose()) * cos
        + (up * t.transpose() - t * up.transpose()) * sin;
    turn * flip * reflect
}

fn measure(effort: Effort) -> Measurement {
    let mut defects = vec![];
    for sample in 0..effort.of(100, 10_000) {
        let angle = Stream::new(2, sample).between(0.0, core::f64::consts::TAU);
        let normal = [libm::cos(angle), libm::sin(angle)];
        for gamma_squared in ALL {
            defects.push((construction(beta(gamma_squared), normal) - no_slip(gamma_squared, normal)).amax());
        }
    }
    let measured = no_slip(UNIFORM, [0.0, -1.0]);
    // a dozen roundings of numbers of size 1
    let rounding = 16.0 * f64::EPSILON;
    [
        Quantity::equal("cos β, from the law", measured[(1, 1)], cos_beta(UNIFORM), rounding),
        Quantity::equal("cos β, the paper's", cos_beta(UNIFORM), 1.0 / 3.0, rounding),
        Quantity::equal("sin β, the paper's", sin_beta(UNIFORM), 2.0 * libm::sqrt(2.0) / 3.0, rounding),
        Quantity::residual("construction against the law, random walls, four values of γ", worst(defects), rounding),
    ]
    .into()
}

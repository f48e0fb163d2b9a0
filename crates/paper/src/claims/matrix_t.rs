//! The collision map in coordinates, and which way its angle turns.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    law::{UNIFORM, no_slip},
};
use nalgebra::{Matrix3, Vector3};

pub(super) const CLAIM: Claim = Claim {
    name: "matrix-t",
    place: "eq. (2.2)",
    statement: "At a wall whose upward normal is in the direction of x₂ the velocity (ẋ₀, ẋ₁, ẋ₂) is multiplied by the matrix T with the \
                entries ∓1/3 on the diagonal and +2√2/3 off it, and −1.",
    verdict: Verdict::HoldsCorrected(
        "For that normal equation (2.1) gives −2√2/3 off the diagonal. T belongs to the normal (0, −1), or to x₀ counted clockwise. \
         What follows in the paper is consistent with T; compared with equation (2.1) the slopes dx₁/dx₀ and the spin of the wedge's axis \
         change sign.",
    ),
    general_gamma: Some("∓(1−γ²)/(1+γ²) on the diagonal and 2γ/(1+γ²) off it."),
    measure,
};

fn measure(_: Effort) -> Measurement {
    let (c, s) = (1.0 / 3.0, 2.0 * libm::sqrt(2.0) / 3.0);
    let t = Matrix3::new(-c, s, 0.0, s, c, 0.0, 0.0, 0.0, -1.0);
    let clockwise = Matrix3::from_diagonal(&Vector3::new(-1.0, 1.0, 1.0));
    let (up, down) = (no_slip(UNIFORM, [0.0, 1.0]), no_slip(UNIFORM, [0.0, -1.0]));
    let rounding = 4.0 * f64::EPSILON;
    [
        Quantity::equal("off-diagonal entry for the normal (0, 1)", up[(0, 1)], -s, rounding),
        Quantity::differs("off-diagonal entry for the normal (0, 1), against T", up[(0, 1)], s, 1.0),
        Quantity::residual("map for the normal (0, −1), against T", (down - t).amax(), rounding),
        Quantity::residual(
            "map for (0, 1) with x₀ clockwise, against T",
            (clockwise * up * clockwise - t).amax(),
            rounding,
        ),
    ]
    .into()
}

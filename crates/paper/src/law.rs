//! The no-slip law as numbers and matrices in `(x₀, x₁, x₂)`.
use billiards::{collision_laws::DiskLaw, collision_laws::laws::NoSlip};
use nalgebra::{Matrix3, Vector3};

/// `γ² = I/(m R²)` of a uniform disk.
pub(crate) const UNIFORM: f64 = 0.5;

/// Values of γ² beside that of the uniform disk at which claims for all γ are tried: a ball rolling as a disk would
/// (2/5), a disk with most of its mass inside, and one with most of it near the rim.
pub(crate) const OTHERS: [f64; 3] = [0.4, 0.15, 0.85];

/// All of them.
pub(crate) const ALL: [f64; 4] = [UNIFORM, OTHERS[0], OTHERS[1], OTHERS[2]];

/// `cos β = (1−γ²)/(1+γ²)`
pub(crate) fn cos_beta(gamma_squared: f64) -> f64 {
    (1.0 - gamma_squared) / (1.0 + gamma_squared)
}

/// `sin β = 2γ/(1+γ²)`
pub(crate) fn sin_beta(gamma_squared: f64) -> f64 {
    2.0 * libm::sqrt(gamma_squared) / (1.0 + gamma_squared)
}

/// `β = 2 arctan γ`
pub(crate) fn beta(gamma_squared: f64) -> f64 {
    2.0 * libm::atan(libm::sqrt(gamma_squared))
}

/// The matrix of the engine's no-slip law at a wall with inward unit normal `ν`.
pub(crate) fn no_slip(gamma_squared: f64, normal: [f64; 2]) -> Matrix3<f64> {
    let map = NoSlip.disk_map(libm::sqrt(gamma_squared));
    let [n1, n2] = normal;
    let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(|v| {
        let (spin, tangent, across) = map.apply(v.x, v.z * n1 - v.y * n2, v.y * n1 + v.z * n2);
        Vector3::new(spin, across * n1 - tangent * n2, across * n2 + tangent * n1)
    });
    Matrix3::from_columns(&columns)
}

//! Jacobian determinants of maps given as programs.

use nalgebra::{DMatrix, DVector};

/// The determinant of the derivative of `map` at a point, by central differences of order 6 with the given step.
///
/// For a map that is smooth on the scale `L` in every coordinate the error is about `(step/L)⁶ + 1e-16 · L/step`; choose
/// coordinates of comparable size. Use it on a billiard map, flight and collision together, in coordinates in which the
/// canonical measure is Lebesgue measure: in the plane `(s, v₀, vₜ)` with `s` arc length, at unit speed.
///
/// ```
/// use collision_laws::check::jacobian_determinant;
/// use nalgebra::{DVector, dvector};
///
/// let polar = |x: &DVector<f64>| dvector![x[0] * libm::cos(x[1]), x[0] * libm::sin(x[1])];
/// assert!((jacobian_determinant(polar, &dvector![2.0, 0.7], 1e-2) - 2.0).abs() < 1e-12);
/// ```
pub fn jacobian_determinant(map: impl Fn(&DVector<f64>) -> DVector<f64>, at: &DVector<f64>, step: f64) -> f64 {
    let size = at.len();
    let mut jacobian = DMatrix::zeros(size, size);
    for j in 0..size {
        let difference = |k: f64| {
            let (mut ahead, mut behind) = (at.clone(), at.clone());
            ahead[j] += k * step;
            behind[j] -= k * step;
            let width = ahead[j] - behind[j]; // what the rounded points are really apart
            (map(&ahead) - map(&behind)) / width
        };
        jacobian.set_column(j, &(difference(1.0) * 1.5 - difference(2.0) * 0.6 + difference(3.0) * 0.1));
    }
    jacobian.determinant()
}

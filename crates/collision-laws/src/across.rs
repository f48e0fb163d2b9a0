//! The component of an impulse perpendicular to its arm, which is all that turns the body: accurate to its own last digits however small
//! it is.
//!
//! If a body hardly resists turning, the impulse is almost along the arm `r`, and the products in `p ∧ r = p rᵀ − r pᵀ` cancel. If they
//! were rounded, the inverse of the inertia would magnify the error of `p ∧ r`, partly in planes of rotation that do not affect the
//! contact velocity, so that nothing could correct it later. Rounding of `p` itself is harmless: its effect on the spin shows in the
//! contact velocity, and [`Pair::collide`](crate::Pair::collide) removes it. (In the plane this is true of the whole error.)

use crate::product::product;
use nalgebra::{SMatrix, SVector};

/// `p − r (r·p)/(r·r)`; zero if the arm is zero.
#[inline]
pub(crate) fn across<const N: usize>(p: &SVector<f64, N>, r: &SVector<f64, N>) -> SVector<f64, N> {
    let size = r.amax();
    if size == 0.0 {
        return SVector::zeros();
    }
    let r = r / libm::ldexp(1.0, libm::frexp(size).1 - 1); // by a power of two: its square is in range and no digit lost
    let mut wedge = SMatrix::<f64, N, N>::zeros();
    for i in 0..N {
        for j in 0..i {
            wedge[(i, j)] = difference_of_products(p[i], r[j], r[i], p[j]);
            wedge[(j, i)] = -wedge[(i, j)];
        }
    }
    wedge * (r / r.norm_squared())
}

/// `a b − c d`, without the rounding of the products.
#[inline]
fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let ((ab, left), (cd, over)) = (product(a, b), product(c, d));
    (ab - cd) + (left - over)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    #[test]
    fn what_is_left_of_products_that_cancel_has_its_digits() {
        // rounded products would leave nothing of (1 + h)² − (1 + 2h) = h²
        let h = f64::from(1 << 30).recip();
        let (p, r) = (Vector2::new(1.0 + 2.0 * h, 1.0 + h), Vector2::new(1.0 + h, 1.0));
        for unit in [0, -1000, 1000].map(|k| libm::ldexp(1.0, k)) {
            let left = across(&p, &(r * unit));
            let exact = Vector2::new(-1.0, 1.0 + h) * (h * h / r.norm_squared());
            assert!((left - exact).amax() <= 2.0 * f64::EPSILON * h * h, "{unit:e}: {left}");
        }
    }

    #[test]
    fn near_the_ends_of_the_range_of_numbers_products_are_rounded_as_usual() {
        for (p, r) in [(1e307, 3e-301), (1e-300, 3e160), (3e150, 1e-310), (0.0, 1e308)] {
            let left = across(&Vector2::new(p, p), &Vector2::new(0.0, r));
            assert!((left.x - p).abs() <= 2.0 * f64::EPSILON * p && left.y == 0.0, "{p:e}: {left}");
        }
        assert_eq!(across(&Vector2::new(1.0, 2.0), &Vector2::zeros()), Vector2::zeros());
    }
}

//! Products with their rounding errors.
use lanes::two_prod;

/// `a b`, rounded, and what rounding left out; 0 where splitting a factor beyond 2⁹⁹⁶ overflows.
#[inline]
pub(crate) fn product(a: f64, b: f64) -> (f64, f64) {
    let (product, error) = two_prod(a, b);
    (product, if error.is_finite() { error } else { 0.0 })
}

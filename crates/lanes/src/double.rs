//! Error-free sums and products, and the double-double numbers made of them.
//!
//! References: [Dekker 1971], [Knuth, TAOCP 2, §4.2.2]; no fused operation is used.
use crate::Lane;

/// `a + b = sum + error` exactly (Knuth's two-sum, six operations; any magnitudes).
#[inline(always)]
pub fn two_sum<F: Lane>(a: F, b: F) -> (F, F) {
    let sum = a + b;
    let b_part = sum - a;
    let a_part = sum - b_part;
    (sum, (a - a_part) + (b - b_part))
}

/// The upper and the lower half of the digits of `a` (Veltkamp); `|a|` below 2⁹⁹⁶.
#[inline(always)]
fn split<F: Lane>(a: F) -> (F, F) {
    let c = a * 134_217_729.0; // 2²⁷ + 1
    let high = c - (c - a);
    (high, a - high)
}

/// `a b = product + error` exactly, where nothing over- or underflows (Dekker's two-product, seventeen operations).
#[inline(always)]
pub fn two_prod<F: Lane>(a: F, b: F) -> (F, F) {
    let product = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    (product, ((ah * bh - product) + ah * bl + al * bh) + al * bl)
}

/// An unevaluated sum `high + low` of two `f64`s: about 106 bits.
///
/// Used as a compensated accumulator: the time and the spin position of a long orbit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Double<F = f64> {
    /// The rounded value.
    pub high: F,
    /// What rounding left over.
    pub low: F,
}

impl<F: Lane> Double<F> {
    /// The number `a`.
    #[inline(always)]
    pub fn new(a: F) -> Self {
        Double { high: a, low: a.same(0.0) }
    }

    /// Adds `a` with an error of about 2⁻¹⁰⁵ of the sum.
    #[inline(always)]
    pub fn add(&mut self, a: F) {
        let (sum, error) = two_sum(self.high, a);
        let low = self.low + error;
        let high = sum + low;
        self.low = low - (high - sum);
        self.high = high;
    }

    /// The nearest `f64`.
    #[inline(always)]
    pub fn value(&self) -> F {
        self.high + self.low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_tenths_sum_to_the_exact_value() {
        let mut sum = Double::new(0.0);
        for _ in 0..1_000_000 {
            sum.add(0.1);
        }
        // 0.1 as an f64 is 0.1 + 5.551115123125783e-18, so the exact sum exceeds 10⁵ by 10⁶ times that
        assert_eq!(sum.high, 100_000.0);
        assert!((sum.low - 5.551_115_123_125_783e-12).abs() < 1e-20);
    }

    #[test]
    fn two_prod_is_error_free() {
        let (a, b) = (1.0 + f64::EPSILON, 1.0 - f64::EPSILON);
        let (p, e) = two_prod(a, b); // 1 − ε²
        assert_eq!((p, e), (1.0, -f64::EPSILON * f64::EPSILON));
    }
}

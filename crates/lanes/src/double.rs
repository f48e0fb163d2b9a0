//! Error-free sums and products, and the double-double numbers made of them.
//!
//! References: [Dekker 1971], [Knuth, TAOCP 2, §4.2.2]; for the errors of double-doubles [Joldes, Muller, Popescu 2017]; no fused operation
//! is used.
use crate::{Lane, Mask};
use core::ops::Neg;

/// `a + b = sum + error` exactly, for `|a|, |b| < 2¹⁰²³`, whichever is the larger (Knuth's two-sum, six operations).
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

/// `a b = product + error` exactly, for `|a|, |b| < 2⁹⁹⁶` with `a b = 0` or `2⁻⁹⁶⁹ ≤ |a b| < 2¹⁰²³` (Dekker's two-product, seventeen
/// operations). Larger numbers may overflow on the way, and the error is no number, however small the product; of smaller products the
/// error is rounded to a multiple of the smallest number.
#[inline(always)]
pub fn two_prod<F: Lane>(a: F, b: F) -> (F, F) {
    let product = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    (product, ((ah * bh - product) + ah * bl + al * bh) + al * bl)
}

/// An unevaluated sum `high + low` of two `f64`s: about 106 bits.
///
/// Used as a compensated accumulator: the time and the spin position of a long orbit.
///
/// The relative errors given for its operations are bounds where `high` is the nearest `f64` to each number, as all operations but
/// [`gather`](Double::gather) leave it, where sums are below 2¹⁰²³, and where what is multiplied is in the range of [`two_prod`]: the factors
/// of a product, quotient and divisor, or root and root. Quotients must also be at least 2⁻⁹⁶⁹.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Double<F = f64> {
    /// The rounded value; of a [gathered](Double::gather) sum, the plain sum of its terms in order.
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

    /// Adds `a`, with an error of at most 2⁻¹⁰⁵ of the sum.
    #[inline(always)]
    pub fn add(&mut self, a: F) {
        let (sum, error) = two_sum(self.high, a);
        let low = self.low + error;
        let high = sum + low;
        self.low = low - (high - sum);
        self.high = high;
    }

    /// Adds `a` to a long sum, whose two parts may overlap: the next term waits for one addition, not for seven. After `n` terms the
    /// small part holds what `n` roundings of the large one have lost, and has itself been rounded as often.
    #[inline(always)]
    pub fn gather(&mut self, a: F) {
        let (sum, error) = two_sum(self.high, a);
        self.high = sum;
        self.low = self.low + error;
    }

    /// `a b`, exactly in the range of [`two_prod`].
    #[inline(always)]
    pub fn product(a: F, b: F) -> Self {
        let (high, low) = two_prod(a, b);
        Double { high, low }
    }

    /// `self + other`, with an error of at most 2⁻¹⁰³ of the sum.
    #[inline(always)]
    #[must_use]
    pub fn plus(mut self, other: Self) -> Self {
        self.add(other.high);
        self.add(other.low);
        self
    }

    /// `self · other`, with an error of at most 2⁻¹⁰³ of the product.
    #[inline(always)]
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        let mut product = Double::product(self.high, other.high);
        product.add(self.high * other.low + self.low * other.high);
        product
    }

    /// `self / other`, with an error of at most 2⁻¹⁰² of the quotient.
    #[inline(always)]
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        let mut quotient = Double::new(self.high / other.high);
        let rest = self.plus((-quotient).times(other));
        quotient.add(rest.value() / other.high);
        quotient
    }

    /// `√self`, with an error of at most 2⁻¹⁰³ of the root; 0 where `self` is not positive.
    #[inline(always)]
    #[must_use]
    pub fn root(self) -> Self {
        let zero = self.high.same(0.0);
        let positive = zero.lt(self.high);
        let mut root = Double::new(positive.select(self.high, zero).sqrt());
        let rest = self.plus((-root).times(root)).value();
        let twice = root.high + root.high;
        root.add(positive.select(rest / positive.select(twice, self.high.same(1.0)), zero));
        root
    }

    /// The nearest `f64`.
    #[inline(always)]
    pub fn value(&self) -> F {
        self.high + self.low
    }
}

impl<F: Lane> Neg for Double<F> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Double { high: -self.high, low: -self.low }
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
    fn roots_of_what_is_not_positive_are_zero() {
        assert_eq!(Double::new(0.0).root(), Double::new(0.0));
        assert_eq!(Double::new(-1e-30).root(), Double::new(0.0));
    }

    #[test]
    fn a_gathered_sum_is_right_to_rounding_however_long() {
        let mut sum = Double::new(0.0);
        for _ in 0..1_000_000 {
            sum.gather(0.1);
        }
        let exact = Double::product(0.1, 1e6);
        assert!((sum.high - exact.high).abs() > 1e-7, "no test: nothing is rounded");
        assert!((sum.value() - exact.value()).abs() <= f64::EPSILON * exact.high);
    }
}

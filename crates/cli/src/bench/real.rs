//! Real numbers of three precisions, so that one program runs in all of them.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

use lanes::{two_prod, two_sum};

/// A number with a rounding error: `f32`, `f64`, or about 106 bits.
pub trait Real:
    Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Relative rounding error of an operation, or a little more.
    const EPSILON: f64;
    /// The nearest number to an `f64`.
    fn of(x: f64) -> Self;
    /// The nearest `f64`.
    fn value(self) -> f64;
    /// `√self`
    #[must_use]
    fn sqrt(self) -> Self;
}

impl Real for f64 {
    const EPSILON: f64 = f64::EPSILON;
    fn of(x: f64) -> Self {
        x
    }
    fn value(self) -> f64 {
        self
    }
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }
}

impl Real for f32 {
    const EPSILON: f64 = f32::EPSILON as f64;
    #[allow(clippy::cast_possible_truncation, reason = "rounding is the point")]
    fn of(x: f64) -> Self {
        x as f32
    }
    fn value(self) -> f64 {
        f64::from(self)
    }
    fn sqrt(self) -> Self {
        libm::sqrtf(self)
    }
}

/// An unevaluated sum of two `f64`s, the second below half an ulp of the first: about 106 bits \[Dekker 1971\].
///
/// Not [`lanes::Double`], with which the engine keeps time, spin position and energy: the reference must not share the arithmetic of what it
/// judges, but for the exact sum and product.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    fn normal(high: f64, low: f64) -> Self {
        let sum = high + low;
        DoubleDouble { high: sum, low: low - (sum - high) }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (sum, error) = two_sum(self.high, other.high);
        let (rest, lost) = two_sum(self.low, other.low);
        let first = Self::normal(sum, error + rest);
        Self::normal(first.high, first.low + lost)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        DoubleDouble { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (product, error) = two_prod(self.high, other.high);
        Self::normal(product, error + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::of(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::of(second);
        Self::normal(first, second) + Self::of(rest.high / other.high)
    }
}

impl Real for DoubleDouble {
    /// 2⁻¹⁰⁴: the last two of 106 bits are not reliable.
    const EPSILON: f64 = 4.930_380_657_631_324e-32;
    fn of(x: f64) -> Self {
        DoubleDouble { high: x, low: 0.0 }
    }
    fn value(self) -> f64 {
        self.high
    }
    fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::of(libm::sqrt(self.high));
        }
        // one step of Newton's method doubles the digits of the root of the high part
        let root = Self::of(libm::sqrt(self.high));
        let rest = self - root * root;
        root + Self::of(rest.high / (2.0 * root.high))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_numbers_hold_thirty_one_digits() {
        let [one, two, three, seven] = [1.0, 2.0, 3.0, 7.0].map(DoubleDouble::of);
        // each is off by one or two roundings of 2⁻¹⁰⁴
        for zero in [two.sqrt() * two.sqrt() - two, one / seven * seven - one, (one / three + two / three) - one] {
            assert!(zero.value().abs() < 8.0 * DoubleDouble::EPSILON, "{zero:?}");
        }
        // √2 = 1.4142135623730950488016887242096980785696718753769…; its f64 is 1.4142135623730951454746218587388
        assert_eq!(two.sqrt().high, core::f64::consts::SQRT_2);
        assert!((two.sqrt().low + 9.667_293_313_452_913e-17).abs() < 1e-31);
    }
}

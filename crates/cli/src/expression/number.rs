//! The kinds of numbers in which a formula can be evaluated: doubles, and intervals that enclose
//! all its values in a box.

use billiards::geometry::shapes::curve::Interval;

use super::{Function, Operation};

/// A kind of number that formulas can be evaluated in.
pub(super) trait Number: Copy {
    /// A number of the formula.
    fn constant(x: f64) -> Self;
    /// `-x`.
    fn negate(self) -> Self;
    /// A function of it.
    fn function(self, f: Function) -> Self;
    /// An operation on it and another.
    fn operation(self, f: Operation, other: Self) -> Self;
}

impl Number for f64 {
    fn constant(x: f64) -> Self {
        x
    }

    fn negate(self) -> Self {
        -self
    }

    fn function(self, f: Function) -> Self {
        match f {
            Function::Sqrt => self.sqrt(),
            Function::Abs => self.abs(),
            Function::Exp => libm::exp(self),
            Function::Ln => libm::log(self),
            Function::Sin => libm::sin(self),
            Function::Cos => libm::cos(self),
            Function::Tan => libm::tan(self),
            Function::Asin => libm::asin(self),
            Function::Acos => libm::acos(self),
            Function::Atan => libm::atan(self),
            Function::Sinh => libm::sinh(self),
            Function::Cosh => libm::cosh(self),
            Function::Tanh => libm::tanh(self),
            Function::Jump => 0.0,
        }
    }

    fn operation(self, f: Operation, other: Self) -> Self {
        match f {
            Operation::Add => self + other,
            Operation::Subtract => self - other,
            Operation::Multiply => self * other,
            Operation::Divide => self / other,
            Operation::Power => power(self, other),
            Operation::SignedPower => power(self.abs(), other).copysign(self),
            Operation::Atan2 => libm::atan2(self, other),
        }
    }
}

/// `aᵇ`; squares and cubes, the powers of every conic and cubic, as products.
fn power(a: f64, b: f64) -> f64 {
    match b {
        2.0 => a * a,
        3.0 => a * a * a,
        _ => libm::pow(a, b),
    }
}

impl Number for Interval {
    fn constant(x: f64) -> Self {
        // an infinite end stands for numbers of any size, and is not a number itself
        if x.is_finite() { Self::from(x) } else { Self::ENTIRE }
    }

    fn negate(self) -> Self {
        -self
    }

    fn function(self, f: Function) -> Self {
        match f {
            Function::Sqrt => self.sqrt(),
            Function::Abs => self.abs(),
            Function::Exp => self.exp(),
            Function::Ln => self.ln(),
            Function::Sin => self.sin(),
            Function::Cos => self.cos(),
            Function::Tan => self.tan(),
            Function::Asin => self.asin(),
            Function::Acos => self.acos(),
            Function::Atan => self.atan(),
            Function::Sinh => self.sinh(),
            Function::Cosh => self.cosh(),
            Function::Tanh => self.tanh(),
            Function::Jump => {
                if self.contains(0.0) {
                    Self::ENTIRE
                } else {
                    Self::from(0.0)
                }
            }
        }
    }

    fn operation(self, f: Operation, other: Self) -> Self {
        match f {
            Operation::Add => self + other,
            Operation::Subtract => self - other,
            Operation::Multiply => self * other,
            Operation::Divide => self / other,
            Operation::Power => self.powf(other),
            Operation::SignedPower => signed_power(self, other),
            Operation::Atan2 => self.atan2(other),
        }
    }
}

/// `sign(x) |x|ʸ`, which rises with `x` for `y ≥ 0`.
fn signed_power(x: Interval, y: Interval) -> Interval {
    let of_size = |x: Interval| x.abs().powf(y);
    if x.low > 0.0 {
        of_size(x)
    } else if x.high < 0.0 {
        -of_size(x)
    } else if y.low < 0.0 {
        Interval::ENTIRE
    } else {
        (-of_size(Interval::new(x.low, 0.0))).union(of_size(Interval::new(0.0, x.high)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expression::value;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn intervals_hold_what_functions_are_worth_in_more_digits(
            thousandths in prop_oneof![-1024..=1024, -20_000..20_000, -716_000..716_000],
        ) {
            // all of whose digits are written
            let x = f64::from(thousandths) / 1024.0;
            for (name, f) in Function::ALL {
                if let Ok(exact) = value(&format!("{name}({x:?})")) {
                    let over = Interval::from(x).function(f);
                    prop_assert!(over.contains(exact), "{name}({x:?}) = {exact:?}, not in {over:?}");
                }
            }
        }
    }
}

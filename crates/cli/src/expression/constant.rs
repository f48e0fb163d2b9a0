//! The constants of formulas, in 192 bits: a part without variables is rounded only once, at its end.
//!
//! Each step in doubles may be off by half a unit in the last place, and `cos(pi/2)` would not even be 0.

use dashu_float::{
    Context, DBig, FBig, FpResult,
    round::{Rounded, mode::HalfEven},
};

use super::{Function, Node, Operation};

type Big = FBig<HalfEven, 2>;

/// Bits of a constant.
const BITS: usize = 192;
/// A number whose relative difference from a double is this small is taken to be that double, and a difference this small beside its
/// terms to be 0: a thousand roundings are less, and only one in 10³⁴ other numbers comes so near.
const ROUNDED: isize = -170;
/// The digits of a larger angle do not determine where on the circle it is.
pub(super) const LARGEST_ANGLE: f64 = 1e30;
/// Larger powers go through the logarithm.
const MOST_FACTORS: f64 = 1024.0;

/// A number of a formula.
#[derive(Clone, Debug)]
pub(super) struct Constant(Big);

/// How a number is written in the text of a formula.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Literal<'a> {
    /// In digits.
    Decimal(&'a str),
    /// By the name of π.
    Pi,
}

impl From<f64> for Constant {
    fn from(x: f64) -> Self {
        Constant(Big::try_from(x).unwrap_or(Big::ZERO).with_precision(BITS).value())
    }
}

impl Constant {
    /// The number that a text means, which as a double is `value`.
    pub(super) fn of(literal: Literal<'_>, value: f64) -> Self {
        let decimal = |text: &str| {
            let digits: DBig = text.parse().ok()?;
            Some(Constant(digits.with_base_and_precision::<2>(BITS).value().with_rounding()))
        };
        match literal {
            Literal::Pi => Constant(Big::pi(BITS)),
            // its exponent may be anything
            Literal::Decimal(_) if value == 0.0 => Constant::from(value),
            Literal::Decimal(text) => decimal(text).unwrap_or_else(|| Constant::from(value)),
        }
    }

    /// The nearest double, infinite for none.
    pub(super) fn value(&self) -> f64 {
        self.0.to_f64().value()
    }

    /// The value of a node with constant operands; `double` is its finite value for the doubles nearest to them.
    pub(super) fn of_node(node: Node, operand: impl Fn(usize) -> Self, double: f64) -> Self {
        let found = match node {
            Node::Constant(_) | Node::Variable(_) => None,
            Node::Negate(a) => Some(-operand(a).0),
            // nothing this small is needed, and computing its digits might take for ever
            Node::Unary(Function::Exp, _) | Node::Binary(Operation::Power | Operation::SignedPower, ..)
                if double == 0.0 =>
            {
                None
            }
            Node::Unary(f, a) => function(f, &operand(a).0),
            Node::Binary(f, a, b) => operation(f, &operand(a).0, &operand(b).0),
        };
        found.map_or_else(|| Constant::from(double), |found| Constant(to_double(found)))
    }
}

/// The number itself, or the double from which it differs only by rounding; 0 has no sign, which `atan2` would see.
fn to_double(x: Big) -> Big {
    let near = x.to_f64().value();
    if near.is_infinite() {
        return x;
    }
    if x == Big::ZERO {
        return Big::ZERO;
    }
    let near = Constant::from(near).0;
    if is_rounding(&(&x - &near), &x) { near } else { x }
}

fn size(x: &Big) -> Big {
    if *x < Big::ZERO { -x } else { x.clone() }
}

/// Whether a number is negligible beside another.
fn is_rounding(x: &Big, beside: &Big) -> bool {
    size(x) <= size(beside) << ROUNDED
}

/// The number, or 0 where it is no more than the rounding of what it was computed from.
fn without_rounding(x: Big, beside: &Big) -> Big {
    if is_rounding(&x, beside) { Big::ZERO } else { x }
}

/// A function of a number; `None` where it has no value, infinite where its value is not known.
fn function(f: Function, x: &Big) -> Option<Big> {
    let (context, repr) = (Context::<HalfEven>::new(BITS), x.repr());
    let wave = matches!(f, Function::Sin | Function::Cos | Function::Tan);
    if wave && x.to_f64().value().abs() > LARGEST_ANGLE {
        return Some(Big::INFINITY);
    }
    let found = match f {
        Function::Abs => return Some(size(x)),
        Function::Jump => return None,
        Function::Sqrt => context.sqrt(repr),
        Function::Exp => context.exp(repr, None),
        Function::Ln => context.ln(repr, None),
        Function::Sin => context.sin(repr, None),
        Function::Cos => context.cos(repr, None),
        Function::Tan => context.tan(repr, None),
        Function::Asin => context.asin(repr, None),
        Function::Acos => context.acos(repr, None),
        Function::Atan => context.atan(repr, None),
        Function::Sinh => context.sinh(repr, None),
        Function::Cosh => context.cosh(repr, None),
        Function::Tanh => context.tanh(repr, None),
    };
    let found = value(found).map(|y| if wave { without_rounding(y, x) } else { y })?;
    let pole = f == Function::Tan && is_rounding(&Big::ONE, &found);
    Some(if pole { Big::INFINITY } else { found })
}

/// An operation on two numbers; `None` where it has no value.
fn operation(f: Operation, x: &Big, y: &Big) -> Option<Big> {
    let context = Context::<HalfEven>::new(BITS);
    let larger = || if size(x) < size(y) { y } else { x };
    match f {
        Operation::Add => value(context.add(x.repr(), y.repr())).map(|sum| without_rounding(sum, larger())),
        Operation::Subtract => {
            value(context.sub(x.repr(), y.repr())).map(|difference| without_rounding(difference, larger()))
        }
        Operation::Multiply => value(context.mul(x.repr(), y.repr())),
        Operation::Divide => value(context.div(x.repr(), y.repr())),
        Operation::Power => power(x, y),
        Operation::SignedPower => power(&size(x), y).map(|z| if *x < Big::ZERO { -z } else { z }),
        Operation::Atan2 => value(context.atan2(x.repr(), y.repr(), None)),
    }
}

/// What was found, if it is a number.
fn value(found: FpResult<Big>) -> Option<Big> {
    found.ok().map(Rounded::value).filter(|x| !x.repr().is_infinite())
}

/// `xʸ`, with a whole `y` by products.
fn power(x: &Big, y: &Big) -> Option<Big> {
    let context = Context::<HalfEven>::new(BITS);
    let exponent = y.to_f64().value();
    value(if exponent.abs() <= MOST_FACTORS && exponent % 1.0 == 0.0 && Constant::from(exponent).0 == *y {
        #[allow(clippy::cast_possible_truncation, reason = "a whole number of four digits")]
        let exponent = exponent as i64;
        context.powi(x.repr(), exponent.into())
    } else {
        context.powf(x.repr(), y.repr(), None)
    })
}

#[cfg(test)]
mod tests {
    use crate::expression::value;

    #[test]
    fn what_mathematics_knows_exactly_is_exact() {
        for (text, exact) in [
            ("cos(pi/2)", 0.0),
            ("sin(pi)", 0.0),
            ("sin(1000*pi)", 0.0),
            ("sin(pi/6)", 0.5),
            ("cos(2*pi/3)", -0.5),
            ("tan(pi/4)", 1.0),
            ("tan(3*pi)", 0.0),
            ("sqrt(2)^2", 2.0),
            ("(-sqrt(2))^3/sqrt(8)", -1.0),
            ("sqrt(1-sin(1)^2-cos(1)^2)", 0.0),
            ("acos(2*cos(pi/3))", 0.0),
            ("4*atan(1)-pi", 0.0),
            ("1/3+1/3+1/3", 1.0),
            ("0.1+0.2", 0.3),
            ("0.1*3", 0.3),
            (".1e1*5.", 5.0),
            ("ln(exp(3))", 3.0),
            ("exp(ln(2)/2)^2", 2.0),
            ("8^(1/3)", 2.0),
            ("2^0.5*2^0.5", 2.0),
            ("(2^0.5)^2046/2^1022", 2.0),
            ("atan2(0, -1) - pi", 0.0),
            ("atan2(-sinh(0), -1) - pi", 0.0),
            ("atan2(1, 1)*4/pi", 1.0),
            ("(sqrt(5)-1)/4 - sin(pi/10)", 0.0),
            ("sinh(ln(2))", 0.75),
            ("cosh(ln(2))", 1.25),
            ("tanh(ln(3))", 0.8),
            ("cosh(3)^2-sinh(3)^2", 1.0),
            ("sinh(1e-30)*1e30", 1.0),
        ] {
            assert_eq!(value(text), Ok(exact), "{text}");
        }
    }

    /// Digits from mpmath, in 300 bits.
    #[test]
    fn a_number_is_the_double_nearest_to_what_its_text_means() {
        for (text, nearest) in [
            ("acos(1/2-(3/2)*cos(pi/4))", 2.165_979_176_431_350_5),
            ("pi", core::f64::consts::PI),
            ("exp(1)", core::f64::consts::E),
            ("pi^10", 93_648.047_476_083_03),
            ("sin(1e22)", -0.852_200_849_767_188_8),
            ("tan(1e10)", -0.558_349_637_811_241_8),
            ("1.1^0.7", 1.068_993_044_916_333),
            ("1e300*pi*1e-300", core::f64::consts::PI),
            ("1e-200*1e-200*1e300*1e100", 1.0),
            ("exp(pi*sqrt(163))-262537412640768744", -7.499_274_028_018_143e-13),
        ] {
            assert_eq!(value(text), Ok(nearest), "{text}");
        }
    }

    #[test]
    fn no_size_of_numbers_takes_for_ever() {
        for text in [
            "exp(-1e300)",
            "1e-300^300",
            "2^-1e18",
            "0.5^1e300",
            "1e-999999999",
            "0e999999999",
            "(1+1e-15)^1e17",
            "(1-1e-300)^1e300",
            "exp(1e-300)",
            "5e-324*5e-324*5e-324",
            "(-2)^1023",
            "(-2)^-1074",
            "(-1)^1e15",
            "atan(1e308)",
            "tanh(1e308)",
            "tanh(-1e-308)",
            "sinh(710)",
            "sinh(1e-300)",
            "cosh(-1e-300)",
            "acos(1-1e-16)",
            "ln(1+1e-300)",
            "atan2(1e-308, -1e308)",
            "0^0",
            "0^0.5",
        ] {
            assert!(value(text).is_ok(), "{text}: {:?}", value(text));
        }
    }

    /// It would come out as rounding: `cos(1e100)` as 0, and it is -0.928.
    #[test]
    fn there_is_no_sine_of_an_angle_whose_digits_do_not_tell_where_on_the_circle_it_is() {
        for (text, column) in
            [("sin(1e31)", 1), ("2*cos(1e100)", 3), ("tan(-1e54)", 1), ("sin(1e308)", 1), ("cos(2^170)", 1)]
        {
            let error = value(text).expect_err(text);
            assert_eq!(error.column, column, "{text}");
            assert!(
                error.what.ends_with("its digits do not determine a point on the circle"),
                "{text}: {}",
                error.what
            );
        }
        // mpmath, in 400 bits
        assert_eq!(value("sin(1e30)"), Ok(-0.090_116_901_912_138_06));
    }

    #[test]
    fn what_is_too_large_in_more_digits_alone_is_too_large() {
        // to a double the base is 1
        let error = value("1 + (1.7e308^1e-20)^1e22").expect_err("e to the power 7000");
        assert_eq!((error.column, error.what.as_str()), (20, "the value is too large for a double"));
    }

    #[test]
    fn there_is_no_tangent_of_a_right_angle() {
        let error = value("1 + tan(pi/2)").expect_err("no number");
        assert_eq!((error.column, error.what.as_str()), (5, "tan of an odd multiple of pi/2, where it is undefined"));
    }
}

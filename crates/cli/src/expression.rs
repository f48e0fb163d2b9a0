//! Numbers written as formulas: `"sqrt(3)/2"`, `"acos(1/2-(3/2)*cos(pi/4))"`, and curves such as `"1 + 0.2*cos(5*t)"`.
//!
//! A mathematician writes √3/2, not 0.8660254037844386, and a scene should contain what was meant. The parser is iterative (an operator
//! stack), so no input can exhaust the call stack; a parsed expression is a list of nodes, each of which refers only to earlier ones, so
//! evaluation and differentiation are single passes.

mod constant;
mod curve;
mod derivative;
mod domain;
mod number;
mod parser;
mod program;
mod turn;

use std::fmt;

pub use curve::{ImplicitCurve, ParametricCurve, PolarCurve};
pub use program::Program;

use constant::{Constant, LARGEST_ANGLE, Literal};
use number::Number;
use parser::{Parser, tokens};

/// Longest accepted text, in characters.
pub const MAX_CHARACTERS: usize = 1000;
/// Deepest accepted nesting of parentheses.
pub const MAX_LEVELS: usize = 100;
/// Up to this many nodes, evaluation needs no allocation.
const SMALL: usize = 64;

/// Advice where a number is too large.
const TOO_LARGE: &str = "the largest double is 1.8e308: make it smaller";

/// What is wrong with an expression, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// Column of the error inside the expression, counted in characters from 1.
    pub column: usize,
    /// What is wrong, in lower case.
    pub what: String,
    /// How to fix it, where that is known.
    pub help: Option<String>,
}

impl Error {
    fn new(column: usize, what: impl Into<String>) -> Self {
        Self { column, what: what.into(), help: None }
    }

    fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "column {}: {}", self.column, self.what)
    }
}

impl std::error::Error for Error {}

/// A function of one real argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Function {
    Sqrt,
    Abs,
    Exp,
    Ln,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    /// The derivative of the sign: 0 except at 0, where it is unbounded. Formulas cannot name it.
    Jump,
}

impl Function {
    const ALL: [(&'static str, Self); 13] = [
        ("sqrt", Self::Sqrt),
        ("abs", Self::Abs),
        ("exp", Self::Exp),
        ("ln", Self::Ln),
        ("sin", Self::Sin),
        ("cos", Self::Cos),
        ("tan", Self::Tan),
        ("asin", Self::Asin),
        ("acos", Self::Acos),
        ("atan", Self::Atan),
        ("sinh", Self::Sinh),
        ("cosh", Self::Cosh),
        ("tanh", Self::Tanh),
    ];
}

/// An operation on two real arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Operation {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    /// `sign(x) |x|ʸ`, used for derivatives of `|x|ʸ`; the sign itself for `y = 0`. Formulas cannot name it.
    SignedPower,
    Atan2,
}

/// One node; operands are indices of earlier nodes.
#[derive(Clone, Copy, Debug)]
enum Node {
    Constant(f64),
    Variable(usize),
    Negate(usize),
    Unary(Function, usize),
    Binary(Operation, usize, usize),
}

/// A formula in named variables, ready to be evaluated and differentiated.
///
/// ```
/// use billiards_cli::expression::Expression;
///
/// let r = Expression::parse("1 + 0.2*cos(5*t)", &["t"])?;
/// assert_eq!(r.evaluate(&[0.0]), 1.2);
/// assert_eq!(r.derivative(0).evaluate(&[0.0]), 0.0);
/// # Ok::<(), billiards_cli::expression::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Expression {
    nodes: Vec<Node>,
    /// Column of each node in the text; empty for a derived expression.
    columns: Vec<usize>,
}

/// The value of an expression without variables.
///
/// Operators by falling precedence: `^` (right-associative), unary minus, `*` and `/`, `+` and `-`; so `-2^2` is −4.
/// `pi`, `sqrt`, `abs`, `exp`, `ln`, `sin`, `cos`, `tan`, `asin`, `acos`, `atan`, `atan2(y, x)`, `sinh`, `cosh`, `tanh`; angles in radians.
///
/// # Errors
/// A syntax error, or a step whose value is not a finite real number.
///
/// ```
/// assert_eq!(billiards_cli::expression::value("-2^2"), Ok(-4.0));
/// assert_eq!(billiards_cli::expression::value("1 + sqrt(-1)").unwrap_err().column, 5);
/// ```
pub fn value(text: &str) -> Result<f64, Error> {
    Ok(Expression::parse(text, &[])?.evaluate(&[]))
}

impl Expression {
    /// Parses a formula in the given variables.
    ///
    /// # Errors
    /// A syntax error, an unknown name, more than [`MAX_CHARACTERS`] or [`MAX_LEVELS`], or a part without variables whose value is not
    /// a finite real number.
    pub fn parse(text: &str, variables: &[&str]) -> Result<Self, Error> {
        if let Some((i, _)) = text.chars().enumerate().nth(MAX_CHARACTERS) {
            return Err(Error::new(i + 1, format!("expression is longer than {MAX_CHARACTERS} characters")));
        }
        let (formula, literals) = Parser::new(variables).parse(&tokens(text)?)?;
        formula.folded(&literals)
    }

    /// The value at a point, one number per variable; NaN or infinite where the formula has no finite real value.
    pub fn evaluate(&self, variables: &[f64]) -> f64 {
        if self.nodes.len() <= SMALL {
            fill(&self.nodes, &mut [0.0; SMALL], variables)
        } else {
            fill(&self.nodes, &mut vec![0.0; self.nodes.len()], variables)
        }
    }

    /// The same formula with its parts without variables replaced by numbers, with every step checked.
    ///
    /// Evaluated in numbers or in intervals, a formula then has the same constants: `x^(4/2)` is a square to both. They are computed
    /// in more digits and rounded to doubles at their ends.
    fn folded(mut self, literals: &[(usize, Literal<'_>)]) -> Result<Self, Error> {
        let mut values = vec![f64::NAN; self.nodes.len()];
        let mut constants: Vec<Option<Constant>> = vec![None; self.nodes.len()];
        // a number that stands alone is simply the double that it is read as
        for &(i, literal) in literals.iter().filter(|_| self.nodes.len() > 1) {
            if let Node::Constant(value) = self.nodes[i] {
                constants[i] = Some(Constant::of(literal, value));
            }
        }
        for (i, &column) in self.columns.iter().enumerate() {
            let node = self.nodes[i].without_root_of_square(&self.nodes);
            let known = |a: usize| matches!(self.nodes[a], Node::Constant(_));
            let constant = match node {
                Node::Constant(_) => true,
                Node::Variable(_) => false,
                Node::Negate(a) | Node::Unary(_, a) => known(a),
                Node::Binary(_, a, b) => known(a) && known(b),
            };
            self.nodes[i] = node;
            if constant {
                let mut value: f64 = node.apply(&values, &[]);
                if !value.is_finite() {
                    return Err(node.complaint(&values, column));
                }
                if !matches!(node, Node::Constant(_)) {
                    let operand = |a: usize| constants[a].clone().unwrap_or_else(|| Constant::from(values[a]));
                    let constant = Constant::of_node(node, operand, value);
                    value = constant.value();
                    constants[i] = Some(constant);
                }
                if !value.is_finite() {
                    return Err(node.complaint(&values, column));
                }
                values[i] = value;
                self.nodes[i] = Node::Constant(value);
            }
        }
        Ok(self)
    }
}

/// Evaluates nodes in turn into `values`, and returns the last value.
fn fill<T: Number>(nodes: &[Node], values: &mut [T], variables: &[T]) -> T {
    let mut last = T::constant(f64::NAN);
    for (i, node) in nodes.iter().enumerate() {
        last = node.apply(values, variables);
        values[i] = last;
    }
    last
}

impl Node {
    fn apply<T: Number>(self, values: &[T], variables: &[T]) -> T {
        match self {
            Self::Constant(x) => T::constant(x),
            Self::Variable(i) => variables.get(i).copied().unwrap_or(T::constant(f64::NAN)),
            Self::Negate(a) => values[a].negate(),
            Self::Unary(f, a) => values[a].function(f),
            Self::Binary(f, a, b) => values[a].operation(f, values[b]),
        }
    }

    /// `|x|` for `√x²`: it is exact to the last bit, and its derivative is a sign rather than a quotient.
    fn without_root_of_square(self, nodes: &[Self]) -> Self {
        match self {
            Self::Unary(Function::Sqrt, a) => match nodes[a] {
                Self::Binary(Operation::Power, x, two) if matches!(nodes[two], Self::Constant(2.0)) => {
                    Self::Unary(Function::Abs, x)
                }
                _ => self,
            },
            _ => self,
        }
    }

    /// Why this node, at a column of the text, has no finite value although its operands are finite.
    fn complaint(self, values: &[f64], column: usize) -> Error {
        let (what, help) = match self {
            Self::Unary(Function::Sqrt, a) => {
                (format!("sqrt of the negative number {}", values[a]), "its argument must not be negative")
            }
            Self::Unary(Function::Ln, a) => {
                (format!("ln of {}, which is not positive", values[a]), "its argument must be positive")
            }
            Self::Unary(Function::Asin, a) => {
                (format!("asin of {}, which is outside [-1, 1]", values[a]), "its argument must lie between -1 and 1")
            }
            Self::Unary(Function::Acos, a) => {
                (format!("acos of {}, which is outside [-1, 1]", values[a]), "its argument must lie between -1 and 1")
            }
            Self::Unary(Function::Sin | Function::Cos | Function::Tan, a) if values[a].abs() > LARGEST_ANGLE => (
                format!("the angle {:?} is so large that its digits do not determine a point on the circle", values[a]),
                "angles are in radians: write one between -1e30 and 1e30",
            ),
            Self::Unary(Function::Tan, _) => (
                "tan of an odd multiple of pi/2, where it is undefined".into(),
                "its argument must not be an odd multiple of pi/2",
            ),
            Self::Binary(Operation::Divide, _, b) if values[b] == 0.0 => {
                ("division by zero".into(), "the divisor must not be 0")
            }
            Self::Binary(Operation::Power, a, b) if values[a] == 0.0 => {
                (format!("zero to the negative power {}", values[b]), "the base must not be 0")
            }
            Self::Binary(Operation::Power, a, b) if values[a] < 0.0 && values[b] % 1.0 != 0.0 => (
                format!("the negative number {} to the power {}, which is not an integer", values[a], values[b]),
                "take an integer power, or abs of the base",
            ),
            _ => ("the value is too large for a double".into(), TOO_LARGE),
        };
        Error::new(column, what).with_help(help)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use billiards::geometry::shapes::curve::Interval;
    use proptest::prelude::*;

    fn error(text: &str) -> (usize, String) {
        let e = value(text).expect_err(text);
        (e.column, e.what)
    }

    #[test]
    fn precedence_is_that_of_mathematics() {
        for (text, expected) in [
            ("1 + 2*3", 7.0),
            ("-2^2", -4.0),
            ("2^-1", 0.5),
            ("2^3^2", 512.0),
            ("2^-1^2", 0.5),
            ("10-4-3", 3.0),
            ("24/4/3", 2.0),
            ("2*-3+1", -5.0),
            ("--2", 2.0),
            ("+2", 2.0),
            ("(1+2)*(3-5)", -6.0),
            ("2^-3*4", 0.5),
            ("-(1)-(-1)", 0.0),
            ("1e-3", 1e-3),
            ("1.5E+2", 150.0),
            (".5 + 5.", 5.5),
            ("atan2(1, -1)", libm::atan2(1.0, -1.0)),
            ("abs(-3) + sqrt(16) + exp(0) + ln(1)", 8.0),
        ] {
            assert_eq!(value(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn results_are_correctly_rounded_where_arithmetic_is() {
        assert_eq!(value("2/3"), Ok(2.0 / 3.0));
        assert_eq!(value("sqrt(2)/4"), Ok(2f64.sqrt() / 4.0));
        assert_eq!(value("0.1"), Ok(0.1));
        assert_eq!(
            value("acos(1/2-(3/2)*cos(pi/4))"),
            Ok(libm::acos(0.5 - 1.5 * libm::cos(core::f64::consts::FRAC_PI_4)))
        );
    }

    #[test]
    fn syntax_errors_point_at_their_column() {
        assert_eq!(error("1 + ").0, 4);
        assert_eq!(error(""), (1, "empty expression".into()));
        assert_eq!(error("2pi"), (2, "missing operator".into()));
        assert_eq!(error("(1+2"), (1, "this parenthesis is never closed".into()));
        assert_eq!(error("1+2)"), (4, "no parenthesis is open here".into()));
        assert_eq!(error("sqrt 2").0, 1);
        assert_eq!(error("atan2(1)").0, 1);
        assert_eq!(error("sin(1, 2)").0, 6);
        assert_eq!(error("1,5").0, 2);
        assert_eq!(error("2**3").0, 3);
        assert_eq!(error("sin()").0, 5);
        assert_eq!(error("π/2 \u{2212} 1").0, 1);
        assert_eq!(error("1 \u{2212} 1").0, 3);
        assert_eq!(error("1.2.3").0, 4);
        assert_eq!(error("()").0, 2);
        let help = |text: &str| value(text).unwrap_err().help;
        assert_eq!(help("sqr(2)").as_deref(), Some("did you mean \"sqrt\"?"));
        for text in ["nan", "NaN", "inf", "-Inf", "Infinity"] {
            assert_eq!(help(text).as_deref(), Some("write a finite number"), "{text}");
        }
        assert_eq!(help("max(2, 1)").as_deref(), Some("write (x+y+abs(x-y))/2"));
    }

    #[test]
    fn values_that_are_not_finite_are_errors() {
        assert_eq!(error("1/0"), (2, "division by zero".into()));
        assert_eq!(error("atan(1/(2-2))").0, 7);
        assert_eq!(error("1 + sqrt(-1)").0, 5);
        assert_eq!(error("ln(0)").0, 1);
        assert_eq!(error("asin(2)").0, 1);
        assert_eq!(error("(-8)^(1/3)").0, 5);
        assert_eq!(error("0^-1").0, 2);
        assert_eq!(error("exp(1000)").0, 1);
        assert_eq!(error("1e999").0, 1);
        assert!(value("nan").is_err());
        assert!(value("inf").is_err());
    }

    #[test]
    fn parts_without_variables_are_numbers_once_parsed() {
        for (text, same) in [
            ("t^(4/2)", "t^2"),
            ("t^sqrt(4)", "t^2"),
            ("t^(exp(0)*3)", "t^3"),
            ("sqrt(t^sqrt(4))", "abs(t)"),
            ("t^-2", "t^(1-3)"),
            ("sin(1)*t", "0.8414709848078965*t"),
        ] {
            let [a, b] = [text, same].map(|text| Program::new([&Expression::parse(text, &["t"]).unwrap()]));
            let over = [Interval::new(-0.5, 1.5)];
            assert_eq!(a.evaluate(&over), b.evaluate(&over), "{text}");
            assert_eq!(a.evaluate(&[-0.3]), b.evaluate(&[-0.3]), "{text}");
        }
        let wrong = |text: &str| Expression::parse(text, &["t"]).unwrap_err();
        assert_eq!(wrong("t + sqrt(1-2)").to_string(), "column 5: sqrt of the negative number -1");
        assert_eq!(wrong("t^(1/0)").column, 5);
    }

    #[test]
    fn limits_are_a_thousand_characters_and_a_hundred_levels() {
        let nested = |n: usize| format!("{}1{}", "(".repeat(n), ")".repeat(n));
        assert_eq!(value(&nested(100)), Ok(1.0));
        assert_eq!(error(&nested(101)).0, 101);
        assert_eq!(value(&"-".repeat(998).add("1")), Ok(1.0));
        assert_eq!(value(&"1^".repeat(499).add("1")), Ok(1.0));
        assert_eq!(value(&"1".repeat(1001)).unwrap_err().column, 1001);
    }

    trait Append {
        fn add(self, tail: &str) -> String;
    }
    impl Append for String {
        fn add(mut self, tail: &str) -> String {
            self.push_str(tail);
            self
        }
    }

    proptest! {
        #[test]
        fn no_text_makes_the_parser_panic(text in any::<String>()) {
            let _ = value(&text);
        }

        #[test]
        fn no_mixture_of_tokens_makes_the_parser_panic(
            tokens in proptest::collection::vec(
                proptest::sample::select(vec!["1", "2.5", "pi", "t", "+", "-", "*", "/", "^", "(", ")", ",", "sin(", "tan(", "acos(", "exp(", "atan2(", "ln(", "sqrt", "1e300", "5e-324", " "]), 0..40),
        ) {
            let text = tokens.concat();
            if let Ok(x) = value(&text) {
                prop_assert!(x.is_finite());
            }
            if let Ok(f) = Expression::parse(&text, &["t"]) {
                f.derivative(0).derivative(0).evaluate(&[0.5]);
            }
        }

        #[test]
        fn every_double_reads_back_from_its_shortest_decimal(x in any::<f64>().prop_filter("finite", |x| x.is_finite())) {
            prop_assert_eq!(value(&format!("{x:?}")), Ok(x));
        }
    }
}

//! Numbers written as formulas: `"sqrt(3)/2"`, `"acos(1/2-(3/2)*cos(pi/4))"`, and curves such as `"1 + 0.2*cos(5*t)"`.
//!
//! A mathematician writes √3/2, not 0.8660254037844386, and a scene should hold what was meant. The parser is iterative
//! (an operator stack), so no input can exhaust the call stack; a parsed expression is a list of nodes, each of which
//! refers only to earlier ones, so evaluation and differentiation are single passes.

mod curve;
mod derivative;
mod number;
mod program;

use std::fmt;

pub use curve::{ImplicitCurve, PolarCurve};
pub use program::Program;

use crate::spelling;
use number::Number;

/// Longest accepted text, in characters.
pub const MAX_CHARACTERS: usize = 1000;
/// Deepest accepted nesting of parentheses.
pub const MAX_LEVELS: usize = 100;
/// Up to this many nodes, evaluation needs no allocation.
const SMALL: usize = 64;

/// What is wrong with an expression, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// Column of the offence inside the expression, counted in characters from 1.
    pub column: usize,
    /// What is wrong, in lower case.
    pub what: String,
    /// How to mend it, where that is known.
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
}

impl Function {
    const ALL: [(&'static str, Self); 10] = [
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
/// `pi`, `sqrt`, `abs`, `exp`, `ln`, `sin`, `cos`, `tan`, `asin`, `acos`, `atan`, `atan2(y, x)`; angles in radians.
///
/// # Errors
/// A syntax error, or a step whose value is not a finite real number.
///
/// ```
/// assert_eq!(billiards_cli::expression::value("-2^2"), Ok(-4.0));
/// assert_eq!(billiards_cli::expression::value("1 + sqrt(-1)").unwrap_err().column, 5);
/// ```
pub fn value(text: &str) -> Result<f64, Error> {
    Expression::parse(text, &[])?.checked_value()
}

impl Expression {
    /// Parses a formula in the given variables.
    ///
    /// # Errors
    /// A syntax error, an unknown name, more than [`MAX_CHARACTERS`] or [`MAX_LEVELS`].
    pub fn parse(text: &str, variables: &[&str]) -> Result<Self, Error> {
        if let Some((i, _)) = text.chars().enumerate().nth(MAX_CHARACTERS) {
            return Err(Error::new(i + 1, format!("expression is longer than {MAX_CHARACTERS} characters")));
        }
        Parser::new(variables).parse(&tokens(text)?)
    }

    /// The value at a point, one number per variable; NaN or infinite where the formula has no finite real value.
    pub fn evaluate(&self, variables: &[f64]) -> f64 {
        if self.nodes.len() <= SMALL {
            fill(&self.nodes, &mut [0.0; SMALL], variables)
        } else {
            fill(&self.nodes, &mut vec![0.0; self.nodes.len()], variables)
        }
    }

    /// The value of an expression without variables, every step checked.
    fn checked_value(&self) -> Result<f64, Error> {
        let mut values = Vec::with_capacity(self.nodes.len());
        for (node, &column) in self.nodes.iter().zip(&self.columns) {
            let y: f64 = node.apply(&values, &[]);
            if !y.is_finite() {
                return Err(Error::new(column, node.complaint(&values)));
            }
            values.push(y);
        }
        values.pop().ok_or_else(|| Error::new(1, "empty expression"))
    }

    /// Whether the formula depends on the variable with this index.
    pub fn depends_on(&self, variable: usize) -> bool {
        self.nodes.iter().any(|node| matches!(node, Node::Variable(i) if *i == variable))
    }
}

/// Evaluates nodes in turn into `values`; the last one's value.
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

    /// Why this node has no finite value, its operands being finite.
    fn complaint(self, values: &[f64]) -> String {
        match self {
            Self::Unary(Function::Sqrt, a) => format!("sqrt of the negative number {}", values[a]),
            Self::Unary(Function::Ln, a) => format!("ln of {}, which is not positive", values[a]),
            Self::Unary(Function::Asin, a) => format!("asin of {}, which is outside [-1, 1]", values[a]),
            Self::Unary(Function::Acos, a) => format!("acos of {}, which is outside [-1, 1]", values[a]),
            Self::Binary(Operation::Divide, _, b) if values[b] == 0.0 => "division by zero".into(),
            Self::Binary(Operation::Power, a, b) if values[a] == 0.0 => {
                format!("zero to the negative power {}", values[b])
            }
            Self::Binary(Operation::Power, a, b) if values[a] < 0.0 && values[b] % 1.0 != 0.0 => {
                format!("the negative number {} to the power {}, which is not an integer", values[a], values[b])
            }
            _ => "the value is too large for a double".into(),
        }
    }
}

/// A lexical token.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Token<'a> {
    Number(f64),
    Name(&'a str),
    Symbol(char),
}

/// The tokens of a text, each with its column.
fn tokens(text: &str) -> Result<Vec<(Token<'_>, usize)>, Error> {
    let mut tokens = Vec::new();
    let mut rest = text;
    let mut column = 1;
    while let Some(c) = rest.chars().next() {
        let length = if c.is_whitespace() {
            c.len_utf8()
        } else if c.is_ascii_digit() || c == '.' {
            let literal = number_prefix(rest);
            let x: f64 = literal.parse().map_err(|_| Error::new(column, format!("\"{literal}\" is not a number")))?;
            if !x.is_finite() {
                return Err(Error::new(column, format!("{literal} is too large for a double")));
            }
            tokens.push((Token::Number(x), column));
            literal.len()
        } else if c.is_ascii_alphabetic() || c == '_' {
            let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len());
            tokens.push((Token::Name(&rest[..end]), column));
            end
        } else if "+-*/^(),".contains(c) {
            tokens.push((Token::Symbol(c), column));
            1
        } else {
            return Err(unexpected_character(c, column));
        };
        column += rest[..length].chars().count();
        rest = &rest[length..];
    }
    Ok(tokens)
}

/// The longest prefix of the form `digits [. digits] [e [+-] digits]`.
fn number_prefix(text: &str) -> &str {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let mut end = digits(0);
    if bytes.get(end) == Some(&b'.') {
        end += 1 + digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits(end + 1 + sign);
        if exponent > 0 {
            end += 1 + sign + exponent;
        }
    }
    &text[..end]
}

fn unexpected_character(c: char, column: usize) -> Error {
    let error = Error::new(column, format!("unexpected character {c:?}"));
    match c {
        '\u{2212}' | '\u{2013}' => error.with_help("write the minus sign as -"),
        '\u{d7}' | '\u{b7}' | '\u{22c5}' => error.with_help("write multiplication as *"),
        '\u{f7}' => error.with_help("write division as /"),
        '\u{3c0}' => error.with_help("write pi"),
        '\u{221a}' => error.with_help("write sqrt(...)"),
        '[' | '{' => error.with_help("only round parentheses group"),
        _ => error,
    }
}

/// What waits on the operator stack.
#[derive(Clone, Copy, Debug)]
enum Pending<'a> {
    /// Parenthesis, opened by a function or bare, and the number of commas seen in it.
    Open {
        function: Option<&'a str>,
        commas: usize,
    },
    Negate,
    Binary(Operation),
}

/// Turns tokens into nodes with an explicit operator stack.
#[derive(Debug)]
struct Parser<'a> {
    variables: &'a [&'a str],
    nodes: Vec<Node>,
    columns: Vec<usize>,
    /// Indices of the nodes that wait for an operator.
    operands: Vec<usize>,
    pending: Vec<(Pending<'a>, usize)>,
    levels: usize,
}

impl<'a> Parser<'a> {
    fn new(variables: &'a [&'a str]) -> Self {
        Self { variables, nodes: vec![], columns: vec![], operands: vec![], pending: vec![], levels: 0 }
    }

    fn parse(mut self, tokens: &[(Token<'a>, usize)]) -> Result<Expression, Error> {
        let mut operand_next = true;
        let mut i = 0;
        while let Some(&(token, column)) = tokens.get(i) {
            i += 1;
            if operand_next {
                match token {
                    Token::Number(x) => {
                        self.push(Node::Constant(x), column);
                        operand_next = false;
                    }
                    Token::Name(name) if is_function(name) => {
                        if !matches!(tokens.get(i), Some((Token::Symbol('('), _))) {
                            return Err(Error::new(column, format!("{name} needs its argument in parentheses"))
                                .with_help(format!("write {}", signature(name))));
                        }
                        i += 1;
                        self.open(Some(name), column)?;
                    }
                    Token::Name(name) => {
                        let node = self.named(name, column)?;
                        self.push(node, column);
                        operand_next = false;
                    }
                    Token::Symbol('(') => self.open(None, column)?,
                    Token::Symbol('-') => self.pending.push((Pending::Negate, column)),
                    Token::Symbol('+') => {}
                    Token::Symbol(c) => return Err(self.missing_operand(c, column, &tokens[..i])),
                }
            } else {
                match token {
                    Token::Symbol(')') => self.close(column)?,
                    Token::Symbol(',') => {
                        self.comma(column)?;
                        operand_next = true;
                    }
                    Token::Symbol(c) if c != '(' => {
                        let operation = match c {
                            '+' => Operation::Add,
                            '-' => Operation::Subtract,
                            '*' => Operation::Multiply,
                            '/' => Operation::Divide,
                            _ => Operation::Power,
                        };
                        self.reduce(precedence(operation), operation == Operation::Power);
                        self.pending.push((Pending::Binary(operation), column));
                        operand_next = true;
                    }
                    _ => {
                        return Err(
                            Error::new(column, "missing operator").with_help("write products with *, as in 2*pi")
                        );
                    }
                }
            }
        }
        if operand_next {
            let column = tokens.last().map_or(1, |t| t.1 + 1);
            let what =
                if tokens.is_empty() { "empty expression" } else { "the expression ends where a number should follow" };
            return Err(Error::new(column, what));
        }
        self.reduce(0, false);
        if let Some(&(_, column)) = self.pending.last() {
            return Err(Error::new(column, "this parenthesis is never closed").with_help("add \")\""));
        }
        Ok(Expression { nodes: self.nodes, columns: self.columns })
    }

    fn push(&mut self, node: Node, column: usize) {
        self.operands.push(self.nodes.len());
        self.nodes.push(node);
        self.columns.push(column);
    }

    fn named(&self, name: &str, column: usize) -> Result<Node, Error> {
        if name == "pi" {
            return Ok(Node::Constant(core::f64::consts::PI));
        }
        if let Some(i) = self.variables.iter().position(|v| *v == name) {
            return Ok(Node::Variable(i));
        }
        let known = Function::ALL.iter().map(|f| f.0).chain(["atan2", "pi"]).chain(self.variables.iter().copied());
        let error = Error::new(column, format!("unknown name \"{name}\""));
        Err(match spelling::closest(name, known) {
            Some(near) => error.with_help(format!("did you mean \"{near}\"?")),
            None if name == "e" => error.with_help("write exp(1)"),
            None if self.variables.is_empty() => error,
            None => error.with_help(format!("the variables here are {}", self.variables.join(", "))),
        })
    }

    fn missing_operand(&self, c: char, column: usize, before: &[(Token<'_>, usize)]) -> Error {
        if let [.., (Token::Symbol('*'), _), (Token::Symbol('*'), _)] = before {
            return Error::new(column, "a number should come before \"*\"").with_help("write powers with ^");
        }
        if let (')', Some((Pending::Open { function: Some(name), .. }, _))) = (c, self.pending.last()) {
            return Error::new(column, format!("{name} lacks an argument"))
                .with_help(format!("write {}", signature(name)));
        }
        Error::new(column, format!("a number should come before \"{c}\""))
    }

    fn open(&mut self, function: Option<&'a str>, column: usize) -> Result<(), Error> {
        self.levels += 1;
        if self.levels > MAX_LEVELS {
            return Err(Error::new(column, format!("more than {MAX_LEVELS} levels of parentheses")));
        }
        self.pending.push((Pending::Open { function, commas: 0 }, column));
        Ok(())
    }

    fn comma(&mut self, column: usize) -> Result<(), Error> {
        self.reduce(0, false);
        match self.pending.last_mut() {
            Some((Pending::Open { function: Some("atan2"), commas }, _)) if *commas == 0 => *commas = 1,
            Some((Pending::Open { function: Some(name), .. }, _)) => {
                let help = format!("write {}", signature(name));
                return Err(Error::new(column, format!("too many arguments of {name}")).with_help(help));
            }
            _ => return Err(Error::new(column, "unexpected \",\"").with_help("write the decimal point as \".\"")),
        }
        Ok(())
    }

    fn close(&mut self, column: usize) -> Result<(), Error> {
        self.reduce(0, false);
        let Some((Pending::Open { function, commas }, opened)) = self.pending.pop() else {
            return Err(Error::new(column, "no parenthesis is open here"));
        };
        self.levels -= 1;
        match function {
            None => {}
            Some("atan2") if commas == 1 => self.apply_binary(Operation::Atan2, opened),
            Some(name) => match Function::ALL.iter().find(|f| f.0 == name) {
                Some(&(_, f)) => self.apply_unary(|a| Node::Unary(f, a), opened),
                None => {
                    return Err(Error::new(opened, format!("{name} takes two arguments"))
                        .with_help(format!("write {}", signature(name))));
                }
            },
        }
        Ok(())
    }

    /// Applies pending operators that bind more tightly than `limit` (or, unless `strictly`, as tightly).
    fn reduce(&mut self, limit: u8, strictly: bool) {
        while let Some(&(pending, column)) = self.pending.last() {
            let own = match pending {
                Pending::Open { .. } => return,
                Pending::Negate => NEGATE,
                Pending::Binary(operation) => precedence(operation),
            };
            if own < limit || (strictly && own == limit) {
                return;
            }
            self.pending.pop();
            match pending {
                Pending::Negate => self.apply_unary(Node::Negate, column),
                Pending::Binary(operation) => self.apply_binary(operation, column),
                Pending::Open { .. } => {}
            }
        }
    }

    fn apply_unary(&mut self, node: impl FnOnce(usize) -> Node, column: usize) {
        if let Some(a) = self.operands.pop() {
            self.push(node(a), column);
        }
    }

    fn apply_binary(&mut self, operation: Operation, column: usize) {
        if let (Some(b), Some(a)) = (self.operands.pop(), self.operands.pop()) {
            self.push(Node::Binary(operation, a, b), column);
        }
    }
}

/// Precedence of the unary minus: above products, below powers.
const NEGATE: u8 = 3;

fn precedence(operation: Operation) -> u8 {
    match operation {
        Operation::Add | Operation::Subtract => 1,
        Operation::Multiply | Operation::Divide => 2,
        Operation::Power | Operation::Atan2 => 4,
    }
}

fn is_function(name: &str) -> bool {
    name == "atan2" || Function::ALL.iter().any(|f| f.0 == name)
}

fn signature(name: &str) -> String {
    if name == "atan2" { "atan2(y, x)".into() } else { format!("{name}(x)") }
}

#[cfg(test)]
mod tests {
    use super::*;
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
        assert_eq!(value("sqr(2)").unwrap_err().help.as_deref(), Some("did you mean \"sqrt\"?"));
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
                proptest::sample::select(vec!["1", "2.5", "pi", "t", "+", "-", "*", "/", "^", "(", ")", ",", "sin(", "atan2(", "ln(", "sqrt", " "]), 0..40),
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

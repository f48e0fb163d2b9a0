//! From the text of a formula to its nodes.

use super::{Error, Expression, Function, MAX_LEVELS, Node, Operation, TOO_LARGE, constant::Literal};
use crate::spelling;

/// A lexical token.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token<'a> {
    Number(f64, &'a str),
    Name(&'a str),
    Symbol(char),
}

/// The tokens of a text, each with its column.
pub(super) fn tokens(text: &str) -> Result<Vec<(Token<'_>, usize)>, Error> {
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
                return Err(Error::new(column, format!("{literal} is too large for a double")).with_help(TOO_LARGE));
            }
            tokens.push((Token::Number(x, literal), column));
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

/// An entry of the operator stack.
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
pub(super) struct Parser<'a> {
    variables: &'a [&'a str],
    nodes: Vec<Node>,
    columns: Vec<usize>,
    /// The nodes that are numbers in the text.
    literals: Vec<(usize, Literal<'a>)>,
    /// Indices of the nodes that wait for an operator.
    operands: Vec<usize>,
    pending: Vec<(Pending<'a>, usize)>,
    levels: usize,
}

impl<'a> Parser<'a> {
    /// For formulas in these variables.
    pub(super) fn new(variables: &'a [&'a str]) -> Self {
        Self {
            variables,
            nodes: vec![],
            columns: vec![],
            literals: vec![],
            operands: vec![],
            pending: vec![],
            levels: 0,
        }
    }

    /// The formula given by some tokens, and which of its nodes are numbers in the text.
    pub(super) fn parse(
        mut self,
        tokens: &[(Token<'a>, usize)],
    ) -> Result<(Expression, Vec<(usize, Literal<'a>)>), Error> {
        let mut operand_next = true;
        let mut i = 0;
        while let Some(&(token, column)) = tokens.get(i) {
            i += 1;
            if operand_next {
                match token {
                    Token::Number(x, text) => {
                        self.literal(Literal::Decimal(text), x, column);
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
                    Token::Name("pi") => {
                        self.literal(Literal::Pi, core::f64::consts::PI, column);
                        operand_next = false;
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
        Ok((Expression { nodes: self.nodes, columns: self.columns }, self.literals))
    }

    fn literal(&mut self, literal: Literal<'a>, value: f64, column: usize) {
        self.literals.push((self.nodes.len(), literal));
        self.push(Node::Constant(value), column);
    }

    fn push(&mut self, node: Node, column: usize) {
        self.operands.push(self.nodes.len());
        self.nodes.push(node);
        self.columns.push(column);
    }

    fn named(&self, name: &str, column: usize) -> Result<Node, Error> {
        if let Some(i) = self.variables.iter().position(|v| *v == name) {
            return Ok(Node::Variable(i));
        }
        let known = Function::ALL.iter().map(|f| f.0).chain(["atan2", "pi"]).chain(self.variables.iter().copied());
        let error = Error::new(column, format!("unknown name \"{name}\""));
        if let Some((_, here)) = FROM_ELSEWHERE.iter().find(|other| other.0.eq_ignore_ascii_case(name)) {
            return Err(error.with_help(format!("write {here}")));
        }
        Err(match spelling::closest(name, known.clone()) {
            Some(near) => error.with_help(format!("did you mean \"{near}\"?")),
            None => error.with_help(format!("known: {}", known.collect::<Vec<_>>().join(", "))),
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

/// Spellings from other languages, with the ones used here.
const FROM_ELSEWHERE: [(&str, &str); 23] = [
    ("e", "exp(1)"),
    ("log", "ln(x)"),
    ("log10", "ln(x)/ln(10)"),
    ("log2", "ln(x)/ln(2)"),
    ("pow", "x^y"),
    ("cbrt", "x^(1/3), or x/abs(x)^(2/3) where x may be negative"),
    ("hypot", "sqrt(x^2+y^2)"),
    ("min", "(x+y-abs(x-y))/2"),
    ("max", "(x+y+abs(x-y))/2"),
    ("sign", "x/abs(x)"),
    ("sgn", "x/abs(x)"),
    ("sec", "1/cos(x)"),
    ("csc", "1/sin(x)"),
    ("cot", "1/tan(x)"),
    ("arcsin", "asin(x)"),
    ("arccos", "acos(x)"),
    ("arctan", "atan(x)"),
    ("asinh", "ln(x+sqrt(x^2+1))"),
    ("acosh", "ln(x+sqrt(x^2-1))"),
    ("atanh", "ln((1+x)/(1-x))/2"),
    ("nan", "a finite number"),
    ("inf", "a finite number"),
    ("infinity", "a finite number"),
];

/// Precedence of the unary minus: above products, below powers.
const NEGATE: u8 = 3;

fn precedence(operation: Operation) -> u8 {
    match operation {
        Operation::Add | Operation::Subtract => 1,
        Operation::Multiply | Operation::Divide => 2,
        Operation::Power | Operation::SignedPower | Operation::Atan2 => 4,
    }
}

fn is_function(name: &str) -> bool {
    name == "atan2" || Function::ALL.iter().any(|f| f.0 == name)
}

fn signature(name: &str) -> String {
    if name == "atan2" { "atan2(y, x)".into() } else { format!("{name}(x)") }
}

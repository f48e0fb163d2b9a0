//! Exact derivatives of formulas, for normals and curvatures of curves given by one.

use std::collections::HashMap;

use super::{Expression, Function, Node, Operation, number::Number};

impl Expression {
    /// The partial derivative with respect to the variable with this index.
    ///
    /// Common parts are shared, so the result has a length proportional to the formula's. Where `f = 0`, `|f|' = ±f'` is one of
    /// the two one-sided slopes, and likewise for derivatives computed from it.
    #[must_use]
    pub fn derivative(&self, variable: usize) -> Self {
        let mut arena = Arena::default();
        let mut values = Vec::with_capacity(self.nodes.len());
        let mut slopes = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let (value, slope) = match *node {
                Node::Constant(x) => (arena.constant(x), arena.constant(0.0)),
                Node::Variable(i) => {
                    (arena.push(Node::Variable(i)), arena.constant(f64::from(u8::from(i == variable))))
                }
                Node::Negate(a) => (arena.negate(values[a]), arena.negate(slopes[a])),
                Node::Unary(f, a) => {
                    let value = arena.unary(f, values[a]);
                    let factor = arena.slope(f, values[a], value);
                    (value, arena.multiply(factor, slopes[a]))
                }
                Node::Binary(f, a, b) => {
                    let value = arena.binary(f, values[a], values[b]);
                    if let (Operation::Power, Node::Unary(Function::Abs, inner)) = (f, self.nodes[a])
                        && arena.is(slopes[b], 0.0)
                    {
                        let slope = arena.slope_of_power(Operation::SignedPower, values[inner], values[b]);
                        values.push(value);
                        slopes.push(arena.multiply(slope, slopes[inner]));
                        continue;
                    }
                    (value, arena.binary_slope(f, [values[a], values[b], value], [slopes[a], slopes[b]]))
                }
            };
            values.push(value);
            slopes.push(slope);
        }
        let root = slopes.pop().unwrap_or_else(|| arena.constant(0.0));
        Self { nodes: arena.reachable([root]).0, columns: Vec::new() }
    }
}

/// Nodes under construction; equal nodes are stored once.
#[derive(Debug, Default)]
pub(super) struct Arena {
    nodes: Vec<Node>,
    index: HashMap<Key, usize>,
}

/// What makes two nodes equal.
#[derive(Debug, PartialEq, Eq, Hash)]
enum Key {
    Constant(u64),
    Variable(usize),
    Negate(usize),
    Unary(Function, usize),
    Binary(Operation, usize, usize),
}

impl Arena {
    fn push(&mut self, node: Node) -> usize {
        let key = match node {
            Node::Constant(x) => Key::Constant(x.to_bits()),
            Node::Variable(i) => Key::Variable(i),
            Node::Negate(a) => Key::Negate(a),
            Node::Unary(f, a) => Key::Unary(f, a),
            Node::Binary(f, a, b) => Key::Binary(f, a, b),
        };
        *self.index.entry(key).or_insert_with(|| {
            self.nodes.push(node);
            self.nodes.len() - 1
        })
    }

    fn constant(&mut self, x: f64) -> usize {
        self.push(Node::Constant(x))
    }

    fn known(&self, a: usize) -> Option<f64> {
        match self.nodes[a] {
            Node::Constant(x) => Some(x),
            _ => None,
        }
    }

    fn is(&self, a: usize, x: f64) -> bool {
        self.known(a) == Some(x)
    }

    fn negate(&mut self, a: usize) -> usize {
        match self.nodes[a] {
            Node::Constant(x) => self.constant(if x == 0.0 { 0.0 } else { -x }),
            Node::Negate(b) => b,
            _ => self.push(Node::Negate(a)),
        }
    }

    fn unary(&mut self, f: Function, a: usize) -> usize {
        match self.known(a) {
            // over an interval a jump has no bound, even if its argument is constant
            Some(x) if f != Function::Jump => self.constant(x.function(f)),
            _ => self.push(Node::Unary(f, a)),
        }
    }

    fn binary(&mut self, f: Operation, a: usize, b: usize) -> usize {
        if let (Some(x), Some(y)) = (self.known(a), self.known(b)) {
            return self.constant(x.operation(f, y));
        }
        match f {
            Operation::Add => self.add(a, b),
            Operation::Subtract => self.subtract(a, b),
            Operation::Multiply => self.multiply(a, b),
            Operation::Divide => self.divide(a, b),
            Operation::Power | Operation::SignedPower if self.is(b, 1.0) => a,
            Operation::Power if self.is(b, 0.0) => self.constant(1.0),
            _ => self.push(Node::Binary(f, a, b)),
        }
    }

    fn add(&mut self, a: usize, b: usize) -> usize {
        if self.is(a, 0.0) {
            b
        } else if self.is(b, 0.0) {
            a
        } else {
            self.push(Node::Binary(Operation::Add, a, b))
        }
    }

    fn subtract(&mut self, a: usize, b: usize) -> usize {
        if self.is(b, 0.0) {
            a
        } else if self.is(a, 0.0) {
            self.negate(b)
        } else {
            self.push(Node::Binary(Operation::Subtract, a, b))
        }
    }

    fn multiply(&mut self, a: usize, b: usize) -> usize {
        if self.is(a, 0.0) || self.is(b, 0.0) {
            self.constant(0.0)
        } else if self.is(a, 1.0) {
            b
        } else if self.is(b, 1.0) {
            a
        } else {
            self.push(Node::Binary(Operation::Multiply, a, b))
        }
    }

    fn divide(&mut self, a: usize, b: usize) -> usize {
        if self.is(a, 0.0) || self.is(b, 1.0) { a } else { self.push(Node::Binary(Operation::Divide, a, b)) }
    }

    fn square(&mut self, a: usize) -> usize {
        self.multiply(a, a)
    }

    /// `f'` at the node `a`, where `value = f(a)`.
    fn slope(&mut self, f: Function, a: usize, value: usize) -> usize {
        let one = self.constant(1.0);
        match f {
            Function::Sqrt => {
                let half = self.constant(0.5);
                self.divide(half, value)
            }
            Function::Abs => {
                let zero = self.constant(0.0);
                self.binary(Operation::SignedPower, a, zero)
            }
            Function::Exp | Function::Jump => value,
            Function::Ln => self.divide(one, a),
            Function::Sin => self.unary(Function::Cos, a),
            Function::Cos => {
                let sine = self.unary(Function::Sin, a);
                self.negate(sine)
            }
            Function::Tan => {
                let square = self.square(value);
                self.add(one, square)
            }
            Function::Asin | Function::Acos => {
                let square = self.square(a);
                let rest = self.subtract(one, square);
                let root = self.unary(Function::Sqrt, rest);
                let slope = self.divide(one, root);
                if f == Function::Asin { slope } else { self.negate(slope) }
            }
            Function::Atan => {
                let square = self.square(a);
                let sum = self.add(one, square);
                self.divide(one, sum)
            }
            Function::Sinh => self.unary(Function::Cosh, a),
            Function::Cosh => self.unary(Function::Sinh, a),
            Function::Tanh => {
                let square = self.square(value);
                self.subtract(one, square)
            }
        }
    }

    /// The derivative of `value = f(a, b)`, given those of `a` and `b`.
    fn binary_slope(&mut self, f: Operation, [a, b, value]: [usize; 3], [da, db]: [usize; 2]) -> usize {
        match f {
            Operation::Add => self.add(da, db),
            Operation::Subtract => self.subtract(da, db),
            Operation::Multiply => {
                let left = self.multiply(da, b);
                let right = self.multiply(a, db);
                self.add(left, right)
            }
            Operation::Divide => {
                let part = self.multiply(value, db);
                let numerator = self.subtract(da, part);
                self.divide(numerator, b)
            }
            Operation::Power if self.is(db, 0.0) => {
                let slope = self.slope_of_power(Operation::Power, a, b);
                self.multiply(slope, da)
            }
            Operation::SignedPower => {
                let slope = if self.is(b, 0.0) {
                    self.unary(Function::Jump, a)
                } else {
                    let size = self.unary(Function::Abs, a);
                    self.slope_of_power(Operation::Power, size, b)
                };
                self.multiply(slope, da)
            }
            Operation::Power => {
                let logarithm = self.unary(Function::Ln, a);
                let first = self.multiply(db, logarithm);
                let quotient = self.divide(da, a);
                let second = self.multiply(b, quotient);
                let sum = self.add(first, second);
                self.multiply(value, sum)
            }
            Operation::Atan2 => {
                let first = self.multiply(b, da);
                let second = self.multiply(a, db);
                let numerator = self.subtract(first, second);
                let (aa, bb) = (self.square(a), self.square(b));
                let sum = self.add(aa, bb);
                self.divide(numerator, sum)
            }
        }
    }

    /// `b a^(b−1)` for a power of either kind.
    fn slope_of_power(&mut self, power: Operation, a: usize, b: usize) -> usize {
        let one = self.constant(1.0);
        let lower = self.binary(Operation::Subtract, b, one);
        let power = self.binary(power, a, lower);
        self.multiply(b, power)
    }

    /// Adds the nodes of an expression, and returns the place of its value.
    pub(super) fn embed(&mut self, expression: &Expression) -> usize {
        let mut places = Vec::with_capacity(expression.nodes.len());
        for node in &expression.nodes {
            places.push(self.push(node.moved(&places)));
        }
        places.pop().unwrap_or_else(|| self.constant(0.0))
    }

    /// The nodes that some roots depend on, in order, and the places of the roots among them.
    pub(super) fn reachable<const K: usize>(&self, roots: [usize; K]) -> (Vec<Node>, [usize; K]) {
        let mut needed = vec![false; self.nodes.len()];
        for root in roots {
            needed[root] = true;
        }
        for (i, node) in self.nodes.iter().enumerate().rev() {
            match *node {
                Node::Negate(a) | Node::Unary(_, a) if needed[i] => needed[a] = true,
                Node::Binary(_, a, b) if needed[i] => {
                    needed[a] = true;
                    needed[b] = true;
                }
                _ => {}
            }
        }
        let mut places = vec![0; self.nodes.len()];
        let mut kept = Vec::new();
        for (i, node) in self.nodes.iter().enumerate().filter(|(i, _)| needed[*i]) {
            places[i] = kept.len();
            kept.push(node.moved(&places));
        }
        (kept, roots.map(|root| places[root]))
    }
}

impl Node {
    /// The same node with its operands at new places.
    fn moved(self, places: &[usize]) -> Self {
        match self {
            Self::Constant(_) | Self::Variable(_) => self,
            Self::Negate(a) => Self::Negate(places[a]),
            Self::Unary(f, a) => Self::Unary(f, places[a]),
            Self::Binary(f, a, b) => Self::Binary(f, places[a], places[b]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expression::Program;
    use billiards::geometry::shapes::curve::Interval;

    /// Central difference with step h = 1e-5: truncation ~ h² f''' ≈ 1e-9 for the functions below, rounding ~ ε/h ≈ 2e-11.
    const TOLERANCE: f64 = 1e-8;

    #[test]
    fn derivatives_agree_with_differences() {
        for text in [
            "1+0.2*cos(5*t)",
            "t^3 - 2*t + 4",
            "sin(t)*exp(-t)/ (1+t^2)",
            "sqrt(1+t)^3",
            "tan(t)",
            "asin(t/2)+acos(t/3)+atan(2*t)",
            "sinh(t)*cosh(2*t)+tanh(3*t-1)",
            "atan2(sin(t), 2+cos(t))",
            "t^t",
            "2^t",
            "abs(t-2)",
            "abs(t-2)^3",
            "abs(t-2)^2.5",
            "abs(sin(t)-2)^(7/2)",
            "ln(1+t^4)",
            "-t^-2",
            "7",
        ] {
            let f = Expression::parse(text, &["t"]).unwrap();
            let (first, second) = (f.derivative(0), f.derivative(0).derivative(0));
            let h = 1e-5;
            for t in [0.3, 0.7, 1.1] {
                let difference = (f.evaluate(&[t + h]) - f.evaluate(&[t - h])) / (2.0 * h);
                let slope = first.evaluate(&[t]);
                assert!(
                    (slope - difference).abs() <= TOLERANCE * (1.0 + slope.abs()),
                    "{text} at {t}: {slope} {difference}"
                );
                let difference = (first.evaluate(&[t + h]) - first.evaluate(&[t - h])) / (2.0 * h);
                let slope = second.evaluate(&[t]);
                assert!(
                    (slope - difference).abs() <= TOLERANCE * (1.0 + slope.abs()),
                    "{text}'' at {t}: {slope} {difference}"
                );
            }
        }
    }

    #[test]
    fn powers_of_absolute_values_have_bounded_second_derivatives_where_they_have_them() {
        for (text, bounded) in
            [("abs(t)^3", true), ("sqrt(t^2)^3", true), ("abs(t)^2.5", true), ("abs(t)^2", true), ("abs(t)", false)]
        {
            let second = Expression::parse(text, &["t"]).unwrap().derivative(0).derivative(0);
            let [over] = Program::new([&second]).evaluate(&[Interval::new(-0.5, 0.25)]);
            assert_eq!(over.magnitude() < 10.0, bounded, "{text}: {over:?}");
            assert!(second.evaluate(&[0.0]).abs() <= 2.0, "{text}");
        }
    }

    #[test]
    fn an_ellipse_has_its_gradient_and_constant_hessian() {
        let f = Expression::parse("x^2/4 + y^2 - 1", &["x", "y"]).unwrap();
        let (fx, fy) = (f.derivative(0), f.derivative(1));
        assert_eq!([fx.evaluate(&[1.0, 3.0]), fy.evaluate(&[1.0, 3.0])], [0.5, 6.0]);
        assert_eq!([fx.derivative(0).evaluate(&[5.0, 6.0]), fx.derivative(1).evaluate(&[5.0, 6.0])], [0.5, 0.0]);
    }

    #[test]
    fn repeated_derivatives_stay_short_because_parts_are_shared() {
        let text = format!("{}t{}", "sin(".repeat(40), ")".repeat(40));
        let second = Expression::parse(&text, &["t"]).unwrap().derivative(0).derivative(0);
        assert!(second.nodes.len() < 40 * 40, "{}", second.nodes.len());
    }
}

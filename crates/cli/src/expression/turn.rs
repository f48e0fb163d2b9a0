//! Whether a formula in an angle is the same after a whole turn, decided from its structure.

use super::{Expression, Function, Node, Operation};

/// How a part of a formula changes when the angle grows by 2π.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Turned {
    /// It grows by this many times 2π.
    Grown(f64),
    /// It is the same.
    Same,
    /// It changes its sign.
    Opposite,
    Unknown,
}

impl Expression {
    /// Whether a formula in one variable certainly has the period 2π. Sampled values would not prove that: anything may hide
    /// between them.
    pub(super) fn comes_back(&self) -> bool {
        let mut turned: Vec<Turned> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            turned.push(match *node {
                Node::Constant(_) => Turned::Same,
                Node::Variable(_) => Turned::Grown(1.0),
                Node::Negate(a) => turned[a].times(-1.0),
                Node::Unary(f, a) => turned[a].through(f),
                Node::Binary(f, a, b) => {
                    let number = |k: usize| match self.nodes[k] {
                        Node::Constant(x) => Some(x),
                        _ => None,
                    };
                    joined(f, [turned[a], turned[b]], [number(a), number(b)])
                }
            });
        }
        turned.last() == Some(&Turned::Same)
    }
}

impl Turned {
    /// The change of the part multiplied by a number.
    fn times(self, x: f64) -> Self {
        match self {
            Self::Grown(k) => Self::Grown(k * x),
            other => other,
        }
    }

    /// The change of a function of the part.
    fn through(self, f: Function) -> Self {
        use Function::{Abs, Asin, Atan, Cos, Cosh, Sin, Sinh, Tan, Tanh};
        match (self, f) {
            (Self::Same, _) | (Self::Opposite, Abs | Cos | Cosh) => Self::Same,
            (Self::Opposite, Sin | Tan | Asin | Atan | Sinh | Tanh) => Self::Opposite,
            (Self::Grown(k), Sin | Cos) if k % 1.0 == 0.0 => Self::Same,
            (Self::Grown(k), Sin | Cos) if k % 0.5 == 0.0 => Self::Opposite,
            (Self::Grown(k), Tan) if k % 0.5 == 0.0 => Self::Same,
            _ => Self::Unknown,
        }
    }
}

/// The change of an operation on two parts, which may be numbers.
fn joined(f: Operation, [a, b]: [Turned; 2], [x, y]: [Option<f64>; 2]) -> Turned {
    use Operation::{Add, Divide, Multiply, Power, Subtract};
    use Turned::{Grown, Opposite, Same, Unknown};
    match (f, a, b) {
        (_, Same, Same) | (Multiply | Divide, Opposite, Opposite) => Same,
        (Add | Subtract, Opposite, Opposite)
        | (Multiply | Divide, Opposite, Same)
        | (Multiply | Divide, Same, Opposite) => Opposite,
        (Add | Subtract, Same | Grown(_), Same | Grown(_)) => {
            let by = |part: Turned| if let Grown(k) = part { k } else { 0.0 };
            match if f == Add { by(a) + by(b) } else { by(a) - by(b) } {
                0.0 => Same,
                k => Grown(k),
            }
        }
        (Multiply, Grown(_), Same) => y.map_or(Unknown, |y| a.times(y)),
        (Multiply, Same, Grown(_)) => x.map_or(Unknown, |x| b.times(x)),
        (Divide, Grown(_), Same) => y.map_or(Unknown, |y| a.times(1.0 / y)),
        (Power, Opposite, Same) => match y {
            Some(y) if y % 2.0 == 0.0 => Same,
            Some(y) if y % 1.0 == 0.0 => Opposite,
            _ => Unknown,
        },
        _ => Unknown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn comes_back(text: &str) -> bool {
        Expression::parse(text, &["t"]).unwrap().comes_back()
    }

    #[test]
    fn formulas_in_waves_come_back() {
        for text in [
            "2",
            "1+0.2*cos(5*t)",
            "2-0.3*abs(cos(1.5*t+0.2))^1.2",
            "1+0.1*abs(sin(t/2))+0.1*cos(t/2)^2+0.1*cos(t/2)*sin(3*t/2)",
            "2+0.1*tan(0.5*sin(t))+0.01*abs(tan(t/2+1))",
            "2+0.1*asin(sin(t/2))^2",
            "exp(cos(t))/(3+sin(2*t-pi))",
            "sqrt(1-cos(t)^2)+atan2(sin(t), 2+cos(t))",
            "2+0.1*cos(t+0.3*sin(t))+0.1*sin(2*(t+1)-t)",
            "2+0.1*cos(-t)",
            "2+0*(t-t)",
            "1+0.1*cosh(sin(t/2))+0.1*sinh(cos(t/2))*tanh(sin(t/2))",
        ] {
            assert!(comes_back(text), "{text}");
        }
    }

    #[test]
    fn formulas_for_one_turn_do_not() {
        for text in [
            "2-0.05*exp(-((t-pi)/0.01)^2)",
            "1+0.2*t*(2*pi-t)",
            "1+0.1*sin(t/2)",
            "1+0.1*cos(t/3)",
            "1+0.1*cos(0.3333333*t)^2",
            "1+0.1*sin(t^2)",
            "2+0.1*sin(t*cos(t))",
            "2+sin(t/2)^3",
            "2+cos(t)/t",
        ] {
            assert!(!comes_back(text), "{text}");
        }
    }
}

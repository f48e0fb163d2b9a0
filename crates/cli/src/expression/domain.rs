//! Where parts of a formula have no real value.

use billiards::geometry::shapes::curve::Interval;

use super::{Error, Expression, Function, Node, Operation, fill};

/// Number of parts of a range that are examined first.
const PARTS: u32 = 1024;
/// Most parts that are halved again: two at each of 2000 places where an argument touches the end of a domain. Where there are more,
/// it is at that end within rounding everywhere.
const MOST: usize = 4096;
/// Parts narrower than this fraction of the range are within rounding.
const NARROW: f64 = 4.0 * f64::EPSILON;

impl Expression {
    /// A part of a formula in one variable that has no real value somewhere in `range`, such as the root of a negative number: what
    /// is wrong, and about the value of the variable.
    ///
    /// A reported part is certain, and one is reported wherever an argument leaves the domain of its function by more than rounding.
    pub fn unreal(&self, range: Interval) -> Option<(Error, f64)> {
        let mut values = vec![Interval::ENTIRE; self.nodes.len()];
        let at = |k: u32| range.low + (range.high - range.low) * (f64::from(k) / f64::from(PARTS));
        let mut parts: Vec<_> = (0..PARTS).map(|k| Interval::new(at(k), at(k + 1))).collect();
        while !parts.is_empty() && parts.len() <= MOST && parts[0].width() > NARROW * range.width() {
            let mut doubtful = vec![];
            for part in parts {
                fill(&self.nodes, &mut values, &[part]);
                let middle = 0.5 * (part.low + part.high);
                let arguments =
                    self.nodes.iter().map(|node| node.domain(&self.nodes).map(|(a, domain)| (values[a], domain)));
                if let Some(i) = arguments
                    .clone()
                    .position(|a| a.is_some_and(|(x, domain)| x.high < domain.low || x.low > domain.high))
                {
                    let mut numbers = vec![0.0; self.nodes.len()];
                    fill(&self.nodes, &mut numbers, &[middle]);
                    return Some((self.nodes[i].complaint(&numbers, self.columns[i]), middle));
                }
                if arguments.flatten().any(|(x, domain)| x.low < domain.low || x.high > domain.high) {
                    doubtful.extend([Interval::new(part.low, middle), Interval::new(middle, part.high)]);
                }
            }
            parts = doubtful;
        }
        None
    }
}

impl Node {
    /// The argument, and the interval in which it has to be, if the function is not defined everywhere.
    fn domain(self, nodes: &[Self]) -> Option<(usize, Interval)> {
        match self {
            Self::Unary(Function::Sqrt | Function::Ln, a) => Some((a, Interval::new(0.0, f64::INFINITY))),
            Self::Unary(Function::Asin | Function::Acos, a) => Some((a, Interval::new(-1.0, 1.0))),
            Self::Binary(Operation::Power, a, b) => match nodes[b] {
                Self::Constant(y) if y % 1.0 != 0.0 => Some((a, Interval::new(0.0, f64::INFINITY))),
                _ => None,
            },
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    fn unreal(text: &str) -> Option<(Error, f64)> {
        Expression::parse(text, &["t"]).unwrap().unreal(Interval::new(0.0, 2.0 * PI))
    }

    #[test]
    fn short_stretches_without_a_real_value_are_found() {
        for (text, column, at) in [
            ("2+0.2*sqrt(sin(t)+0.99)", 7, 1.5 * PI),
            ("2+0.2*asin(sin(t)*1.0000001)", 7, 0.5 * PI),
            ("2+0.2*acos(cos(t)*1.000000000001)", 7, 0.0),
            ("2+0.2*(1.00000001*sin(t)+1)^2.5", 28, 1.5 * PI),
            ("2+ln(sin(t-1)+2-1.0000000001)", 3, 1.5 * PI + 1.0),
            ("2+0.5*sqrt(cos(2*t))", 7, 0.5 * PI),
            ("2+0.2*cos(t)^(1/3)", 13, 1.0 * PI),
        ] {
            let (error, angle) = unreal(text).expect(text);
            assert_eq!(error.column, column, "{text}");
            assert!(Expression::parse(text, &["t"]).unwrap().evaluate(&[angle]).is_nan(), "{text}: {angle}");
            assert!((angle - at).abs() < 1.6, "{text}: {angle}");
        }
        assert_eq!(unreal("sqrt(cos(t))").unwrap().0.what.split(" -").next(), Some("sqrt of the negative number"));
    }

    #[test]
    fn ends_of_domains_may_be_touched_though_rounding_leads_beyond() {
        for text in [
            "sqrt(1-cos(t)^2)",
            "(1+cos(t))^1.5",
            "sqrt(t^2)",
            "asin(sin(t))+acos(cos(t))",
            "sqrt(cos(t)^2-2*cos(t)+1)",
            "sqrt(sin(t)^2+cos(t)^2-1)",
            "sqrt(1-cos(300*t)^2)",
            "abs(sin(t))^0.5",
            "cos(t)^2000",
        ] {
            assert_eq!(unreal(text), None, "{text}");
        }
    }
}

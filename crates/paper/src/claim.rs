//! A statement, a verdict, and a measurement that can contradict it.
use core::fmt;

/// One statement of the paper, or one beside it.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// Short name, in lower case with hyphens.
    pub name: &'static str,
    /// Where it stands: "Proposition 2.1", "eq. (2.2)", or "beyond the paper".
    pub place: &'static str,
    /// What it says, in our words.
    pub statement: &'static str,
    /// What we find.
    pub verdict: Verdict,
    /// What it becomes for a disk with any mass distribution, γ² = I/(m R²).
    pub general_gamma: Option<&'static str>,
    pub(crate) measure: fn(Effort) -> Measurement,
}

impl Claim {
    /// Measures.
    pub fn measure(&self, effort: Effort) -> Measurement {
        (self.measure)(effort)
    }
}

/// What we find about a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It holds as it stands.
    Holds,
    /// What is meant holds, with this correction and its reason.
    HoldsCorrected(&'static str),
    /// It does not hold; this does, with its reason.
    False(&'static str),
}

impl Verdict {
    /// The verdict in words.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Holds => "holds",
            Verdict::HoldsCorrected(_) => "holds with a correction",
            Verdict::False(_) => "false",
        }
    }

    /// The corrected statement with its reason.
    pub fn corrected(self) -> Option<&'static str> {
        match self {
            Verdict::Holds => None,
            Verdict::HoldsCorrected(text) | Verdict::False(text) => Some(text),
        }
    }
}

/// How much work a measurement may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Two seconds or less each.
    Quick,
    /// Up to half a minute each.
    Full,
}

impl Effort {
    /// A sample size for each effort.
    pub(crate) fn of<T>(self, quick: T, full: T) -> T {
        match self {
            Effort::Quick => quick,
            Effort::Full => full,
        }
    }
}

/// What a measurement found.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// The numbers measured, each beside the one expected.
    pub quantities: Vec<Quantity>,
}

impl Measurement {
    /// Whether every number agrees with our verdict.
    pub fn is_consistent(&self) -> bool {
        !self.quantities.is_empty() && self.quantities.iter().all(Quantity::agrees)
    }
}

impl<const N: usize> From<[Quantity; N]> for Measurement {
    fn from(quantities: [Quantity; N]) -> Measurement {
        Measurement { quantities: quantities.into() }
    }
}

impl From<Vec<Quantity>> for Measurement {
    fn from(quantities: Vec<Quantity>) -> Measurement {
        Measurement { quantities }
    }
}

/// A measured number beside the one expected.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// What it is, in Unicode, with its unit where it has one.
    pub label: String,
    /// The number measured.
    pub measured: f64,
    /// The number it is compared with.
    pub expected: f64,
    /// How it is compared.
    pub relation: Relation,
    /// The deviation that the relation allows or demands; see [`Relation`].
    pub bound: f64,
}

/// How a measured number is compared with the one expected.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Relation {
    /// Equal within the bound: `|measured − expected| ≤ bound`.
    Equal,
    /// Equal within sampling: `|measured − expected| ≤ bound`, which is [`STANDARD_ERRORS`] standard errors and the systematic part.
    Sampled {
        /// One standard error of the measured number.
        standard_error: f64,
        /// By how much the expected number may be off.
        systematic: f64,
    },
    /// `measured ≤ expected + bound`.
    AtMost,
    /// `measured ≥ expected − bound`.
    AtLeast,
    /// `|measured − expected| > bound`: the expected number is the paper's, and refuted.
    Differs,
}

/// How many standard errors a sampled number may be off: 5, a false alarm of 6·10⁻⁷ for a normal number. Seeds are fixed.
pub const STANDARD_ERRORS: f64 = 5.0;

impl Quantity {
    /// A number that equals another one within rounding, or within a bound that the claim's code gives a reason for.
    pub fn equal(label: impl Into<String>, measured: f64, expected: f64, bound: f64) -> Quantity {
        Quantity { label: label.into(), measured, expected, relation: Relation::Equal, bound }
    }

    /// A residual: a number that is 0 within rounding.
    pub fn residual(label: impl Into<String>, measured: f64, bound: f64) -> Quantity {
        Quantity::equal(label, measured, 0.0, bound)
    }

    /// A count, which must be exact.
    pub fn count(label: impl Into<String>, measured: usize, expected: usize) -> Quantity {
        Quantity::equal(label, measured as f64, expected as f64, 0.0)
    }

    /// A mean over a sample.
    pub fn sampled(label: impl Into<String>, mean: f64, standard_error: f64, expected: f64) -> Quantity {
        Quantity {
            label: label.into(),
            measured: mean,
            expected,
            relation: Relation::Sampled { standard_error, systematic: 0.0 },
            bound: STANDARD_ERRORS * standard_error,
        }
    }

    /// A mean over a sample beside a number that may be off by `systematic`.
    pub fn sampled_near(
        label: impl Into<String>,
        mean: f64,
        standard_error: f64,
        expected: f64,
        systematic: f64,
    ) -> Quantity {
        Quantity {
            relation: Relation::Sampled { standard_error, systematic },
            bound: STANDARD_ERRORS * standard_error + systematic,
            ..Quantity::sampled(label, mean, standard_error, expected)
        }
    }

    /// A number that does not exceed another one, except by rounding.
    pub fn at_most(label: impl Into<String>, measured: f64, limit: f64, rounding: f64) -> Quantity {
        Quantity { label: label.into(), measured, expected: limit, relation: Relation::AtMost, bound: rounding }
    }

    /// A number that does not fall below another one, except by rounding.
    pub fn at_least(label: impl Into<String>, measured: f64, limit: f64, rounding: f64) -> Quantity {
        Quantity { label: label.into(), measured, expected: limit, relation: Relation::AtLeast, bound: rounding }
    }

    /// A number that is not the one claimed, by more than `gap`.
    pub fn differs(label: impl Into<String>, measured: f64, claimed: f64, gap: f64) -> Quantity {
        Quantity { label: label.into(), measured, expected: claimed, relation: Relation::Differs, bound: gap }
    }

    /// `|measured − expected|`
    pub fn deviation(&self) -> f64 {
        (self.measured - self.expected).abs()
    }

    /// Whether the relation holds. Never for NaN.
    pub fn agrees(&self) -> bool {
        match self.relation {
            Relation::Equal | Relation::Sampled { .. } => self.deviation() <= self.bound,
            Relation::AtMost => self.measured <= self.expected + self.bound,
            Relation::AtLeast => self.measured >= self.expected - self.bound,
            Relation::Differs => self.deviation() > self.bound,
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Quantity { label, measured, expected, relation, bound } = self;
        let sign = if self.agrees() { "" } else { "  <-- DISAGREES" };
        match relation {
            Relation::Equal => write!(
                f,
                "{label}: {measured:.10} = {expected:.10} (off by {:.1e}, bound {bound:.1e})",
                self.deviation()
            )?,
            Relation::Sampled { standard_error, systematic } => {
                write!(f, "{label}: {measured:.6} ± {standard_error:.6} = {expected:.6}")?;
                if *systematic > 0.0 {
                    write!(f, " (known to {systematic:.6})")?;
                }
            }
            Relation::AtMost => write!(f, "{label}: {measured:.10} ≤ {:.10}", expected + bound)?,
            Relation::AtLeast => write!(f, "{label}: {measured:.10} ≥ {:.10}", expected - bound)?,
            Relation::Differs => write!(f, "{label}: {measured:.10} ≠ {expected:.10} (by more than {bound:.1e})")?,
        }
        f.write_str(sign)
    }
}

impl fmt::Display for Measurement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for quantity in &self.quantities {
            writeln!(f, "{quantity}")?;
        }
        Ok(())
    }
}

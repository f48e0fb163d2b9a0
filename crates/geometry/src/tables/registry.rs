//! Named tables: their names, their parameters, and how they are built.
use super::SpatialTable;
use crate::{Error, Table};
use nalgebra::Vector2;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// A named table: what it needs, and how to build it.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Its name in scene files.
    pub name: &'static str,
    /// A description of one line.
    pub summary: &'static str,
    /// Its parameters.
    pub parameters: &'static [Parameter],
    /// Builds it from completed values ([`Entry::complete`]).
    pub build: Build,
}

/// A constructor.
#[derive(Clone, Copy, Debug)]
pub enum Build {
    /// A constructor of a planar table.
    Planar(fn(&Values) -> Result<Table, Error>),
    /// A constructor of a table in space.
    Spatial(fn(&Values) -> Result<SpatialTable, Error>),
}

/// One parameter of a named table.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name in scene files.
    pub name: &'static str,
    /// What it measures.
    pub kind: Kind,
    /// Its default; where it is required, a typical value.
    pub value: Value,
    /// Whether it must be given.
    pub required: bool,
}

/// What a parameter measures: its form, and how it scales with the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A positive length \[L\].
    Length,
    /// A length with a sign \[L\].
    Displacement,
    /// An angle in radians.
    Angle,
    /// A pure number.
    Number,
    /// A whole number, at least `least` and at most [`MOST_VERTICES`](super::MOST_VERTICES).
    Count {
        /// Its least value.
        least: u64,
    },
    /// A list of this many lengths \[L\].
    Lengths(usize),
    /// A list of this many points of the plane \[L\].
    Points(usize),
}

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A list of numbers.
    List(Cow<'static, [f64]>),
    /// A list of points.
    Points(Cow<'static, [[f64; 2]]>),
}

/// Values by the names of their parameters.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Values(BTreeMap<String, Value>);

impl Parameter {
    const fn optional(name: &'static str, kind: Kind, value: Value) -> Parameter {
        Parameter { name, kind, value, required: false }
    }
    pub(super) const fn length(name: &'static str, default: f64) -> Parameter {
        Parameter::optional(name, Kind::Length, Value::Number(default))
    }
    pub(super) const fn displacement(name: &'static str, default: f64) -> Parameter {
        Parameter::optional(name, Kind::Displacement, Value::Number(default))
    }
    pub(super) const fn angle(name: &'static str, default: f64) -> Parameter {
        Parameter::optional(name, Kind::Angle, Value::Number(default))
    }
    pub(super) const fn number(name: &'static str, default: f64) -> Parameter {
        Parameter::optional(name, Kind::Number, Value::Number(default))
    }
    pub(super) const fn count(name: &'static str, least: u64, default: f64) -> Parameter {
        Parameter::optional(name, Kind::Count { least }, Value::Number(default))
    }
    pub(super) const fn lengths(name: &'static str, default: &'static [f64]) -> Parameter {
        Parameter::optional(name, Kind::Lengths(default.len()), Value::List(Cow::Borrowed(default)))
    }
    pub(super) const fn points(name: &'static str, default: &'static [[f64; 2]]) -> Parameter {
        Parameter::optional(name, Kind::Points(default.len()), Value::Points(Cow::Borrowed(default)))
    }
    /// The same parameter, required; its value is then a typical one.
    pub(super) const fn required(mut self) -> Parameter {
        self.required = true;
        self
    }

    /// Whether a value has the form that the parameter asks for.
    fn check(&self, value: &Value) -> Result<(), Error> {
        let Parameter { name, kind, .. } = *self;
        let numbers: &[f64] = match (kind, value) {
            (Kind::Length | Kind::Displacement | Kind::Angle | Kind::Number | Kind::Count { .. }, Value::Number(x)) => {
                core::slice::from_ref(x)
            }
            (Kind::Lengths(n), Value::List(list)) if list.len() == n => list,
            (Kind::Points(n), Value::Points(points)) if points.len() == n => points.as_flattened(),
            (kind, _) => return Err(Error::Form { name, must: kind.form(), found: value.describe() }),
        };
        match numbers.iter().find(|x| !x.is_finite()) {
            Some(&value) => Err(Error::Parameter { name, must: "finite", value }),
            None => Ok(()),
        }
    }
}

impl Kind {
    /// What a value of this kind looks like.
    pub fn form(self) -> String {
        match self {
            Kind::Length | Kind::Displacement | Kind::Angle | Kind::Number => "a number".into(),
            Kind::Count { .. } => "a whole number".into(),
            Kind::Lengths(n) => format!("a list of {n} numbers"),
            Kind::Points(n) => format!("a list of {n} points [x1, x2]"),
        }
    }

    /// Whether values of this kind scale with the table.
    pub fn is_length(self) -> bool {
        match self {
            Kind::Length | Kind::Displacement | Kind::Lengths(_) | Kind::Points(_) => true,
            Kind::Angle | Kind::Number | Kind::Count { .. } => false,
        }
    }
}

impl Value {
    fn describe(&self) -> String {
        match self {
            Value::Number(x) => format!("{x}"),
            Value::List(list) => format!("a list of {} numbers", list.len()),
            Value::Points(points) => format!("a list of {} points", points.len()),
        }
    }

    /// The value with every number multiplied by `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Value {
        match self {
            Value::Number(x) => Value::Number(x * factor),
            Value::List(list) => Value::List(list.iter().map(|x| x * factor).collect()),
            Value::Points(points) => Value::Points(points.iter().map(|p| p.map(|x| x * factor)).collect()),
        }
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Value {
        Value::Number(number)
    }
}
impl From<Vec<f64>> for Value {
    fn from(list: Vec<f64>) -> Value {
        Value::List(list.into())
    }
}
impl From<Vec<[f64; 2]>> for Value {
    fn from(points: Vec<[f64; 2]>) -> Value {
        Value::Points(points.into())
    }
}

impl Values {
    /// No values: all defaults.
    pub fn new() -> Values {
        Values::default()
    }

    /// The same values and one more.
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, value: impl Into<Value>) -> Values {
        self.0.insert(name.into(), value.into());
        self
    }

    /// The value of a parameter.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.0.get(name)
    }

    /// All of them, in the order of their names.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Value)> {
        self.0.iter().map(|(name, value)| (name.as_str(), value))
    }

    /// The number of that name, in completed values.
    pub(super) fn number(&self, name: &'static str) -> Result<f64, Error> {
        match self.get(name) {
            Some(Value::Number(x)) => Ok(*x),
            _ => Err(Error::Missing { name }),
        }
    }

    /// The whole number of that name, in completed values.
    pub(super) fn count(&self, name: &'static str) -> Result<usize, Error> {
        let value = self.number(name)?;
        // 2⁵³: beyond this not every whole number is an f64
        if !((0.0..9_007_199_254_740_992.0).contains(&value) && libm::floor(value) == value) {
            return Err(Error::Parameter { name, must: "a whole number, 0 or more", value });
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked above")]
        Ok(value as usize)
    }

    /// The list of that name, in completed values.
    pub(super) fn list<const K: usize>(&self, name: &'static str) -> Result<[f64; K], Error> {
        match self.get(name) {
            Some(Value::List(list)) => list.as_ref().try_into().map_err(|_| Error::Missing { name }),
            _ => Err(Error::Missing { name }),
        }
    }

    /// The points of that name, in completed values.
    pub(super) fn points<const K: usize>(&self, name: &'static str) -> Result<[Vector2<f64>; K], Error> {
        match self.get(name) {
            Some(Value::Points(points)) => {
                let points: [[f64; 2]; K] = points.as_ref().try_into().map_err(|_| Error::Missing { name })?;
                Ok(points.map(Vector2::from))
            }
            _ => Err(Error::Missing { name }),
        }
    }
}

impl Entry {
    /// The dimension of the space it lies in.
    pub fn dimension(&self) -> usize {
        match self.build {
            Build::Planar(_) => 2,
            Build::Spatial(_) => 3,
        }
    }

    /// The values given, and defaults for all others.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a parameter that this table does not have, [`Error::Missing`] for one that it needs,
    /// [`Error::Form`] for one of the wrong form, and [`Error::Parameter`] for one that is not finite.
    pub fn complete(&self, given: &Values) -> Result<Values, Error> {
        if let Some(name) = given.0.keys().find(|name| self.parameters.iter().all(|p| p.name != **name)) {
            let known = self.parameters.iter().map(|p| p.name).collect::<Vec<_>>().join(", ");
            return Err(Error::Unknown { name: name.clone(), table: self.name, known });
        }
        let mut all = Values::new();
        for parameter in self.parameters {
            let value = match given.get(parameter.name) {
                Some(value) => value.clone(),
                None if parameter.required => return Err(Error::Missing { name: parameter.name }),
                None => parameter.value.clone(),
            };
            parameter.check(&value)?;
            all = all.with(parameter.name, value);
        }
        Ok(all)
    }

    /// All defaults, and typical values for required parameters: a table to start from.
    pub fn typical(&self) -> Values {
        self.parameters.iter().fold(Values::new(), |all, p| all.with(p.name, p.value.clone()))
    }

    /// The values of the same table `factor` times as large.
    #[must_use]
    pub fn scaled(&self, values: &Values, factor: f64) -> Values {
        let scale = |(name, value): (&String, &Value)| {
            let is_length = self.parameters.iter().any(|p| p.name == name && p.kind.is_length());
            (name.clone(), if is_length { value.scaled(factor) } else { value.clone() })
        };
        Values(values.0.iter().map(scale).collect())
    }

    /// The planar table with the given values, and defaults for all others.
    ///
    /// # Errors
    /// As [`Entry::complete`] and the table's own constructor; [`Error::Dimension`] for a table in space.
    pub fn planar(&self, given: &Values) -> Result<Table, Error> {
        match self.build {
            Build::Planar(build) => build(&self.complete(given)?),
            Build::Spatial(_) => Err(Error::Dimension { table: self.name, dimension: 3 }),
        }
    }

    /// The table in space with the given values, and defaults for all others.
    ///
    /// # Errors
    /// As [`Entry::complete`] and the table's own constructor; [`Error::Dimension`] for a planar table.
    pub fn spatial(&self, given: &Values) -> Result<SpatialTable, Error> {
        match self.build {
            Build::Spatial(build) => build(&self.complete(given)?),
            Build::Planar(_) => Err(Error::Dimension { table: self.name, dimension: 2 }),
        }
    }
}

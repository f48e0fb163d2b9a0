//! Things known by name with named parameters: tables and shapes.

use std::borrow::Cow;

use super::{direction, known, point, text, unknown};
use crate::document::{self, Item, Problems, Section, Span, Spanned};

/// Something a scene can name, with its parameters.
#[derive(Clone, Debug)]
pub struct Model<B = ()> {
    /// Its name in a scene.
    pub name: &'static str,
    /// Dimension of its space, 2 or 3.
    pub dimension: usize,
    /// What it is, in one line.
    pub summary: &'static str,
    /// Its parameters.
    pub parameters: Cow<'static, [Parameter]>,
    /// How it is built from them; nothing for a table, which the geometry crate builds.
    pub build: B,
}

/// A named parameter.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Its key.
    pub name: &'static str,
    /// What values it takes.
    pub kind: Kind,
    /// Its value if absent.
    pub default: IfAbsent,
}

/// What values a parameter takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A positive length.
    Length,
    /// A length that may be zero.
    Distance,
    /// Any real number: a coordinate, an angle in radians, a signed length.
    Real,
    /// A whole number.
    Count {
        /// At least.
        least: u64,
        /// At most.
        most: u64,
    },
    /// This many positive lengths.
    Lengths(usize),
    /// A point of space.
    Point,
    /// A vector that is not zero; its length does not matter.
    Direction,
    /// A list of points of space.
    Points {
        /// At least.
        least: usize,
        /// At most.
        most: usize,
    },
    /// At least this many real numbers.
    Reals(usize),
    /// Triples of whole numbers from 0.
    Triples,
}

impl Kind {
    /// An example of a list of this kind in this dimension.
    fn list(self, dimension: usize) -> &'static str {
        match (self, dimension) {
            (Kind::Points { .. }, 2) => "[[0, 0], [4, 0], [1, 3]]",
            (Kind::Points { .. }, _) => "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]",
            (Kind::Triples, 2) => "[[0, 1, 2]]",
            (Kind::Triples, _) => "[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]",
            _ => "[0, 0.5, 0.25]",
        }
    }
}

/// What a parameter is if absent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum IfAbsent {
    /// It must be given. With the defaults of the others, this example makes a table or a shape; where there is none, one follows from
    /// its kind.
    Required(Option<Constant>),
    /// This.
    Value(Constant),
}

/// The value of a parameter that a scene does not give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Constant {
    /// One number or several.
    Numbers(&'static [f64]),
    /// Points of the plane.
    Points(&'static [[f64; 2]]),
}

impl Constant {
    fn argument(self, span: Span) -> Argument {
        match self {
            Constant::Numbers(numbers) => Argument::Numbers(numbers.to_vec()),
            Constant::Points(points) => {
                Argument::Points(points.iter().map(|point| Spanned::new(point.to_vec(), span)).collect())
            }
        }
    }
}

impl std::fmt::Display for Constant {
    /// As a scene writes it.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let list = |numbers: &[f64]| {
            let numbers: Vec<_> = numbers.iter().map(|x| document::spell(*x)).collect();
            format!("[{}]", numbers.join(", "))
        };
        match self {
            Constant::Numbers([x]) => f.write_str(&document::spell(*x)),
            Constant::Numbers(numbers) => f.write_str(&list(numbers)),
            Constant::Points(points) => {
                let points: Vec<_> = points.iter().map(|point| list(point)).collect();
                write!(f, "[{}]", points.join(", "))
            }
        }
    }
}

impl Parameter {
    /// A parameter that must be given.
    pub const fn required(name: &'static str, kind: Kind) -> Self {
        Self { name, kind, default: IfAbsent::Required(None) }
    }

    /// A parameter with a default.
    pub const fn with_default(name: &'static str, kind: Kind, default: &'static [f64]) -> Self {
        Self { name, kind, default: IfAbsent::Value(Constant::Numbers(default)) }
    }

    /// How to write it: `size = [2, 1]`, or the name alone if it has no default.
    pub fn signature(&self) -> String {
        match self.default {
            IfAbsent::Required(_) => self.name.into(),
            IfAbsent::Value(value) => format!("{} = {value}", self.name),
        }
    }

    /// Whether its numbers are lengths.
    pub(super) fn is_length(&self) -> bool {
        matches!(self.kind, Kind::Length | Kind::Distance | Kind::Lengths(_) | Kind::Point | Kind::Points { .. })
    }

    /// An example of it in this dimension: values that make a shape together with the examples of the other parameters.
    fn example(&self, dimension: usize) -> String {
        if let IfAbsent::Required(Some(example)) = self.default {
            return format!("{} = {example}", self.name);
        }
        let value = match self.kind {
            Kind::Length | Kind::Distance | Kind::Real => "1",
            Kind::Count { .. } => "5",
            Kind::Lengths(n) => return format!("{} = [{}]", self.name, vec!["1"; n].join(", ")),
            Kind::Point => match (self.name, dimension) {
                ("to", 2) => "[1, 0]", // not where "from" is
                ("to", _) => "[1, 0, 0]",
                (_, 2) => "[0, 0]",
                _ => "[0, 0, 0]",
            },
            Kind::Direction if dimension == 2 => "[0, 1]",
            Kind::Direction => "[0, 0, 1]",
            kind @ (Kind::Points { .. } | Kind::Reals(_) | Kind::Triples) => kind.list(dimension),
        };
        format!("{} = {value}", self.name)
    }
}

/// The value of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Argument {
    /// One number or several.
    Numbers(Vec<f64>),
    /// Points, each with its place.
    Points(Vec<Spanned<Vec<f64>>>),
}

/// The values of all parameters of a [`Model`], defaults included.
#[derive(Clone, Debug, PartialEq)]
pub struct Arguments {
    values: Vec<(&'static str, Spanned<Argument>)>,
    /// Where the model was named.
    span: Span,
}

impl Arguments {
    /// Where a parameter was given; where the model was named, if it was not given.
    pub fn span(&self, name: &str) -> Span {
        self.find(name).map_or(self.span, |argument| argument.span)
    }

    /// The numbers of a parameter: one for a length, as many as it has for a list of lengths, none for points.
    pub fn numbers(&self, name: &str) -> &[f64] {
        match self.find(name).map(|argument| &argument.value) {
            Some(Argument::Numbers(numbers)) => numbers,
            _ => &[],
        }
    }

    /// A parameter that is a single number; NaN, which no table accepts, if the model has no such parameter.
    pub fn number(&self, name: &str) -> f64 {
        self.numbers(name).first().copied().unwrap_or(f64::NAN)
    }

    /// The points of a parameter.
    pub fn points(&self, name: &str) -> &[Spanned<Vec<f64>>] {
        match self.find(name).map(|argument| &argument.value) {
            Some(Argument::Points(points)) => points,
            _ => &[],
        }
    }

    fn find(&self, name: &str) -> Option<&Spanned<Argument>> {
        self.values.iter().find(|(known, _)| *known == name).map(|(_, argument)| argument)
    }
}

/// The model a name stands for.
pub(super) fn model<B>(
    item: &Item,
    what: &str,
    models: &'static [Model<B>],
    dimension: usize,
    problems: &mut Problems,
) -> Option<&'static Model<B>> {
    let fitting = models.iter().filter(|model| model.dimension == dimension);
    let word = text(item, &known(fitting.clone().map(|model| model.name)), problems)?.value;
    if let Some(model) = fitting.clone().find(|model| model.name == word) {
        return Some(model);
    }
    if let Some(other) = models.iter().find(|model| model.name == word) {
        let n = other.dimension;
        problems.add_with_help(
            item.span,
            format!("the {what} \"{word}\" is {n}-dimensional"),
            format!("set dimension = {n} in [table]"),
        );
        return None;
    }
    unknown(item.span, what, &word, fitting.map(|model| model.name), problems);
    None
}

/// Reads the parameters of a model from the keys of a section.
pub(super) fn arguments<B>(
    section: &mut Section<'_>,
    span: Span,
    model: &'static Model<B>,
    problems: &mut Problems,
) -> Option<Arguments> {
    let mut values = Vec::new();
    let mut complete = true;
    for parameter in model.parameters.iter() {
        let given = match parameter.default {
            IfAbsent::Required(_) => section.required(parameter.name, &parameter.example(model.dimension)),
            IfAbsent::Value(_) => section.optional(parameter.name),
        };
        let value = match (given, parameter.default) {
            (Some(item), _) => argument(item, parameter.kind, model.dimension, problems),
            (None, IfAbsent::Value(value)) => Some(Spanned::new(value.argument(span), span)),
            (None, IfAbsent::Required(_)) => None,
        };
        complete &= value.is_some();
        values.extend(value.map(|value| (parameter.name, value)));
    }
    complete.then_some(Arguments { values, span })
}

fn argument(item: &Item, kind: Kind, dimension: usize, problems: &mut Problems) -> Option<Spanned<Argument>> {
    let one = |x: Spanned<f64>| Argument::Numbers(vec![x.value]);
    let value = match kind {
        Kind::Length => one(document::positive(item, problems)?),
        Kind::Distance => one(document::nonnegative(item, problems)?),
        Kind::Real => one(document::real(item, problems)?),
        Kind::Count { least, most } => {
            Argument::Numbers(vec![document::whole(item, least..=most, problems)?.value as f64])
        }
        Kind::Lengths(n) => Argument::Numbers(document::lengths(item, n, problems)?.value),
        Kind::Point => Argument::Numbers(point(item, dimension, problems)?.value),
        Kind::Direction => Argument::Numbers(direction(item, dimension, problems)?.value),
        Kind::Reals(least) => {
            let items = super::list(item, "a list of numbers", kind.list(dimension), problems)?;
            let numbers: Vec<_> = items.iter().map(|item| document::real(item, problems)).collect();
            if numbers.len() < least {
                problems.add(item.span, format!("expected at least {least} numbers, found {}", numbers.len()));
            }
            Argument::Numbers(numbers.into_iter().map(|x| x.map(|x| x.value)).collect::<Option<_>>()?)
        }
        Kind::Triples => {
            let whole = |item: &Item, problems: &mut Problems| {
                let n = document::count(item, 0, problems)?;
                Some(n.map(|n| n as f64))
            };
            let items = super::list(item, "a list of triples", kind.list(dimension), problems)?;
            let triples: Vec<_> =
                items.iter().map(|item| document::array(item, 3, whole, "[0, 1, 2]", problems)).collect();
            let triples: Vec<_> = triples.into_iter().collect::<Option<_>>()?;
            Argument::Numbers(triples.into_iter().flat_map(|t| t.value).collect())
        }
        Kind::Points { least, most } => {
            let items = super::list(item, "a list of points", kind.list(dimension), problems)?;
            let points: Vec<_> = items.iter().map(|item| point(item, dimension, problems)).collect();
            if !(least..=most).contains(&points.len()) {
                let so_many = if least == most { least.to_string() } else { format!("at least {least}") };
                problems.add(item.span, format!("expected {so_many} points, found {}", points.len()));
                return None;
            }
            Argument::Points(points.into_iter().collect::<Option<_>>()?)
        }
    };
    Some(Spanned::new(value, item.span))
}

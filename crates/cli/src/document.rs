//! Input files as trees of values that remember their place in the file, whether written in TOML or
//! in JSON.
//!
//! So every later error, even one about geometry, can point at the line and column of its cause.

mod diagnostic;
mod json;
mod misnamed;
mod number;
mod section;
mod source;
mod toml;

pub use diagnostic::{Diagnostic, Place, Problems, plain};
pub use json::{in_json, parse as parse_json};
pub use misnamed::with_file_meant;
pub use number::{
    LARGEST, SMALLEST, array, coordinate_formula, count, formula, lengths, nonnegative, number, polar_formula,
    positive, real, seed, spell, vector, whole,
};
pub use section::Section;
pub(crate) use source::bytes_of;
pub use source::{STANDARD_INPUT, Source, Span, Spanned};
pub use toml::parse as parse_toml;

/// A value with its place in the source.
pub type Item = Spanned<Value>;

/// A value of an input file.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A whole number, kept exactly.
    Integer(i128),
    /// Any other number; may be NaN or infinite, which no reader accepts.
    Float(f64),
    /// A string.
    Text(String),
    /// `true` or `false`.
    Boolean(bool),
    /// A date or time, which no reader accepts.
    Date,
    /// JSON's `null`, which no reader accepts.
    Null,
    /// An array.
    List(Vec<Item>),
    /// A table (JSON: object), in the order of the file.
    Table(Vec<(Spanned<String>, Item)>),
}

impl Value {
    /// What the value is, with an article, for messages.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Integer(_) => "an integer",
            Self::Float(_) => "a number",
            Self::Text(_) => "a string",
            Self::Boolean(_) => "a boolean",
            Self::Date => "a date",
            Self::Null => "null",
            Self::List(_) => "an array",
            Self::Table(_) => "a table",
        }
    }
}

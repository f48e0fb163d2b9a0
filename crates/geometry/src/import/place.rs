//! Where in a file something is.
use core::fmt;
use std::sync::Arc;

/// What was read from a file, and where in it each part is.
#[derive(Clone, Debug)]
pub struct Imported<T> {
    /// Pieces, or a surface of triangles.
    pub walls: T,
    /// The place of each piece or triangle.
    pub places: Vec<Place>,
}

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// A line, counted from 1.
    Line(usize),
    /// A facet of a binary file, counted from 0.
    Facet(usize),
    /// An outline: line and element of a drawing, or the path of keys of a map.
    Outline(Arc<str>),
    /// A position of an outline of a map, counted from 0: the one where the file starts the piece.
    Position(Arc<str>, usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Line(line) => write!(f, "line {line}"),
            Place::Facet(facet) => write!(f, "facet {facet}, counted from 0"),
            Place::Outline(outline) => f.write_str(outline),
            Place::Position(outline, position) => write!(f, "{outline}[{position}]"),
        }
    }
}

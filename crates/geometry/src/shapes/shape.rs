//! The shapes that answer in lanes.
use super::{Arc, Circle, Ellipse, EllipticArc, FullLine, Ray, Segment};
use crate::Piece;
use nalgebra::Vector2;
use std::sync::Arc as Shared;

/// A piece whose crossings and landings are formulas in [`Lane`](lanes::Lane)s: a list of such pieces is asked for many
/// paths at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A straight segment.
    Segment(Segment),
    /// Half a straight line.
    Ray(Ray),
    /// A whole straight line.
    Line(FullLine),
    /// Part of a circle.
    Arc(Arc),
    /// A whole circle.
    Circle(Circle),
    /// Part of an ellipse.
    EllipticArc(EllipticArc),
    /// A whole ellipse.
    Ellipse(Ellipse),
}

/// How a path lands on a shape.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Ground {
    /// On the line through a point with this unit normal into the table.
    Flat { through: [f64; 2], normal: [f64; 2] },
    /// On a circle: `±1/r` from the offset off the centre to the inward normal, and `r²`.
    Round { center: [f64; 2], to_normal: f64, square: f64 },
    /// On an ellipse.
    Oval(Ellipse),
}

impl Shape {
    /// The same moved by a vector \[L\].
    #[must_use]
    pub fn translated(self, by: Vector2<f64>) -> Shape {
        let by = by.into();
        match self {
            Shape::Segment(s) => Shape::Segment(s.translated(by)),
            Shape::Ray(s) => Shape::Ray(s.translated(by)),
            Shape::Line(s) => Shape::Line(s.translated(by)),
            Shape::Arc(s) => Shape::Arc(s.translated(by)),
            Shape::Circle(s) => Shape::Circle(s.translated(by)),
            Shape::EllipticArc(s) => Shape::EllipticArc(s.translated(by)),
            Shape::Ellipse(s) => Shape::Ellipse(s.translated(by)),
        }
    }

    /// The same as one side of a wall on which the table lies behind, too: what starts on the wall, within rounding, may be on either
    /// side and does not cross it.
    pub(crate) fn two_sided(self) -> Shape {
        match self {
            Shape::Segment(s) => Shape::Segment(s.two_sided()),
            Shape::Ray(s) => Shape::Ray(s.two_sided()),
            Shape::Line(s) => Shape::Line(s.two_sided()),
            Shape::Arc(s) => Shape::Arc(s.two_sided()),
            Shape::Circle(s) => Shape::Circle(s.two_sided()),
            Shape::EllipticArc(s) => Shape::EllipticArc(s.two_sided()),
            Shape::Ellipse(s) => Shape::Ellipse(s.two_sided()),
        }
    }
    pub(crate) fn is_two_sided(&self) -> bool {
        match self {
            Shape::Segment(s) => s.is_two_sided(),
            Shape::Ray(s) => s.is_two_sided(),
            Shape::Line(s) => s.is_two_sided(),
            Shape::Arc(s) => s.circle().is_two_sided(),
            Shape::Circle(s) => s.is_two_sided(),
            Shape::EllipticArc(s) => s.ellipse().unit().is_two_sided(),
            Shape::Ellipse(s) => s.unit().is_two_sided(),
        }
    }

    pub(crate) fn into_piece(self) -> Shared<dyn Piece> {
        match self {
            Shape::Segment(s) => Shared::new(s),
            Shape::Ray(s) => Shared::new(s),
            Shape::Line(s) => Shared::new(s),
            Shape::Arc(s) => Shared::new(s),
            Shape::Circle(s) => Shared::new(s),
            Shape::EllipticArc(s) => Shared::new(s),
            Shape::Ellipse(s) => Shared::new(s),
        }
    }

    pub(crate) fn as_piece(&self) -> &dyn Piece {
        match self {
            Shape::Segment(s) => s,
            Shape::Ray(s) => s,
            Shape::Line(s) => s,
            Shape::Arc(s) => s,
            Shape::Circle(s) => s,
            Shape::EllipticArc(s) => s,
            Shape::Ellipse(s) => s,
        }
    }

    pub(crate) fn ground(&self) -> Ground {
        match self {
            Shape::Segment(s) => Ground::Flat { through: s.start(), normal: s.inward_normal() },
            Shape::Ray(s) => Ground::Flat { through: s.start(), normal: s.inward_normal() },
            Shape::Line(s) => Ground::Flat { through: s.through(), normal: s.inward_normal() },
            Shape::Arc(s) => s.circle().ground(),
            Shape::Circle(s) => s.ground(),
            Shape::EllipticArc(s) => Ground::Oval(*s.ellipse()),
            Shape::Ellipse(s) => Ground::Oval(*s),
        }
    }
}

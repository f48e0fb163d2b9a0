//! The shapes that answer in lanes.
use super::{Arc, Circle, Ellipse, EllipticArc, FullLine, Ray, Screen, Segment};
use crate::{Figure, Piece};
use nalgebra::Vector2;
use std::sync::Arc as Shared;

/// A piece whose crossings and landings are formulas in [`Lane`](lanes::Lane)s: a list of such pieces is tested for many paths at a
/// time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A straight segment.
    Segment(Segment),
    /// A straight segment that is a wall on both of its sides.
    Screen(Screen),
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

/// The same expression for every kind of shape: `$s` is the content of a variant, `$shape` its constructor.
macro_rules! each {
    ($self:expr, $shape:pat, $s:ident => $then:expr) => {
        each!($self, $shape, $s => $then; Segment Screen Ray Line Arc Circle EllipticArc Ellipse)
    };
    ($self:expr, $shape:pat, $s:ident => $then:expr; $($kind:ident)*) => {
        match $self {
            $(Shape::$kind($s) => {
                let $shape = Shape::$kind;
                $then
            })*
        }
    };
}

/// How a path lands on a shape.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Ground {
    /// On the line through a point with this unit normal into the table.
    Flat { through: [f64; 2], normal: [f64; 2] },
    /// On either of two segments.
    Faces([Segment; 2]),
    /// On a circle: `±1/r`, the factor from the offset from the centre to the inward normal, and `r²`.
    Round { center: [f64; 2], to_normal: f64, square: f64 },
    /// On an ellipse.
    Oval(Ellipse),
}

impl Shape {
    /// The same moved by a vector \[L\].
    #[must_use]
    pub fn translated(self, by: Vector2<f64>) -> Shape {
        let by = by.into();
        each!(self, shape, s => shape(s.translated(by)))
    }

    /// The same as one side of a wall with the table on both sides: a path that starts on the wall, within rounding, may be on either
    /// side and does not cross it.
    pub(crate) fn two_sided(self) -> Shape {
        each!(self, shape, s => shape(s.two_sided()))
    }
    pub(crate) fn is_two_sided(&self) -> bool {
        match self {
            Shape::Segment(s) => s.is_two_sided(),
            Shape::Screen(s) => s.is_two_sided(),
            Shape::Ray(s) => s.is_two_sided(),
            Shape::Line(s) => s.is_two_sided(),
            Shape::Arc(s) => s.circle().is_two_sided(),
            Shape::Circle(s) => s.is_two_sided(),
            Shape::EllipticArc(s) => s.ellipse().unit().is_two_sided(),
            Shape::Ellipse(s) => s.unit().is_two_sided(),
        }
    }

    pub(crate) fn into_piece(self) -> Shared<dyn Piece> {
        each!(self, _, s => Shared::new(s))
    }

    pub(crate) fn as_piece(&self) -> &dyn Piece {
        each!(self, _, s => s)
    }

    /// The exact figure.
    pub fn figure(&self) -> Figure {
        match self {
            Shape::Segment(s) => Figure::Segment { ends: s.vertices().map(|p| Vector2::from(*p)) },
            Shape::Ray(s) => Figure::Ray { from: s.start().into(), direction: s.direction().into(), left: s.is_left() },
            Shape::Line(s) => Figure::Line { through: s.through().into(), direction: s.direction() },
            Shape::Arc(s) => {
                let Circle { center, radius, inside, .. } = *s.circle();
                let ends = s.vertices().map(|p| Vector2::from(*p));
                Figure::Arc { center: center.into(), radius, ends, inside }
            }
            Shape::Circle(Circle { center, radius, inside, .. }) => {
                Figure::Circle { center: (*center).into(), radius: *radius, inside: *inside }
            }
            Shape::Screen(_) | Shape::EllipticArc(_) | Shape::Ellipse(_) => Figure::Other,
        }
    }

    pub(crate) fn ground(&self) -> Ground {
        match self {
            Shape::Segment(s) => Ground::Flat { through: s.start(), normal: s.inward_normal() },
            Shape::Screen(s) => Ground::Faces(*s.faces()),
            Shape::Ray(s) => Ground::Flat { through: s.start(), normal: s.inward_normal() },
            Shape::Line(s) => Ground::Flat { through: s.through(), normal: s.inward_normal() },
            Shape::Arc(s) => s.circle().ground(),
            Shape::Circle(s) => s.ground(),
            Shape::EllipticArc(s) => Ground::Oval(*s.ellipse()),
            Shape::Ellipse(s) => Ground::Oval(*s),
        }
    }
}

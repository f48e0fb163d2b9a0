//! A piece of a planar boundary: everything that may be asked of it.
use crate::{
    crossing::Crossing,
    path::Line,
    plane::slack,
    shapes::{Shape, curve::Graph},
};
use core::fmt::Debug;
use nalgebra::Vector2;

pub use crate::extent::Extent;

/// Where a path lands on a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landing {
    /// The point of the piece, projected onto it \[L\].
    pub point: Vector2<f64>,
    /// Unit normal there, into the table.
    pub normal: Vector2<f64>,
}

/// The exact figure of a piece, for code that can use it: composite walls, offsets, pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Figure {
    /// A straight segment, table on its left.
    Segment {
        /// Its ends, in the order of traversal.
        ends: [Vector2<f64>; 2],
    },
    /// Half a straight line.
    Ray {
        /// Its end.
        from: Vector2<f64>,
        /// Unit direction away from the end.
        direction: Vector2<f64>,
        /// Whether the table lies on the left of `direction`.
        left: bool,
    },
    /// A whole straight line, table on its left.
    Line {
        /// A point of it.
        through: Vector2<f64>,
        /// Unit direction.
        direction: Vector2<f64>,
    },
    /// Part of a circle, traversed with the table on the left: counter-clockwise where the table is inside.
    Arc {
        /// Centre.
        center: Vector2<f64>,
        /// Radius, positive.
        radius: f64,
        /// Its ends, in the order of traversal.
        ends: [Vector2<f64>; 2],
        /// Whether the table lies inside the circle (a focusing arc).
        inside: bool,
    },
    /// A whole circle.
    Circle {
        /// Centre.
        center: Vector2<f64>,
        /// Radius, positive.
        radius: f64,
        /// Whether the table lies inside.
        inside: bool,
    },
    /// Anything else.
    Other,
}

/// A piece of a planar boundary. Object safe; a new shape is one implementation.
///
/// A piece is traversed with the table on its left; arc length `s` \[L\] runs from 0 to [`Piece::length`]. Infinite
/// pieces have infinite length and measure `s` from their end or from a given point, with either sign.
///
/// A smooth curve with a formula need not implement all this: [`PolarFormula`](crate::shapes::curve::PolarFormula),
/// [`ParametricFormula`](crate::shapes::curve::ParametricFormula) and [`ImplicitFormula`](crate::shapes::curve::ImplicitFormula) make
/// pieces of it. A boundary that is only to be hit is a [`Boundary`](crate::Boundary), of one function.
/// [`check::piece`](crate::check::piece()) measures how well a piece of your own keeps the promises made here. What they are for a
/// circle:
///
/// ```
/// use geometry::{Line, Piece, Vector2, shapes::Circle};
///
/// let circle: &dyn Piece = &Circle::new(Vector2::zeros(), 2.0, true)?;
/// let path = Line { point: Vector2::zeros(), velocity: Vector2::new(0.0, 4.0) };
/// let time = circle.crossing(&path).time();
/// let top = circle.landing(&path, time);
/// assert_eq!((time, top.point, top.normal), (0.5, Vector2::new(0.0, 2.0), Vector2::new(0.0, -1.0)));
/// // it leaves the wall where it starts, and crosses on the other side
/// let back = Line { point: top.point, velocity: -path.velocity };
/// assert_eq!(circle.crossing(&back).time(), 1.0);
/// assert_eq!(circle.curvature(&top.point), 0.5); // focusing
/// assert!((circle.arc_length_of(&top) - 0.25 * circle.length()).abs() < 1e-15); // a quarter turn to the left
/// # Ok::<(), geometry::Error>(())
/// ```
pub trait Piece: Debug + Send + Sync {
    /// When \[T\] the path first crosses the piece **outwards** (from the table's side); [`Crossing::NEVER`] where it does not.
    ///
    /// A start that lies outside by no more than rounding crosses at time 0. A start on the piece with a velocity
    /// into the table does not cross there. Neighbours that share a vertex decide by the same sign of
    /// `velocity × (vertex − point)`, so that no path slips through between them.
    fn crossing(&self, path: &Line<2>) -> Crossing;

    /// The point of the piece reached at `time` \[T\], that of a [`crossing`](Piece::crossing), projected onto the piece, and the normal
    /// there.
    fn landing(&self, path: &Line<2>, time: f64) -> Landing;

    /// Curvature at a point of the piece \[L⁻¹\]: positive where the table is on the concave side (focusing), negative
    /// where the wall bulges into the table (dispersing).
    fn curvature(&self, point: &Vector2<f64>) -> f64;

    /// Total arc length \[L\].
    fn length(&self) -> f64;

    /// The point at arc length `s`.
    fn point_at(&self, s: f64) -> Vector2<f64>;

    /// The point at arc length `s`, and the inward normal there.
    ///
    /// A piece with its own parametrisation need not search for the point again to know the normal.
    fn landing_at(&self, s: f64) -> Landing {
        let point = self.point_at(s);
        Landing { point, normal: self.closest(&point).normal }
    }

    /// The arc length of the point of the piece closest to `point`.
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64;

    /// The arc length of a landing: the inverse of [`Piece::landing_at`].
    ///
    /// A piece that lies on itself, as a wall without thickness does, tells by the normal which of its faces is meant.
    fn arc_length_of(&self, landing: &Landing) -> f64 {
        self.arc_length_at(&landing.point)
    }

    /// The point of the piece closest to `point`, and the inward normal there.
    fn closest(&self, point: &Vector2<f64>) -> Landing;

    /// Start and end in the order of traversal; `None` for a closed curve. An end at infinity has infinite
    /// coordinates.
    fn ends(&self) -> Option<[Vector2<f64>; 2]>;

    /// A box around the piece.
    fn extent(&self) -> Extent;

    /// The area \[L²\] between the piece and its chord, `½ ∫ (x dy − y dx)` about a point of the chord: positive where the piece runs
    /// counter-clockwise around it, 0 for a straight one. A closed curve has the area it encloses; infinite pieces have NaN.
    ///
    /// [`enclosed_area`] is the area that several pieces bound together.
    fn area(&self) -> f64;

    /// The piece as a shape that answers in SIMD lanes, if it is one: lists of such shapes run side by side at full speed, other pieces one
    /// lane after another.
    fn shape(&self) -> Option<Shape> {
        None
    }

    /// The piece as polynomial graphs over short chords, in the order of traversal, if it is a smooth curve that these represent to
    /// rounding: paths meet them in tens of nanoseconds, and side by side in lanes.
    fn graphs(&self) -> Option<Vec<Graph>> {
        None
    }

    /// How far the rounding of its own parameter may shift its points \[L\]: `ε |t| |c′|` on a curve `c(t)`, which is more than the
    /// rounding of coordinates where the formula is steep; 0 for other pieces.
    fn shift(&self) -> f64 {
        0.0
    }

    /// The two tips of a straight wall without thickness, whose boundary runs from one to the other and back.
    fn tips(&self) -> Option<[Vector2<f64>; 2]> {
        None
    }

    /// Whether the table also lies behind the piece, so that a path that starts on it, within rounding, does not cross it.
    fn has_two_sides(&self) -> bool {
        self.tips().is_some() || self.shape().is_some_and(|shape| shape.is_two_sided())
    }
}

impl dyn Piece + '_ {
    /// The exact figure: that of its shape, where it has one.
    pub fn figure(&self) -> Figure {
        self.shape().map_or(Figure::Other, |shape| shape.figure())
    }
}

/// The error of points of a piece \[L\]: on an arc, however short, the [`slack`] of its centre and radius; on other pieces only that of
/// their coordinates.
pub(crate) fn rounding(piece: &dyn Piece) -> f64 {
    match piece.figure() {
        Figure::Arc { center, radius, .. } => slack([center.x, center.y, radius]),
        _ => 0.0,
    }
}

/// The area \[L²\] enclosed by pieces each of which begins where the one before it ends: positive if they run counter-clockwise. A straight
/// line closes the loop from the end of the last one to the start of the first; infinite pieces have the area NaN.
///
/// Triangles are summed about a vertex, so that no accuracy is lost far from the origin.
pub fn enclosed_area<'a>(pieces: impl IntoIterator<Item = &'a dyn Piece>) -> f64 {
    let mut corner = None;
    let mut area = 0.0;
    for piece in pieces {
        area += piece.area();
        if let Some([a, b]) = piece.ends() {
            let corner = *corner.get_or_insert(a);
            area += 0.5 * (a - corner).perp(&(b - corner));
        }
    }
    area
}

//! What an explicit boundary consists of.

use super::super::law::Law;
use super::super::shapes::Shape;
use crate::document::{Span, Spanned};
use crate::expression::Expression;

/// One entry of an explicit boundary.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Where the entry stands.
    pub span: Span,
    /// What it is.
    pub border: Border,
    /// The law of its pieces, if not the scene's.
    pub law: Option<Law>,
}

/// What a boundary entry can be. Points and vectors have as many coordinates as the scene has dimensions.
#[derive(Clone, Debug)]
pub enum Border {
    /// `loop = { from = [x1, x2], edges = […], domain }`: a closed chain with the domain on its left; `chain = { … }`: one that
    /// continues in the next cell of a lattice.
    Loop {
        /// First vertex; of a loop also the last.
        from: Spanned<Vec<f64>>,
        /// Edges, each from the end of the one before it.
        edges: Vec<Edge>,
        /// Whether it is a loop.
        closed: bool,
        /// Where the domain lies, if the loop says so besides the order of its vertices.
        domain: Option<Domain>,
    },
    /// `circle` (in space: `sphere`) `= { center, radius, domain }`.
    Circle {
        /// Centre.
        center: Spanned<Vec<f64>>,
        /// Radius.
        radius: Spanned<f64>,
        /// Where the domain lies.
        domain: Domain,
    },
    /// `ellipse = { center, semi_axes, angle, domain }`.
    Ellipse {
        /// Centre.
        center: Spanned<Vec<f64>>,
        /// Half of each axis.
        semi_axes: Spanned<Vec<f64>>,
        /// From the x1 axis to the first axis, counter-clockwise.
        angle: Spanned<f64>,
        /// Where the domain lies.
        domain: Domain,
    },
    /// `line = { through, direction }`: a whole line with the domain on its left.
    Line {
        /// A point of it.
        through: Spanned<Vec<f64>>,
        /// Its direction.
        direction: Spanned<Vec<f64>>,
    },
    /// `ray = { from, direction, domain }`.
    Ray {
        /// Its end.
        from: Spanned<Vec<f64>>,
        /// Its direction.
        direction: Spanned<Vec<f64>>,
        /// Where the domain lies.
        domain: Side,
    },
    /// `plane = { through, normal }`, in space only; the normal points into the domain.
    Plane {
        /// A point of it.
        through: Spanned<Vec<f64>>,
        /// Direction into the domain.
        normal: Spanned<Vec<f64>>,
    },
    /// `curve = { polar = "1 + 0.2*cos(5*t)", center = [0, 0] }`,
    /// `curve = { x = "2*cos(t)", y = "sin(t)", over = [0, "2*pi"] }` or
    /// `curve = { implicit = "x^2/4 + y^2 - 1", within = [[-3, -2], [3, 2]] }`.
    Curve {
        /// Its formula.
        curve: Curve,
        /// The formula as written.
        formula: Spanned<String>,
        /// Where the domain lies.
        domain: Domain,
    },
    /// `shape = { name = "capsule", … }`.
    Shape {
        /// The shape.
        shape: Shape,
        /// The lengths that determine its size.
        lengths: Vec<f64>,
        /// Where the domain lies; outside unless it says otherwise.
        domain: Domain,
    },
    /// `outline = "file.svg"` (or `GeoJSON`): loops from a file.
    Outline {
        /// Path, relative to the scene file.
        file: Spanned<String>,
    },
    /// `mesh = { file = "file.obj", … }` (or STL), in space only: triangles from a file.
    Mesh {
        /// Path, relative to the scene file.
        file: Spanned<String>,
        /// Length of one unit of the file, in units of the scene.
        unit: f64,
        /// Where the file's origin lies.
        center: Spanned<Vec<f64>>,
        /// Where the domain lies; outside unless it says otherwise.
        domain: Domain,
    },
}

impl Border {
    /// The edges of a loop or chain; of anything else, none.
    pub(in crate::scene) fn edges(&self) -> &[Edge] {
        if let Border::Loop { edges, .. } = self { edges } else { &[] }
    }

    /// Whether the entry says by itself that the domain is around it.
    pub(crate) fn is_obstacle(&self) -> bool {
        match self {
            Border::Loop { domain, .. } => *domain == Some(Domain::Outside),
            Border::Circle { domain, .. }
            | Border::Ellipse { domain, .. }
            | Border::Curve { domain, .. }
            | Border::Shape { domain, .. }
            | Border::Mesh { domain, .. } => *domain == Domain::Outside,
            Border::Line { .. } | Border::Ray { .. } | Border::Plane { .. } | Border::Outline { .. } => false,
        }
    }
}

/// An edge of a loop.
#[derive(Clone, Debug)]
pub struct Edge {
    /// Where the edge stands.
    pub span: Span,
    /// Its shape and end.
    pub path: EdgePath,
    /// Its law, if not the entry's.
    pub law: Option<Law>,
}

/// Shape and end of an edge.
#[derive(Clone, Debug)]
pub enum EdgePath {
    /// `{ line_to = [x1, x2] }`.
    Line {
        /// Its end.
        to: Spanned<Vec<f64>>,
    },
    /// `{ arc_to = [x1, x2], center = [c1, c2], turn = "ccw" }`.
    Arc {
        /// Its end.
        to: Spanned<Vec<f64>>,
        /// Centre of its circle.
        center: Spanned<Vec<f64>>,
        /// Sense in which it is traversed.
        turn: Turn,
    },
    /// `{ x = "t", y = "t^2", over = [0, 1] }`: the points of a curve.
    Curve {
        /// The point at the last parameter.
        to: Spanned<Vec<f64>>,
        /// That at the first one.
        from: [f64; 2],
        /// `x` and `y`.
        point: [Expression; 2],
        /// First and last parameter.
        over: [f64; 2],
    },
}

impl EdgePath {
    /// Where it ends.
    pub(crate) fn end(&self) -> &Spanned<Vec<f64>> {
        match self {
            EdgePath::Line { to } | EdgePath::Arc { to, .. } | EdgePath::Curve { to, .. } => to,
        }
    }
}

/// Sense of rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// `"ccw"`: counter-clockwise.
    CounterClockwise,
    /// `"cw"`: clockwise.
    Clockwise,
}

/// Where the domain of a closed curve lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// Inside the curve.
    Inside,
    /// Outside the curve.
    Outside,
}

/// Where the domain of a ray lies, seen along its direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// On the left.
    Left,
    /// On the right.
    Right,
}

/// A closed curve given by a formula.
#[derive(Clone, Debug)]
pub enum Curve {
    /// The distance `r(t) > 0` from a centre in the direction `t`, with period 2π.
    Polar {
        /// `r(t)`.
        radius: Expression,
        /// The centre; the origin unless the scene says otherwise.
        center: Spanned<Vec<f64>>,
    },
    /// The points `(x(t), y(t))`.
    Parametric {
        /// `x` and `y`.
        point: [Expression; 2],
        /// First and last `t`; 0 and 2π unless the scene says otherwise.
        over: Spanned<[f64; 2]>,
    },
    /// The zeros of a function that is negative inside.
    Implicit {
        /// `f(x, y)`.
        function: Expression,
        /// Lower left and upper right corner of a box that contains the curve, not very much larger than it.
        within: Spanned<[[f64; 2]; 2]>,
    },
}

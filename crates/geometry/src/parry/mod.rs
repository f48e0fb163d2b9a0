//! Arbitrary shapes: anything that parry can represent can bound a table, in the plane and in space.
//!
//! parry says *which* part of a shape is near, how far it is and which way it faces; our exact solvers say *when* it
//! is touched, to the last bits. parry's own ray casts are not used at all: they hit the wall they start from again,
//! leak through vertices, and miss grazing paths and tiny shapes.
//!
//! * In the plane, [`pieces`] turns a shape into exact [`Piece`](crate::Piece)s wherever it consists of segments and
//!   arcs; any other shape becomes a [`DistancePiece`], which needs nothing but parry's point projection.
//! * In space, [`Solid`] is a [`Boundary`](crate::Boundary) inside or outside of any shape.
//! * A [`Room`] is bounded by several of them.
//! * [`ShapeSpec`] describes a shape as plain data, for scene files.
//!
//! parry's shapes are the only types of parry and glam that appear in a signature. Positions, poses and normals are
//! nalgebra's.
mod contour;
mod convert;
mod curve;
mod distance;
mod feet;
mod first;
mod mesh;
mod outer;
mod planar;
mod polytope;
mod room;
mod solid;
mod solid_spec;
mod spec;
mod traced;
mod union;

pub(crate) use contour::piece_of;
pub use curve::DistancePiece;
pub use parry2d_f64;
pub use parry3d_f64;
pub use planar::pieces;
pub use room::{Room, RoomSurface};
pub use solid::{Closest, Solid};
pub use solid_spec::SolidSpec;
pub use spec::{Placed, ShapeSpec};

/// On which side of a shape's surface the table lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The table is the inside of the shape.
    Inside,
    /// The shape is an obstacle and the table is around it.
    Outside,
}

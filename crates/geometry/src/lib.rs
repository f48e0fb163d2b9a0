//! Billiard tables: what a particle can hit, when, and which way the wall faces.
//!
//! Three layers, each with one job:
//!
//! * A [`Piece`] is an exact curve: [`shapes`] has segments, rays, lines, arcs, circles and more. To add a shape of
//!   your own, implement this one trait.
//! * A [`Table`] is a numbered set of connected pieces ([`Outline`] draws them; [`tables`] has the classical ones),
//!   perhaps repeated by a [`Lattice`].
//! * [`walls`] answer the engine's one question, in SIMD lanes of any width: what is hit first? A table chooses the
//!   fastest walls by itself ([`Table::with_walls`]).
//!
//! Everything is oriented: the boundary is traversed with the table on its left, and normals point into the table.
//! Nothing here has an absolute tolerance; scaling a table by a power of two scales every answer exactly, to the
//! last bit, while it is neither larger than 10⁴⁵ nor smaller than 10⁻⁴⁵: beyond, products of lengths in the formulas for hits may
//! over- or underflow. Scale such a table to a size near 1, as the command does.
#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::print_stdout))]

mod afar;
mod boundary;
mod boxes;
pub mod check;
mod chord;
mod components;
mod copies;
mod crossing;
mod describe;
pub mod edges;
mod error;
mod extent;
pub mod import;
mod inscribed;
mod intersect;
mod joints;
mod lattice;
mod nearest;
mod offset;
mod outline;
pub mod parry;
mod path;
mod piece;
mod plane;
mod random;
mod sample;
pub mod shapes;
mod sight;
mod spokes;
mod surface;
mod table;
pub mod tables;
mod validate;
pub mod walls;

pub use boundary::{Boundary, Hit};
pub use boxes::BoxTree;
pub use components::Component;
pub use crossing::Crossing;
pub use describe::Description;
pub use error::{Error, ImplicitRule, ParametricRule};
pub use inscribed::LargestDisk;
pub use intersect::{Meeting, MeetingKind, meetings};
pub use lattice::Lattice;
pub use nalgebra::{SVector, Vector2, Vector3};
pub use offset::{Offset, Origin};
pub use outline::{Outline, Turn};
pub use path::Line;
pub use piece::{Extent, Figure, Landing, Piece, enclosed_area};
#[doc(hidden)]
pub use plane::{GOLDEN_RATIO, MUST_HAVE_SQUARE};
pub use sample::{BoundaryPoint, Interior, Perimeter};
pub use surface::Surface;
pub use table::{FundamentalCell, Table};
pub use walls::{Chord, Homogeneous, Swing, WallHit, Walls, WithWalls};

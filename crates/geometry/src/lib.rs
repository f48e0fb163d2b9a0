//! Billiard tables: what a particle can hit, and when.
#![warn(clippy::unwrap_used, clippy::print_stdout)]

mod boundary;
mod crossing;
mod error;
mod path;
mod piece;
mod plane;
pub mod shapes;

pub use boundary::{Boundary, Hit};
pub use crossing::Crossing;
pub use error::Error;
pub use path::Line;
pub use piece::{Extent, Figure, Landing, Piece};

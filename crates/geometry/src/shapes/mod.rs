//! Exact planar pieces, one shape per file.
mod arc;
mod bump;
mod circle;
pub mod curve;
mod ellipse;
mod elliptic_arc;
mod elliptic_integral;
mod kink;
mod line;
mod parallel;
mod ray;
pub(crate) mod segment;
mod shape;
mod translated;

pub use arc::Arc;
pub use bump::Bump;
pub use circle::Circle;
pub use ellipse::Ellipse;
pub use elliptic_arc::EllipticArc;
pub use line::FullLine;
pub use parallel::Parallel;
pub use ray::Ray;
pub use segment::Segment;
pub(crate) use shape::Ground;
pub use shape::Shape;
pub use translated::Translated;

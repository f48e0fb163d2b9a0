//! Exact planar pieces, one shape per file.
mod arc;
mod circle;
mod line;
mod ray;
mod segment;
mod translated;

pub use arc::Arc;
pub use circle::Circle;
pub use line::FullLine;
pub use ray::Ray;
pub use segment::Segment;
pub use translated::Translated;

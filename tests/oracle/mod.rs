//! A slow oracle for hits and collisions, and the errors of the library measured with it.
//!
//! Shared by `tests/exactness.rs` and `examples/exactness.rs`.
pub(crate) mod convex;
pub(crate) mod curve;
pub(crate) mod curves;
pub(crate) mod errors;
pub(crate) mod number;
pub(crate) mod rays;
pub(crate) mod samples;
pub(crate) mod solids;
pub(crate) mod space;
pub(crate) mod subjects;
pub(crate) mod tables;

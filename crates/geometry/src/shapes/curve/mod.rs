//! Smooth curves given by formulas, and the tools they share.
//!
//! [`Implicit`] is a closed curve `f(x, y) = 0`, [`Polar`] a curve `r(φ)` about a centre. Both are met by the majorant
//! method ([`first_rise`]), which cannot step over a root; what makes it sound is an enclosure of the second
//! derivatives in [`Interval`] arithmetic.
mod arc_length;
mod fit;
mod graph;
mod implicit;
mod interval;
mod majorant;
mod polar;
mod root;

pub(crate) use arc_length::{ArcLength, Parametric, closest_parameter};
pub(crate) use fit::graphs;
pub use graph::Graph;
pub(crate) use graph::{Local, Meeting, Ray};
pub use implicit::{Implicit, ImplicitFormula};
pub use interval::Interval;
pub use majorant::{Smooth, first_rise};
pub use polar::{Polar, PolarFormula};
pub(crate) use root::rising_root;

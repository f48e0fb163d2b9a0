//! Smooth curves given by formulas, and the tools they share.
//!
//! [`Implicit`] is a closed curve `f(x, y) = 0`, [`Polar`] a curve `r(φ)` about a centre, and [`ParametricCurve`] a curve `c(t)`, which may
//! have cusps ([`PolarPoints`] gives such a curve by its radius). Paths meet the first two by the majorant method ([`first_rise`]), which
//! cannot step over a root, thanks to an enclosure of the second derivatives in [`Interval`] arithmetic.
//!
//! A smooth curve is also cut into [`graphs`](graphs()), once per table: polynomials over short chords that are accurate to rounding. The
//! engine uses these, for many paths at a time; the majorant method remains for curves with kinks or unbounded curvature.
mod arc_length;
mod bends;
mod cusp;
mod fit;
mod graph;
mod hidden;
mod implicit;
mod interval;
mod jump;
mod kinks;
mod majorant;
mod nearest;
mod parametric_curve;
mod polar;
mod polar_arc;
mod polar_points;
mod ranges;
mod root;
mod seeds;
mod spike;

pub(crate) use arc_length::ArcLength;
pub use arc_length::Parametric;
pub use fit::graphs;
pub(crate) use fit::rough_graphs;
pub use graph::Graph;
pub(crate) use graph::{Aimed, Local, Meeting, Row, at_least, grazes, turn};
pub use implicit::{Implicit, ImplicitFormula};
pub use interval::Interval;
pub use majorant::{Smooth, first_rise};
pub(crate) use nearest::Blocks;
pub use parametric_curve::{ParametricCurve, ParametricFormula};
pub use polar::{Polar, PolarFormula};
pub use polar_arc::PolarArc;
pub use polar_points::PolarPoints;
pub(crate) use root::{rising_root, rising_root_near};

//! The paper, recomputed: C. Cox and R. Feres, *No-Slip Billiards in Dimension Two*, figure by figure and claim by claim.
//!
//! A [`Figure`] computes what it shows with the engine and draws it; the registry is [`figures::all`]. The claims are
//! those of the crate `paper`. [`page`] puts both on one page.

mod camera;
pub mod figures;
mod motion;
pub mod page;
mod portrait;
mod sheet;

use crate::picture::Svg;

/// A picture of the paper, or one beside it.
#[derive(Clone, Copy, Debug)]
pub struct Figure {
    /// Short name, in lower case with hyphens; of its file too.
    pub name: &'static str,
    /// What it is, as a heading.
    pub title: &'static str,
    /// Where the paper has it: "Figure 5", or "beyond the paper".
    pub place: &'static str,
    /// What is to be seen, in our words.
    pub caption: &'static str,
    /// What it was computed with.
    pub parameters: &'static str,
    /// Computes and draws it.
    pub draw: fn(Effort) -> Drawing,
}

/// A picture, or why there is none.
pub type Drawing = Result<Svg, Box<dyn std::error::Error + Send + Sync>>;

pub use paper::Effort;

/// `γ` of a uniform disk, `1/√2`.
const UNIFORM: f64 = core::f64::consts::FRAC_1_SQRT_2;

/// The name of a figure that does not belong to the paper.
pub const BEYOND: &str = "beyond the paper";

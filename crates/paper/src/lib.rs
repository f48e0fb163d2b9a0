//! Every numbered statement of C. Cox and R. Feres, *No-Slip Billiards in Dimension Two*, measured.
//!
//! A [`Claim`] is one statement of the paper (or one beside it), our verdict on it, and a measurement that could show the
//! verdict to be wrong. The registry is [`claims::all`]:
//!
//! ```
//! use paper::{Effort, claims};
//! let claim = claims::find("strip-width").expect("a claim of the paper");
//! let measurement = claim.measure(Effort::Quick);
//! assert!(measurement.is_consistent(), "{measurement}");
//! ```
//!
//! **Conventions.** `x = (x₀, x₁, x₂)`, with `x₀ = γ R θ` counter-clockwise and `(x₁, x₂)` the centre of the disk; the kinetic
//! energy is `(m/2)|ẋ|²`. `ν` points into the table, `t = J ν` with `J(x, y) = (−y, x)`. These are the conventions of the
//! paper's equation (2.1); its matrix `T`, equation (2.2), turns `x₀` the other way (see the claim `matrix-t`). Unless said
//! otherwise the disk is uniform, `γ² = 1/2`, and `|ẋ| = 1`.
//!
//! Random starts come from `ChaCha` streams, one per sample, and nothing depends on the number of threads: every
//! measurement has the same bits every time.
#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::print_stdout))]

mod circle;
mod claim;
pub mod claims;
pub mod fractions;
mod law;
mod motion;
mod random;
pub mod side_sequences;
mod statistics;
pub mod strip;
pub mod wedge;

pub use claim::{Claim, Effort, Measurement, Quantity, Relation, STANDARD_ERRORS, Verdict};

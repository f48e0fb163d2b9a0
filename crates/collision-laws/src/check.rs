//! Checks of the axioms, for any law, built in or your own.
//!
//! [`law`] tries a law on a pair of bodies with random velocities and returns a [`Report`] of numbers: how far the law is from
//! each axiom, relative to the size of the velocities. [`map`] does the same for any map of `T_qM`, linear or not, and
//! [`body`] tests the four maps of a [`Body`](crate::Body). If the directions of a law vary in space, or turn with the body, only a whole
//! step of a billiard shows whether it preserves the measure: [`Slab`].
//!
//! ```
//! use collision_laws::{Contact, Fixed, Pair, bodies::Ball, check::{self, Axiom, Samples}, laws::{NoSlip, Restitution}};
//! use nalgebra::Vector2;
//!
//! let contact = Contact::new(Vector2::zeros(), Vector2::new(0.0, 1.0), 0)?;
//! let disk = Ball::<2>::uniform(1.0, 1.0)?;
//! let pair = Pair::new(contact, (disk, Vector2::new(0.0, -1.0)), (Fixed, Vector2::zeros()));
//!
//! assert!(check::law(&pair, &NoSlip, Samples::default()).is_strict(check::TOLERANCE));
//!
//! let dissipative = check::law(&pair, &Restitution::new(0.5, 1.0)?, Samples::default());
//! let broken: Vec<Axiom> = dissipative.broken(check::TOLERANCE).map(|(axiom, _)| axiom).collect();
//! assert_eq!(broken, [Axiom::Energy, Axiom::Involution, Axiom::Measure]);
//! # Ok::<(), collision_laws::Error>(())
//! ```

pub mod axioms;
pub mod controls;
mod measure;
mod report;
mod slab;
mod trial;

pub use measure::jacobian_determinant;
pub use report::{Axiom, Report, TOLERANCE};
pub use slab::{LawOfOrientation, Slab, SlabState};
pub use trial::{BodyReport, Samples, body, law, map, tolerance};

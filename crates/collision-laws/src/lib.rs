//! Collision laws of rigid bodies, in any dimension.
//!
//! Two bodies touch; `ν` points from the second (the wall) into the first. `u = J v ∈ ℝᴺ` is the velocity of the first
//! touching point minus that of the second, `p ∈ ℝᴺ` the impulse on the first, `v⁺ = v + G⁻¹Jᵀ p` with `G` the kinetic-energy
//! metric. All a law needs to know of the bodies is the Delassus operator `K = J G⁻¹ Jᵀ`.
//!
//! A **strict** collision law is linear in the velocities, conserves energy and momenta, is reversible, and acts at the contact
//! alone. (Without linearity there are many more: in the plane one for each involution of an interval of angles.) Cox, Feres and Ward
//! (arXiv:1501.06536) proved that there is one for each subspace of the contact plane `ν⊥`, that of its *rough directions*: with
//! `P` the projector onto them and `Q = ν νᵀ + P`,
//!
//! ```text
//! (Q K Q + 1 − Q) p = −2 Q u        k = 0: specular,   k = N−1: no-slip,   else: a point of Gr(k, N−1)
//! ```
//!
//! So a law is N-dimensional linear algebra, and never sees the N(N+1)/2 degrees of freedom of a body.
//!
//! | mathematics | here |
//! |---|---|
//! | boundary point `q` of configuration space | [`Pair`]: two bodies at a [`Contact`] |
//! | `T_qM`, its metric and subspaces | [`TangentSpace`] |
//! | a body's kinetic-energy metric, `J`, `G⁻¹Jᵀ`, `K` | the four maps of [`Body`] |
//! | a strict law, any law | [`StrictLaw`], [`CollisionLaw`] |
//! | the collision map `C_q` | [`Pair::collide`], as a matrix [`Pair::collision_map`] |
//! | the axioms, the moduli of strict maps | [`check`], [`classify()`] |
//!
//! Results have the same bits on every CPU. (If another crate in a program enables nalgebra's feature `std`, products of large matrices
//! use fused operations on CPUs that have them, and the last digits of what [`check`] and [`classify()`] find depend on that; collisions
//! do not.)
//!
//! A wall is an immovable body, [`Fixed`]; a ball against a wall and two free bodies run the same code:
//!
//! ```
//! use collision_laws::{Contact, Pair, Twist, bodies::{Ball, Planar}, laws::NoSlip};
//! use nalgebra::Vector2;
//!
//! let contact = Contact::new(Vector2::zeros(), Vector2::new(0.0, 1.0), 0)?;
//! let (disk, plank) = (Ball::<2>::uniform(1.0, 1.0)?, Planar::new(2.0, 5.0)?);
//! let pair = Pair::from_centres(contact, (disk, Vector2::new(0.0, 1.0)), (plank, Vector2::new(0.5, -0.25)));
//! let before = (Twist::planar(Vector2::new(0.3, -1.0), 2.0), Twist::planar(Vector2::new(0.0, 0.5), 0.0));
//! let collision = pair.try_collide(&NoSlip, &before)?;
//! let gain = pair.kinetic_energy(&collision.velocities) - pair.kinetic_energy(&before);
//! assert!(gain.abs() < 1e-15 * pair.kinetic_energy(&before) * 8.0); // a few roundings
//! # Ok::<(), collision_laws::Error>(())
//! ```

#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::expect_used, clippy::print_stdout))]

mod across;
mod ball_wall;
pub mod bodies;
mod body;
pub mod check;
mod classify;
mod contact;
mod contact_map;
mod delassus;
mod error;
mod law;
pub mod laws;
mod near;
mod pair;
mod product;
mod random;
mod roughness;
mod symmetric;
mod tangent_space;
mod through;
mod twist;

pub use ball_wall::{DiskLaw, DiskMap};
pub use body::{Body, Fixed};
pub use classify::{Classification, classify};
pub use contact::Contact;
pub use delassus::Delassus;
pub use error::Error;
pub use law::{CollisionLaw, StrictLaw, reflect};
pub use pair::{Collision, Pair, Velocities};
pub use roughness::{LOST_DIRECTION, RoughSubspace, Roughness};
pub use tangent_space::TangentSpace;
pub use through::{AnyLaw, Through};
pub use twist::{TangentVector, Twist};

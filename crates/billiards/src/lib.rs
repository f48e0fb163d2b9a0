//! Billiards with any collision law: the engine, phase space, observers, ensembles.
//!
//! A particle flies freely to the wall of its table, where a collision law changes its velocity and its spin. Everything is generic, so
//! that a scene carries only what it needs:
//!
//! * [`Orbit`]: position, velocity, as many components of spin as the law needs, what keeps the energy
//!   ([`Conserved`] or [`Free`]), and what is tracked along the path ([`Clock`], [`Angle`], [`Cell`], or nothing).
//! * [`Billiard`]: walls and a law; [`run()`] is the loop, [`run_side_by_side`] the same for many orbits in the lanes of
//!   vector registers, with the same bits. [`Planar`] and [`Spatial`] choose the fastest walls for a table;
//!   [`WithMotion`] is for your own loops on these.
//! * [`laws`]: laws of [`collision_laws`] as the loop applies them; [`laws::Custom`] runs any of them, yours included.
//! * [`observe`]: measurements that watch a run, alone or several together, and may stop it.
//! * [`Horizon`]: how far rounding leaves digits of an orbit.
//! * [`ReducedState`]: arc length, spin and tangential velocity; the billiard map and its inverse.
//! * [`Ensemble`] and [`Starts`]: many orbits on the canonical measure, the same whatever the number of threads.
//!
//! The crates that your own laws, walls, tracks and observers need are re-exported, in the versions that this crate uses:
//! [`collision_laws`], [`geometry`], [`lanes`] and [`nalgebra`]. (Four names occur twice: [`Planar`] and [`Spatial`] are not the bodies
//! [`collision_laws::bodies::Planar`] and [`collision_laws::bodies::Spatial`], and [`Collision`] and [`Error`] are not those of
//! [`collision_laws`].)
//!
//! Each combination of law, keeper, track and observer is compiled for every kind of walls: in a crate with many of them, `opt-level = 0`
//! under `[profile.dev]`, and 2 under `[profile.dev.package."*"]`, turns minutes of compile time into seconds.
//!
//! The scaled spin is `v₀ = γ R θ̇`, so that the energy is `(m/2)(|v|² + v₀²)`; normals point into the table.
#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::print_stdout))]

mod billiard;
mod bounce;
mod creep;
mod energy;
mod ensemble;
mod error;
mod horizon;
mod in_lanes;
pub mod laws;
mod limit;
mod merge;
pub mod observe;
mod orbit;
mod planar;
mod recurring;
mod reduced;
mod reverse;
mod rolling;
mod run;
mod side_by_side;
mod spatial;
mod start;
mod stop;
mod track;
mod with_motion;

pub use billiard::{BallLaw, Billiard, Motion};
pub use bounce::Bounce;
pub use collision_laws;
pub use energy::{Arrived, BEAT, Conserved, EnergyKeeper, Free, Keeping};
pub use ensemble::Ensemble;
pub use error::Error;
pub use geometry;
pub use horizon::{Bend, Felt, Horizon};
pub use in_lanes::InLanes;
pub use lanes;
pub use limit::{Collisions, LaneLimit, Limit, Time};
pub use merge::Merge;
pub use nalgebra;
pub use observe::{Collision, Observer};
pub use orbit::Orbit;
pub use planar::Planar;
pub use recurring::Recurring;
pub use reduced::ReducedState;
pub use reverse::reverse;
pub use rolling::{Frame, Rolling};
pub use run::run;
pub use side_by_side::{Finished, SEATS, run_side_by_side};
pub use spatial::Spatial;
pub use start::{Canonical, CanonicalSpatial, Grid, Start, Starts};
pub use stop::{Outcome, Stop};
pub use track::{Angle, Cell, Clock, InCell, Timed, Timing, Track, Tracking, Turned};
pub use with_motion::{OnWalls, WithMotion};

#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;

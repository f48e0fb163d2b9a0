//! Billiards with any collision law.
#![cfg_attr(not(test), warn(clippy::unwrap_used, clippy::print_stdout))]

mod billiard;
mod energy;
mod ensemble;
mod error;
pub mod laws;
mod merge;
pub mod observe;
mod orbit;
mod planar;
mod reduced;
mod reverse;
mod run;
mod side_by_side;
mod spatial;
mod start;
mod track;
mod tracked;

pub use billiard::{BallLaw, Billiard};
pub use collision_laws;
pub use energy::{Conserved, EnergyKeeper, Free};
pub use ensemble::Ensemble;
pub use error::Error;
pub use geometry;
pub use merge::Merge;
pub use observe::Observer;
pub use orbit::Orbit;
pub use planar::Planar;
pub use reduced::ReducedState;
pub use reverse::reverse;
pub use run::{Collision, Collisions, Limit, Outcome, Stop, Time, run};
pub use side_by_side::{Conserve, Finished, Forget, Keeping, Start, Tracking, run_side_by_side};
pub use spatial::Spatial;
pub use start::{Canonical, CanonicalSpatial, Grid, Starts};
pub use track::{LaneTrack, Angle, Cell, Clock, Timed, Track};
pub use tracked::{InCell, Turned};

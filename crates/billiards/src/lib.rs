//! Billiards with any collision law.
#![warn(clippy::unwrap_used, clippy::print_stdout)]

mod billiard;
mod energy;
pub mod laws;
pub mod observe;
mod orbit;
mod planar;
mod run;
mod track;

pub use billiard::{BallLaw, Billiard};
pub use collision_laws;
pub use energy::{Conserved, EnergyKeeper, Free};
pub use geometry;
pub use observe::Observer;
pub use orbit::Orbit;
pub use planar::Planar;
pub use run::{Collision, Collisions, Limit, Outcome, Stop, Time, run};
pub use track::{Angle, Cell, Clock, Timed, Track};

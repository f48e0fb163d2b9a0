//! The laws that are timed.

use billiards::collision_laws::laws as strict;
use billiards::laws::{Disk, RoughBall};

use crate::simulation::{PlanarLaw, SpatialLaw};

/// A collision law, for a uniform disk (γ² = 1/2) or a uniform ball (γ² = 2/5).
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Law {
    /// Contact without slip
    NoSlip,
    /// Frictionless contact
    Specular,
}

impl Law {
    /// As scenes call it.
    pub fn name(self) -> &'static str {
        match self {
            Law::NoSlip => "no-slip",
            Law::Specular => "specular",
        }
    }

    pub(crate) fn planar(self) -> PlanarLaw {
        PlanarLaw::Uniform(match self {
            Law::NoSlip => Disk::new(&strict::NoSlip, libm::sqrt(0.5)).expect("a γ in range"),
            Law::Specular => Disk::new(&strict::Specular, libm::sqrt(0.5)).expect("a γ in range"),
        })
    }

    pub(crate) fn spatial(self) -> SpatialLaw {
        match self {
            Law::NoSlip => SpatialLaw::Rough(RoughBall::no_slip(libm::sqrt(0.4)).expect("a γ in range")),
            Law::Specular => SpatialLaw::Specular,
        }
    }
}

//! What can be wrong with a table.
use thiserror::Error;

/// Why a piece or a table cannot be built.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A piece without length or a direction that is zero.
    #[error("the piece has no length: its ends coincide, or its direction is zero")]
    ZeroLength,
    /// A radius that is not positive and finite.
    #[error("the radius must be positive and finite, not {radius}")]
    Radius {
        /// The radius given.
        radius: f64,
    },
    /// An arc whose ends are not equally far from its centre.
    #[error("the ends of the arc lie {start} and {end} from its centre; they must be equally far")]
    OffCircle {
        /// Distance of the start.
        start: f64,
        /// Distance of the end, or the radius given.
        end: f64,
    },
    /// A parameter outside its range.
    #[error("{name} must be {must}, not {value}")]
    Parameter {
        /// Its name.
        name: &'static str,
        /// What it must be.
        must: &'static str,
        /// What it is.
        value: f64,
    },
}

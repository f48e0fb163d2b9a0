//! What can be wrong with what a user asks for.
use crate::Stop;
use collision_laws::DiskMap;
use thiserror::Error;

/// Why a table, a law, or the billiard that they make cannot be built or computed.
///
/// ```
/// use billiards::{Error, Planar, collision_laws::laws::Restitution, geometry::tables, laws::Disk};
///
/// fn lossy(normal: f64) -> Result<Planar<Disk>, Error> {
///     let law = Restitution::new(normal, 0.0)?; // an error of the law
///     Ok(Planar { table: tables::stadium(1.0, 1.0)?, law: Disk::new(&law, 0.5)? }) // of the table, of the disk
/// }
///
/// assert!(lossy(0.9).is_ok());
/// assert!(matches!(lossy(-2.0), Err(Error::Law(_))));
/// ```
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// Something wrong with the table.
    #[error(transparent)]
    Table(#[from] geometry::Error),
    /// Something wrong with a body or its law.
    #[error(transparent)]
    Law(#[from] collision_laws::Error),
    /// A parameter of a ball that is out of range.
    #[error("the {quantity} of the ball must be {must}, not {value:?}")]
    Ball {
        /// What was given.
        quantity: &'static str,
        /// What it must be.
        must: &'static str,
        /// What it is.
        value: f64,
    },
    /// A law for a disk that does not come from an impulse at the contact.
    #[error(
        "the law does not come from an impulse at the contact of a disk with γ = {gamma:?}: the scaled spin must change by −1/γ times the change of the tangential velocity, which it does not under {map:?}"
    )]
    NoContactImpulse {
        /// What the law does to the disk.
        map: DiskMap,
        /// The disk's mass distribution parameter.
        gamma: f64,
    },
    /// A speed that is not positive and finite.
    #[error("the speed must be positive and finite, not {speed:?}")]
    Speed {
        /// The speed given.
        speed: f64,
    },
    /// A velocity or spin that is not finite.
    #[error("the {quantity} {value:?} must be finite")]
    NotFinite {
        /// Which.
        quantity: &'static str,
        /// What was given.
        value: Vec<f64>,
    },
    /// A start that is not in the table.
    #[error("the position {position:?} does not lie in the table")]
    Outside {
        /// The position given.
        position: Vec<f64>,
    },
    /// A piece that the table does not have.
    #[error("the table has no piece {piece}; it has {pieces}, counted from 0")]
    Piece {
        /// The number given.
        piece: usize,
        /// How many there are.
        pieces: usize,
    },
    /// An arc length beyond the ends of a piece.
    #[error("piece {piece} has no point at arc length {s:?}: it runs from {from:?} to {to:?}")]
    ArcLength {
        /// Number of the piece.
        piece: usize,
        /// The arc length given.
        s: f64,
        /// That of its start.
        from: f64,
        /// That of its end.
        to: f64,
    },
    /// Tangential velocities that leave nothing for the normal one.
    #[error(
        "(v0, v·t) = ({v0:?}, {vt:?}) does not lie inside the disk whose radius is the speed, {speed:?}: no normal velocity is left to leave the wall with"
    )]
    Tangential {
        /// Scaled spin.
        v0: f64,
        /// Tangential velocity.
        vt: f64,
        /// Speed, spin included.
        speed: f64,
    },
    /// A law that has no time reversal, because it is not an involution.
    #[error(
        "the law is not an involution: applied twice it changes the velocity by {defect:e} times the speed, so it has no time reversal"
    )]
    Irreversible {
        /// By how much, as a fraction of the speed.
        defect: f64,
    },
    /// A step of the billiard map that ends before the next collision.
    #[error("the orbit ends before the next collision: {}", stop.name())]
    Ended {
        /// Why.
        stop: Stop,
    },
    /// A grid without cells.
    #[error("a grid needs at least one cell in each direction, and fewer than 2^63 in all")]
    Grid,
}

/// # Errors
/// [`Error::NotFinite`] unless all components are finite.
pub(crate) fn finite(quantity: &'static str, value: &[f64]) -> Result<(), Error> {
    if value.iter().all(|x| x.is_finite()) { Ok(()) } else { Err(Error::NotFinite { quantity, value: value.to_vec() }) }
}

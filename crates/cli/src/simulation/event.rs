//! The data of a collision that is recorded or drawn.

/// A collision in the user's units. In the plane only the first two components of vectors count, and the first of the
/// spin.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Event {
    /// Number of the orbit, from 0.
    pub(crate) orbit: u64,
    /// Its number, from 1.
    pub(crate) n: u64,
    /// Time since the start.
    pub(crate) time: f64,
    /// The piece hit, as the user numbers them.
    pub(crate) piece: u64,
    /// Centre of the particle.
    pub(crate) position: [f64; 3],
    /// Velocity after the collision.
    pub(crate) velocity: [f64; 3],
    /// Scaled spin after the collision.
    pub(crate) spin: [f64; 3],
    /// Scaled spin position x0.
    pub(crate) angle: f64,
    /// Accumulated translation, in lattice vectors.
    pub(crate) cell: [f64; 2],
}

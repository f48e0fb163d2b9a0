//! The flight that ended in a collision: an observer is called after it, when the velocity of the flight is gone.
use crate::orbit::Orbit;

/// Remembers the velocity and the spin with which the next flight starts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flight<const N: usize, const S: usize> {
    /// Velocity during the flight.
    pub(super) velocity: [f64; N],
    /// Spin during the flight.
    pub(super) spin: [f64; S],
}

impl<const N: usize, const S: usize> Flight<N, S> {
    /// The flight that begins where the orbit is.
    #[inline]
    pub(super) fn from<K, T>(orbit: &Orbit<f64, N, S, K, T>) -> Self {
        Flight { velocity: orbit.velocity, spin: orbit.spin }
    }
}

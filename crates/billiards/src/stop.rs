//! Why an orbit ends.
use crate::energy::taxicab;
use lanes::{Lane, dot};

/// Why an orbit ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stop {
    /// The limit was reached.
    Finished,
    /// An observer had seen enough of an orbit that could go on. If the collision that it saw last ends the orbit, that is reported
    /// instead.
    Observer,
    /// The path ends in a corner, where no normal is defined.
    Corner,
    /// The ball leaves the wall so flat that the next flight cannot be told from rounding.
    Grazing,
    /// The path meets no wall any more.
    Escaped,
    /// Many collisions without any progress: the end of a cusp. Or the particle has all but stopped, under a law that takes energy from
    /// it.
    Stalled,
    /// A law has left a velocity that is not a number, or one so large that its square is infinite.
    NotFinite,
    /// A law has left the ball moving into the wall.
    IntoWall,
}

impl Stop {
    /// The word for it in summaries.
    pub fn name(self) -> &'static str {
        match self {
            Stop::Finished => "finished",
            Stop::Observer => "observer",
            Stop::Corner => "corner",
            Stop::Grazing => "grazing",
            Stop::Escaped => "escaped",
            Stop::Stalled => "stalled",
            Stop::NotFinite => "not finite",
            Stop::IntoWall => "into the wall",
        }
    }
}

/// How a run ended: why, and after how many collisions. The orbit holds the state right after the last of these, or that of the
/// start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Why.
    pub stop: Stop,
    /// Collisions made.
    pub collisions: u64,
}

/// An orbit ends after this many consecutive flights of zero length: two curves that touch can hold a particle for ever.
///
/// A compromise: a specular particle that is within rounding of the place where two walls meet at an angle `α` hits them up to `π/α` times
/// before it gets away, so 64 lets it out of all angles above 3°; more would only prolong orbits that never get away.
pub(crate) const MOST_IDLE: u32 = 64;

/// A normal speed up to this fraction of the speed (in the [`taxicab`] norm) cannot be told from rounding.
pub(crate) const GRAZING: f64 = f64::EPSILON;

/// Rounding under a law may leave a normal speed of up to this fraction of the speeds before and after: the normal component is a sum of
/// products, is subtracted, and computed again, each time rounded.
pub(crate) const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// A normal speed below 0 by more than this fraction of the speed means that a law lets the ball into the wall: less may be rounding,
/// even where the law has left no more than 10⁻⁷ of the speed.
const INWARDS: f64 = 1.0 / 8_388_608.0; // 2⁻²³

/// The square of a normal speed of this has lost its digits.
pub(crate) const LEAST: f64 = 1e-154;

/// Whether the square of the speed has lost its digits.
#[inline(always)]
pub(crate) fn has_stalled<F: Lane, const N: usize>(velocity: &[F; N]) -> F::Mask {
    dot(velocity, velocity).lt(velocity[0].same(f64::MIN_POSITIVE))
}

/// Why an orbit of this velocity ends: `why`, unless the velocity is not a number or has stalled.
pub(crate) fn ended<const N: usize>(velocity: &[f64; N], why: Stop) -> Stop {
    if !dot(velocity, velocity).is_finite() {
        Stop::NotFinite
    } else if has_stalled(velocity) {
        Stop::Stalled
    } else {
        why
    }
}

/// Why an orbit of this velocity does not get away from a wall that it leaves with this normal speed.
pub(crate) fn stays<const N: usize>(velocity: &[f64; N], leaving: f64) -> Stop {
    let leaves_inwards = leaving < -INWARDS * taxicab(velocity);
    ended(velocity, if leaves_inwards { Stop::IntoWall } else { Stop::Grazing })
}

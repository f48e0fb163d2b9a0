//! Measurements: one per file. The engine calls an observer, which looks and may stop the run.
mod density;
mod each_orbit;
mod energy_drift;
mod first_return;
mod flight;
mod free_path;
mod in_lanes;
mod invariant;
mod moments;
mod nearest;
mod period;
mod record;
mod reduced_portrait;
mod survival;
mod velocity_portrait;
mod watch;

pub use density::{Density, Noted};
pub use each_orbit::EachOrbit;
pub use energy_drift::EnergyDrift;
pub use first_return::{Entry, FirstReturn};
pub use free_path::{FreePath, mean_free_time};
pub use in_lanes::LaneObserver;
pub use invariant::Invariant;
pub use moments::{Mean, Moments};
pub use nearest::Nearest;
pub use period::{Period, Return};
pub use record::{PlanarRow, Record, SpatialRow};
pub use reduced_portrait::ReducedPortrait;
pub use survival::Survival;
pub use velocity_portrait::VelocityPortrait;
pub use watch::Watch;

use crate::orbit::Orbit;
use core::ops::ControlFlow;
use geometry::WallHit;

/// A collision that has just happened, as an observer sees it.
#[derive(Debug)]
pub struct Collision<'a, const N: usize, const S: usize, K, T> {
    /// Its number, from 1.
    pub n: u64,
    /// Where it was.
    pub hit: &'a WallHit<f64, N>,
    /// The state right after it.
    pub orbit: &'a Orbit<f64, N, S, K, T>,
}

impl<const N: usize, const S: usize, K, T> Collision<'_, N, S, K, T> {
    /// Number of the piece hit.
    pub fn piece(&self) -> usize {
        self.hit.number()
    }
}

/// Watches a run. ([`Watch`] makes an observer of a function.)
///
/// ```
/// use billiards::{Collision, Collisions, Observer, Orbit, Planar, Stop, geometry::tables, laws::Specular};
/// use std::ops::ControlFlow;
///
/// /// Waits for so many flights that take longer than 1.
/// struct Wait(u64);
/// impl<K, T> Observer<2, 1, K, T> for Wait {
///     fn collision(&mut self, collision: &Collision<'_, 2, 1, K, T>) -> ControlFlow<()> {
///         self.0 -= u64::from(collision.hit.time > 1.0);
///         if self.0 == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
///     }
/// }
/// let strip = Planar { table: tables::strip(1.0)?, law: Specular };
/// let mut orbit = Orbit::<f64, 2, 1>::new([0.0, 0.5], [0.6, 0.8], [0.0], ());
/// let outcome = strip.run(&mut orbit, &Collisions(100), &mut Wait(3));
/// assert_eq!((outcome.stop, outcome.collisions), (Stop::Observer, 4)); // only the first takes half of 1.25
/// # Ok::<(), billiards::Error>(())
/// ```
pub trait Observer<const N: usize, const S: usize, K, T> {
    /// A collision has just happened. `Break` ends the orbit, as [`Stop::Observer`](crate::Stop::Observer) if it could go on.
    fn collision(&mut self, collision: &Collision<'_, N, S, K, T>) -> ControlFlow<()>;
    /// Whether it looks at the orbit: if no observer does, the orbit is written down only at the end, and before that may be that of an
    /// earlier collision.
    #[inline(always)]
    fn looks(&self) -> bool {
        true
    }
}

/// No observer: costs nothing.
impl<const N: usize, const S: usize, K, T> Observer<N, S, K, T> for () {
    #[inline(always)]
    fn collision(&mut self, _: &Collision<'_, N, S, K, T>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
    #[inline(always)]
    fn looks(&self) -> bool {
        false
    }
}

/// Two observers see the same run, which ends when either has seen enough.
impl<const N: usize, const S: usize, K, T, A: Observer<N, S, K, T>, B: Observer<N, S, K, T>> Observer<N, S, K, T>
    for (A, B)
{
    #[inline(always)]
    fn collision(&mut self, collision: &Collision<'_, N, S, K, T>) -> ControlFlow<()> {
        let first = self.0.collision(collision);
        self.1.collision(collision)?;
        first
    }
    #[inline(always)]
    fn looks(&self) -> bool {
        self.0.looks() || self.1.looks()
    }
}

/// Three observers see the same run, as two do. More than three nest, as in `((a, b), (c, d))`.
impl<const N: usize, const S: usize, K, T, A, B, C> Observer<N, S, K, T> for (A, B, C)
where
    A: Observer<N, S, K, T>,
    B: Observer<N, S, K, T>,
    C: Observer<N, S, K, T>,
{
    #[inline(always)]
    fn collision(&mut self, collision: &Collision<'_, N, S, K, T>) -> ControlFlow<()> {
        (&mut self.0, (&mut self.1, &mut self.2)).collision(collision)
    }
    #[inline(always)]
    fn looks(&self) -> bool {
        self.0.looks() || self.1.looks() || self.2.looks()
    }
}

/// A borrowed observer, or one of several types: `&mut dyn Observer<N, S, K, T>`.
impl<const N: usize, const S: usize, K, T, O: Observer<N, S, K, T> + ?Sized> Observer<N, S, K, T> for &mut O {
    #[inline(always)]
    fn collision(&mut self, collision: &Collision<'_, N, S, K, T>) -> ControlFlow<()> {
        (**self).collision(collision)
    }
    #[inline(always)]
    fn looks(&self) -> bool {
        (**self).looks()
    }
}

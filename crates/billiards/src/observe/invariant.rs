//! Whether a quantity is conserved.
use super::{Collision, Observer, energy_drift::larger};
use crate::merge::Merge;
use core::{fmt, ops::ControlFlow};

/// How far a quantity of your own strays from its value at the first collision of an orbit: the largest and the mean square drift.
///
/// ```
/// use billiards::{Collision, Collisions, Conserved, Orbit, Planar, laws::Disk};
/// use billiards::{collision_laws::laws::Specular, geometry::tables, observe::Invariant};
///
/// // angular momentum about the centre of a circle
/// let circle = Planar { table: tables::circle(1.0)?, law: Disk::new(&Specular, 0.5_f64.sqrt())? };
/// let mut momentum = Invariant::new(|c: &Collision<'_, 2, 1, _, _>| {
///     let ([x1, x2], [v1, v2]) = (c.orbit.position, c.orbit.velocity);
///     x1 * v2 - x2 * v1
/// });
/// let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>>::new([0.1, 0.2], [0.6, 0.3], [0.4], ());
/// circle.run(&mut orbit, &Collisions(10_000), &mut momentum);
/// assert!(momentum.largest_drift() < 1e-12);
/// # Ok::<(), billiards::Error>(())
/// ```
#[derive(Clone)]
pub struct Invariant<F> {
    quantity: F,
    reference: Option<f64>,
    scale: Option<f64>,
    largest: f64,
    squares: f64,
    count: u64,
}

impl<F> Invariant<F> {
    /// The drift of `quantity`, relative to the size of its value at the first collision.
    pub fn new<const N: usize, const S: usize, K, T>(quantity: F) -> Self
    where
        F: FnMut(&Collision<'_, N, S, K, T>) -> f64,
    {
        Invariant { quantity, reference: None, scale: None, largest: 0.0, squares: 0.0, count: 0 }
    }

    /// The same relative to `scale`, in the units of the quantity: for one whose value may be 0.
    #[must_use]
    pub fn relative_to(self, scale: f64) -> Self {
        Invariant { scale: Some(scale), ..self }
    }

    /// The largest relative drift.
    pub fn largest_drift(&self) -> f64 {
        self.largest
    }

    /// The root of the mean square of the relative drift, over all collisions but the first of each orbit.
    pub fn rms_drift(&self) -> f64 {
        if self.count == 0 { 0.0 } else { (self.squares / self.count as f64).sqrt() }
    }
}

impl<F> fmt::Debug for Invariant<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Invariant")
            .field("largest", &self.largest)
            .field("rms", &self.rms_drift())
            .finish_non_exhaustive()
    }
}

impl<K, T, F, const N: usize, const S: usize> Observer<N, S, K, T> for Invariant<F>
where
    F: FnMut(&Collision<'_, N, S, K, T>) -> f64,
{
    #[inline]
    fn collision(&mut self, c: &Collision<'_, N, S, K, T>) -> ControlFlow<()> {
        let now = (self.quantity)(c);
        let Some(reference) = self.reference else {
            self.reference = Some(now);
            return ControlFlow::Continue(());
        };
        let drift = (now - reference) / self.scale.unwrap_or(reference.abs());
        self.largest = larger(self.largest, drift.abs());
        self.squares += drift * drift;
        self.count += 1;
        ControlFlow::Continue(())
    }
}

/// The first collision of the [next orbit](Merge::next_orbit) gives a new reference value; the drifts seen stay.
impl<F> Merge for Invariant<F> {
    fn merge(self, other: Self) -> Self {
        Invariant {
            largest: larger(self.largest, other.largest),
            squares: self.squares + other.squares,
            count: self.count + other.count,
            ..self
        }
    }
    fn next_orbit(&mut self) {
        self.reference = None;
    }
}

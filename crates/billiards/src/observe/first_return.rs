//! When an orbit first enters a set.
use super::{Collision, Observer};
use core::{fmt, ops::ControlFlow};
use lanes::Double;

/// Stops an orbit at the first collision whose outcome lies in a set: a return to where it came from, or an escape through
/// a hole in the wall.
///
/// It watches one orbit, in one run or several. In an [`Ensemble`](crate::Ensemble) give each orbit its own, and merge the list of what
/// they have [found](FirstReturn::found).
///
/// ```
/// use billiards::{Collision, Collisions, Conserved, Orbit, Planar, Stop, laws::Specular};
/// use billiards::{geometry::tables, observe::FirstReturn};
///
/// // a hole in the floor of the unit square, 1/4 < x₁ < 3/4
/// let square = Planar { table: tables::square(1.0)?, law: Specular };
/// let mut hole = FirstReturn::to(|c: &Collision<'_, 2, 1, _, _>| {
///     c.piece() == 0 && (c.orbit.position[0] - 0.5).abs() < 0.25
/// });
/// let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>>::new([0.0, 0.5], [0.25, 1.0], [0.0], ());
/// assert_eq!(square.run(&mut orbit, &Collisions(100), &mut hole).stop, Stop::Observer);
/// assert_eq!(hole.found().map(|entry| (entry.collisions, entry.time)), Some((2, 1.5)));
/// # Ok::<(), billiards::geometry::Error>(())
/// ```
#[derive(Clone)]
pub struct FirstReturn<F> {
    is_in: F,
    collisions: u64,
    time: Double,
    found: Option<Entry>,
}

/// When an orbit entered a set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// The number of the collision, from 1, of those seen in one run or several.
    pub collisions: u64,
    /// The time from the start of the first of these runs \[T\].
    pub time: f64,
}

impl<F> FirstReturn<F> {
    /// Waits for the first collision for which `is_in` is true.
    pub fn to<const N: usize, const S: usize, K, T>(is_in: F) -> Self
    where
        F: FnMut(&Collision<'_, N, S, K, T>) -> bool,
    {
        FirstReturn { is_in, collisions: 0, time: Double::new(0.0), found: None }
    }

    /// When the orbit entered the set for the first time, if it did.
    pub fn found(&self) -> Option<Entry> {
        self.found
    }
}

impl<F> fmt::Debug for FirstReturn<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FirstReturn").field("found", &self.found).finish_non_exhaustive()
    }
}

impl<K, T, F, const N: usize, const S: usize> Observer<N, S, K, T> for FirstReturn<F>
where
    F: FnMut(&Collision<'_, N, S, K, T>) -> bool,
{
    #[inline]
    fn collision(&mut self, c: &Collision<'_, N, S, K, T>) -> ControlFlow<()> {
        self.collisions += 1;
        self.time.add(c.hit.time);
        if (self.is_in)(c) {
            self.found.get_or_insert(Entry { collisions: self.collisions, time: self.time.value() });
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

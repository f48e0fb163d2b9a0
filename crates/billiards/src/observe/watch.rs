//! A function as an observer.
use super::{Collision, Observer};
use core::{fmt, ops::ControlFlow};

/// Calls a function for each collision: the shortest way to a measurement of your own.
///
/// ```
/// use billiards::{Collision, Collisions, Conserved, Orbit, Planar, laws::Specular, observe::Watch};
/// use billiards::geometry::tables;
/// use std::ops::ControlFlow;
///
/// let square = Planar { table: tables::square(1.0)?, law: Specular };
/// let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>>::new([0.0, 0.5], [0.25, 1.0], [0.0], ());
/// let mut sides = vec![];
/// square.run(&mut orbit, &Collisions(5), &mut Watch::new(|c: &Collision<'_, 2, 1, _, _>| {
///     sides.push(c.piece());
///     ControlFlow::Continue(())
/// }));
/// assert_eq!(sides, [2, 0, 2, 0, 1]);
/// # Ok::<(), billiards::geometry::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Watch<F>(F);

impl<F> Watch<F> {
    /// An observer that calls `look` for each collision.
    pub fn new<const N: usize, const S: usize, K, T>(look: F) -> Self
    where
        F: FnMut(&Collision<'_, N, S, K, T>) -> ControlFlow<()>,
    {
        Watch(look)
    }
}

impl<F> fmt::Debug for Watch<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Watch")
    }
}

impl<K, T, F, const N: usize, const S: usize> Observer<N, S, K, T> for Watch<F>
where
    F: FnMut(&Collision<'_, N, S, K, T>) -> ControlFlow<()>,
{
    #[inline]
    fn collision(&mut self, collision: &Collision<'_, N, S, K, T>) -> ControlFlow<()> {
        (self.0)(collision)
    }
}

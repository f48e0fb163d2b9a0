//! Statistics of many orbits, made from those of parts of them.

/// Something measured on some orbits that can be put together with the same thing measured on others.
///
/// Counts and extremes merge exactly, in any order. Sums and means are rounded, each block in the order of its orbits, and an
/// [`Ensemble`](crate::Ensemble) merges in the order of the blocks, so its results are the same on any number of threads.
pub trait Merge {
    /// What was measured here and there together; `other` comes after `self`.
    #[must_use]
    fn merge(self, other: Self) -> Self;

    /// The orbit that was watched is over, and another begins: what goes on from collision to collision ends here.
    ///
    /// An [`Ensemble`](crate::Ensemble) says so before each orbit. What is put together of several measurements passes it on.
    fn next_orbit(&mut self) {}
}

impl Merge for () {
    fn merge(self, (): ()) {}
}

/// A count.
impl Merge for u64 {
    fn merge(self, other: u64) -> u64 {
        self + other
    }
}

/// A list: what was found here, then what was found there.
impl<T> Merge for Vec<T> {
    fn merge(mut self, mut other: Vec<T>) -> Vec<T> {
        self.append(&mut other);
        self
    }
}

impl<A: Merge, B: Merge> Merge for (A, B) {
    fn merge(self, other: (A, B)) -> (A, B) {
        (self.0.merge(other.0), self.1.merge(other.1))
    }
    fn next_orbit(&mut self) {
        self.0.next_orbit();
        self.1.next_orbit();
    }
}

//! Statistics of many orbits, made from those of parts of them.
use std::collections::BTreeMap;

/// Something measured on some orbits that can be put together with the same thing measured on others.
///
/// Counts and extremes merge exactly, in any order. Sums and means are rounded, each block in the order of its orbits, and an
/// [`Ensemble`](crate::Ensemble) merges in the order of the blocks, so its results are the same on any number of threads.
///
/// ```
/// use billiards::{Canonical, Collision, Collisions, Ensemble, Merge, Observer, Orbit, Planar, Starts};
/// use billiards::{geometry::tables, laws::Specular};
/// use std::ops::ControlFlow;
///
/// /// Collisions, and how many of them hit the same piece as the one before.
/// #[derive(Default)]
/// struct Repeats {
///     collisions: u64,
///     same: u64,
///     last: Option<usize>,
/// }
/// impl<K, T> Observer<2, 1, K, T> for Repeats {
///     fn collision(&mut self, collision: &Collision<'_, 2, 1, K, T>) -> ControlFlow<()> {
///         self.collisions += 1;
///         self.same += u64::from(self.last.replace(collision.piece()) == Some(collision.piece()));
///         ControlFlow::Continue(())
///     }
/// }
/// impl Merge for Repeats {
///     fn merge(self, other: Repeats) -> Repeats {
///         Repeats { collisions: self.collisions + other.collisions, same: self.same + other.same, ..self }
///     }
///     fn next_orbit(&mut self) {
///         self.last = None;
///     }
/// }
/// let square = Planar { table: tables::square(1.0)?, law: Specular };
/// let canonical = Canonical::new(&square.table, 1.0, 1)?;
/// let seen = Ensemble::of(1000).run(Repeats::default, |i, seen| {
///     let mut orbit: Orbit<f64, 2, 1> = canonical.start(i).orbit(());
///     square.run(&mut orbit, &Collisions(10), seen);
/// });
/// assert_eq!((seen.collisions, seen.same), (10_000, 0)); // no orbit hits a straight side twice in a row
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Merge {
    /// The combination of what was measured here and there; `other` comes after `self`.
    #[must_use]
    fn merge(self, other: Self) -> Self;

    /// The orbit that was watched is over, and another begins: what is carried from collision to collision ends here.
    ///
    /// An [`Ensemble`](crate::Ensemble) calls this before each orbit. Combinations of measurements pass it on.
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

/// Statistics by name, each merged with that of the same name: how many orbits ended for which reason, say.
///
/// ```
/// use billiards::{Canonical, Collision, Collisions, Ensemble, Orbit, Planar, Starts, Stop};
/// use billiards::{geometry::tables, laws::Specular, observe::FirstReturn};
/// use std::collections::BTreeMap;
///
/// // a hole in the whole floor of the unit square: in a hundred collisions all find it but those that fly nearly level
/// let square = Planar { table: tables::square(1.0)?, law: Specular };
/// let canonical = Canonical::new(&square.table, 1.0, 1)?;
/// let stops = Ensemble::of(1000).run(BTreeMap::new, |i, stops: &mut BTreeMap<Stop, u64>| {
///     let mut floor = FirstReturn::to(|c: &Collision<'_, 2, 1, _, _>| c.piece() == 0);
///     let mut orbit: Orbit<f64, 2, 1> = canonical.start(i).orbit(());
///     let outcome = square.run(&mut orbit, &Collisions(100), &mut floor);
///     *stops.entry(outcome.stop).or_default() += 1;
/// });
/// assert_eq!(stops.values().sum::<u64>(), 1000);
/// assert!(stops[&Stop::Observer] > 950);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl<N: Ord, M: Merge> Merge for BTreeMap<N, M> {
    fn merge(mut self, other: BTreeMap<N, M>) -> BTreeMap<N, M> {
        for (name, there) in other {
            let both = match self.remove(&name) {
                Some(here) => here.merge(there),
                None => there,
            };
            self.insert(name, both);
        }
        self
    }
    fn next_orbit(&mut self) {
        self.values_mut().for_each(Merge::next_orbit);
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

/// More than three nest, as in `((a, b), (c, d))`.
impl<A: Merge, B: Merge, C: Merge> Merge for (A, B, C) {
    fn merge(self, other: (A, B, C)) -> (A, B, C) {
        (self.0.merge(other.0), self.1.merge(other.1), self.2.merge(other.2))
    }
    fn next_orbit(&mut self) {
        self.0.next_orbit();
        self.1.next_orbit();
        self.2.next_orbit();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether the next orbit was announced, and what was seen, in its order.
    #[derive(Debug, PartialEq)]
    struct Seen(bool, Vec<u8>);

    impl Merge for Seen {
        fn merge(self, other: Self) -> Self {
            Seen(self.0, self.1.merge(other.1))
        }
        fn next_orbit(&mut self) {
            self.0 = true;
        }
    }

    fn seen(what: u8) -> Seen {
        Seen(false, vec![what])
    }

    #[test]
    fn each_of_three_is_merged_with_its_own_and_told_of_the_next_orbit() {
        let mut three = (seen(1), seen(2), seen(3)).merge((seen(4), seen(5), seen(6)));
        three.next_orbit();
        assert_eq!(three, (Seen(true, vec![1, 4]), Seen(true, vec![2, 5]), Seen(true, vec![3, 6])));
    }

    #[test]
    fn what_has_a_name_is_merged_with_what_has_the_same_in_order_and_told_of_the_next_orbit() {
        let named = |all: &[(char, u8)]| -> BTreeMap<char, Seen> { all.iter().map(|(n, x)| (*n, seen(*x))).collect() };
        let mut merged = named(&[('a', 1), ('b', 2)]).merge(named(&[('b', 3), ('c', 4)]));
        merged.next_orbit();
        let all: Vec<_> = merged.into_iter().collect();
        assert_eq!(all, [('a', Seen(true, vec![1])), ('b', Seen(true, vec![2, 3])), ('c', Seen(true, vec![4]))]);
    }
}

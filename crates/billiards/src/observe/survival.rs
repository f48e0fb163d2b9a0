//! How many orbits last how long.
use crate::merge::Merge;

/// How many orbits made at least a number of collisions before they left: through an opening, to infinity, or into a set that
/// [`FirstReturn`](super::FirstReturn) watches.
///
/// ```
/// use billiards::observe::Survival;
///
/// let mut survival = Survival::at([1, 10, 100]);
/// for collisions in [3, 250, 10] {
///     survival.add(collisions);
/// }
/// assert_eq!(survival.survivors().collect::<Vec<_>>(), [(1, 3), (10, 2), (100, 1)]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Survival {
    /// In increasing order.
    ages: Vec<u64>,
    /// For each age, the orbits that reached it but not the next one.
    ended: Vec<u64>,
    orbits: u64,
}

impl Survival {
    /// Counts at these numbers of collisions.
    pub fn at(ages: impl IntoIterator<Item = u64>) -> Self {
        let mut ages: Vec<u64> = ages.into_iter().collect();
        ages.sort_unstable();
        ages.dedup();
        let ended = vec![0; ages.len()];
        Survival { ages, ended, orbits: 0 }
    }

    /// Adds an orbit that made this many collisions ([`Outcome::collisions`](crate::Outcome::collisions)) and no more. An orbit that was
    /// ended by a limit is counted correctly up to that limit.
    pub fn add(&mut self, collisions: u64) {
        self.orbits += 1;
        let reached = self.ages.partition_point(|&age| age <= collisions);
        if reached > 0 {
            self.ended[reached - 1] += 1;
        }
    }

    /// Orbits in all.
    pub fn orbits(&self) -> u64 {
        self.orbits
    }

    /// For each age, how many orbits reached it.
    pub fn survivors(&self) -> impl Iterator<Item = (u64, u64)> {
        let mut alive: u64 = self.ended.iter().sum();
        self.ages.iter().zip(&self.ended).map(move |(&age, &ended)| {
            let reached = alive;
            alive -= ended;
            (age, reached)
        })
    }
}

/// If the ages differ, the orbits of the second count at those ages of the first that they are known to have reached.
impl Merge for Survival {
    fn merge(mut self, other: Self) -> Self {
        for (&age, &ended) in other.ages.iter().zip(&other.ended) {
            let reached = self.ages.partition_point(|&own| own <= age);
            if reached > 0 {
                self.ended[reached - 1] += ended;
            }
        }
        self.orbits += other.orbits;
        self
    }
}

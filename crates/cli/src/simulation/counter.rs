//! Counts of points for a cloud.

use billiards::observe::{Density, Noted};
use lanes::Lane;

use crate::picture::Cloud;

/// Counts the points of a cloud.
#[derive(Clone, Debug)]
pub(super) struct Counter {
    density: Density,
    noted: Noted,
    /// Whether there is anything to count.
    counts: bool,
}

impl Counter {
    /// The counter of a cloud, without points.
    pub(super) fn of(cloud: &Cloud) -> Self {
        let density = cloud.counter();
        Counter { noted: Noted::new(&density), density, counts: false }
    }

    /// Begins counting in a layer, and returns it in the form that [`note`](Self::note) takes.
    pub(super) fn begin(&mut self, layer: usize) -> f64 {
        self.counts = true;
        self.density.layer(layer)
    }

    /// Notes points, in the window or near it.
    #[inline(always)]
    pub(super) fn note<F: Lane>(&mut self, point: [F; 2], layer: F, here: F::Mask) {
        let cells = self.density.cells(point, layer, here);
        self.noted.note(&mut self.density, cells);
    }

    /// Points, moved near the window where they are far from it.
    #[inline(always)]
    pub(super) fn near<F: Lane>(&self, point: [F; 2]) -> [F; 2] {
        self.density.near(point)
    }

    /// Adds what another one has counted.
    pub(super) fn add(&mut self, other: &Density) {
        self.counts = true;
        self.density.merge_in(other);
    }

    /// What it has counted, if anything.
    pub(super) fn counted(mut self) -> Option<Density> {
        self.noted.count(&mut self.density);
        // orbits that have begun may have no collision
        (self.counts && self.density.total() > 0).then_some(self.density)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture;

    #[test]
    fn what_has_begun_without_a_point_has_counted_nothing() {
        let mut counter = Counter::of(&picture::velocities());
        let layer = counter.begin(3);
        assert!(counter.clone().counted().is_none());
        counter.note([0.25, 0.5], layer, true);
        assert_eq!(counter.counted().map(|density| density.total()), Some(1));
    }
}

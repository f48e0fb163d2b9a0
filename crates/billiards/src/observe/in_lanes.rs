//! Watching many orbits side by side.
use crate::{energy::Keeping, orbit::Orbit, track::Tracking};
use geometry::WallHit;
use lanes::Lane;

/// Watches runs of many orbits side by side; see [`run_side_by_side`](crate::run_side_by_side).
///
/// It sees every collision that an [`Observer`](super::Observer) of the single orbits would see, as many at a time as the CPU has lanes,
/// those of one orbit in order. It must ignore lanes without an orbit: some are idle where there are fewer orbits than lanes.
pub trait LaneObserver<const N: usize, const S: usize, K: Keeping<N, S>, T: Tracking<N, S>> {
    /// What it knows of the orbits in the lanes of a vector.
    type View<F: Lane>;
    /// The view while no lane has an orbit.
    fn nobody<F: Lane>(&self, zero: F) -> Self::View<F>;
    /// Orbit number `index`, in the order of the starts, begins in the lane where `here` is true.
    fn begin<F: Lane>(&mut self, view: &mut Self::View<F>, here: F::Mask, index: u64, orbit: &Orbit<f64, N, S, K, T>);
    /// The orbits in some lanes have ended, and no others have taken their place.
    fn end<F: Lane>(&mut self, view: &mut Self::View<F>, here: F::Mask);
    /// A collision has just happened in every lane with an orbit.
    fn collision<F: Lane>(
        &mut self,
        view: &mut Self::View<F>,
        hit: &WallHit<F, N>,
        orbit: &Orbit<F, N, S, K::In<F>, T::In<F>>,
    );
    /// Whether it looks at the orbits: if no observer does, they are written down only when they end.
    #[inline(always)]
    fn looks(&self) -> bool {
        true
    }
}

/// No observer: costs nothing.
impl<const N: usize, const S: usize, K: Keeping<N, S>, T: Tracking<N, S>> LaneObserver<N, S, K, T> for () {
    type View<F: Lane> = ();
    fn nobody<F: Lane>(&self, _: F) {}
    fn begin<F: Lane>(&mut self, (): &mut (), _: F::Mask, _: u64, _: &Orbit<f64, N, S, K, T>) {}
    fn end<F: Lane>(&mut self, (): &mut (), _: F::Mask) {}
    #[inline(always)]
    fn collision<F: Lane>(&mut self, (): &mut (), _: &WallHit<F, N>, _: &Orbit<F, N, S, K::In<F>, T::In<F>>) {}
    #[inline(always)]
    fn looks(&self) -> bool {
        false
    }
}

/// A borrowed observer.
impl<const N: usize, const S: usize, K, T, O> LaneObserver<N, S, K, T> for &mut O
where
    K: Keeping<N, S>,
    T: Tracking<N, S>,
    O: LaneObserver<N, S, K, T>,
{
    type View<F: Lane> = O::View<F>;
    fn nobody<F: Lane>(&self, zero: F) -> Self::View<F> {
        (**self).nobody(zero)
    }
    fn begin<F: Lane>(&mut self, view: &mut Self::View<F>, here: F::Mask, index: u64, orbit: &Orbit<f64, N, S, K, T>) {
        (**self).begin(view, here, index, orbit);
    }
    fn end<F: Lane>(&mut self, view: &mut Self::View<F>, here: F::Mask) {
        (**self).end(view, here);
    }
    #[inline(always)]
    fn collision<F: Lane>(
        &mut self,
        view: &mut Self::View<F>,
        hit: &WallHit<F, N>,
        orbit: &Orbit<F, N, S, K::In<F>, T::In<F>>,
    ) {
        (**self).collision(view, hit, orbit);
    }
    #[inline(always)]
    fn looks(&self) -> bool {
        (**self).looks()
    }
}

/// Two observers see the same runs.
impl<const N: usize, const S: usize, K, T, A, B> LaneObserver<N, S, K, T> for (A, B)
where
    K: Keeping<N, S>,
    T: Tracking<N, S>,
    A: LaneObserver<N, S, K, T>,
    B: LaneObserver<N, S, K, T>,
{
    type View<F: Lane> = (A::View<F>, B::View<F>);
    fn nobody<F: Lane>(&self, zero: F) -> Self::View<F> {
        (self.0.nobody(zero), self.1.nobody(zero))
    }
    fn begin<F: Lane>(&mut self, view: &mut Self::View<F>, here: F::Mask, index: u64, orbit: &Orbit<f64, N, S, K, T>) {
        self.0.begin(&mut view.0, here, index, orbit);
        self.1.begin(&mut view.1, here, index, orbit);
    }
    fn end<F: Lane>(&mut self, view: &mut Self::View<F>, here: F::Mask) {
        self.0.end(&mut view.0, here);
        self.1.end(&mut view.1, here);
    }
    #[inline(always)]
    fn collision<F: Lane>(
        &mut self,
        view: &mut Self::View<F>,
        hit: &WallHit<F, N>,
        orbit: &Orbit<F, N, S, K::In<F>, T::In<F>>,
    ) {
        self.0.collision(&mut view.0, hit, orbit);
        self.1.collision(&mut view.1, hit, orbit);
    }
    #[inline(always)]
    fn looks(&self) -> bool {
        self.0.looks() || self.1.looks()
    }
}

//! Watching many orbits side by side.
use crate::{energy::Keeping, orbit::Orbit, track::Tracking};
use geometry::WallHit;
use lanes::Lane;

/// Watches runs of many orbits side by side; see [`run_side_by_side`](crate::run_side_by_side).
///
/// It sees every collision that an [`Observer`](super::Observer) of the single orbits would see, as many at a time as the CPU has lanes,
/// those of one orbit in order. It must ignore lanes without an orbit: some are idle where there are fewer orbits than lanes.
///
/// ```
/// use billiards::{Billiard, Collision, Collisions, Keeping, Orbit, Tracking, run, run_side_by_side};
/// use billiards::{lanes::{Lane, Mask}, laws::Specular, observe::{LaneObserver, Watch}};
/// use billiards::geometry::{WallHit, walls::Cuboid};
/// use std::ops::ControlFlow;
///
/// /// Counts flights that take longer than 1.
/// struct Long(u64);
/// impl<const S: usize, K: Keeping<2, S>, T: Tracking<2, S>> LaneObserver<2, S, K, T> for Long {
///     /// The lanes with an orbit.
///     type View<F: Lane> = F::Mask;
///     fn nobody<F: Lane>(&self, zero: F) -> F::Mask {
///         zero.never()
///     }
///     fn begin<F: Lane>(&mut self, view: &mut F::Mask, here: F::Mask, _: u64, _: &Orbit<f64, 2, S, K, T>) {
///         *view = *view | here;
///     }
///     fn end<F: Lane>(&mut self, view: &mut F::Mask, here: F::Mask) {
///         *view = *view & !here;
///     }
///     fn collision<F: Lane>(
///         &mut self,
///         view: &mut F::Mask,
///         hit: &WallHit<F, 2>,
///         _: &Orbit<F, 2, S, K::In<F>, T::In<F>>,
///     ) {
///         let long = hit.time.same(1.0).lt(hit.time) & *view;
///         self.0 += u64::from(long.bits().count_ones());
///     }
/// }
/// let rectangle = Cuboid::new([0.0, 0.0], [2.0, 1.0], [[3, 1], [0, 2]])?;
/// let billiard = Billiard { walls: &rectangle, law: &Specular };
/// let orbits = || (0..100).map(|i| Orbit::<f64, 2, 0>::new([1.0, 0.5], [1.0, 1.3 - 0.013 * f64::from(i)], [], ()));
/// let (mut long, mut alone) = (Long(0), 0);
/// run_side_by_side(&billiard, &mut orbits(), &Collisions(10), &mut long, &mut |_| {});
/// let mut watch = Watch::new(|collision: &Collision<'_, 2, 0, _, _>| {
///     alone += u64::from(collision.hit.time > 1.0);
///     ControlFlow::Continue(())
/// });
/// orbits().for_each(|mut orbit| _ = run(&billiard, &mut orbit, &Collisions(10), &mut watch));
/// assert!(alone > 0 && long.0 == alone);
/// # Ok::<(), billiards::Error>(())
/// ```
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
    /// Whether it looks at the orbits: if no observer does, they are written down only when they end, and before that may be those of
    /// earlier collisions.
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

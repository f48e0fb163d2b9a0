//! Any observer, for orbits that run side by side.
use super::{Collision, LaneObserver, Observer};
use crate::{energy::Keeping, in_lanes::InLanes, merge::Merge, orbit::Orbit, track::Tracking};
use core::{marker::PhantomData, ops::ControlFlow};
use geometry::WallHit;
use lanes::{Lane, MOST_LANES, Mask};
use std::collections::BTreeMap;

/// An [`Observer`] of its own for each of the orbits that run side by side, merged in the order of the starts.
///
/// The result is the same, to the last bit, on every CPU, and the same as if one orbit ran after another, each with an observer of its
/// own. A single observer that sees them all adds up their collisions in another order than observers that are merged: its means may
/// differ in the last bits. Several runs are merged in their order.
///
/// Each collision is taken out of its lane, which costs more than a [`LaneObserver`] made for the purpose, such as a
/// [`VelocityPortrait`](super::VelocityPortrait) that counts: with an observer as large as that for each orbit, the observers would cost
/// more than the orbits. An orbit whose observer has seen enough goes on unobserved. The observers of orbits that have ended stay in
/// memory as long as an orbit that began before them goes on.
///
/// ```
/// use billiards::{Canonical, Collisions, Conserved, Orbit, Planar, Starts, laws::Disk};
/// use billiards::{collision_laws::laws::NoSlip, geometry::tables, observe::{EachOrbit, FreePath}};
///
/// let square = Planar { table: tables::square(1.0)?, law: Disk::new(&NoSlip, 0.5_f64.sqrt())? };
/// let canonical = Canonical::new(&square.table, 1.0, 1)?;
/// let mut paths = EachOrbit::new(|_, orbit: &Orbit<f64, 2, 1, Conserved<f64, 2>>| {
///     let mut path = FreePath::new();
///     path.follow(orbit);
///     path
/// });
/// square.run_side_by_side(&mut (0..1000).map(|i| canonical.start(i).orbit(())), &Collisions(10), &mut paths, &mut |_| {});
/// let time = paths.merged().map(|paths| paths.time());
/// assert!(time.is_some_and(|time| time.count == 10_000 && (time.mean - 1.0).abs() < 0.1)); // 4A/P = 1
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// An observer that does not merge, as it tells something of one orbit, is asked for that when its orbit has ended:
///
/// ```
/// use billiards::{Canonical, Collisions, Conserved, Orbit, Planar, Starts, laws::Disk};
/// use billiards::{collision_laws::laws::NoSlip, geometry::tables, observe::{EachOrbit, Period}};
///
/// // in an equilateral triangle every orbit of a uniform disk that meets no vertex has period 4 or 6, or a divisor of them
/// let triangle = Planar { table: tables::equilateral(1.0)?, law: Disk::new(&NoSlip, 0.5_f64.sqrt())? };
/// let canonical = Canonical::new(&triangle.table, 1.0, 1)?;
/// let period = |_, _: &Orbit<f64, 2, 1, Conserved<f64, 2>>| Period::new(1e-11, 1.0);
/// let mut periods = EachOrbit::asked(period, |_, seen: Period| vec![seen.found().map(|found| found.period)]);
/// triangle.run_side_by_side(&mut (0..100).map(|i| canonical.start(i).orbit(())), &Collisions(50), &mut periods, &mut |_| {});
/// let periods: Vec<Option<u64>> = periods.merged().unwrap_or_default();
/// assert_eq!(periods.len(), 100);
/// assert!(periods.iter().all(|period| period.is_some_and(|period| 12 % period == 0)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct EachOrbit<O, M, R = O, A = fn(u64, O) -> R> {
    make: M,
    ask: A,
    /// It watches by observers of this type.
    by: PhantomData<fn() -> O>,
    /// How many orbits there were in earlier runs, and how many have begun in all.
    earlier: u64,
    begun: u64,
    /// What was seen of the orbits before number `next`, counted through all runs.
    merged: Option<R>,
    next: u64,
    /// What was seen of later ones that have ended already.
    ahead: BTreeMap<u64, R>,
}

/// The observer of the orbit in one lane.
#[derive(Debug)]
pub struct Seat<O> {
    observer: O,
    /// The number of the orbit in its run, and counted through all runs.
    index: u64,
    number: u64,
    collisions: u64,
    /// Whether it has seen enough.
    done: bool,
}

impl<O: Merge, M> EachOrbit<O, M> {
    /// The observer of orbit number `index` of a run is `make(index, orbit)`, called when that begins.
    pub fn new(make: M) -> Self {
        EachOrbit::asked(make, |_, observer| observer)
    }
}

impl<O, M, R: Merge, A: FnMut(u64, O) -> R> EachOrbit<O, M, R, A> {
    /// The same, where `ask(index, observer)` is what is merged, called when the orbit has ended.
    pub fn asked(make: M, ask: A) -> Self {
        EachOrbit { make, ask, by: PhantomData, earlier: 0, begun: 0, merged: None, next: 0, ahead: BTreeMap::new() }
    }

    /// What was seen of all orbits; `None` if there was none.
    pub fn merged(self) -> Option<R> {
        self.merged
    }

    /// An orbit has ended.
    fn take(&mut self, seat: Option<Seat<O>>) {
        let Some(Seat { observer, index, number, .. }) = seat else { return };
        self.ahead.insert(number, (self.ask)(index, observer));
        while let Some(seen) = self.ahead.remove(&self.next) {
            self.merged = Some(match self.merged.take() {
                Some(merged) => merged.merge(seen),
                None => seen,
            });
            self.next += 1;
        }
    }
}

impl<O, M, R, A, K, T, const N: usize, const S: usize> LaneObserver<N, S, K, T> for EachOrbit<O, M, R, A>
where
    O: Observer<N, S, K, T>,
    M: FnMut(u64, &Orbit<f64, N, S, K, T>) -> O,
    R: Merge,
    A: FnMut(u64, O) -> R,
    K: Keeping<N, S>,
    T: Tracking<N, S>,
{
    type View<F: Lane> = [Option<Seat<O>>; MOST_LANES];
    fn nobody<F: Lane>(&self, _: F) -> Self::View<F> {
        [const { None }; MOST_LANES]
    }
    fn begin<F: Lane>(&mut self, view: &mut Self::View<F>, here: F::Mask, index: u64, orbit: &Orbit<f64, N, S, K, T>) {
        // every run begins with its first orbit
        if index == 0 {
            self.earlier = self.begun;
        }
        let number = self.earlier + index;
        self.begun = self.begun.max(number + 1);
        for (_, seat) in view.iter_mut().enumerate().take(F::LANES).filter(|(lane, _)| here.at(*lane)) {
            let observer = (self.make)(index, orbit);
            let before = seat.replace(Seat { observer, index, number, collisions: 0, done: false });
            self.take(before);
        }
    }
    fn end<F: Lane>(&mut self, view: &mut Self::View<F>, here: F::Mask) {
        for (_, seat) in view.iter_mut().enumerate().take(F::LANES).filter(|(lane, _)| here.at(*lane)) {
            self.take(seat.take());
        }
    }
    fn collision<F: Lane>(
        &mut self,
        view: &mut Self::View<F>,
        hit: &WallHit<F, N>,
        orbit: &Orbit<F, N, S, K::In<F>, T::In<F>>,
    ) {
        for (lane, seat) in view.iter_mut().enumerate().take(F::LANES) {
            let Some(seat) = seat.as_mut().filter(|seat| !seat.done) else { continue };
            seat.collisions += 1;
            let (hit, orbit) = (hit.one(lane), orbit.one(lane));
            let seen = seat.observer.collision(&Collision { n: seat.collisions, hit: &hit, orbit: &orbit });
            seat.done = seen == ControlFlow::Break(());
        }
    }
}

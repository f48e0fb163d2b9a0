//! Many orbits side by side: the lanes of vector registers, refilled as orbits end.
use crate::{
    billiard::Motion,
    bounce::Bounce,
    energy::Keeping,
    in_lanes::InLanes,
    limit::LaneLimit,
    observe::LaneObserver,
    orbit::Orbit,
    stop::{MOST_IDLE, Outcome, Stop, ended, stays},
    track::{Track, Tracking},
    with_motion::WithMotion,
};
use lanes::{Kernel, Lane, MOST_LANES, Mask, Twin};

/// An orbit that has ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Finished<const N: usize, const S: usize, K, T> {
    /// Its number, in the order of the starts.
    pub index: u64,
    /// Its last state, from which it can go on.
    pub orbit: Orbit<f64, N, S, K, T>,
    /// How it ended.
    pub outcome: Outcome,
}

/// Runs every orbit up to a limit, as many side by side as this CPU has lanes, and hands over each one as it
/// ends (in no particular order). The observer sees all collisions; `()` costs nothing. Once the limit
/// [calls the run off](LaneLimit::is_called_off), orbits that have not begun are not handed over.
///
/// An orbit ends as it would in [`run`](crate::run()), in the same state to the last bit; its lane goes to the next one at once, so that
/// neither an early end nor a long run holds up the others.
///
/// ```
/// use billiards::{Billiard, Collisions, Orbit, laws::Specular, run, run_side_by_side};
/// use billiards::geometry::{Vector2, walls::Sphere};
///
/// let circle = Sphere::new(Vector2::zeros(), 1.0, 0)?;
/// let billiard = Billiard { walls: &circle, law: &Specular };
/// let start = |i: u64| Orbit::<f64, 2, 0>::new([0.0, 0.005 * i as f64], [1.0, 0.0], [], ());
/// let mut count = 0;
/// run_side_by_side(&billiard, &mut (0..100).map(start), &Collisions(1000), &mut (), &mut |finished| {
///     let mut alone = start(finished.index);
///     let outcome = run(&billiard, &mut alone, &Collisions(1000), &mut ());
///     assert_eq!((finished.orbit, finished.outcome), (alone, outcome));
///     count += 1;
/// });
/// assert_eq!(count, 100);
/// # Ok::<(), billiards::Error>(())
/// ```
pub fn run_side_by_side<B, const N: usize, const S: usize, K, T, L, O>(
    billiard: &B,
    orbits: &mut dyn Iterator<Item = Orbit<f64, N, S, K, T>>,
    limit: &L,
    observer: &mut O,
    finished: &mut dyn FnMut(Finished<N, S, K, T>),
) where
    B: Motion<N, S>,
    K: Keeping<N, S>,
    T: Tracking<N, S>,
    L: LaneLimit<N, S, T>,
    O: LaneObserver<N, S, K, T>,
{
    // lanes that have not been used yet hold the first orbit
    let Some(first) = orbits.next() else { return };
    lanes::dispatch(Many {
        billiard,
        orbits,
        upcoming: Some(first.clone()),
        first,
        limit,
        observer,
        finished,
        changed: false,
    });
}

struct Many<'a, B, const N: usize, const S: usize, K, T, L, O> {
    billiard: &'a B,
    orbits: &'a mut dyn Iterator<Item = Orbit<f64, N, S, K, T>>,
    /// The next of the orbits.
    upcoming: Option<Orbit<f64, N, S, K, T>>,
    first: Orbit<f64, N, S, K, T>,
    limit: &'a L,
    observer: &'a mut O,
    finished: &'a mut dyn FnMut(Finished<N, S, K, T>),
    /// Whether some lane has got another orbit since the next end was looked for.
    changed: bool,
}

/// Twins of vectors in flight at a time: enough that the divisions of one hide behind the arithmetic of the other.
const TWINS: usize = 2;
/// The same where [a step is short](Motion::IS_SHORT).
const MANY_TWINS: usize = 8;

/// The number of orbits side by side, where vectors are widest: if all starts run equally long, a multiple of it leaves no lane empty.
/// (In strips, where steps are short, there are four times as many.)
pub const SEATS: usize = TWINS * MOST_LANES;

/// A twin of vectors of orbits.
struct Group<F: Lane, const N: usize, const S: usize, K, T, C, V> {
    orbit: Orbit<F, N, S, K, T>,
    carried: C,
    /// What the observer knows of these orbits.
    view: V,
    /// The normal speed that counts as grazing.
    slow: F,
    lanes: [Seat; MOST_LANES],
    /// Whether it holds no orbit any more, and never will.
    empty: bool,
}

/// The group of a run of the motion `B` of orbits that keep the energy with `K` and track `T`, seen by `O`.
type GroupOf<F, const N: usize, const S: usize, B, K, T, O> = Group<
    F,
    N,
    S,
    <K as Keeping<N, S>>::In<F>,
    <T as Tracking<N, S>>::In<F>,
    <B as Motion<N, S>>::Carried<F>,
    <O as LaneObserver<N, S, K, T>>::View<F>,
>;

/// What a lane holds.
#[derive(Clone, Copy)]
struct Seat {
    /// The orbit's number; `None` while the lane is idle, until the next beat or because the starts have run out.
    index: Option<u64>,
    /// The step with which it ends, or the beat at which an idle lane gets its next orbit.
    until: u64,
    /// The step it began with.
    since: u64,
    /// The last step without motion, and how many of these came in a row.
    idle_at: u64,
    idle: u32,
}

impl<B, const N: usize, const S: usize, K, T, L, O> Many<'_, B, N, S, K, T, L, O>
where
    B: Motion<N, S>,
    K: Keeping<N, S>,
    T: Tracking<N, S>,
    L: LaneLimit<N, S, T>,
    O: LaneObserver<N, S, K, T>,
{
    /// Hands over the orbits of the lanes in which `ended` says why, and puts the next starts there: as soon as the energy keeper has
    /// come as far as theirs, so that each orbit has the same beats as on its own.
    #[cold]
    #[inline(never)]
    fn change<F: Lane>(
        &mut self,
        group: &mut GroupOf<F, N, S, B, K, T, O>,
        next: &mut u64,
        step: u64,
        ended: &[Option<Stop>; MOST_LANES],
    ) {
        self.changed = true;
        let zero = group.slow.same(0.0);
        let mask = |of: &[bool; MOST_LANES]| zero.lt(zero.each(|k| if of[k % MOST_LANES] { 1.0 } else { 0.0 }));
        let mut idle = [false; MOST_LANES];
        self.billiard.settle(&mut group.orbit, &group.carried);
        for lane in 0..F::LANES {
            let Some(stop) = ended[lane] else { continue };
            let seat = &mut group.lanes[lane];
            if let Some(index) = seat.index {
                let outcome = Outcome { stop, collisions: step - seat.since };
                (self.finished)(Finished { index, orbit: group.orbit.one(lane), outcome });
            } else if step < seat.until {
                continue;
            }
            *seat = Seat { index: None, until: u64::MAX, since: step, idle_at: u64::MAX, idle: 0 };
            idle[lane] = true;
            let wait = self.upcoming.as_ref().map(|next| group.orbit.wait(next));
            match (wait, self.upcoming.take()) {
                (Some(0), Some(mut orbit)) => {
                    let index = *next;
                    // the last number is that of no step: no run gets there
                    (seat.index, seat.until) = (Some(index), step.saturating_add(self.limit.most()).min(u64::MAX - 1));
                    *next += 1;
                    idle[lane] = false;
                    self.upcoming = self.orbits.next();
                    let mut here = [false; MOST_LANES];
                    here[lane] = true;
                    self.billiard.restart(&mut group.carried, mask(&here), &mut orbit);
                    self.seat(group, lane, &orbit);
                    group.orbit.track.begin(mask(&here));
                    self.observer.begin(&mut group.view, mask(&here), index, &orbit);
                }
                (Some(wait), orbit) => {
                    seat.until = step + wait;
                    self.upcoming = orbit;
                }
                (None, _) => {}
            }
        }
        if idle.contains(&true) {
            group.empty = group.lanes[..F::LANES].iter().all(|seat| seat.until == u64::MAX);
            self.observer.end(&mut group.view, mask(&idle));
        }
        // an idle lane copies an orbit that goes on: one that has just ended would be looked at in every step
        let idle = core::array::from_fn(|lane| lane < F::LANES && group.lanes[lane].index.is_none());
        let model = group.lanes.iter().take(F::LANES).position(|seat| seat.index.is_some());
        if let Some(model) = model.filter(|_| idle.contains(&true)) {
            let mut orbit = group.orbit.one(model);
            for lane in (0..F::LANES).filter(|lane| idle[*lane]) {
                self.seat(group, lane, &orbit);
            }
            self.billiard.restart(&mut group.carried, mask(&idle), &mut orbit);
        }
    }

    /// Puts an orbit into a lane: numbers in memory, for which no vectors are needed.
    fn seat<F: Lane>(&self, group: &mut GroupOf<F, N, S, B, K, T, O>, lane: usize, orbit: &Orbit<f64, N, S, K, T>) {
        group.orbit.put(lane, orbit);
        group.slow.put(lane, self.billiard.slow(&orbit.velocity, &orbit.spin));
    }

    /// One collision of every lane.
    #[inline(always)]
    fn step<F: Lane>(&mut self, group: &mut GroupOf<F, N, S, B, K, T, O>, next: &mut u64, step: u64) {
        let zero = group.slow.same(0.0);
        loop {
            let (hit, arrival) = self.billiard.flight(&group.orbit, &group.carried);
            let moves = zero.lt(hit.time) & hit.time.lt(zero.same(f64::INFINITY));
            let mut special = !moves | hit.corner;
            if let Some(beyond) = self.limit.may_be_beyond(&group.orbit.track, hit.time) {
                special = special | beyond;
            }
            if special.any() && self.look(group, hit.time, hit.corner, next, step) {
                continue;
            }
            let slides = self.billiard.collide(&mut group.orbit, &mut group.carried, &hit, &arrival, group.slow);
            if self.observer.looks() || group.orbit.track.looks() {
                self.billiard.settle(&mut group.orbit, &group.carried);
            }
            self.observer.collision(&mut group.view, &hit, &group.orbit);
            if slides.any() {
                self.slide(group, slides, next, step + 1);
            }
            return;
        }
    }

    /// Orbits that do not get away from the boundary end.
    #[cold]
    #[inline(never)]
    fn slide<F: Lane>(&mut self, group: &mut GroupOf<F, N, S, B, K, T, O>, slides: F::Mask, next: &mut u64, step: u64) {
        self.billiard.settle(&mut group.orbit, &group.carried);
        let leaving = self.billiard.leaving(&group.carried);
        let velocity = |lane: usize| group.orbit.velocity.map(|x| x.lane(lane));
        let ended = core::array::from_fn(|lane| {
            (lane < F::LANES && slides.at(lane)).then(|| stays(&velocity(lane), leaving.lane(lane)))
        });
        self.change(group, next, step, &ended);
    }

    /// Looks at a hit that is a corner, out of reach, without motion or beyond the limit somewhere; returns whether an orbit ended.
    #[cold]
    #[inline(never)]
    fn look<F: Lane>(
        &mut self,
        group: &mut GroupOf<F, N, S, B, K, T, O>,
        time: F,
        corner: F::Mask,
        next: &mut u64,
        step: u64,
    ) -> bool {
        self.billiard.settle(&mut group.orbit, &group.carried);
        let mut stops = [None; MOST_LANES];
        for (lane, stop) in stops.iter_mut().enumerate().take(F::LANES) {
            let time = time.lane(lane);
            let seat = &mut group.lanes[lane];
            if seat.index.is_none() {
                continue;
            }
            let (n, track) = (step - seat.since + 1, group.orbit.track.one(lane));
            let is_beyond = |flight: f64| self.limit.is_beyond(n, &track, flight);
            if is_beyond(time) && (time < f64::INFINITY || is_beyond(0.0)) {
                *stop = Some(Stop::Finished);
            } else if !(time < f64::INFINITY) {
                let [position, velocity] =
                    [&group.orbit.position, &group.orbit.velocity].map(|x| x.map(|x| x.lane(lane)));
                let why = self.billiard.without_hit(position, velocity);
                let is_over = why == Stop::Escaped && is_beyond(f64::INFINITY);
                *stop = Some(if is_over { Stop::Finished } else { why });
            } else if corner.at(lane) {
                *stop = Some(Stop::Corner);
            } else if !(time > 0.0) && seat.idle_at != step {
                seat.idle = if seat.idle_at == step.wrapping_sub(1) { seat.idle + 1 } else { 1 };
                seat.idle_at = step;
                if seat.idle > MOST_IDLE {
                    *stop = Some(ended(&group.orbit.velocity.map(|x| x.lane(lane)), Stop::Stalled));
                }
            }
        }
        let any = stops.iter().any(Option::is_some);
        if any {
            self.change(group, next, step, &stops);
        }
        any
    }

    /// All orbits, in lanes like those of `zero`, so many vectors of them at a time.
    #[inline(always)]
    fn all<F: Lane, const GROUPS: usize>(mut self, zero: F) {
        let mut next = 0;
        let seat = Seat { index: None, until: 0, since: 0, idle_at: u64::MAX, idle: 0 };
        let nobody = Orbit::all(&self.first, zero);
        let mut groups: [GroupOf<F, N, S, B, K, T, O>; GROUPS] = core::array::from_fn(|_| Group {
            orbit: nobody.clone(),
            carried: self.billiard.start(zero),
            view: self.observer.nobody(zero),
            slow: zero,
            lanes: [seat; MOST_LANES],
            empty: false,
        });
        for group in &mut groups {
            self.change(group, &mut next, 0, &[Some(Stop::Finished); MOST_LANES]);
        }
        let mut step = 0;
        loop {
            if self.limit.is_called_off() {
                // nobody takes the places of those that end here
                self.upcoming = None;
                for group in &mut groups {
                    self.change(group, &mut next, step, &[Some(Stop::Observer); MOST_LANES]);
                }
                break;
            }
            let until = groups.iter().flat_map(|g| &g.lanes[..F::LANES]).map(|s| s.until).min().unwrap_or(step);
            if until == u64::MAX {
                break;
            }
            // an orbit that takes the place of one that ended early may end before
            self.changed = false;
            while step < until && !self.changed && !self.limit.is_called_off() {
                for group in groups.iter_mut().filter(|group| !group.empty) {
                    self.step(group, &mut next, step);
                }
                step += 1;
            }
            for group in &mut groups {
                if group.lanes[..F::LANES].iter().any(|s| s.until == step) {
                    let ended = group.lanes.map(|s| (s.until == step).then_some(Stop::Finished));
                    self.change(group, &mut next, step, &ended);
                }
            }
        }
    }
}

impl<B, const N: usize, const S: usize, K, T, L, O> Kernel for Many<'_, B, N, S, K, T, L, O>
where
    B: Motion<N, S>,
    K: Keeping<N, S>,
    T: Tracking<N, S>,
    L: LaneLimit<N, S, T>,
    O: LaneObserver<N, S, K, T>,
{
    type Output = ();
    #[inline(always)]
    fn run<F: Lane>(self, zero: F) {
        // on a CPU whose vectors we do not know, two groups of one are enough: it has no more than 16 registers
        if const { F::LANES == 1 } {
            self.all::<F, TWINS>(zero);
        } else if const { B::IS_SHORT } {
            self.all::<Twin<F>, MANY_TWINS>(Twin::of(zero));
        } else {
            self.all::<Twin<F>, TWINS>(Twin::of(zero));
        }
    }
}

/// [`run_side_by_side`], for any motion.
pub(crate) struct ManyOn<'a, const N: usize, const S: usize, K, T, L, O> {
    pub(crate) orbits: &'a mut dyn Iterator<Item = Orbit<f64, N, S, K, T>>,
    pub(crate) limit: &'a L,
    pub(crate) observer: &'a mut O,
    pub(crate) finished: &'a mut dyn FnMut(Finished<N, S, K, T>),
}

impl<const N: usize, const S: usize, K, T, L, O> WithMotion<N, S> for ManyOn<'_, N, S, K, T, L, O>
where
    K: Keeping<N, S>,
    T: Tracking<N, S>,
    L: LaneLimit<N, S, T>,
    O: LaneObserver<N, S, K, T>,
{
    type Output = ();
    fn run<B: Motion<N, S> + Bounce<N, S>>(self, motion: &B) {
        run_side_by_side(motion, self.orbits, self.limit, self.observer, self.finished);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Billiard, Canonical, Clock, Collisions, Conserved, Limit, Rolling, Starts, Timed, laws::Disk};
    use collision_laws::laws::NoSlip;
    use geometry::{
        Table, tables,
        walls::{Cuboid, Pieces, Sphere},
    };

    type Disks = Orbit<f64, 2, 1, Conserved<f64, 2>, Clock>;

    /// How the orbits end in lanes like those of `zero`.
    fn ends<F: Lane>(billiard: &impl Motion<2, 1>, orbits: &[Disks], zero: F) -> Vec<(u64, [u64; 6], Outcome)> {
        let mut ends = vec![];
        let mut finished = |Finished { index, orbit, outcome }: Finished<2, 1, Conserved<f64, 2>, Clock>| {
            let ([x, y], [u, v], [w]) = (orbit.position, orbit.velocity, orbit.spin);
            ends.push((index, [x, y, u, v, w, orbit.track.time()].map(f64::to_bits), outcome));
        };
        let mut rest = orbits[1..].iter().copied();
        let many = Many {
            billiard,
            orbits: &mut rest,
            upcoming: Some(orbits[0]),
            first: orbits[0],
            limit: &Collisions(200),
            observer: &mut (),
            finished: &mut finished,
            changed: false,
        };
        many.run(zero);
        ends.sort_by_key(|end| end.0);
        ends
    }

    fn have_the_same_bits(table: &Table, billiard: &impl Motion<2, 1>) {
        let starts = Canonical::new(table, 1.0, 3).unwrap();
        let orbits: Vec<Disks> = (0..90).map(|k| starts.start(k).orbit(Clock::new(0.0))).collect();
        let one = 0.0;
        let (two, four) = (Twin::of(one), Twin::of(Twin::of(one)));
        let alone = ends(billiard, &orbits, one);
        assert_eq!(alone.len(), orbits.len());
        assert_eq!(ends(billiard, &orbits, two), alone);
        assert_eq!(ends(billiard, &orbits, four), alone);
        let mut widest = vec![];
        run_side_by_side(billiard, &mut orbits.iter().copied(), &Collisions(200), &mut (), &mut |end| widest.push(end));
        widest.sort_by_key(|end| end.index);
        for (end, (_, bits, outcome)) in widest.iter().zip(alone) {
            assert_eq!((end.orbit.position.map(f64::to_bits), end.outcome), ([bits[0], bits[1]], outcome));
        }
    }

    /// Is called off after some steps.
    struct CalledOff(core::cell::Cell<u64>);

    impl<T> Limit<T> for CalledOff {
        fn is_beyond(&self, n: u64, _: &T, _: f64) -> bool {
            n > 200
        }
    }

    impl LaneLimit<2, 1, Clock> for CalledOff {
        fn most(&self) -> u64 {
            200
        }
        fn is_called_off(&self) -> bool {
            self.0.set(self.0.get().saturating_sub(1));
            self.0.get() == 0
        }
    }

    #[test]
    fn orbits_of_a_run_that_is_called_off_are_where_they_would_have_been_then() {
        let law = Disk::new(&NoSlip, libm::sqrt(0.5)).unwrap();
        let walls = Cuboid::new([0.0; 2], [1.0; 2], [[0, 1], [2, 3]]).unwrap();
        let billiard = Billiard { walls: &walls, law: &law };
        let table = tables::square(1.0).unwrap();
        let starts = Canonical::new(&table, 1.0, 3).unwrap();
        let orbits: Vec<Disks> = (0..1000).map(|k| starts.start(k).orbit(Clock::new(0.0))).collect();
        for steps in [1, 2, 50, 330] {
            let mut ends = vec![];
            let limit = CalledOff(core::cell::Cell::new(steps));
            run_side_by_side(&billiard, &mut orbits.iter().copied(), &limit, &mut (), &mut |end| ends.push(end));
            assert!((1..orbits.len()).contains(&ends.len()), "after {steps} steps: {}", ends.len());
            let called_off = ends.iter().filter(|end| end.outcome.stop == Stop::Observer);
            assert!(called_off.clone().count() > 0 && called_off.clone().all(|end| end.outcome.collisions < steps));
            for Finished { index, orbit, outcome } in &ends {
                let mut alone = orbits[usize::try_from(*index).unwrap()];
                let end = crate::run(&billiard, &mut alone, &Collisions(outcome.collisions), &mut ());
                assert_eq!((end.collisions, &alone), (outcome.collisions, orbit));
            }
        }
    }

    #[test]
    fn orbits_have_the_same_bits_in_lanes_of_any_width() {
        let law = Disk::new(&NoSlip, libm::sqrt(0.5)).unwrap();
        let walls = Cuboid::new([0.0; 2], [1.0; 2], [[0, 1], [2, 3]]).unwrap();
        have_the_same_bits(&tables::square(1.0).unwrap(), &Billiard { walls: &walls, law: &law });
        let walls = Sphere::new([0.0; 2].into(), 1.0, 0).unwrap();
        have_the_same_bits(&tables::circle(1.0).unwrap(), &Rolling::new(&walls, &law));
        let mushroom = tables::mushroom(1.0, 0.5, 0.75).unwrap();
        let walls = Pieces::new(mushroom.pieces().iter().cloned().enumerate().collect(), mushroom.corners());
        have_the_same_bits(&mushroom, &Billiard { walls: &walls, law: &law });
    }
}

//! Many orbits side by side: the lanes of vector registers, refilled as orbits end.
use crate::{
    billiard::Motion,
    energy::EnergyKeeper,
    orbit::{Orbit, square_speed},
    run::{GRAZING, MOST_IDLE, Outcome, Stop},
    track::{LaneTrack, Track},
};
use core::marker::PhantomData;
use lanes::{Kernel, Lane, Mask};

/// Where an orbit starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start<const N: usize, const S: usize> {
    /// Position of the centre \[L\].
    pub position: [f64; N],
    /// Velocity of the centre [L T⁻¹].
    pub velocity: [f64; N],
    /// Scaled spin [L T⁻¹].
    pub spin: [f64; S],
}

/// An orbit that has ended.
#[derive(Clone, Debug)]
pub struct Finished<const N: usize, const S: usize, T> {
    /// Its number, in the order of the starts.
    pub index: u64,
    /// Its last state.
    pub orbit: Orbit<f64, N, S, (), T>,
    /// How it ended.
    pub outcome: Outcome,
}

/// How the energy is kept in lanes: a type per lane width.
///
/// Implemented by [`Conserve`] and [`Forget`], the two choices there are.
pub trait Keeping<const N: usize, const S: usize> {
    /// The keeper in lanes of `F`.
    type Keeper<F: Lane>: EnergyKeeper<F, N, S>;
}

/// Keep the energy ([`Conserved`](crate::Conserved)).
#[derive(Clone, Copy, Debug)]
pub enum Conserve {}
/// Leave it to the law and to rounding ([`Free`](crate::Free)).
#[derive(Clone, Copy, Debug)]
pub enum Forget {}
impl<const N: usize, const S: usize> Keeping<N, S> for Conserve {
    type Keeper<F: Lane> = crate::energy::Conserved<F, N>;
}
impl<const N: usize, const S: usize> Keeping<N, S> for Forget {
    type Keeper<F: Lane> = ();
}

/// What is tracked in lanes: a type per lane width.
pub trait Tracking<const N: usize, const S: usize> {
    /// The track in lanes of `F`.
    type In<F: Lane>: Track<F, N, S> + LaneTrack<F, One = Self::One>;
    /// The track of one orbit.
    type One: Clone;
    /// At the start.
    fn start() -> Self::One;
}

impl<const N: usize, const S: usize> Tracking<N, S> for () {
    type In<F: Lane> = ();
    type One = ();
    fn start() {}
}

impl<const N: usize, const S: usize> Tracking<N, S> for crate::track::Clock {
    type In<F: Lane> = crate::track::Clock<F>;
    type One = crate::track::Clock;
    fn start() -> Self {
        crate::track::Clock::new(0.0)
    }
}

/// Runs every start for so many collisions, as many side by side as this CPU has lanes, and hands over each orbit as
/// it ends (in no particular order).
///
/// An orbit ends as it would in [`run`](crate::run), in the same state to the last bit; its lane goes to the next
/// start at once, so that one early end or one long life holds nobody up.
pub fn run_side_by_side<P, Q, B, const N: usize, const S: usize>(
    billiard: &B,
    starts: &mut dyn Iterator<Item = Start<N, S>>,
    collisions: u64,
    finished: &mut dyn FnMut(Finished<N, S, Q::One>),
) where
    P: Keeping<N, S>,
    Q: Tracking<N, S>,
    B: Motion<N, S>,
{
    let upcoming = starts.next();
    lanes::dispatch(Many::<P, Q, _, N, S> { billiard, starts, upcoming, collisions, finished, keeping: PhantomData });
}

struct Many<'a, P, Q: Tracking<N, S>, B, const N: usize, const S: usize> {
    billiard: &'a B,
    starts: &'a mut dyn Iterator<Item = Start<N, S>>,
    /// The next of the starts.
    upcoming: Option<Start<N, S>>,
    collisions: u64,
    finished: &'a mut dyn FnMut(Finished<N, S, Q::One>),
    keeping: PhantomData<P>,
}

/// Vectors in flight at a time: enough that the divisions of one hide behind the arithmetic of the others.
const VECTORS: usize = 4;
/// No instruction set has more lanes.
const MOST_LANES: usize = 16;

/// One vector of orbits.
struct Group<F: Lane, const N: usize, const S: usize, K, T, C> {
    orbit: Orbit<F, N, S, K, T>,
    carried: C,
    /// Square of the normal speed that counts as grazing.
    slow: F,
    lanes: [Seat; MOST_LANES],
}

/// The group of a run of the motion `B` that keeps the energy as `P` says and tracks `Q`.
type GroupOf<F, const N: usize, const S: usize, P, Q, B> =
    Group<F, N, S, <P as Keeping<N, S>>::Keeper<F>, <Q as Tracking<N, S>>::In<F>, <B as Motion<N, S>>::Carried<F>>;

/// Who sits in a lane.
#[derive(Clone, Copy)]
struct Seat {
    /// The orbit's number; none where the lane idles along, until the next beat or because the starts have run out.
    index: Option<u64>,
    /// The step with which it ends, or the beat at which an idle lane gets its next orbit.
    until: u64,
    /// The step it began with.
    since: u64,
    /// The last step without motion, and how many of these came in a row.
    idle_at: u64,
    idle: u32,
}

impl<P, Q, B, const N: usize, const S: usize> Many<'_, P, Q, B, N, S>
where
    P: Keeping<N, S>,
    Q: Tracking<N, S>,
    B: Motion<N, S>,
{
    /// Hands over the orbits of the lanes in which `ended` says why, and seats the next starts there: at a beat of the
    /// energy keeper, so that each orbit has the beats that it has on its own.
    #[cold]
    #[inline(never)]
    fn change<F: Lane>(
        &mut self,
        group: &mut GroupOf<F, N, S, P, Q, B>,
        next: &mut u64,
        step: u64,
        ended: impl Fn(usize) -> Option<Stop>,
    ) {
        let zero = group.slow.same(0.0);
        let wait = EnergyKeeper::<F, N, S>::until_beat(&group.orbit.keeper);
        let mut starts = [None; MOST_LANES];
        let mut idle = [false; MOST_LANES];
        for (lane, seat) in group.lanes.iter_mut().enumerate().take(F::LANES) {
            let Some(stop) = ended(lane) else { continue };
            if let Some(index) = seat.index {
                let o = &group.orbit;
                let orbit = Orbit {
                    position: o.position.map(|x| x.lane(lane)),
                    velocity: o.velocity.map(|x| x.lane(lane)),
                    spin: o.spin.map(|x| x.lane(lane)),
                    keeper: (),
                    track: o.track.one(lane),
                };
                let outcome = Outcome { stop, collisions: step - seat.since };
                (self.finished)(Finished { index, orbit, outcome });
            } else if step < seat.until {
                continue;
            }
            *seat = Seat { index: None, until: u64::MAX, since: step, idle_at: u64::MAX, idle: 0 };
            if self.upcoming.is_some() && wait > 0 {
                seat.until = step + wait;
            } else if let Some(start) = self.upcoming.take() {
                self.upcoming = self.starts.next();
                (seat.index, seat.until) = (Some(*next), step + self.collisions);
                *next += 1;
                starts[lane] = Some(start);
            }
            idle[lane] = seat.index.is_none();
        }
        let seated = |k: usize| starts.get(k).is_some_and(Option::is_some);
        let pick = |old: F, f: &dyn Fn(&Start<N, S>) -> f64| {
            old.each(|k| starts.get(k).and_then(Option::as_ref).map_or_else(|| old.lane(k), f))
        };
        let o = &mut group.orbit;
        o.position = core::array::from_fn(|i| pick(o.position[i], &|s| s.position[i]));
        o.velocity = core::array::from_fn(|i| pick(o.velocity[i], &|s| s.velocity[i]));
        o.spin = core::array::from_fn(|i| pick(o.spin[i], &|s| s.spin[i]));
        // an idle lane follows an orbit, which has a future
        let model = group.lanes.iter().take(F::LANES).position(|seat| seat.index.is_some());
        let follow =
            |old: F| old.each(|k| if idle.get(k) == Some(&true) { old.lane(model.unwrap_or(k)) } else { old.lane(k) });
        o.position = o.position.map(follow);
        o.velocity = o.velocity.map(follow);
        o.spin = o.spin.map(follow);
        let new = |k: usize| seated(k) || idle.get(k) == Some(&true);
        let new = zero.lt(zero.each(|k| if new(k) { 1.0 } else { 0.0 }));
        o.keeper.replace(new, &P::Keeper::<F>::new(&o.velocity, &o.spin));
        o.track.replace(new, &Q::In::<F>::all(&Q::start(), zero));
        let slow = square_speed(&o.velocity, &o.spin) * (GRAZING * GRAZING);
        group.slow = new.select(slow, group.slow);
        self.billiard.restart(&mut group.carried, new);
    }

    /// One collision of every lane.
    #[inline(always)]
    fn step<F: Lane>(&mut self, group: &mut GroupOf<F, N, S, P, Q, B>, next: &mut u64, step: u64) {
        let zero = group.slow.same(0.0);
        let (hit, arrival) = loop {
            let (hit, arrival) = self.billiard.flight(&group.orbit, &group.carried);
            let odd = hit.corner | !zero.lt(hit.time) | !hit.time.lt(zero.same(f64::INFINITY));
            if !odd.any() || !self.look(group, hit.time, hit.corner, next, step) {
                break (hit, arrival);
            }
        };
        let square = self.billiard.collide(&mut group.orbit, &mut group.carried, &hit, &arrival);
        let grazes = !group.slow.lt(square);
        if grazes.any() {
            self.change(group, next, step + 1, |lane| grazes.at(lane).then_some(Stop::Grazing));
        }
    }

    /// Looks at a hit that is a corner, out of reach or without motion somewhere; whether an orbit ended.
    #[cold]
    #[inline(never)]
    fn look<F: Lane>(
        &mut self,
        group: &mut GroupOf<F, N, S, P, Q, B>,
        time: F,
        corner: F::Mask,
        next: &mut u64,
        step: u64,
    ) -> bool {
        let mut stops = [None; MOST_LANES];
        for (lane, stop) in stops.iter_mut().enumerate().take(F::LANES) {
            let time = time.lane(lane);
            let seat = &mut group.lanes[lane];
            if seat.index.is_none() {
                continue;
            }
            if !(time < f64::INFINITY) {
                *stop = Some(Stop::Escaped);
            } else if corner.at(lane) {
                *stop = Some(Stop::Corner);
            } else if !(time > 0.0) && seat.idle_at != step {
                seat.idle = if seat.idle_at == step.wrapping_sub(1) { seat.idle + 1 } else { 1 };
                seat.idle_at = step;
                if seat.idle > MOST_IDLE {
                    *stop = Some(Stop::Stalled);
                }
            }
        }
        let any = stops.iter().any(Option::is_some);
        if any {
            self.change(group, next, step, |lane| stops[lane]);
        }
        any
    }
}

impl<P, Q, B, const N: usize, const S: usize> Kernel for Many<'_, P, Q, B, N, S>
where
    P: Keeping<N, S>,
    Q: Tracking<N, S>,
    B: Motion<N, S>,
{
    type Output = ();
    #[inline(always)]
    fn run<F: Lane>(mut self, zero: F) {
        let mut next = 0;
        let seat = Seat { index: None, until: 0, since: 0, idle_at: u64::MAX, idle: 0 };
        let nobody = Orbit::new([zero; N], [zero.same(1.0); N], [zero; S], Q::In::<F>::all(&Q::start(), zero));
        let mut groups: [GroupOf<F, N, S, P, Q, B>; VECTORS] = core::array::from_fn(|_| Group {
            orbit: nobody.clone(),
            carried: self.billiard.start(zero),
            slow: zero,
            lanes: [seat; MOST_LANES],
        });
        for group in &mut groups {
            self.change(group, &mut next, 0, |_| Some(Stop::Finished));
        }
        let mut step = 0;
        loop {
            let until = groups.iter().flat_map(|g| &g.lanes[..F::LANES]).map(|s| s.until).min().unwrap_or(step);
            if until == u64::MAX {
                break;
            }
            while step < until {
                for group in &mut groups {
                    self.step(group, &mut next, step);
                }
                step += 1;
            }
            for group in &mut groups {
                if group.lanes[..F::LANES].iter().any(|s| s.until == step) {
                    let until = group.lanes.map(|s| s.until);
                    self.change(group, &mut next, step, |k| (until[k] == step).then_some(Stop::Finished));
                }
            }
        }
    }
}

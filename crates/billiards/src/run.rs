//! The engine's loop.
use crate::{
    billiard::Motion,
    bounce::Bounce,
    energy::EnergyKeeper,
    limit::Limit,
    observe::{Collision, Observer},
    orbit::Orbit,
    stop::{self, MOST_IDLE, Outcome, Stop},
    track::Track,
    with_motion::WithMotion,
};
use core::ops::ControlFlow;
use lanes::Task;

/// `0 < time < ∞`, as one comparison of integers: the units for these are idle during a chain of floating-point operations.
#[inline(always)]
fn moves(time: f64) -> bool {
    time.to_bits().wrapping_sub(1) < f64::INFINITY.to_bits() - 1
}

/// Runs an orbit from collision to collision until the limit, an observer or physics ends it, and leaves it where it was right after the
/// last collision. [`Orbit`] has an example.
pub fn run<B, const N: usize, const S: usize, K, T, O>(
    billiard: &B,
    orbit: &mut Orbit<f64, N, S, K, T>,
    limit: &impl Limit<T>,
    observer: &mut O,
) -> Outcome
where
    B: Motion<N, S>,
    K: EnergyKeeper<f64, N, S>,
    T: Track<f64, N, S> + Clone,
    O: Observer<N, S, K, T>,
{
    lanes::vectorized(Run { billiard, orbit, limit, observer })
}

/// The arguments of [`run`], to be run by code for the instruction set at hand.
struct Run<'a, B, const N: usize, const S: usize, K, T, M, O> {
    billiard: &'a B,
    orbit: &'a mut Orbit<f64, N, S, K, T>,
    limit: &'a M,
    observer: &'a mut O,
}

impl<B, const N: usize, const S: usize, K, T, M, O> Task for Run<'_, B, N, S, K, T, M, O>
where
    B: Motion<N, S>,
    K: EnergyKeeper<f64, N, S>,
    T: Track<f64, N, S> + Clone,
    M: Limit<T>,
    O: Observer<N, S, K, T>,
{
    type Output = Outcome;
    #[inline(always)]
    fn run(self) -> Outcome {
        let Run { billiard, orbit: at, limit, observer } = self;
        let mut start = billiard.start(0.0);
        billiard.restart(&mut start, true, at);
        // copies of our own, to which nothing else points: they live in registers for as long as no observer looks at them
        let (mut orbit, mut carried) = (at.clone(), start);
        let orbit = &mut orbit;
        orbit.track.begin(true);
        let slow = billiard.slow(&orbit.velocity, &orbit.spin);
        let mut n = 0;
        // consecutive flights of zero length, and the number of the last one
        let (mut idle, mut idle_at) = (0, 0);
        let stop = loop {
            let (hit, arrival) = billiard.flight(orbit, &carried);
            if limit.is_beyond(n + 1, &orbit.track, hit.time) {
                // what hits nothing is beyond all time, and may end here
                let is_over = hit.time < f64::INFINITY || limit.is_beyond(n + 1, &orbit.track, 0.0);
                break if is_over { Stop::Finished } else { Stop::Escaped };
            }
            if hit.corner | !moves(hit.time) {
                if !(hit.time < f64::INFINITY) {
                    break Stop::Escaped;
                }
                if hit.corner {
                    break Stop::Corner;
                }
                idle = if idle_at == n { idle + 1 } else { 1 };
                idle_at = n + 1;
                if idle > MOST_IDLE {
                    break Stop::Stalled;
                }
            }
            let stays = billiard.collide(orbit, &mut carried, &hit, &arrival, slow);
            n += 1;
            if observer.looks() || orbit.track.looks() {
                billiard.settle(orbit, &carried);
            }
            let seen = observer.collision(&Collision { n, hit: &hit, orbit });
            // an observer's stop means that the orbit could go on, so an end of the orbit itself comes first
            if stays {
                break Stop::Grazing;
            }
            if let ControlFlow::Break(()) = seen {
                break Stop::Observer;
            }
        };
        billiard.settle(orbit, &carried);
        *at = orbit.clone();
        let stop = match stop {
            Stop::Escaped => match billiard.without_hit(at.position, at.velocity) {
                Stop::Escaped if limit.is_beyond(n + 1, &at.track, f64::INFINITY) => Stop::Finished,
                why => why,
            },
            Stop::Grazing => stop::stays(&at.velocity, billiard.leaving(&carried)),
            Stop::Stalled => stop::ended(&at.velocity, Stop::Stalled),
            other => other,
        };
        Outcome { stop, collisions: n }
    }
}

/// [`run`], for any motion.
pub(crate) struct RunOn<'a, const N: usize, const S: usize, K, T, M, O> {
    pub(crate) orbit: &'a mut Orbit<f64, N, S, K, T>,
    pub(crate) limit: &'a M,
    pub(crate) observer: &'a mut O,
}

impl<const N: usize, const S: usize, K, T, M, O> WithMotion<N, S> for RunOn<'_, N, S, K, T, M, O>
where
    K: EnergyKeeper<f64, N, S>,
    T: Track<f64, N, S> + Clone,
    M: Limit<T>,
    O: Observer<N, S, K, T>,
{
    type Output = Outcome;
    fn run<B: Motion<N, S> + Bounce<N, S>>(self, motion: &B) -> Outcome {
        run(motion, self.orbit, self.limit, self.observer)
    }
}

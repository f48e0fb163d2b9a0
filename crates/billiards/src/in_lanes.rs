//! What belongs to one orbit, in lanes of many.
use crate::orbit::Orbit;
use lanes::{Double, Lane};

/// Something that belongs to an orbit, in lanes: each lane can be taken out and put in. [`Tracking`](crate::Tracking) has an example.
pub trait InLanes<F: Lane>: Clone {
    /// What belongs to a single orbit.
    type One: Clone;
    /// What belongs to the orbit in one lane.
    fn one(&self, lane: usize) -> Self::One;
    /// The same in every lane, as many as `zero` has.
    fn all(one: &Self::One, zero: F) -> Self;
    /// Puts what belongs to an orbit into one lane.
    fn put(&mut self, lane: usize, one: &Self::One);
    /// After how many collisions an orbit can join these, because all lanes share one count.
    fn wait(&self, _: &Self::One) -> u64 {
        0
    }
}

impl<F: Lane> InLanes<F> for () {
    type One = ();
    fn one(&self, _: usize) {}
    fn all((): &(), _: F) {}
    fn put(&mut self, _: usize, (): &()) {}
}

impl<F: Lane, A: InLanes<F>, B: InLanes<F>> InLanes<F> for (A, B) {
    type One = (A::One, B::One);
    fn one(&self, lane: usize) -> Self::One {
        (self.0.one(lane), self.1.one(lane))
    }
    fn all(one: &Self::One, zero: F) -> Self {
        (A::all(&one.0, zero), B::all(&one.1, zero))
    }
    fn put(&mut self, lane: usize, one: &Self::One) {
        self.0.put(lane, &one.0);
        self.1.put(lane, &one.1);
    }
}

impl<F: Lane> InLanes<F> for Double<F> {
    type One = Double;
    #[inline(always)]
    fn one(&self, lane: usize) -> Double {
        Double { high: self.high.lane(lane), low: self.low.lane(lane) }
    }
    #[inline(always)]
    fn all(one: &Double, zero: F) -> Self {
        Double { high: zero.same(one.high), low: zero.same(one.low) }
    }
    #[inline(always)]
    fn put(&mut self, lane: usize, one: &Double) {
        self.high.put(lane, one.high);
        self.low.put(lane, one.low);
    }
}

impl<F: Lane, const N: usize, const S: usize, K: InLanes<F>, T: InLanes<F>> InLanes<F> for Orbit<F, N, S, K, T> {
    type One = Orbit<f64, N, S, K::One, T::One>;
    #[inline(always)]
    fn one(&self, lane: usize) -> Self::One {
        Orbit {
            position: self.position.map(|x| x.lane(lane)),
            velocity: self.velocity.map(|x| x.lane(lane)),
            spin: self.spin.map(|x| x.lane(lane)),
            keeper: self.keeper.one(lane),
            track: self.track.one(lane),
        }
    }
    #[inline(always)]
    fn all(one: &Self::One, zero: F) -> Self {
        Orbit {
            position: one.position.map(|x| zero.same(x)),
            velocity: one.velocity.map(|x| zero.same(x)),
            spin: one.spin.map(|x| zero.same(x)),
            keeper: K::all(&one.keeper, zero),
            track: T::all(&one.track, zero),
        }
    }
    #[inline(always)]
    fn put(&mut self, lane: usize, one: &Self::One) {
        let to = self.position.iter_mut().chain(&mut self.velocity).chain(&mut self.spin);
        for (to, from) in to.zip(one.position.iter().chain(&one.velocity).chain(&one.spin)) {
            to.put(lane, *from);
        }
        self.keeper.put(lane, &one.keeper);
        self.track.put(lane, &one.track);
    }
    fn wait(&self, one: &Self::One) -> u64 {
        self.keeper.wait(&one.keeper)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::track::{Angle, Clock};
    use lanes::Twin;

    type Tracked<F> = Orbit<F, 2, 1, (), (Clock<F>, Angle<F>)>;

    #[test]
    fn an_orbit_put_into_a_lane_comes_out_of_it_and_the_other_lane_stays() {
        let digits = |high: f64| Double { high, low: high * 1e-17 };
        let orbit = |x: f64| Tracked {
            position: [x, x + 1.0],
            velocity: [x + 2.0, x + 3.0],
            spin: [x + 4.0],
            keeper: (),
            track: (Clock(digits(x + 5.0)), Angle(digits(x + 6.0))),
        };
        let same = |a: &Tracked<f64>, b: &Tracked<f64>| assert_eq!(format!("{a:?}"), format!("{b:?}"));
        let (first, second) = (orbit(0.1), orbit(0.7));
        let mut both: Tracked<Twin<f64>> = Orbit::all(&first, Twin::of(0.0));
        same(&both.one(1), &first);
        both.put(1, &second);
        same(&both.one(0), &first);
        same(&both.one(1), &second);
    }
}

//! What belongs to one orbit, in lanes of many.
use lanes::Lane;

/// Something that belongs to an orbit, in lanes: each lane can be taken out and put in.
pub trait InLanes<F: Lane>: Clone {
    /// What belongs to a single orbit.
    type One: Clone;
    /// What belongs to the orbit in one lane.
    fn one(&self, lane: usize) -> Self::One;
    /// The same in every lane, as many as `zero` has.
    fn all(one: &Self::One, zero: F) -> Self;
    /// Puts what belongs to an orbit into one lane.
    fn put(&mut self, lane: usize, one: &Self::One);
    /// After how many collisions an orbit can join these, because all of them count together.
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

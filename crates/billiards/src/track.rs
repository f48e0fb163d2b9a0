//! What grows along a path: time, spin position, the cell of a lattice. Where nobody asks, the track is `()`.
use crate::in_lanes::InLanes;
use geometry::{Lattice, Vector2, WallHit};
use lanes::{Double, Lane};
use std::sync::Arc;

/// Something that each flight from one collision to the next adds to.
pub trait Track<F: Lane, const N: usize, const S: usize> {
    /// A flight with this velocity and spin from `from` to the hit.
    fn fly(&mut self, from: &[F; N], velocity: &[F; N], spin: &[F; S], hit: &WallHit<F, N>);
    /// Whether it looks at position, velocity and spin.
    #[inline(always)]
    fn looks(&self) -> bool {
        true
    }
}

/// What is tracked along the path of an orbit, with a type for every lane width.
pub trait Tracking<const N: usize, const S: usize>: Clone {
    /// The track in lanes of `F`.
    type In<F: Lane>: Track<F, N, S> + InLanes<F, One = Self>;
}

/// A track that knows the time.
pub trait Timed<F: Lane> {
    /// The time since the start \[T\].
    fn time(&self) -> F;
}

impl<F: Lane, const N: usize, const S: usize> Track<F, N, S> for () {
    #[inline(always)]
    fn fly(&mut self, _: &[F; N], _: &[F; N], _: &[F; S], _: &WallHit<F, N>) {}
    #[inline(always)]
    fn looks(&self) -> bool {
        false
    }
}

impl<const N: usize, const S: usize> Tracking<N, S> for () {
    type In<F: Lane> = ();
}

impl<F: Lane, const N: usize, const S: usize, A: Track<F, N, S>, B: Track<F, N, S>> Track<F, N, S> for (A, B) {
    #[inline(always)]
    fn fly(&mut self, from: &[F; N], velocity: &[F; N], spin: &[F; S], hit: &WallHit<F, N>) {
        self.0.fly(from, velocity, spin, hit);
        self.1.fly(from, velocity, spin, hit);
    }
    #[inline(always)]
    fn looks(&self) -> bool {
        self.0.looks() || self.1.looks()
    }
}

/// The time since the start \[T\], as a compensated sum: its error does not grow with the number of collisions.
#[derive(Clone, Copy, Debug)]
pub struct Clock<F = f64>(pub Double<F>);

impl<F: Lane> Clock<F> {
    /// A clock at 0, in as many lanes as `zero`.
    pub fn new(zero: F) -> Self {
        Clock(Double::new(zero))
    }
}

impl<F: Lane, const N: usize, const S: usize> Track<F, N, S> for Clock<F> {
    #[inline(always)]
    fn fly(&mut self, _: &[F; N], _: &[F; N], _: &[F; S], hit: &WallHit<F, N>) {
        self.0.gather(hit.time);
    }
    #[inline(always)]
    fn looks(&self) -> bool {
        false
    }
}

impl<F: Lane> Timed<F> for Clock<F> {
    #[inline(always)]
    fn time(&self) -> F {
        self.0.value()
    }
}

impl<F: Lane, B> Timed<F> for (Clock<F>, B) {
    #[inline(always)]
    fn time(&self) -> F {
        self.0.time()
    }
}

impl<F: Lane> InLanes<F> for Clock<F> {
    type One = Clock;
    fn one(&self, lane: usize) -> Clock {
        Clock(Double { high: self.0.high.lane(lane), low: self.0.low.lane(lane) })
    }
    fn all(one: &Clock, zero: F) -> Self {
        Clock(Double { high: zero.same(one.0.high), low: zero.same(one.0.low) })
    }
    fn put(&mut self, lane: usize, one: &Clock) {
        self.0.high.put(lane, one.0.high);
        self.0.low.put(lane, one.0.low);
    }
}

impl<const N: usize, const S: usize> Tracking<N, S> for Clock {
    type In<F: Lane> = Clock<F>;
}

/// The scaled spin position `x₀ = γ R θ` of a disk \[L\], not reduced modulo a turn, as a compensated sum.
#[derive(Clone, Copy, Debug)]
pub struct Angle<F = f64>(pub Double<F>);

impl<F: Lane> Angle<F> {
    /// The spin position at the start.
    pub fn new(start: F) -> Self {
        Angle(Double::new(start))
    }
}

impl<F: Lane, const N: usize> Track<F, N, 1> for Angle<F> {
    #[inline(always)]
    fn fly(&mut self, _: &[F; N], _: &[F; N], spin: &[F; 1], hit: &WallHit<F, N>) {
        self.0.add(spin[0] * hit.time);
    }
}

/// The translation accumulated on a lattice, in multiples of its vectors.
#[derive(Clone, Debug)]
pub struct Cell<F = f64> {
    lattice: Arc<Lattice>,
    /// Position in the plane = position in the unit cell + `cell` · lattice vectors.
    pub cell: [F; 2],
}

impl<F: Lane> Cell<F> {
    /// In the unit cell, in as many lanes as `zero`.
    pub fn new(lattice: Arc<Lattice>, zero: F) -> Self {
        Cell { lattice, cell: [zero; 2] }
    }
}

impl<F: Lane, const S: usize> Track<F, 2, S> for Cell<F> {
    #[inline(always)]
    fn fly(&mut self, from: &[F; 2], velocity: &[F; 2], _: &[F; S], hit: &WallHit<F, 2>) {
        for lane in 0..F::LANES {
            let lifted = |i: usize| from[i].lane(lane) + velocity[i].lane(lane) * hit.time.lane(lane);
            let moved = Vector2::new(lifted(0) - hit.point[0].lane(lane), lifted(1) - hit.point[1].lane(lane));
            let step = self.lattice.rounded(&moved);
            for i in 0..2 {
                let old = self.cell[i];
                self.cell[i] = old.each(|k| if k == lane { old.lane(k) + step[i] } else { old.lane(k) });
            }
        }
    }
}

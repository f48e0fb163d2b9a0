//! The outside of many balls.
use super::{Scatterer, WallHit, Walls};
use crate::{BoxTree, Crossing, Error, Extent, Line};
use lanes::{Lane, MOST_LANES, Mask, stored};
use nalgebra::SVector;

/// The complement of balls that do not meet, in ℝᴺ.
///
/// A few are tested one after another, each for all lanes at once; for many, a tree of boxes finds which one a path meets first.
#[derive(Clone, Debug)]
pub struct Scatterers<const N: usize> {
    balls: Vec<Scatterer<N>>,
    tree: BoxTree<N>,
}

impl<const N: usize> Scatterers<N> {
    /// The scatterers with their centres \[L\], positive radii \[L\] and numbers. Where two of them meet, paths into the edge between
    /// them are reflected with the normal of one of them.
    ///
    /// # Errors
    /// [`Error::Radius`] unless all radii are positive and finite, [`Error::Parameter`] for a centre that is not finite.
    pub fn new(balls: impl IntoIterator<Item = (SVector<f64, N>, f64, usize)>) -> Result<Self, Error> {
        let (mut scatterers, mut boxes) = (vec![], vec![]);
        for (center, radius, piece) in balls {
            scatterers.push(Scatterer::new(center, radius, piece)?);
            boxes.push(Extent { min: center.add_scalar(-radius), max: center.add_scalar(radius) });
        }
        Ok(Scatterers { balls: scatterers, tree: BoxTree::new(boxes) })
    }

    /// With this many per lane, testing each is as fast as searching the tree one lane after another: 0.9 ns a ball in 16 lanes,
    /// against 200 ns.
    const PER_LANE: usize = 12;

    /// The first hit, each ball being tested for all lanes.
    #[inline(always)]
    fn of_each<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let mut soonest = v[0].same(f64::INFINITY);
        let Some(any) = self.balls.first() else { return WallHit::never(*x) };
        let mut first = any.in_lanes(soonest);
        for ball in &self.balls {
            let ball = ball.in_lanes(soonest);
            let approach = ball.approach(x, v);
            if approach.meets.any() {
                let time = approach.time();
                let sooner = time.lt(soonest);
                soonest = sooner.select(time, soonest);
                first = first.or(sooner, &ball);
            }
        }
        first.landing(x, v, soonest)
    }

    /// The first hit, the ball being searched for each lane separately.
    #[inline(always)]
    fn of_tree<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let zero = v[0].same(0.0);
        let (from, along) = (stored(x), stored(v));
        let (mut balls, mut times) = ([0; MOST_LANES], [f64::INFINITY; MOST_LANES]);
        for lane in 0..F::LANES {
            let [point, velocity] = [&from, &along].map(|a| a.each_ref().map(|a| a[lane]));
            let crossing = |k: usize| {
                let approach = self.balls[k].round().approach(&point, &velocity);
                if approach.meets { Crossing { num: approach.time(), den: 1.0 } } else { Crossing::NEVER }
            };
            let path = Line { point: point.into(), velocity: velocity.into() };
            if let Some((ball, time)) = self.tree.first(&path, crossing) {
                (balls[lane], times[lane]) = (ball, time);
            }
        }
        let time = zero.load(&times);
        if !time.lt(zero.same(f64::INFINITY)).any() {
            return WallHit::never(*x);
        }
        let mut ball = self.balls[0].in_lanes(zero);
        for i in 0..N {
            ball.center[i] = zero.each(|lane| self.balls[balls[lane]].round().center[i]);
        }
        ball.square = zero.each(|lane| self.balls[balls[lane]].round().square);
        ball.inverse = zero.each(|lane| self.balls[balls[lane]].round().inverse);
        ball.half = zero.each(|lane| self.balls[balls[lane]].round().half);
        ball.piece = zero.each(|lane| self.balls[balls[lane]].round().piece);
        ball.landing(x, v, time)
    }
}

impl<const N: usize> Walls<N> for Scatterers<N> {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        if self.balls.len() <= Self::PER_LANE * F::LANES { self.of_each(x, v) } else { self.of_tree(x, v) }
    }
}

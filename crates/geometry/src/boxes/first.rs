//! The first thing on a path, found so that rounding never loses one.
use super::{BoxTree, Eight, WIDTH, stack::Stack};
use crate::{Crossing, Line};
use lanes::{Kernel, Lane, Mask};

/// A path prepared for box tests.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab<const N: usize> {
    /// The start of the path, moved forward by the margin for the sides through which it enters, and back for those through
    /// which it leaves.
    enter: [f64; N],
    leave: [f64; N],
    inverse: [f64; N],
    /// Whether the path runs downwards.
    down: [bool; N],
}

impl<const N: usize> Slab<N> {
    /// The path, for boxes whose finite coordinates do not exceed `size`.
    ///
    /// A piece decides with an error of a few ulp of its distance from the start of the path, which is at most |x| + size; a
    /// box enlarged by ten times that contains every crossing that the piece can find. The few roundings of the box test
    /// itself are of the same size.
    ///
    /// Only for a path that grazes a piece is the piece itself less accurate: it knows the place along the path only to that
    /// error divided by the angle, and may count a crossing behind the start, if this lies on the piece's line, as one at
    /// time 0. There the box decides.
    #[inline(always)]
    pub(crate) fn new(path: &Line<N>, size: f64) -> Self {
        let margin = 64.0 * f64::EPSILON * (path.point.amax() + size);
        let down: [bool; N] = core::array::from_fn(|i| path.velocity[i] < 0.0);
        let start = |margin: f64| core::array::from_fn(|i| path.point[i] + if down[i] { -margin } else { margin });
        // turns −0 into 0, and avoids 0·∞, which would be NaN
        let inverse = core::array::from_fn(|i| (1.0 / (path.velocity[i] + 0.0)).clamp(-f64::MAX, f64::MAX));
        Slab { enter: start(margin), leave: start(-margin), inverse, down }
    }

    /// Lower bounds of the times at which the path enters eight boxes, and a bit mask of those that it enters before
    /// `limit`.
    #[inline(always)]
    fn enters<F: Lane>(&self, zero: F, boxes: &Eight<N>, limit: f64) -> ([f64; WIDTH], u64) {
        let mut times = [0.0; WIDTH];
        let mut hit = 0;
        let mut k = 0;
        while k < WIDTH {
            let (mut enter, mut leave) = (zero, zero.same(limit));
            for i in 0..N {
                let (near, far) =
                    if self.down[i] { (&boxes.max[i], &boxes.min[i]) } else { (&boxes.min[i], &boxes.max[i]) };
                let from = (zero.load(&near[k..]) - zero.same(self.enter[i])) * self.inverse[i];
                let to = (zero.load(&far[k..]) - zero.same(self.leave[i])) * self.inverse[i];
                (enter, leave) = (from.max(enter), to.min(leave));
            }
            enter.store(&mut times[k..]);
            hit |= (!leave.lt(enter)).bits() << k;
            k += F::LANES;
        }
        (times, hit)
    }
}

/// The first of the crossings offered, in whatever order; for equal times the one with the lowest number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct First {
    time: f64,
    place: usize,
}

impl First {
    /// Nothing so far.
    pub(crate) const NONE: First = First { time: f64::INFINITY, place: 0 };

    /// Takes the crossing of the thing at a place if it is the first so far; its number is computed only if needed.
    #[inline(always)]
    pub(crate) fn offer(&mut self, place: usize, crossing: Crossing, number: impl Fn(usize) -> usize) {
        let time = crossing.time();
        if time < self.time || (time == self.time && time < f64::INFINITY && number(place) < number(self.place)) {
            *self = First { time, place };
        }
    }

    /// The place found, and the time.
    pub(crate) fn found(self) -> Option<(usize, f64)> {
        (self.time < f64::INFINITY).then_some((self.place, self.time))
    }
}

/// A node to visit: a lower bound of the time at which the path reaches it, and which node it is.
///
/// Packed into one number whose upper half is that of the time (rounded down; times are not negative), so that the first
/// node has the least number.
#[derive(Clone, Copy)]
struct Open(u64);

/// The bits of an [`Open`] that hold the time.
const TIME: u64 = !0 << 32;

/// Number of bits for the place of a node on its level; the bits above them hold the level.
const PLACE: u32 = 28;

impl Open {
    #[inline(always)]
    fn new(time: f64, what: u64) -> Open {
        Open((time.to_bits() & TIME) | what)
    }
    #[inline(always)]
    fn what(self) -> usize {
        (self.0 & !TIME) as usize
    }
    #[inline(always)]
    fn is_before(self, time: f64) -> bool {
        self.0 <= time.to_bits() | !TIME
    }
}

/// The contents of the boxes of a tree.
pub(crate) trait Inside {
    /// Offers the crossing of the path with the contents of the box at a place.
    fn offer<F: Lane>(&self, zero: F, place: usize, first: &mut First);
}

/// Things that are tested one by one.
struct OneByOne<'a, const N: usize, C> {
    tree: &'a BoxTree<N>,
    path: &'a Line<N>,
    crossing: C,
}

impl<const N: usize, C: Fn(usize) -> Crossing> Inside for OneByOne<'_, N, C> {
    #[inline(always)]
    fn offer<F: Lane>(&self, _: F, place: usize, first: &mut First) {
        let number = |place: usize| self.tree.number(place);
        first.offer(place, (self.crossing)(number(place)), number);
    }
}

impl<const N: usize, C: Fn(usize) -> Crossing> Kernel for OneByOne<'_, N, C> {
    type Output = First;
    #[inline(always)]
    fn run<F: Lane>(self, zero: F) -> First {
        self.tree.walk(zero, self.path, &self)
    }
}

impl<const N: usize> BoxTree<N> {
    /// The first piece that the path crosses, given the crossing of each, and the time; for equal times the one with the
    /// lowest number.
    pub fn first(&self, path: &Line<N>, crossing: impl Fn(usize) -> Crossing) -> Option<(usize, f64)> {
        let found = lanes::dispatch(OneByOne { tree: self, path, crossing }).found();
        found.map(|(place, time)| (self.number(place), time))
    }

    /// Tests the contents of boxes that the path enters, nearer ones first, until nothing can come before the first one
    /// found.
    #[inline(always)]
    pub(crate) fn walk<F: Lane>(&self, zero: F, path: &Line<N>, inside: &impl Inside) -> First {
        let mut first = First::NONE;
        let Some(root) = self.levels.len().checked_sub(1) else { return first };
        // NaN is in no box, and infinite values would be in the empty boxes that fill up a node
        if path.point.iter().chain(path.velocity.iter()).any(|a| !a.is_finite()) {
            return first;
        }
        let slab = Slab::new(path, self.size);
        let mut open = Stack::of(Open::new(0.0, (root as u64) << PLACE));
        while let Some(node) = open.pop(0) {
            if !node.is_before(first.time) {
                continue;
            }
            let (level, place) = (node.what() >> PLACE, node.what() & ((1 << PLACE) - 1));
            let boxes = &self.nodes[self.levels[level].start + place];
            let (enter, mut hit) = slab.enters(zero, boxes, first.time.min(f64::MAX));
            let below = if level == 0 { 0 } else { (level as u64 - 1) << PLACE };
            // the nearest goes on top
            let bottom = open.count();
            while hit != 0 {
                let k = hit.trailing_zeros() as usize;
                hit &= hit - 1;
                let child = Open::new(enter[k], below | (WIDTH * place + k) as u64);
                open.insert(bottom, child, |other| other.0 < child.0);
            }
            if level == 0 {
                while let Some(here) = open.pop(bottom) {
                    if here.is_before(first.time) {
                        inside.offer(zero, here.what(), &mut first);
                    }
                }
            }
        }
        first
    }
}

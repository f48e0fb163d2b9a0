//! The first thing on a path, made so that rounding never loses one.
use super::{BoxTree, Eight, WIDTH, stack::Stack};
use crate::{Crossing, Line};
use lanes::{Kernel, Lane, Mask};

/// A path prepared for box tests.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab<const N: usize> {
    /// Where the path starts, moved back by the margin for the sides that it enters through and on for those through which it
    /// leaves.
    enter: [f64; N],
    leave: [f64; N],
    inverse: [f64; N],
    /// Whether the path runs downwards.
    down: [bool; N],
}

impl<const N: usize> Slab<N> {
    /// The path, for boxes whose finite coordinates do not exceed `size`.
    ///
    /// A piece decides for itself with an error of a few ulp of its distance from the start of the path, which is at most
    /// |x| + size; a box that is larger by ten times that holds every crossing that the piece can find. The few
    /// roundings of the box test itself are of the same size.
    ///
    /// Only of a path that grazes a piece the piece itself knows less: the place along the path to that error over the angle,
    /// and it may count as crossed at once what lies behind a start that is on its line. There the box decides.
    #[inline(always)]
    pub(crate) fn new(path: &Line<N>, size: f64) -> Self {
        let margin = 64.0 * f64::EPSILON * (path.point.amax() + size);
        let down: [bool; N] = core::array::from_fn(|i| path.velocity[i] < 0.0);
        let start = |margin: f64| core::array::from_fn(|i| path.point[i] + if down[i] { -margin } else { margin });
        // −0 is 0, and 0·∞ would be no number
        let inverse = core::array::from_fn(|i| (1.0 / (path.velocity[i] + 0.0)).clamp(-f64::MAX, f64::MAX));
        Slab { enter: start(margin), leave: start(-margin), inverse, down }
    }

    /// Lower bounds of the times at which the path enters eight boxes, and as bits which of them it enters before `limit`
    /// at all.
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

/// The first of what has been offered, in whatever order: of equal times the lowest number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct First {
    time: f64,
    place: usize,
}

impl First {
    /// Nothing so far.
    pub(crate) const NONE: First = First { time: f64::INFINITY, place: 0 };

    /// Takes the crossing of the thing at a place, whose number is asked for only if need be, if it is the first so far.
    #[inline(always)]
    pub(crate) fn offer(&mut self, place: usize, crossing: Crossing, number: impl Fn(usize) -> usize) {
        let time = crossing.time();
        if time < self.time || (time == self.time && time < f64::INFINITY && number(place) < number(self.place)) {
            *self = First { time, place };
        }
    }

    /// Its place and the time.
    pub(crate) fn found(self) -> Option<(usize, f64)> {
        (self.time < f64::INFINITY).then_some((self.place, self.time))
    }
}

/// Something to look at: a lower bound of the time at which the path gets there, and what it is.
///
/// As one number, whose upper half is that of the time (rounded down, and times are not negative): what comes first is
/// the least.
#[derive(Clone, Copy)]
struct Open(u64);

/// The bits of an [`Open`] that hold the time.
const TIME: u64 = !0 << 32;

/// Bits of the place of a node on its level, which is told by the bits above them.
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

/// What lies in the boxes of a tree.
pub(crate) trait Inside {
    /// Offers what is in the box at a place: the crossing of it with the path.
    fn offer<F: Lane>(&self, zero: F, place: usize, first: &mut First);
}

/// Things that are asked one by one.
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
    /// The first piece that the path crosses, given the crossing of each, and the time; of equal times the lowest
    /// number.
    pub fn first(&self, path: &Line<N>, crossing: impl Fn(usize) -> Crossing) -> Option<(usize, f64)> {
        let found = lanes::dispatch(OneByOne { tree: self, path, crossing }).found();
        found.map(|(place, time)| (self.number(place), time))
    }

    /// Asks what lies in boxes that the path enters, nearer ones first, until nothing can come before the first that
    /// was found.
    #[inline(always)]
    pub(crate) fn walk<F: Lane>(&self, zero: F, path: &Line<N>, inside: &impl Inside) -> First {
        let mut first = First::NONE;
        let Some(root) = self.levels.len().checked_sub(1) else { return first };
        // what is not a number is in no box, and what is infinite would be in those that fill a node up
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
            // the nearest on top
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

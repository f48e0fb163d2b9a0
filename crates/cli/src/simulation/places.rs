//! The points of a phase portrait. Finding the place of a collision on the boundary takes longer than the collision itself,
//! so collisions are noted, and their places are found for many at a time.

use std::sync::Arc;

use billiards::geometry::WallHit;
use lanes::{Kernel, Lane, Mask, Twin};

use super::counter::Counter;
use super::unrolled::Unrolled;

/// Number of collisions noted at a time: several vectors of any width.
const MOST: usize = 256;

/// Counts the places and tangential velocities of collisions.
#[derive(Clone, Debug)]
pub(super) struct Places {
    pub(super) counter: Counter,
    pub(super) unrolled: Arc<Unrolled>,
    noted: Box<Collisions>,
    /// How many are noted.
    count: usize,
}

/// The data of noted collisions.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct Collisions {
    point: [[f64; MOST]; 2],
    /// Unit normals, where they determine the place better than points do.
    normal: [[f64; MOST]; 2],
    piece: [f64; MOST],
    tangential: [f64; MOST],
    /// The layer of each; [`NOBODY`] where there is none.
    layer: [f64; MOST],
}

/// No layer.
const NOBODY: f64 = -1.0;

impl Places {
    /// Places on a boundary, counted by this counter.
    pub(super) fn new(counter: Counter, unrolled: Arc<Unrolled>) -> Self {
        let none = [0.0; MOST];
        let noted = Collisions { point: [none; 2], normal: [none; 2], piece: none, tangential: none, layer: none };
        Places { counter, unrolled, noted: Box::new(noted), count: 0 }
    }

    /// Notes collisions in their layers, in the lanes that are `here`.
    #[inline(always)]
    pub(super) fn note<F: Lane>(&mut self, hit: &WallHit<F, 2>, tangential: F, layer: F, here: F::Mask) {
        if self.count + F::LANES > MOST {
            self.find();
        }
        let these = self.count..self.count + F::LANES;
        let Collisions { point, normal, piece: pieces, tangential: tangentials, layer: layers } = &mut *self.noted;
        for (x, xs) in hit.point.iter().zip(point) {
            x.store(&mut xs[these.clone()]);
        }
        if self.unrolled.wants_normals() {
            for (n, ns) in hit.unit_normal().iter().zip(normal) {
                n.store(&mut ns[these.clone()]);
            }
        }
        // where nobody is, there may be no piece
        here.select(hit.piece, layer.same(0.0)).store(&mut pieces[these.clone()]);
        tangential.store(&mut tangentials[these.clone()]);
        here.select(layer, layer.same(NOBODY)).store(&mut layers[these]);
        self.count += F::LANES;
    }

    /// Finds the places of the noted collisions, and counts them.
    #[inline(never)]
    fn find(&mut self) {
        let Collisions { layer, .. } = &mut *self.noted;
        layer[self.count..].fill(NOBODY);
        self.count = 0;
        lanes::dispatch(Find(self));
    }

    /// Counts the rest, and returns the counter.
    pub(super) fn counted(mut self) -> Counter {
        self.find();
        self.counter
    }
}

/// Finds places in lanes.
struct Find<'a>(&'a mut Places);

impl Kernel for Find<'_> {
    type Output = ();
    #[inline(always)]
    fn run<F: Lane>(self, zero: F) {
        let Places { counter, unrolled, noted, .. } = self.0;
        // an angle is a long chain of dependent operations
        let zero = Twin::of(zero);
        for first in (0..MOST).step_by(Twin::<F>::LANES) {
            let of = |numbers: &[f64; MOST]| zero.load(&numbers[first..first + Twin::<F>::LANES]);
            let place = unrolled.arc_length(
                noted.point.each_ref().map(of),
                || noted.normal.each_ref().map(of),
                of(&noted.piece),
            );
            let layer = of(&noted.layer);
            let point = counter.near([place, of(&noted.tangential)]);
            counter.note(point, layer, zero.lt(layer));
        }
    }
}

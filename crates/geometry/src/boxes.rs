//! A tree of boxes: finds which of many things are near a point or on a path, without asking all of them.
//!
//! Eight children per node, whose boxes lie side by side, coordinate by coordinate, so that all eight are tested at once. The
//! tree has no pointers: things are taken eight at a time in some order, then the boxes around these eight at a time, and so
//! on up to one node. A search keeps the nodes it has yet to visit in an array of fixed size and allocates nothing.
mod first;
mod near;
mod order;
mod stack;

use crate::Extent;
use nalgebra::SVector;

pub(crate) use first::{First, Inside};
pub(crate) use order::order;

/// Children of a node: as many numbers as fill a cache line, and the widest registers.
pub(crate) const WIDTH: usize = 8;

/// Levels of the highest tree, of 8¹¹ boxes: more than the 2³¹ whose places fit into 28 bits a node.
const LEVELS: usize = 11;

/// Most nodes that a search has yet to visit: seven siblings on every level, and the eight children of the last one.
const OPEN: usize = LEVELS * (WIDTH - 1) + 1;

/// A tree over boxes numbered from 0, for paths in N dimensions.
///
/// The tree only skips what cannot matter, and the things in the boxes decide; so the answers are bit for bit those of asking
/// each of them, in logarithmic time. At most 2³¹ boxes.
#[derive(Clone)]
pub struct BoxTree<const N: usize = 2> {
    /// All levels one after another: first the boxes themselves, eight to a node, last the root.
    nodes: Vec<Eight<N>>,
    levels: Vec<Level>,
    /// For each place in the tree the number of the box there; empty where they are in the order of their numbers.
    order: Vec<u32>,
    /// Greatest finite coordinate.
    size: f64,
}

/// Eight boxes; missing ones are empty.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Eight<const N: usize> {
    min: [[f64; WIDTH]; N],
    max: [[f64; WIDTH]; N],
}

#[derive(Clone, Copy, Debug)]
struct Level {
    /// The first of its nodes.
    start: usize,
    /// How many boxes it has.
    boxes: usize,
}

impl<const N: usize> core::fmt::Debug for BoxTree<N> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "a tree of {} boxes", self.len())
    }
}

impl<const N: usize> Eight<N> {
    fn of(extents: &[Extent<N>]) -> Self {
        let side = |pick: fn(&Extent<N>) -> &SVector<f64, N>| {
            core::array::from_fn(|i| core::array::from_fn(|k| pick(extents.get(k).unwrap_or(&Extent::EMPTY))[i]))
        };
        Eight { min: side(|e| &e.min), max: side(|e| &e.max) }
    }

    #[inline]
    fn extent(&self, k: usize) -> Extent<N> {
        let at = |side: &[[f64; WIDTH]; N]| SVector::from_fn(|i, _| side[i][k]);
        Extent { min: at(&self.min), max: at(&self.max) }
    }
}

impl<const N: usize> BoxTree<N> {
    /// The tree over some boxes, whose sides may lie at infinity, in the better of two orders: their own, in which the pieces
    /// of a boundary follow one another, and that of recursive halving at the median.
    pub fn new(boxes: impl IntoIterator<Item = Extent<N>>) -> Self {
        let boxes: Vec<Extent<N>> = boxes.into_iter().collect();
        match order(&boxes) {
            None => BoxTree::in_order(&boxes),
            Some(order) => {
                let sorted: Vec<Extent<N>> = order.iter().map(|&i| boxes[i as usize]).collect();
                BoxTree { order, ..BoxTree::in_order(&sorted) }
            }
        }
    }

    /// The tree over some boxes in their own order.
    pub(crate) fn in_order(boxes: &[Extent<N>]) -> Self {
        let size = boxes.iter().map(Extent::size).fold(0.0, f64::max);
        // n/8 + n/64 + …, each rounded up
        let nodes = Vec::with_capacity(boxes.len() / (WIDTH - 1) + LEVELS);
        let mut tree = BoxTree { nodes, levels: vec![], order: vec![], size };
        if !boxes.is_empty() {
            let mut above = tree.add(boxes);
            while above.len() > 1 {
                above = tree.add(&above);
            }
        }
        tree
    }

    /// Adds a level, and returns the boxes around its nodes.
    fn add(&mut self, boxes: &[Extent<N>]) -> Vec<Extent<N>> {
        self.levels.push(Level { start: self.nodes.len(), boxes: boxes.len() });
        self.nodes.extend(boxes.chunks(WIDTH).map(Eight::of));
        boxes.chunks(WIDTH).map(|eight| eight.iter().copied().fold(Extent::EMPTY, Extent::union)).collect()
    }

    /// The greatest finite coordinate of its boxes.
    pub(crate) fn size(&self) -> f64 {
        self.size
    }

    /// How many boxes there are.
    fn len(&self) -> usize {
        self.levels.first().map_or(0, |level| level.boxes)
    }

    /// The number of the box at a place.
    #[inline]
    fn number(&self, place: usize) -> usize {
        self.order.get(place).map_or(place, |&i| i as usize)
    }

    /// The numbers of the boxes in an order in which neighbours are near each other.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = usize> {
        (0..self.len()).map(|place| self.number(place))
    }
}

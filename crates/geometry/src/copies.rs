//! Pieces with all translates that matter, and a tree to find them by position.
use crate::{BoxTree, Extent, Lattice, Piece, lattice::multiples, nearest::nearest_of, shapes::Translated};
use nalgebra::Vector2;
use std::sync::Arc;

/// A piece, or a translate of one by a lattice vector.
#[derive(Clone, Debug)]
pub(crate) struct Translate {
    /// The number of the piece.
    pub(crate) number: usize,
    /// How many of each lattice vector it is moved by.
    pub(crate) cell: [f64; 2],
    /// The translation by which it is moved.
    pub(crate) by: Vector2<f64>,
    /// The piece, moved.
    pub(crate) piece: Arc<dyn Piece>,
}

impl Translate {
    /// The piece itself.
    pub(crate) fn home(number: usize, piece: &Arc<dyn Piece>) -> Translate {
        Translate { number, cell: [0.0; 2], by: Vector2::zeros(), piece: piece.clone() }
    }

    /// The piece moved by these multiples of the lattice vectors.
    pub(crate) fn new(number: usize, piece: &Arc<dyn Piece>, lattice: &Lattice, cell: [f64; 2]) -> Translate {
        let by = lattice.translation(cell);
        if by == Vector2::zeros() {
            return Translate::home(number, piece);
        }
        Translate { number, cell, by, piece: Arc::new(Translated::new(piece.clone(), by)) }
    }
}

/// Pieces and their translates.
#[derive(Clone, Debug)]
pub(crate) struct Copies {
    all: Vec<Translate>,
    /// For each piece, the index of the unmoved copy.
    home: Vec<usize>,
    boxes: Vec<Extent>,
    tree: BoxTree,
}

impl Copies {
    /// All copies of `pieces` that come as near as `reach` \[L\] to the box `around`. Infinite pieces lie along the lattice
    /// and are their own translates.
    pub(crate) fn new(pieces: &[Arc<dyn Piece>], lattice: Option<&Lattice>, around: &Extent, reach: f64) -> Copies {
        let (mut all, mut boxes, mut home) = (vec![], vec![], vec![]);
        for (number, piece) in pieces.iter().enumerate() {
            let extent = piece.extent();
            home.push(all.len());
            all.push(Translate::home(number, piece));
            boxes.push(extent);
            let Some(lattice) = lattice.filter(|_| extent.is_finite() && around.is_finite()) else { continue };
            for cell in cells(lattice, &extent, around, reach) {
                let by = lattice.translation(cell);
                let moved = Extent { min: extent.min + by, max: extent.max + by };
                if cell != [0.0; 2] && moved.meets(around, reach) {
                    all.push(Translate::new(number, piece, lattice, cell));
                    boxes.push(moved);
                }
            }
        }
        let tree = BoxTree::new(boxes.iter().copied());
        Copies { all, home, boxes, tree }
    }

    pub(crate) fn get(&self, index: usize) -> (&Translate, &Extent) {
        (&self.all[index], &self.boxes[index])
    }

    /// The index of a piece's unmoved copy.
    pub(crate) fn home(&self, number: usize) -> usize {
        self.home[number]
    }

    /// Indices of all copies, neighbours near each other.
    pub(crate) fn order(&self) -> impl Iterator<Item = usize> {
        self.tree.numbers()
    }

    /// Visits the indices of the copies with boxes that are `wanted`.
    pub(crate) fn search(&self, wanted: impl Fn(&Extent) -> bool, visit: impl FnMut(usize)) {
        self.tree.search(wanted, visit);
    }

    /// The distance of the nearest copy, if it is at most `bound`, and its index.
    pub(crate) fn nearest(&self, point: &Vector2<f64>, bound: f64) -> Option<(f64, usize)> {
        let distance = |i: usize| {
            let foot = self.all[i].piece.closest(point).point;
            libm::hypot(foot.x - point.x, foot.y - point.y)
        };
        self.tree.nearest(point, bound, distance)
    }

    /// The distance from the boundary, negative outside the table.
    pub(crate) fn signed_distance(&self, point: &Vector2<f64>) -> f64 {
        let Some((d, _)) = self.nearest(point, f64::INFINITY) else { return f64::NEG_INFINITY };
        let mut near = vec![];
        self.search(|e| e.distance(point) <= d * (1.0 + 1e-12), |i| near.push(i));
        let pieces = near.iter().map(|&i| {
            let copy = &self.all[i];
            (copy.number, &*copy.piece)
        });
        if nearest_of(pieces, point).is_some_and(|nearest| nearest.is_outside) { -d } else { d }
    }
}

/// Most translations of one piece. Where a cell is so thin that there would be more, those farther than this many cells away are left
/// out: something nearer is in between.
const MOST: f64 = 1e6;

/// The translations that may bring a box near another one.
fn cells(lattice: &Lattice, moving: &Extent, around: &Extent, reach: f64) -> Vec<[f64; 2]> {
    let (lattice, of_old) = lattice.reduced();
    let mut range = [[0.0, 0.0]; 2];
    for (k, range) in range.iter_mut().enumerate().take(lattice.vectors().len()) {
        let [f, g] = lattice.functional(k);
        let span = |i: usize, h: f64| {
            let (low, high) = (around.min[i] - moving.max[i] - reach, around.max[i] - moving.min[i] + reach);
            if h < 0.0 { [h * high, h * low] } else { [h * low, h * high] }
        };
        let (x, y) = (span(0, f), span(1, g));
        *range = [libm::ceil(x[0] + y[0]), libm::floor(x[1] + y[1])];
    }
    if range.iter().map(|[low, high]| (high - low + 1.0).max(0.0)).product::<f64>() > MOST {
        let side = 0.5 * MOST.sqrt();
        range = range.map(|[low, high]| {
            let middle = libm::rint(0.5 * low + 0.5 * high);
            [low.max(middle - side), high.min(middle + side)]
        });
    }
    multiples(range).map(|[first, second]| [0, 1].map(|i| first * of_old[0][i] + second * of_old[1][i])).collect()
}

/// The box around all finite pieces.
pub(crate) fn finite_extent(pieces: &[Arc<dyn Piece>]) -> Extent {
    pieces.iter().map(Piece::extent).filter(Extent::is_finite).fold(Extent::EMPTY, Extent::union)
}

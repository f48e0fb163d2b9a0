//! How the pieces of a boundary follow each other, corner by corner.
use crate::{Piece, Table, intersect::direction_at, plane::is_finite};
use core::f64::consts::{PI, TAU};
use nalgebra::Vector2;

/// Where one piece ends and the next one starts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Joint {
    pub(crate) before: usize,
    pub(crate) after: usize,
    /// How many of each lattice vector `after` is moved by to start where `before` ends.
    pub(crate) cell: [f64; 2],
    pub(crate) vertex: Vector2<f64>,
}

/// Directions that turn straight back within this (radians) are those of a cusp or of the tip of a slit: a point where curves touch
/// is known only to the square root of rounding, 10⁻⁸.
const CUSP: f64 = 2e-7;

impl Joint {
    /// The angle by which the boundary turns, positive to the left: in (−π, 0) at a re-entrant corner, −π at the tip of
    /// a slit, π in a cusp.
    pub(crate) fn turn(&self, table: &Table) -> f64 {
        let [p, q] = [self.before, self.after].map(|i| &table.pieces()[i]);
        let there = self.vertex - table.shortest().map_or_else(Vector2::zeros, |l| l.translation(self.cell));
        let (n, m) = (p.closest(&self.vertex).normal, q.closest(&there).normal);
        let angle = libm::atan2(n.perp(&m), n.dot(&m));
        if PI - angle.abs() <= CUSP {
            // the sides of a cusp bend apart
            let bend = p.curvature(&self.vertex) + q.curvature(&there);
            return libm::copysign(angle, if bend < 0.0 { 1.0 } else { -1.0 });
        }
        angle
    }
}

/// How a boundary leaves a point, or comes into it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Branch {
    /// Unit vector in the sense of traversal.
    pub(crate) direction: Vector2<f64>,
    pub(crate) curvature: f64,
}

impl Branch {
    pub(crate) fn of(piece: &dyn Piece, point: &Vector2<f64>) -> Branch {
        Branch { direction: direction_at(piece, point), curvature: piece.curvature(point) }
    }
}

/// Directions that differ by less than this (radians) are told apart by curvature: a point where curves touch is known only to the
/// square root of rounding.
const STRAIGHT_BACK: f64 = 1e-6;

/// Which of several branches turns most sharply to the left.
///
/// All of the table near the point that is next to the incoming piece lies between it and the piece found.
pub(crate) fn leftmost(incoming: Branch, outgoing: impl Iterator<Item = Branch>) -> Option<usize> {
    let back = -incoming.direction;
    let clockwise = |out: Branch| {
        let angle = libm::atan2(out.direction.perp(&back), out.direction.dot(&back));
        // straight back: no turn at all in a cusp, whose sides bend apart; a full turn about the tip of a slit
        if angle.abs() <= STRAIGHT_BACK {
            if incoming.curvature + out.curvature < 0.0 { 0.0 } else { TAU }
        } else if angle < 0.0 {
            angle + TAU
        } else {
            angle
        }
    };
    outgoing.map(clockwise).enumerate().min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(k, _)| k)
}

/// The joints of a table; on a lattice also those across cells, for pieces after which none starts within the same cell.
pub(crate) fn joints(table: &Table) -> Vec<Joint> {
    joints_where(table, <[Candidate]>::is_empty)
}

/// The same where translates may touch what starts within a cell, for each part of the table by itself; takes `n²` operations for `n`
/// pieces on a lattice.
pub(crate) fn joints_around_parts(table: &Table) -> Vec<Joint> {
    joints_where(table, |_| true)
}

/// A piece that starts at a vertex, and by how many lattice vectors it is moved.
type Candidate = (usize, [f64; 2]);

/// Joints to what starts within a cell, and across cells if `across` says so for the candidates within it.
fn joints_where(table: &Table, across: impl Fn(&[Candidate]) -> bool) -> Vec<Joint> {
    let pieces = table.pieces();
    let mut starts: Vec<(Vector2<f64>, usize)> = pieces
        .iter()
        .enumerate()
        .filter_map(|(j, p)| p.ends().map(|[a, _]| (a, j)))
        .filter(|(a, _)| is_finite(a))
        .collect();
    let order = |a: &Vector2<f64>, b: &Vector2<f64>| (a.x, a.y).partial_cmp(&(b.x, b.y));
    starts.sort_by(|(a, i), (b, j)| order(a, b).unwrap_or(core::cmp::Ordering::Equal).then(i.cmp(j)));
    let mut found = vec![];
    for (before, piece) in pieces.iter().enumerate() {
        let Some([_, vertex]) = piece.ends().filter(|[_, b]| is_finite(b)) else { continue };
        let first = starts.partition_point(|(a, _)| order(a, &vertex).is_some_and(core::cmp::Ordering::is_lt));
        let mut candidates: Vec<Candidate> =
            starts[first..].iter().take_while(|(a, _)| *a == vertex).map(|&(_, j)| (j, [0.0; 2])).collect();
        if let Some(lattice) = table.shortest().filter(|_| across(&candidates)) {
            let moved = |&(a, j): &(Vector2<f64>, usize)| lattice.between(&a, &vertex).map(|cell| (j, cell));
            let within = candidates.clone();
            candidates.extend(starts.iter().filter_map(moved).filter(|moved| !within.contains(moved)));
        }
        // where several parts of the table touch, each is followed by itself
        let incoming = Branch::of(&**piece, &vertex);
        let start = |&(j, _): &Candidate| pieces[j].ends().map_or(vertex, |[a, _]| a);
        let outgoing = candidates.iter().map(|c| Branch::of(&*pieces[c.0], &start(c)));
        if let Some(k) = leftmost(incoming, outgoing) {
            let (after, cell) = candidates[k];
            found.push(Joint { before, after, cell, vertex });
        }
    }
    found
}

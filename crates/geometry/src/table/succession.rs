//! Which piece of a boundary follows which.
use crate::{
    Error, Lattice, Piece,
    plane::{is_finite, key},
};
use nalgebra::Vector2;
use std::{
    cell::{LazyCell, OnceCell},
    collections::HashSet,
    sync::Arc,
};

/// Two normals that differ by less than this (radians) belong to a smooth joint.
///
/// Rounding of the vertices of a joint meant to be smooth turns the normals by a few ulp of size over length of the
/// shorter piece; no intended corner is this flat.
pub(crate) const SMOOTH: f64 = 1e-9;

/// How pieces are connected.
pub(super) struct Succession {
    /// For each piece, the one that starts where it ends; `None` where only a translate of one does.
    pub(super) next: Vec<Option<usize>>,
    /// The vertices at which the direction of the boundary jumps; both ends of a joint across cells.
    pub(super) corners: Vec<Vector2<f64>>,
}

impl Succession {
    /// # Errors
    /// [`Error::Open`] where a piece ends and none starts, or starts and none ends.
    pub(super) fn of(pieces: &[Arc<dyn Piece>], lattice: Option<&Lattice>) -> Result<Succession, Error> {
        let ends: Vec<Option<[Vector2<f64>; 2]>> = pieces.iter().map(Piece::ends).collect();
        let starts = || ends.iter().enumerate().filter_map(|(i, e)| e.map(|[a, _]| (a, i)));
        let mut following = Following::new(&ends);
        // whether the direction of the boundary jumps from the end of one piece to the start of another
        let kink = |(i, b): (usize, Vector2<f64>), (j, a): (usize, Vector2<f64>)| {
            (pieces[i].closest(&b).normal - pieces[j].closest(&a).normal).norm() > SMOOTH
        };
        let mut next = vec![None; pieces.len()];
        let mut corners = vec![];
        for (i, end) in ends.iter().enumerate() {
            let Some([_, b]) = end else {
                next[i] = Some(i);
                continue;
            };
            if !is_finite(b) {
                continue;
            }
            next[i] = following.after(i, b);
            let translate = |lattice: &Lattice| starts().find(|(a, _)| lattice.between(a, b).is_some());
            if let Some(j) = next[i] {
                if kink((i, *b), (j, *b)) {
                    corners.push(*b);
                }
            } else if let Some((a, j)) = lattice.and_then(translate) {
                if kink((i, *b), (j, a)) {
                    corners.extend([*b, a]);
                }
            } else {
                let gap = starts().map(|(a, _)| (a - b).norm()).fold(f64::INFINITY, f64::min);
                return Err(Error::Open { piece: i, starts: false, gap });
            }
        }
        every_start_is_an_end(&ends, &next, lattice)?;
        Ok(Succession { next, corners })
    }
}

/// Finds which piece starts where another ends.
struct Following<'a> {
    ends: &'a [Option<[Vector2<f64>; 2]>],
    /// The first piece of the loop that is followed.
    head: usize,
    /// All starts in order, computed when first needed.
    sorted: OnceCell<Vec<(Vector2<f64>, usize)>>,
}

impl<'a> Following<'a> {
    fn new(ends: &'a [Option<[Vector2<f64>; 2]>]) -> Self {
        Following { ends, head: 0, sorted: OnceCell::new() }
    }

    /// The piece that starts at `v`, where piece `i` ends: usually the next one, or the first one of the loop that it closes.
    fn after(&mut self, i: usize, v: &Vector2<f64>) -> Option<usize> {
        let starts_there = |j: &usize| self.ends.get(*j).copied().flatten().is_some_and(|[a, _]| a == *v);
        let next = [i + 1, self.head].into_iter().find(starts_there);
        if next != Some(i + 1) {
            self.head = i + 1;
        }
        next.or_else(|| self.anywhere(v))
    }

    fn anywhere(&self, v: &Vector2<f64>) -> Option<usize> {
        let order = |a: &Vector2<f64>, b: &Vector2<f64>| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
        let positive = |v: Vector2<f64>| v.map(|x| x + 0.0); // −0 is 0
        let sorted = self.sorted.get_or_init(|| {
            let starts = self.ends.iter().enumerate().filter_map(|(i, e)| e.map(|[a, _]| (positive(a), i)));
            let mut sorted: Vec<_> = starts.collect();
            sorted.sort_by(|(a, _), (b, _)| order(a, b));
            sorted
        });
        let v = positive(*v);
        sorted.binary_search_by(|(a, _)| order(a, &v)).ok().map(|k| sorted[k].1)
    }
}

/// Fails where a piece starts and none ends: `next` only accounts for ends, and where boundaries touch it may name one piece
/// twice.
fn every_start_is_an_end(
    ends: &[Option<[Vector2<f64>; 2]>],
    next: &[Option<usize>],
    lattice: Option<&Lattice>,
) -> Result<(), Error> {
    let mut has_previous = vec![false; ends.len()];
    for &i in next.iter().flatten() {
        has_previous[i] = true;
    }
    let starts = ends.iter().enumerate().filter_map(|(i, e)| e.map(|[a, _]| (i, a)));
    let unknown = starts.filter(|(i, a)| !has_previous[*i] && is_finite(a));
    let all_ends = || ends.iter().flatten().map(|[_, b]| b);
    let known = LazyCell::new(|| all_ends().map(|b| key(*b)).collect::<HashSet<_>>());
    for (piece, a) in unknown {
        let is_translate = |b: &Vector2<f64>| lattice.is_some_and(|lattice| lattice.between(&a, b).is_some());
        if !known.contains(&key(a)) && !all_ends().any(is_translate) {
            let gap = all_ends().map(|b| (a - b).norm()).filter(|gap| !gap.is_nan()).fold(f64::INFINITY, f64::min);
            return Err(Error::Open { piece, starts: true, gap });
        }
    }
    Ok(())
}

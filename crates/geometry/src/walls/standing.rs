//! Where a vertex of one chain of pieces stands on a wall of another one.
use super::CORNER;
use crate::{BoxTree, Extent, Piece, plane::is_finite};
use nalgebra::Vector2;
use std::sync::Arc;

/// Chains of pieces that follow one another in a list.
struct Chains {
    /// For each piece the number of its chain.
    of: Vec<usize>,
    /// A box around each chain.
    boxes: Vec<Extent>,
    /// All ends of pieces, with the number of the chain.
    vertices: Vec<(usize, Vector2<f64>)>,
}

impl Chains {
    fn of(pieces: &[(usize, Arc<dyn Piece>)]) -> Chains {
        let mut chains = Chains { of: Vec::with_capacity(pieces.len()), boxes: vec![], vertices: vec![] };
        let mut end: Option<Vector2<f64>> = None;
        for (_, piece) in pieces {
            let [start, next] = piece.ends().map_or([None; 2], |ends| ends.map(Some));
            match chains.boxes.last_mut() {
                Some(last) if start.is_some() && start == end => *last = last.union(piece.extent()),
                _ => {
                    chains.vertices.extend(end.map(|end| (chains.boxes.len() - 1, end)));
                    chains.boxes.push(piece.extent());
                }
            }
            let chain = chains.boxes.len() - 1;
            chains.of.push(chain);
            chains.vertices.extend(start.map(|start| (chain, start)));
            end = next;
        }
        chains.vertices.extend(end.map(|end| (chains.boxes.len() - 1, end)));
        chains
    }

    /// The vertices that may lie on another chain.
    fn vertices_on_others(&self, within: impl Fn(&Vector2<f64>) -> f64) -> Vec<(usize, Vector2<f64>)> {
        if self.boxes.len() < 2 {
            return vec![];
        }
        let tree = BoxTree::new(self.boxes.iter().copied());
        let may_meet = |(chain, vertex): &(usize, Vector2<f64>)| {
            let mut found = false;
            tree.search(|e| e.distance(vertex) <= within(vertex), |other| found |= other != *chain);
            is_finite(vertex) && found
        };
        self.vertices.iter().filter(|vertex| may_meet(vertex)).copied().collect()
    }
}

/// Places on walls, and not at their ends, where vertices of other chains stand, with how far from them orbits end \[L\]: such a place is a
/// corner on either side of the vertex, although the wall goes on, with the same tolerance as any other corner.
///
/// Takes `n log n` operations. (A chain that stands on itself is not recognised.)
pub(super) fn standing(pieces: &[(usize, Arc<dyn Piece>)]) -> Vec<(Vector2<f64>, f64)> {
    let chains = Chains::of(pieces);
    let extents = chains.boxes.iter().filter(|e| e.is_finite());
    let size = extents.fold(0.0, |size: f64, e| size.max(e.size()));
    let near = |p: &Vector2<f64>| CORNER * size.max(p.amax());
    let candidates = chains.vertices_on_others(|p| 2.0 * near(p));
    if candidates.is_empty() {
        return vec![];
    }
    let tree = BoxTree::new(pieces.iter().map(|(_, piece)| piece.extent()));
    let stands = |(chain, vertex): &(usize, Vector2<f64>)| {
        // both may be rounded
        let within = 2.0 * near(vertex);
        let is_at = |end: Vector2<f64>| (end - vertex).amax() <= within;
        let bears_it = |piece: &dyn Piece| {
            let goes_on = !piece.has_two_sides() && !piece.ends().into_iter().flatten().any(is_at);
            goes_on && is_at(piece.closest(vertex).point)
        };
        let mut found = false;
        tree.search(|e| e.distance(vertex) <= within, |k| found |= chains.of[k] != *chain && bears_it(&*pieces[k].1));
        found
    };
    candidates.iter().filter(|candidate| stands(candidate)).map(|(_, vertex)| (*vertex, near(vertex))).collect()
}

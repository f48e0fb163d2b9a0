//! Ends that are one vertex but for rounding.
use super::{cuts::part, two_sided::one_side};
use crate::{
    BoxTree, Extent, Figure, Piece,
    plane::{is_finite, key, slack},
};
use nalgebra::Vector2;
use std::{collections::HashSet, sync::Arc};

/// An end or a start that has no counterpart, and the number of its piece.
type Loose = (usize, Vector2<f64>);

/// Where a piece ends, and another one starts, within rounding of one another (16 ulp of the greatest coordinate of any end), and nothing
/// starts or ends exactly there, one of the two pieces is moved to the vertex of the other; returns whether there are such pieces.
///
/// A segment or an arc is moved rather than a ray, which would move as a whole. A curve given by a formula stays where it is.
pub(super) fn unite(pieces: &mut [Arc<dyn Piece>]) -> bool {
    let [starts, stops] = [0, 1].map(|k| loose(pieces, k));
    let coordinates = pieces.iter().filter_map(Piece::ends).flatten().filter(is_finite).flat_map(|p| [p.x, p.y]);
    let near = slack(coordinates);
    let tree = BoxTree::new(starts.iter().map(|&(_, p)| Extent { min: p, max: p }));
    let mut is_taken = vec![false; starts.len()];
    for (i, stop) in stops {
        let here = Extent { min: stop, max: stop };
        let mut nearest: Option<(f64, usize)> = None;
        tree.search(
            |e| e.meets(&here, near),
            |k| {
                let gap = (starts[k].1 - stop).amax();
                if !is_taken[k] && starts[k].0 != i && nearest.is_none_or(|(least, _)| gap < least) {
                    nearest = Some((gap, k));
                }
            },
        );
        if let Some((_, k)) = nearest {
            is_taken[k] = follow(pieces, (i, stop), starts[k]);
        }
    }
    is_taken.contains(&true)
}

/// The finite starts (`k = 0`) or ends (`k = 1`) of pieces at which none ends or starts.
fn loose(pieces: &[Arc<dyn Piece>], k: usize) -> Vec<Loose> {
    let ends = || pieces.iter().enumerate().filter_map(|(i, piece)| Some((i, piece.ends()?)));
    let counterparts: HashSet<[u64; 2]> = ends().map(|(_, ends)| key(ends[1 - k])).collect();
    let own = ends().map(|(i, ends)| (i, ends[k]));
    own.filter(|(_, p)| is_finite(p) && !counterparts.contains(&key(*p))).collect()
}

/// Lets one piece start where another one ends; returns whether one of them could be moved.
fn follow(pieces: &mut [Arc<dyn Piece>], (i, stop): Loose, (j, start): Loose) -> bool {
    let [Some([first, _]), Some([_, last])] = [i, j].map(|k| pieces[k].ends()) else { return false };
    let is_ray = |k: usize| matches!(pieces[k].figure(), Figure::Ray { .. });
    let mut ways = [(i, [first, start]), (j, [stop, last])];
    if is_ray(i) {
        ways.reverse();
    }
    let moved = ways.into_iter().find_map(|(k, ends)| Some((k, part(&*pieces[k], ends).ok()?)));
    moved.is_some_and(|(k, piece)| {
        let piece = Arc::from(piece);
        pieces[k] = if pieces[k].has_two_sides() { one_side(&piece) } else { piece };
        true
    })
}

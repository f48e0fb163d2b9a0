//! Where one curve crosses itself.
use super::{MeetingKind, subdivision::search};
use crate::{BoxTree, Extent, Piece, plane::slack};
use core::f64::consts::PI;
use nalgebra::Vector2;

/// Stretches of a piece that is not known as graphs.
const PARTS: u32 = 32;

/// What turns by less (radians) does not come back to itself, wherever along it that is: by half a turn, but for rounding.
const TURN: f64 = PI - 1e-6;

/// Where two parts of a piece cross, or run along each other, if they do.
///
/// Its stretches bend one way each, where it is known as [graphs](Piece::graphs). Two of them that come near each other may cross if the
/// directions on the way from one to the other are not all within half a turn.
pub(crate) fn self_crossing(piece: &dyn Piece) -> Option<Vector2<f64>> {
    let length = piece.length();
    if !length.is_finite() {
        return None;
    }
    let tolerance = 4.0 * slack([piece.extent().size()]);
    let marks = marks(piece, length);
    let landings: Vec<_> = marks.iter().map(|s| piece.landing_at(*s)).collect();
    let boxes: Vec<Extent> =
        marks.windows(2).zip(landings.windows(2)).map(|(s, ends)| around(s, [0, 1].map(|k| ends[k].point))).collect();
    let mut directions = vec![0.0];
    for ends in landings.windows(2) {
        let [a, b] = [0, 1].map(|k| ends[k].normal);
        directions.push(directions[directions.len() - 1] + libm::atan2(a.perp(&b), a.dot(&b)));
    }
    // the directions at the start and the end of some parts, and of those between; past the end of a closed piece they go on
    let last = boxes.len();
    let turned = directions[last];
    let direction = |k: usize| if k <= last { directions[k] } else { directions[k - last] + turned };
    let turns = |from: usize, to: usize| {
        let all = (from..=to).map(direction);
        let [low, high] = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], d| [low.min(d), high.max(d)]);
        high - low >= TURN
    };
    let is_closed = piece.ends().is_none();
    let may_cross = |i: usize, j: usize| turns(i, j + 1) && (!is_closed || turns(j, last + i + 1));
    let tree = BoxTree::in_order(&boxes);
    let crossing = |i: usize, j: usize| {
        let mut found = vec![];
        search([piece; 2], [i, j].map(|k| [marks[k], marks[k + 1]]), tolerance, &mut found);
        let crosses = |kind| matches!(kind, MeetingKind::Crossing | MeetingKind::Overlap);
        found.iter().find(|m| crosses(m.kind)).map(|m| m.point)
    };
    (0..last).find_map(|i| {
        let mut near = vec![];
        tree.search(|other| other.meets(&boxes[i], tolerance), |j| near.push(j));
        near.into_iter().filter(|&j| i < j && may_cross(i, j)).find_map(|j| crossing(i, j))
    })
}

/// The arc lengths between which a piece is looked at: about where its graphs end.
fn marks(piece: &dyn Piece, length: f64) -> Vec<f64> {
    let Some(graphs) = piece.graphs() else {
        return (0..=PARTS).map(|k| length * (f64::from(k) / f64::from(PARTS))).collect();
    };
    let mut marks = vec![0.0];
    marks.extend(graphs.iter().scan(0.0, |sum, graph| {
        *sum += graph.arc_length();
        Some(*sum)
    }));
    let scale = length / marks[marks.len() - 1];
    marks.iter().map(|s| (s * scale).min(length)).collect()
}

/// A box around a stretch: its points are as far from both of its ends together as it is long, at most.
fn around(s: &[f64], ends: [Vector2<f64>; 2]) -> Extent {
    let length = s[1] - s[0];
    let chord = (ends[1] - ends[0]).norm();
    let height = 0.5 * ((length - chord) * (length + chord)).max(0.0).sqrt();
    let Extent { min, max } = Extent::of(ends);
    Extent { min: min.add_scalar(-height), max: max.add_scalar(height) }
}

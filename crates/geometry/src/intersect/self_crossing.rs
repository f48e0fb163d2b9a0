//! Where one curve crosses itself.
use super::{MeetingKind, subdivision::search};
use crate::{BoxTree, Extent, Piece, plane::slack};
use core::f64::consts::PI;
use nalgebra::Vector2;

/// Number of stretches of a piece that has no graphs.
const PARTS: u32 = 32;

/// A stretch whose direction varies by less than this (radians; half a turn, up to rounding) cannot come back to itself.
const TURN: f64 = PI - 1e-6;

/// Where two parts of a piece cross, or run along each other, if they do.
///
/// Each of its stretches bends in one sense, if it has [graphs](Piece::graphs). Two stretches that come near each other can cross only
/// if the directions on the way from one to the other are not all within half a turn.
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
    // the directions at the ends of the stretches from one to another; past the end of a closed piece they continue
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

/// The arc lengths that separate the stretches: about where the graphs end.
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

/// A box around a stretch: the distances of a point of it from its two ends add up to at most its length.
fn around(s: &[f64], ends: [Vector2<f64>; 2]) -> Extent {
    let length = s[1] - s[0];
    let chord = (ends[1] - ends[0]).norm();
    let height = 0.5 * ((length - chord) * (length + chord)).max(0.0).sqrt();
    let Extent { min, max } = Extent::of(ends);
    Extent { min: min.add_scalar(-height), max: max.add_scalar(height) }
}

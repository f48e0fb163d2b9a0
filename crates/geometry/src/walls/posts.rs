//! Where round walls touch that have the table outside: nothing passes between them.
use crate::{
    BoxTree, Extent, Meeting, MeetingKind, Piece, meetings,
    plane::slack,
    shapes::{Segment, Shape},
};
use nalgebra::Vector2;
use std::sync::Arc;

/// A place where two scatterers touch.
///
/// A path along their common tangent crosses neither of them and would go on between them, where no table is: it ends in the cusp, as
/// in any other. There stands a wall, tiny and straight across the gap, behind which the scatterers are; orbits end at it.
pub(super) struct Post {
    /// Where they touch \[L\].
    pub(super) place: Vector2<f64>,
    /// From there to the end of the wall in the first scatterer \[L\].
    half: Vector2<f64>,
    /// The number of that.
    number: usize,
}

/// Unit normals whose sum is no longer than this are opposite. In a cusp between arcs that end there it is as long as centres and ends
/// are rounded; sides that form a corner of a smaller angle than this (radians) are far apart everywhere but there, too.
const OPPOSITE: f64 = 1e-9;

/// All such places of the pieces with these numbers, where these are parts of circles and ellipses. (Of curves by formulas it would take
/// long to find them.)
pub(super) fn posts(pieces: &[(usize, Arc<dyn Piece>)]) -> Vec<Post> {
    let scatters = |piece: &Arc<dyn Piece>| match piece.shape() {
        Some(Shape::Arc(_) | Shape::Circle(_) | Shape::EllipticArc(_) | Shape::Ellipse(_)) => {
            piece.curvature(&piece.point_at(0.5 * piece.length())) < 0.0
        }
        _ => false,
    };
    let round: Vec<&(usize, Arc<dyn Piece>)> = pieces.iter().filter(|(_, piece)| scatters(piece)).collect();
    let boxes: Vec<_> = round.iter().map(|(_, piece)| piece.extent()).collect();
    // how far such walls reach, and by how much paths that miss both may be off
    let rounding = slack(boxes.iter().map(Extent::size));
    let tree = BoxTree::new(boxes.iter().copied());
    let mut found = vec![];
    for (i, (number, first)) in round.iter().enumerate() {
        let mut near = vec![];
        tree.search(|e| e.meets(&boxes[i], rounding), |j| near.extend((j > i).then_some(j)));
        for (_, second) in near.into_iter().map(|j| round[j]) {
            let pair = [&**first, &**second];
            for Meeting { point, kind, .. } in meetings(pair[0], pair[1]) {
                let place = if kind == MeetingKind::Tangency { refined(pair, point) } else { point };
                let [n, m] = pair.map(|piece| piece.closest(&place).normal);
                if (n + m).norm() <= OPPOSITE {
                    found.push(Post { place, half: -n * rounding, number: *number });
                }
            }
        }
    }
    found
}

/// Where two curves touch, of which that is known to the root of rounding: where their normals are opposite. Along the unit tangent `τ`
/// the sum of these, `n + m`, grows by the curvatures.
fn refined(pair: [&dyn Piece; 2], mut point: Vector2<f64>) -> Vector2<f64> {
    for _ in 0..2 {
        let [a, b] = pair.map(|piece| piece.closest(&point));
        let tangent = Vector2::new(-a.normal.y, a.normal.x);
        let bend: f64 = pair.iter().map(|piece| piece.curvature(&point).abs()).sum();
        point = (a.point + b.point) * 0.5 - tangent * ((a.normal + b.normal).dot(&tangent) / bend);
    }
    point
}

impl Post {
    /// Within this distance \[L\] of the place orbits end: twice what rounding leaves to a path that meets the wall.
    pub(super) fn reach(&self) -> f64 {
        2.0 * self.half.amax()
    }

    /// The wall, as seen from the one side and from the other.
    pub(super) fn faces(&self) -> impl Iterator<Item = (usize, Arc<dyn Piece>)> {
        let ends = [self.place + self.half, self.place - self.half];
        let face = |[a, b]: [Vector2<f64>; 2]| Segment::new(a, b).ok();
        let faces = [face(ends), face([ends[1], ends[0]])].into_iter().flatten();
        faces.map(|face| (self.number, Arc::new(face) as Arc<dyn Piece>))
    }
}

//! Points where round walls with the table outside touch: nothing passes between them.
use crate::{
    BoxTree, Extent, Meeting, MeetingKind, Piece, meetings,
    plane::slack,
    shapes::{Segment, Shape},
};
use nalgebra::Vector2;
use std::sync::Arc;

/// A place where two scatterers touch.
///
/// A path along their common tangent crosses neither of them and would go on between them, where there is no table; it must end in the
/// cusp, as in any other. So a tiny straight wall is placed across the gap, with its ends inside the scatterers, and orbits end at it.
pub(super) struct Post {
    /// Where they touch \[L\].
    pub(super) place: Vector2<f64>,
    /// Vector from there to the end of the wall in the first scatterer \[L\].
    half: Vector2<f64>,
    /// The number of the first scatterer.
    number: usize,
}

/// Unit normals whose sum is no longer than this are opposite. In a cusp between arcs that end there the sum is as long as the rounding
/// of centres and ends; sides that form a corner with an angle smaller than this (radians) are far apart everywhere except there, too.
const OPPOSITE: f64 = 1e-9;

/// All such places of the pieces with these numbers that are parts of circles and ellipses. (For curves given by formulas finding them
/// would take too long.)
pub(super) fn posts(pieces: &[(usize, Arc<dyn Piece>)]) -> Vec<Post> {
    let scatters = |piece: &Arc<dyn Piece>| match piece.shape() {
        Some(Shape::Arc(_) | Shape::Circle(_) | Shape::EllipticArc(_) | Shape::Ellipse(_)) => {
            piece.curvature(&piece.point_at(0.5 * piece.length())) < 0.0
        }
        Some(Shape::Segment(_) | Shape::Screen(_) | Shape::Ray(_) | Shape::Line(_)) | None => false,
    };
    let round: Vec<&(usize, Arc<dyn Piece>)> = pieces.iter().filter(|(_, piece)| scatters(piece)).collect();
    let boxes: Vec<_> = round.iter().map(|(_, piece)| piece.extent()).collect();
    // the half-length of such walls, and the error of paths that may miss both scatterers
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

/// Refines a point where two curves touch, which is known to the square root of rounding: their normals are opposite there. Along the
/// unit tangent `τ` the sum of the normals, `n + m`, changes at the rate of the curvatures.
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
    /// Orbits end within this distance \[L\] of the place: twice the rounding error of a path that meets the wall.
    pub(super) fn reach(&self) -> f64 {
        2.0 * self.half.amax()
    }

    /// The two faces of the wall.
    pub(super) fn faces(&self) -> impl Iterator<Item = (usize, Arc<dyn Piece>)> {
        let ends = [self.place + self.half, self.place - self.half];
        let face = |[a, b]: [Vector2<f64>; 2]| Segment::new(a, b).ok();
        let faces = [face(ends), face([ends[1], ends[0]])].into_iter().flatten();
        faces.map(|face| (self.number, Arc::new(face) as Arc<dyn Piece>))
    }
}

//! Pieces cut at places along them.
use crate::{
    BoxTree, Error, Extent, Figure, Piece,
    parry::piece_of,
    plane::is_finite,
    shapes::{Ellipse, EllipticArc, Shape},
};
use nalgebra::Vector2;

/// Arc length along a piece, and the point there.
pub(super) type Place = (f64, Vector2<f64>);

/// The ends of a piece and the places where it is cut, in order, no two of them equal within rounding; around a closed piece, back to the
/// first.
pub(super) fn stops(piece: &dyn Piece, mut cuts: Vec<Place>, near: f64) -> Vec<Place> {
    cuts.sort_by(|(s, _), (t, _)| s.total_cmp(t));
    let length = piece.length();
    let [first, last] = match (piece.ends(), cuts.first()) {
        (Some([a, b]), _) => {
            let to = if length.is_finite() { length } else { 0.0 };
            [
                (if is_finite(&a) { 0.0 } else { f64::NEG_INFINITY }, a),
                (if is_finite(&b) { to } else { f64::INFINITY }, b),
            ]
        }
        (None, Some(&(s, point))) => [(s, point), (s + length, point)],
        (None, None) => return vec![],
    };
    let mut stops = vec![first];
    for cut in cuts {
        if cut.0 > stops[stops.len() - 1].0 + near && cut.0 < last.0 - near {
            stops.push(cut);
        }
    }
    stops.push(last);
    stops
}

/// Whether [`part`] knows how to make part of a piece: of all but curves given by formulas.
pub(super) fn has_parts(piece: &dyn Piece) -> bool {
    piece.figure() != Figure::Other || ellipse(piece).is_some()
}

/// Part of a piece, between two points of it, as a wall with the table on one side.
///
/// # Errors
/// [`Error::Empty`] for a curve given by a formula; otherwise those of the piece, where the points are equal or not on it.
pub(super) fn part(piece: &dyn Piece, ends: [Vector2<f64>; 2]) -> Result<Box<dyn Piece>, Error> {
    match ellipse(piece) {
        Some(ellipse) => Ok(Box::new(EllipticArc::new(ellipse.one_sided(), ends[0], ends[1])?)),
        None => piece_of(&with_ends(piece.figure(), ends)),
    }
}

/// The ellipse that a piece is, or is an arc of.
fn ellipse(piece: &dyn Piece) -> Option<Ellipse> {
    match piece.shape()? {
        Shape::Ellipse(ellipse) => Some(ellipse),
        Shape::EllipticArc(arc) => Some(*arc.ellipse()),
        _ => None,
    }
}

/// Part of a figure, between two points of it.
pub(crate) fn with_ends(figure: Figure, ends: [Vector2<f64>; 2]) -> Figure {
    let straight = |toward: Vector2<f64>| match ends.map(|end| is_finite(&end)) {
        [true, true] => Figure::Segment { ends },
        [true, false] => Figure::Ray { from: ends[0], direction: toward, left: true },
        [false, true] => Figure::Ray { from: ends[1], direction: -toward, left: false },
        [false, false] => figure,
    };
    match figure {
        Figure::Segment { .. } => Figure::Segment { ends },
        Figure::Ray { direction, left, .. } => straight(if left { direction } else { -direction }),
        Figure::Line { direction, .. } => straight(direction),
        Figure::Arc { center, radius, inside, .. } | Figure::Circle { center, radius, inside } => {
            Figure::Arc { center, radius, ends, inside }
        }
        Figure::Other => Figure::Other,
    }
}

/// Points where pieces are cut, so that all pieces that end at a point share exactly the same one.
pub(super) struct Vertices {
    points: Vec<Vector2<f64>>,
    tree: BoxTree,
    near: f64,
}

impl Vertices {
    pub(super) fn new(points: impl Iterator<Item = Vector2<f64>>, near: f64) -> Vertices {
        let points: Vec<Vector2<f64>> = points.filter(is_finite).collect();
        let tree = BoxTree::new(points.iter().map(|&p| Extent { min: p, max: p }));
        Vertices { points, tree, near }
    }

    /// The first of the points that equal this one up to rounding, or else this one.
    pub(super) fn snap(&self, point: Vector2<f64>) -> Vector2<f64> {
        let here = Extent { min: point, max: point };
        let mut first = None;
        if is_finite(&point) {
            self.tree
                .search(|e| e.meets(&here, self.near), |k| first = Some(first.map_or(k, |known: usize| known.min(k))));
        }
        first.map_or(point, |k| self.points[k])
    }
}

//! One side of a wall with the table on both sides.
use crate::{Crossing, Extent, Landing, Line, Piece, plane::slack};
use nalgebra::Vector2;
use std::sync::Arc;

/// A piece of a wall with the table on both sides, the other side of which is another, coincident piece: a path that starts on the wall,
/// within rounding, and moves to the other side counts as being there already, and does not cross it.
#[derive(Clone, Debug)]
pub(crate) struct OneSide {
    piece: Arc<dyn Piece>,
    /// How far inside a start must lie to cross.
    inside: f64,
    /// The size of the piece.
    size: f64,
}

/// A path with a hit farther away than this fraction of the size did not start on the wall, unless it grazes it to rounding.
const FAR: f64 = 1e-3;

impl OneSide {
    pub(crate) fn new(piece: Arc<dyn Piece>) -> OneSide {
        let size = piece.extent().size();
        OneSide { piece, inside: 0.5 * slack([size]), size }
    }
}

impl Piece for OneSide {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        let crossing = self.piece.crossing(path);
        if crossing.time() * path.velocity.norm() > FAR * self.size {
            return crossing;
        }
        let foot = self.piece.closest(&path.point);
        let from_behind =
            (path.point - foot.point).dot(&foot.normal) < self.inside && path.velocity.dot(&foot.normal) <= 0.0;
        if from_behind { Crossing::NEVER } else { crossing }
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        self.piece.landing(path, time)
    }
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        self.piece.curvature(point)
    }
    fn length(&self) -> f64 {
        self.piece.length()
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        self.piece.point_at(s)
    }
    fn landing_at(&self, s: f64) -> Landing {
        self.piece.landing_at(s)
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        self.piece.arc_length_at(point)
    }
    fn arc_length_of(&self, landing: &Landing) -> f64 {
        self.piece.arc_length_of(landing)
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        self.piece.closest(point)
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        self.piece.ends()
    }
    fn extent(&self) -> Extent {
        self.piece.extent()
    }
    fn area(&self) -> f64 {
        self.piece.area()
    }
    fn has_two_sides(&self) -> bool {
        true
    }
    fn shift(&self) -> f64 {
        self.piece.shift()
    }
    fn tips(&self) -> Option<[Vector2<f64>; 2]> {
        self.piece.tips()
    }
}

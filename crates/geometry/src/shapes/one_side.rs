//! One side of a wall with the table on both sides.
use crate::{Crossing, Extent, Landing, Line, Piece, plane::slack};
use nalgebra::Vector2;
use std::sync::Arc;

/// A piece of a wall with the table on both sides, the other side of which is another, coincident piece: a path that starts on the wall,
/// within rounding, and moves to the other side counts as being there already, and does not cross it there; it may cross the same piece
/// farther on.
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

/// A path that lies this many times [`OneSide::inside`] behind the wall has left it: eight times what counts as rounding of the piece's own
/// coordinates, since that of its centre or base may be a few times as large.
const CLEAR: f64 = 16.0;

impl OneSide {
    pub(crate) fn new(piece: Arc<dyn Piece>) -> OneSide {
        let size = piece.extent().size();
        OneSide { piece, inside: 0.5 * slack([size]), size }
    }
}

/// How far a path goes from a point on a wall of curvature `κ`, at an angle of sine `descent` behind it, until it lies so deep behind it:
/// `descent s + κ s²/2 = depth`. Where the wall bends away so soon that the path never does, until it has come back and lies as high
/// before it.
fn way_to_leave(descent: f64, curvature: f64, depth: f64) -> f64 {
    let [square, bend] = [descent * descent, 2.0 * curvature * depth];
    if square + bend >= 0.0 {
        2.0 * depth / (descent + (square + bend).sqrt())
    } else {
        (descent + (square - bend).sqrt()) / -curvature
    }
}

impl Piece for OneSide {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        let crossing = self.piece.crossing(path);
        let speed = path.velocity.norm();
        if crossing.time() * speed > FAR * self.size {
            return crossing;
        }
        let foot = self.piece.closest(&path.point);
        let (height, descent) = ((path.point - foot.point).dot(&foot.normal), -path.velocity.dot(&foot.normal) / speed);
        let clear = CLEAR * self.inside;
        if !(-clear..self.inside).contains(&height) || descent < 0.0 {
            return crossing;
        }
        let left = way_to_leave(descent, self.piece.curvature(&foot.point), clear) / speed;
        if crossing.time() > left {
            return crossing;
        }
        // a path that never leaves the wall runs along it
        if !left.is_finite() {
            return Crossing::NEVER;
        }
        let onwards = self.piece.crossing(&Line { point: path.at(left), ..*path });
        Crossing { num: left + onwards.time(), den: 1.0 }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_a_path_has_left_a_wall_it_lies_so_deep_behind_it_or_has_come_back_before_it() {
        let depth = 1e-14;
        for curvature in [-2.0, -1e-3, 0.0, 1e-3, 2.0] {
            for descent in [0.0, 1e-16, 1e-12, 1e-8, 1e-6, 0.5] {
                let way = way_to_leave(descent, curvature, depth);
                if descent == 0.0 && curvature == 0.0 {
                    assert_eq!(way, f64::INFINITY);
                    continue;
                }
                // so shallow a path comes back from a wall that bends after it
                let comes_back = descent * descent < -2.0 * curvature * depth;
                let expected = if comes_back { -depth } else { depth };
                let behind = descent * way + 0.5 * curvature * way * way;
                assert!(
                    way > 0.0 && (behind - expected).abs() < 1e-12 * depth.max(descent * way),
                    "{descent} {curvature}"
                );
            }
        }
    }
}

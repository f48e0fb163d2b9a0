//! Walls in a frame of their own.
use super::{WallHit, Walls};
use crate::Error;
use lanes::Lane;
use nalgebra::Vector2;

/// Walls described in a frame that is turned about the origin.
#[derive(Clone, Debug)]
pub struct Rotated<W> {
    walls: W,
    /// The first axis of the walls' frame, of unit length.
    axis: [f64; 2],
}

impl<W> Rotated<W> {
    /// `walls` with their first axis along `axis`, of any length but 0.
    ///
    /// # Errors
    /// [`Error::ZeroLength`] if `axis` is zero.
    pub fn new(walls: W, axis: Vector2<f64>) -> Result<Self, Error> {
        let length = libm::hypot(axis.x, axis.y);
        if length > 0.0 && length.is_finite() {
            Ok(Rotated { walls, axis: [axis.x / length, axis.y / length] })
        } else {
            Err(Error::ZeroLength)
        }
    }
}

impl<W: Walls<2>> Walls<2> for Rotated<W> {
    fn is_delicate(&self) -> bool {
        self.walls.is_delicate()
    }

    fn rounds_normals(&self) -> bool {
        self.walls.rounds_normals()
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let [c, s] = self.axis;
        let into = |a: &[F; 2]| [a[0] * c + a[1] * s, a[1] * c - a[0] * s];
        let back = |a: &[F; 2]| [a[0] * c - a[1] * s, a[0] * s + a[1] * c];
        let hit = self.walls.first_hit(&into(x), &into(v));
        WallHit { point: back(&hit.point), normal: back(&hit.normal), ..hit }
    }
}

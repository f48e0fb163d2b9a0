//! The composite wall around obstacles, of any kind.
use super::{ConvexPolygon, Cuboid, Rotated, Sphere, WallHit, Walls};
use lanes::Lane;

/// A composite wall around something, or with sides of several pieces.
///
/// The kind costs a branch that always goes the same way, and the same code serves all: compiled for each kind, with all that may
/// lie within, it would be several times as large.
#[derive(Clone, Debug)]
pub enum Hull {
    /// A rectangle along the axes.
    Rectangle(Cuboid<2>),
    /// Any other convex polygon.
    Convex(ConvexPolygon),
    /// A stadium.
    Capsule(Rotated),
    /// A disk.
    Disk(Sphere<2>),
}

impl Walls<2> for Hull {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        match self {
            Hull::Rectangle(walls) => walls.first_hit(x, v),
            Hull::Convex(walls) => walls.first_hit(x, v),
            Hull::Capsule(walls) => walls.first_hit(x, v),
            Hull::Disk(walls) => walls.first_hit(x, v),
        }
    }
}

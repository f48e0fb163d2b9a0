//! The composite wall around balls in space, of any kind.
use super::{Cuboid, Cylinder, Slab, Sphere, WallHit, Walls};
use lanes::Lane;

/// A composite wall around something in space.
///
/// The kind costs a branch that always goes the same way, and the same code serves all, as in
/// [`Hull`](super::Hull).
#[derive(Clone, Debug)]
pub enum Vessel {
    /// A ball.
    Ball(Sphere<3>),
    /// A cylinder with flat ends.
    Cylinder(Cylinder),
    /// A box along the axes.
    Box(Cuboid<3>),
    /// The space between two planes perpendicular to the first axis.
    Slab1(Slab<3, 0>),
    /// Perpendicular to the second.
    Slab2(Slab<3, 1>),
    /// Perpendicular to the third.
    Slab3(Slab<3, 2>),
}

impl Walls<3> for Vessel {
    fn rounds_normals(&self) -> bool {
        matches!(self, Vessel::Cylinder(walls) if walls.rounds_normals())
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 3], v: &[F; 3]) -> WallHit<F, 3> {
        match self {
            Vessel::Ball(walls) => walls.first_hit(x, v),
            Vessel::Cylinder(walls) => walls.first_hit(x, v),
            Vessel::Box(walls) => walls.first_hit(x, v),
            Vessel::Slab1(walls) => walls.first_hit(x, v),
            Vessel::Slab2(walls) => walls.first_hit(x, v),
            Vessel::Slab3(walls) => walls.first_hit(x, v),
        }
    }
}

//! Whatever composite wall encloses the particle.
use super::{Capsule, ConvexPolygon, Cuboid, Rotated, Slab, Sphere, WallHit, Walls, Wedge, Zonogon};
use lanes::Lane;

/// A composite convex wall of any kind.
///
/// By itself each is asked as what it is. Where something comes before it or after it, which kind it is costs a branch that is always
/// the same, and one code serves all.
#[derive(Clone, Debug)]
pub enum Hull {
    /// Between two level lines.
    Level(Slab<2, 1>),
    /// Between two upright lines.
    Upright(Slab<2, 0>),
    /// A rectangle along the axes.
    Rectangle(Cuboid<2>),
    /// A hexagon with a centre of symmetry.
    Hexagon(Zonogon<3>),
    /// Any other convex polygon.
    Convex(ConvexPolygon),
    /// A wedge.
    Wedge(Wedge),
    /// A stadium along the first axis.
    Capsule(Capsule),
    /// A stadium askew.
    RotatedCapsule(Rotated),
    /// A disk.
    Disk(Sphere<2>),
}

impl Walls<2> for Hull {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        match self {
            Hull::Level(walls) => walls.first_hit(x, v),
            Hull::Upright(walls) => walls.first_hit(x, v),
            Hull::Rectangle(walls) => walls.first_hit(x, v),
            Hull::Hexagon(walls) => walls.first_hit(x, v),
            Hull::Convex(walls) => walls.first_hit(x, v),
            Hull::Wedge(walls) => walls.first_hit(x, v),
            Hull::Capsule(walls) => walls.first_hit(x, v),
            Hull::RotatedCapsule(walls) => walls.first_hit(x, v),
            Hull::Disk(walls) => walls.first_hit(x, v),
        }
    }
}

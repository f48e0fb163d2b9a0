//! A stadium that lies askew.
use super::{Capsule, WallHit, Walls};
use crate::{Error, plane};
use lanes::Lane;
use nalgebra::Vector2;

/// A capsule turned about its centre: far from the origin, too, coordinates are rounded once.
#[derive(Clone, Debug)]
pub struct Rotated {
    capsule: Capsule,
    /// Along the capsule, of unit length.
    axis: [f64; 2],
}

impl Rotated {
    /// `capsule`, whose centre stays where it is, along `axis`, of any length but 0.
    ///
    /// # Errors
    /// [`Error::ZeroLength`] if `axis` is zero.
    pub fn new(capsule: Capsule, axis: Vector2<f64>) -> Result<Self, Error> {
        let (axis, _) = plane::direction([0.0; 2], axis.into()).ok_or(Error::ZeroLength)?;
        Ok(Rotated { capsule, axis })
    }
}

impl Walls<2> for Rotated {
    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let ([c, s], [c1, c2]) = (self.axis, self.capsule.center());
        let into = |a: &[F; 2]| [a[0] * c + a[1] * s, a[1] * c - a[0] * s];
        let back = |a: &[F; 2]| [a[0] * c - a[1] * s, a[0] * s + a[1] * c];
        let hit = self.capsule.first_hit_from_center(into(&[x[0] - c1, x[1] - c2]), &into(v));
        let [p1, p2] = back(&hit.point);
        WallHit { point: [p1 + c1, p2 + c2], normal: back(&hit.normal), ..hit }
    }
}

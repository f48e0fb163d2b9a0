//! A rotated stadium.
use super::{Capsule, WallHit, Walls};
use crate::{Error, plane};
use lanes::Lane;
use nalgebra::Vector2;

/// A capsule turned about its centre; coordinates are rounded only once even far from the origin.
#[derive(Clone, Debug)]
pub struct Rotated {
    capsule: Capsule,
    /// Along the capsule, of unit length.
    axis: [f64; 2],
}

impl Rotated {
    /// `capsule` turned about its centre to lie along `axis`, of any length but 0.
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
        let ([c, s], center) = (self.axis, self.capsule.center());
        let hit = self.capsule.first_hit_from_center(turned(center.sees(x), [c, -s]), &turned(*v, [c, -s]));
        let point = center.seen(&turned(hit.point, [c, s]));
        WallHit { point, normal: turned(hit.normal, [c, s]), ..hit }
    }
}

/// A vector turned by the angle with this cosine and sine.
///
/// Not a closure: a closure that is not inlined is compiled without the wider instruction set, and calls a function for
/// each product in lanes.
#[inline(always)]
fn turned<F: Lane>([x, y]: [F; 2], [c, s]: [f64; 2]) -> [F; 2] {
    [x * c - y * s, y * c + x * s]
}

//! A box.
use super::{Core, View};
use crate::{
    Error, Extent,
    parry::convert::{Frame, from_glam3},
    plane::has_square,
};
use nalgebra::Vector3;
use parry3d_f64::shape::Cuboid;

/// A box: its centre, its axes, and half of each edge.
#[derive(Debug)]
pub(super) struct Brick {
    center: Vector3<f64>,
    axes: [Vector3<f64>; 3],
    half: [f64; 3],
}

impl Brick {
    pub(super) fn new(cuboid: &Cuboid, frame: &Frame<3>) -> Result<Brick, Error> {
        let half: [f64; 3] = from_glam3(cuboid.half_extents).into();
        half.iter().try_for_each(|&x| has_square("an edge", 2.0 * x))?;
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()].map(|e| frame.direction(&e));
        Ok(Brick { center: frame.translation, axes, half })
    }

    /// Per axis, the distance of a point beyond a side, and the outward normal of that side.
    fn beyond(&self, x: &Vector3<f64>) -> [(f64, Vector3<f64>); 3] {
        let w = x - self.center;
        core::array::from_fn(|i| {
            let along = self.axes[i].dot(&w);
            (along.abs() - self.half[i], self.axes[i] * 1.0_f64.copysign(along))
        })
    }

    /// The side that is farthest out.
    fn outmost(beyond: [(f64, Vector3<f64>); 3]) -> View {
        let [first, second, third] = beyond.map(|(height, normal)| View { height, normal });
        let outer = if second.height > first.height { second } else { first };
        if third.height > outer.height { third } else { outer }
    }
}

impl Core for Brick {
    fn outer(&self, x: &Vector3<f64>) -> View {
        let beyond = self.beyond(x);
        let outside = beyond.iter().filter(|(by, _)| *by > 0.0);
        // beyond a single side the surface is flat
        if outside.clone().count() < 2 {
            return Brick::outmost(beyond);
        }
        let away = outside.map(|(by, normal)| normal * *by).sum();
        View::around(away).unwrap_or_else(|| Brick::outmost(beyond))
    }

    fn inner(&self, x: &Vector3<f64>) -> Option<View> {
        let side = Brick::outmost(self.beyond(x));
        (side.height <= 0.0).then_some(side)
    }

    fn extent(&self) -> Extent<3> {
        let reach: Vector3<f64> = (0..3).map(|i| self.axes[i].abs() * self.half[i]).sum();
        Extent { min: self.center - reach, max: self.center + reach }
    }
}

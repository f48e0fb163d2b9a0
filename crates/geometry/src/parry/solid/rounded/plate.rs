//! A flat triangle, without thickness except for its border.
use super::{
    Core, View,
    facet::{Facet, Foot},
};
use crate::Extent;
use nalgebra::Vector3;

/// A triangle, seen from both of its sides.
#[derive(Clone, Copy, Debug)]
pub(in crate::parry) struct Plate(Facet);

impl Plate {
    /// The triangle with these corners and this unit normal of its plane.
    pub(in crate::parry::solid) fn new(corners: [Vector3<f64>; 3], normal: Vector3<f64>) -> Plate {
        Plate(Facet::new(corners, normal))
    }

    /// What of it is nearest to a point.
    pub(super) fn foot(&self, x: &Vector3<f64>) -> Foot {
        self.0.either(x).1
    }
}

impl Core for Plate {
    fn outer(&self, x: &Vector3<f64>) -> View {
        self.0.either(x).0
    }

    fn inner(&self, _: &Vector3<f64>) -> Option<View> {
        None
    }

    fn extent(&self) -> Extent<3> {
        self.0.extent()
    }
}

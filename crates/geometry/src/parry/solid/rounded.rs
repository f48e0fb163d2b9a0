//! Convex solids with a border of constant width: the first hit to the last digits.
//!
//! The distance from a convex core is a convex function along any line. So Newton's method converges from one side to where this
//! distance equals the width of the border, and never oversteps: from before the entry of the path, or from beyond its exit. The
//! core is given by its faces, edges and corners, so that distance and normal come from formulas.
mod brick;
mod facet;
mod hull;
mod lathe;
mod plate;

use super::{
    super::{
        Side,
        convert::{Frame, from_glam3},
        mesh::across,
        polytope::Polytope,
    },
    Closest, unsupported,
};
use crate::{Error, Extent, Line, plane::LENGTHS};
use brick::Brick;
use core::fmt::Debug;
use hull::Hull;
use lathe::Lathe;
use nalgebra::Vector3;
use parry3d_f64::shape::{Cone, Cuboid, Cylinder, Triangle};

pub(super) use facet::Foot;
pub(in crate::parry) use plate::Plate;

/// A surface as seen from a point: the height of the point above it, negative below, and the outward unit normal at the foot.
#[derive(Clone, Copy, Debug)]
pub(in crate::parry) struct View {
    pub(super) height: f64,
    pub(super) normal: Vector3<f64>,
}

impl View {
    /// The view of a point, an edge, or anything else whose section in a plane containing `away` is a point; `away` leads from
    /// it to the viewer.
    fn around(away: Vector3<f64>) -> Option<View> {
        let height = away.norm();
        (height > 0.0).then(|| View { height, normal: away / height })
    }
}

/// A convex set.
pub(in crate::parry) trait Core: Debug + Send + Sync {
    /// Its surface, seen from outside.
    fn outer(&self, x: &Vector3<f64>) -> View;
    /// Its surface, seen from inside, if the point lies inside.
    fn inner(&self, x: &Vector3<f64>) -> Option<View>;
    /// A box around it.
    fn extent(&self) -> Extent<3>;
}

impl Core for Box<dyn Core> {
    fn outer(&self, x: &Vector3<f64>) -> View {
        (**self).outer(x)
    }
    fn inner(&self, x: &Vector3<f64>) -> Option<View> {
        (**self).inner(x)
    }
    fn extent(&self) -> Extent<3> {
        (**self).extent()
    }
}

/// All points within a radius of a convex core.
#[derive(Debug)]
pub(super) struct Rounded<C = Box<dyn Core>> {
    core: C,
    radius: f64,
    extent: Extent<3>,
    /// Within this distance of the surface the next step of Newton's method is the last: it leaves an error of a quarter of an
    /// ulp where the path goes sixteen ulp deep, and less where it goes deeper.
    near: f64,
}

/// More steps than any path needs: at grazing incidence each step halves the distance from the hit, for which 10⁻⁸ of the size
/// is as good as 0.
const MOST_STEPS: usize = 200;

impl Rounded {
    pub(super) fn cuboid(inner: &Cuboid, radius: f64, frame: &Frame<3>) -> Result<Rounded, Error> {
        Rounded::new(Box::new(Brick::new(inner, frame)?), radius)
    }
    pub(super) fn cylinder(inner: &Cylinder, radius: f64, frame: &Frame<3>) -> Result<Rounded, Error> {
        Rounded::new(Box::new(Lathe::cylinder(inner, frame)?), radius)
    }
    pub(super) fn cone(inner: &Cone, radius: f64, frame: &Frame<3>) -> Result<Rounded, Error> {
        Rounded::new(Box::new(Lathe::cone(inner, frame)?), radius)
    }
    pub(super) fn polytope(inner: &Polytope, radius: f64, frame: &Frame<3>) -> Result<Rounded, Error> {
        Rounded::new(Box::new(Hull::new(inner, frame)), radius)
    }
    pub(super) fn triangle(inner: &Triangle, radius: f64, frame: &Frame<3>) -> Result<Rounded, Error> {
        let corners = [inner.a, inner.b, inner.c].map(|p| frame.point(&from_glam3(p)));
        let (normal, _) = across(corners);
        let length = normal.norm();
        if !(length > 0.0 && length.is_finite()) {
            return Err(unsupported("round triangle", "its corners lie on a line: use a capsule"));
        }
        Rounded::new(Box::new(Plate::new(corners, normal / length)), radius)
    }
}

impl Rounded<Plate> {
    /// A triangle with these corners and this unit normal of its plane.
    pub(super) fn plate(corners: [Vector3<f64>; 3], normal: Vector3<f64>, radius: f64) -> Result<Self, Error> {
        Rounded::new(Plate::new(corners, normal), radius)
    }

    /// What of the triangle is nearest to a point.
    pub(super) fn foot(&self, x: &Vector3<f64>) -> Foot {
        self.core.foot(x)
    }
}

impl<C: Core> Rounded<C> {
    fn new(core: C, radius: f64) -> Result<Self, Error> {
        // its square is nowhere needed, so a border may be as narrow as one likes
        if !(radius > 0.0 && radius <= *LENGTHS.end()) {
            return Err(Error::Length { name: "the border radius", must: "positive and at most 1e150", value: radius });
        }
        let Extent { min, max } = core.extent();
        let border = Vector3::repeat(radius);
        let extent = Extent { min: min - border, max: max + border };
        let near = 4.0 * f64::EPSILON * extent.size();
        Ok(Rounded { core, radius, extent, near })
    }

    /// A box around it.
    pub(super) fn extent(&self) -> Extent<3> {
        self.extent
    }

    /// The surface, seen from outside the core.
    fn view(&self, x: &Vector3<f64>) -> View {
        let View { height, normal } = self.core.outer(x);
        View { height: height - self.radius, normal }
    }

    /// The same from the position of a path at a time, corrected for the rounding of that position.
    fn on_path(&self, path: &Line<3>, time: f64) -> View {
        let [x, rest] = path.at_exactly(time);
        let View { height, normal } = self.view(&x);
        View { height: height + normal.dot(&rest), normal }
    }

    /// When the path crosses the surface out of the table.
    pub(super) fn first(&self, path: &Line<3>, side: Side) -> Option<f64> {
        match side {
            Side::Outside => self.enters(path, f64::INFINITY),
            Side::Inside => Some(self.leaves(path)),
        }
    }

    /// When the path comes in from outside, unless that is later than `limit`.
    pub(super) fn enters(&self, path: &Line<3>, limit: f64) -> Option<f64> {
        let mut time = 0.0;
        for _ in 0..MOST_STEPS {
            let View { height, normal } = self.on_path(path, time);
            let speed = -normal.dot(&path.velocity);
            if !(speed > 0.0) {
                return None;
            }
            let next = time + height / speed;
            if height <= self.near || next <= time {
                return Some(next.max(0.0));
            }
            if next > limit {
                return None;
            }
            time = next;
        }
        Some(time)
    }

    fn leaves(&self, path: &Line<3>) -> f64 {
        // a point beyond the box, wherever inside it the path starts
        let Extent { min: low, max: high } = &self.extent;
        let mut time = 2.0 * (high - low).norm() / path.velocity.norm();
        for _ in 0..MOST_STEPS {
            let View { height, normal } = self.on_path(path, time);
            let speed = normal.dot(&path.velocity);
            // the path runs beside the shape: it starts on the surface and touches it there
            if !(speed > 0.0) {
                return 0.0;
            }
            let next = time - height / speed;
            if height <= self.near || next >= time {
                return next.max(0.0);
            }
            time = next;
        }
        time.max(0.0)
    }

    /// A point projected onto the surface, and the outward normal there.
    pub(super) fn land(&self, x: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let View { height, normal } = self.view(x);
        (x - normal * height, normal)
    }

    /// The distance \[L\] of a point from the core.
    pub(super) fn core_distance(&self, x: &Vector3<f64>) -> f64 {
        self.core.outer(x).height
    }

    /// The surface as seen from anywhere.
    pub(super) fn closest(&self, x: &Vector3<f64>, side: Side) -> Closest {
        let View { height, normal } = self.core.inner(x).unwrap_or_else(|| self.core.outer(x));
        let height = height - self.radius;
        let sign = if side == Side::Outside { 1.0 } else { -1.0 };
        Closest { distance: sign * height, point: x - normal * height, normal: normal * sign }
    }
}

//! A planar boundary of which only the distance is known.
use super::{
    Side,
    convert::{Frame, from_glam2, to_glam2},
    distance::{Distance, Field},
    outer::projected,
    traced::Traced,
};
use crate::{Crossing, Error, Extent, Landing, Line, Piece, plane::cross};
use core::fmt;
use nalgebra::Vector2;
use parry2d_f64::{math::Vector as Glam, shape::Shape};
use std::sync::OnceLock;

/// The boundary of any shape that can project points onto itself: one of parry's, or your own `impl Shape`.
///
/// Only `project_local_point` (with `solid = false`), `compute_local_aabb`, `scale_dyn` and `clone_dyn` of the shape are
/// used, and of a convex one its support map: such shapes are queried only from outside, since parry's projection by support map is
/// unreliable elsewhere. Crossings are certified to be the first ones, with the error of the projection divided by the sine of the angle of
/// incidence, and normals are accurate to about 10⁻¹³. Closer to a corner than 10⁻⁵ of the shape's size no normal can be determined, and a
/// path that leaves the wall there may hit it again at once. A crossing costs some fifty projections.
///
/// Arc length comes from the outline traced on a grid of 256 cells across the shape and refined to 10⁻¹² of its size,
/// or 10⁻⁸ per corner; loops smaller than a cell are hit but not measured. A shape with several loops is one piece: `s` runs through one loop after
/// another. A shape without an inside, or an infinite one, has no arc length: it is NaN. Curvature is a difference of normals, accurate to
/// about 10⁻⁸ away from corners.
pub struct DistancePiece {
    distance: Distance<2>,
    traced: OnceLock<Traced>,
}

impl fmt::Debug for DistancePiece {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("DistancePiece").field(&self.distance).finish()
    }
}

impl DistancePiece {
    pub(crate) fn new(shape: &dyn Shape, frame: &Frame<2>, side: Side) -> Result<DistancePiece, Error> {
        let own = Planar { shape: shape.clone_dyn() };
        let scale = Distance::unit(&own.extent());
        // parry's own shapes fail below size 1e-8; a shape that cannot be scaled is used as it is
        let scaled = shape.scale_dyn(Glam::splat(scale), 20);
        let distance = match scaled {
            Some(shape) => Distance::new(Box::new(Planar { shape }), *frame, scale, side),
            None => Distance::new(Box::new(own), *frame, 1.0, side),
        };
        let Extent { min, max } = distance.extent();
        if min.iter().zip(&max).any(|(low, high)| low.is_nan() || high.is_nan() || low > high) {
            return Err(Error::Shape { shape: "shape", why: "its bounding box is empty or not a number" });
        }
        Ok(DistancePiece { distance, traced: OnceLock::new() })
    }

    /// Distance from the boundary \[L\], positive in the table and negative outside.
    pub fn distance(&self, point: &Vector2<f64>) -> f64 {
        self.distance.probe(point).distance
    }

    fn traced(&self) -> &Traced {
        self.traced.get_or_init(|| Traced::new(&self.distance))
    }

    /// Curvature from the turn of the normal over a stretch of half-length `h`.
    fn turn(&self, at: &Landing, h: f64) -> f64 {
        let tangent = Vector2::new(at.normal.y, -at.normal.x);
        let [before, after] = [-h, h].map(|h| self.closest(&(at.point + tangent * h)));
        let chord = (after.point - before.point).norm();
        // chord = 2 sin(φ/2)/κ on a circle
        let sine = cross(before.normal.into(), after.normal.into());
        let angle = libm::asin(sine.clamp(-1.0, 1.0));
        2.0 * libm::sin(0.5 * angle) / chord
    }
}

/// A parry shape as a field of distances.
struct Planar {
    shape: Box<dyn Shape>,
}

impl fmt::Debug for Planar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.shape.shape_type())
    }
}

impl Field<2> for Planar {
    fn project(&self, x: &Vector2<f64>) -> (Vector2<f64>, bool) {
        let projection = self.shape.project_local_point(to_glam2(x), false);
        let support =
            self.shape.as_support_map().map(|s| move |n: &Vector2<f64>| from_glam2(s.local_support_point(to_glam2(n))));
        projected(x, (from_glam2(projection.point), projection.is_inside), support)
    }
    fn extent(&self) -> Extent {
        let extent = self.shape.compute_local_aabb();
        Extent { min: from_glam2(extent.mins), max: from_glam2(extent.maxs) }
    }
    fn is_convex(&self) -> bool {
        self.shape.is_convex() || self.shape.as_support_map().is_some()
    }
}

impl Piece for DistancePiece {
    fn crossing(&self, path: &Line<2>) -> Crossing {
        self.distance.first(path).map_or(Crossing::NEVER, |time| Crossing { num: time, den: 1.0 })
    }
    fn landing(&self, path: &Line<2>, time: f64) -> Landing {
        self.closest(&path.at(time))
    }
    fn curvature(&self, point: &Vector2<f64>) -> f64 {
        let at = self.closest(point);
        let Extent { min, max } = self.distance.extent();
        // the extrapolated quotient has an error of h⁴ in its scale and a rounding error divided by h: both about 10⁻¹²
        let h = 1e-3 * (max - min).norm();
        (4.0 * self.turn(&at, 0.5 * h) - self.turn(&at, h)) / 3.0
    }
    fn length(&self) -> f64 {
        self.traced().length()
    }
    fn point_at(&self, s: f64) -> Vector2<f64> {
        self.traced().point_at(&self.distance, s)
    }
    fn arc_length_at(&self, point: &Vector2<f64>) -> f64 {
        self.traced().arc_length_at(&self.closest(point))
    }
    fn closest(&self, point: &Vector2<f64>) -> Landing {
        let (point, normal, _) = self.distance.closest(point);
        Landing { point, normal }
    }
    fn ends(&self) -> Option<[Vector2<f64>; 2]> {
        None
    }
    fn extent(&self) -> Extent {
        self.distance.extent()
    }
    fn area(&self) -> f64 {
        self.traced().area()
    }
}

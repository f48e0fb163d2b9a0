//! Shapes in space as plain data, as scene files have them.
mod parallel;
mod rims;
mod wires;

use super::{
    Side, Solid,
    convert::{Frame, to_glam3},
    distance::to_unit,
};
use crate::{Error, plane::slack};
use nalgebra::{Matrix3, Vector3};
use parry3d_f64::{
    math::Vector as Glam,
    shape::{Ball, Capsule, Cone, ConvexPolyhedron, Cuboid, Cylinder, HalfSpace, RoundShape, Shape, TriMesh},
};

/// A shape in space as plain data: what `shape = { … }` in a scene file says.
///
/// Lengths \[L\]. Shapes with a size are centred at the origin; `rounding` is the radius of a ball that rolls around the
/// shape, 0 for none.
#[derive(Clone, Debug, PartialEq)]
pub enum SolidSpec {
    /// All points within `radius` of the origin.
    Ball {
        /// Radius.
        radius: f64,
    },
    /// A box with edges along the axes.
    Cuboid {
        /// Lengths of its edges.
        size: [f64; 3],
        /// Rounding.
        rounding: f64,
    },
    /// All points within `radius` of a segment.
    Capsule {
        /// One end of the segment.
        from: [f64; 3],
        /// The other end.
        to: [f64; 3],
        /// Radius.
        radius: f64,
    },
    /// A cylinder with its axis along x₃.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Height.
        height: f64,
        /// Rounding.
        rounding: f64,
    },
    /// A cone with its axis along x₃, apex up.
    Cone {
        /// Radius of its base.
        radius: f64,
        /// Height.
        height: f64,
        /// Rounding.
        rounding: f64,
    },
    /// The convex hull of some points.
    ConvexHull {
        /// The points.
        points: Vec<[f64; 3]>,
        /// Rounding.
        rounding: f64,
    },
    /// Bounded by triangles, counter-clockwise as seen from outside.
    TriMesh {
        /// Vertices.
        vertices: Vec<[f64; 3]>,
        /// Triples of numbers of vertices.
        triangles: Vec<[usize; 3]>,
        /// How far the table keeps off the triangles, on whichever side it lies: [`Solid::kept_off`].
        margin: f64,
    },
    /// Everything behind the plane through the origin.
    HalfSpace {
        /// Normal of the plane, out of the shape, of any length.
        normal: [f64; 3],
    },
}

impl SolidSpec {
    /// The boundary of the shape, moved by `center`, with the table inside or outside of it.
    ///
    /// # Errors
    /// [`Error::Field`] for a field that is wrong; otherwise as [`Solid::new`].
    ///
    /// ```
    /// use geometry::{Vector3, parry::{Side, SolidSpec}};
    /// let can = SolidSpec::Cylinder { radius: 1.0, height: 2.0, rounding: 0.0 };
    /// let room = can.solid([0.0, 0.0, 1.0], Side::Inside)?;
    /// assert!((room.distance(&Vector3::new(0.0, 0.0, 0.25)) - 0.25).abs() < 1e-15);
    /// # Ok::<(), geometry::Error>(())
    /// ```
    pub fn solid(&self, center: [f64; 3], side: Side) -> Result<Solid, Error> {
        finite("center", &center)?;
        // parry's axes of revolution lie along x₂; a quaternion for the quarter turn would be rounded
        let upright = Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
        let rotation = match self {
            SolidSpec::Cylinder { .. } | SolidSpec::Cone { .. } => upright,
            _ => Matrix3::identity(),
        };
        let solid = Solid::placed(&*self.shape()?, &Frame { rotation, translation: center.into() }, side)?;
        match self {
            SolidSpec::TriMesh { margin, .. } if *margin != 0.0 => solid.kept_off(positive("margin", *margin)?),
            _ => Ok(solid),
        }
    }

    /// The same shape, `factor` times as large.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> SolidSpec {
        let point = |p: &[f64; 3]| p.map(|x| x * factor);
        match self {
            SolidSpec::Ball { radius } => SolidSpec::Ball { radius: radius * factor },
            SolidSpec::Cuboid { size, rounding } => {
                SolidSpec::Cuboid { size: point(size), rounding: rounding * factor }
            }
            SolidSpec::Capsule { from, to, radius } => {
                SolidSpec::Capsule { from: point(from), to: point(to), radius: radius * factor }
            }
            SolidSpec::Cylinder { radius, height, rounding } => {
                SolidSpec::Cylinder { radius: radius * factor, height: height * factor, rounding: rounding * factor }
            }
            SolidSpec::Cone { radius, height, rounding } => {
                SolidSpec::Cone { radius: radius * factor, height: height * factor, rounding: rounding * factor }
            }
            SolidSpec::ConvexHull { points, rounding } => {
                SolidSpec::ConvexHull { points: points.iter().map(point).collect(), rounding: rounding * factor }
            }
            SolidSpec::TriMesh { vertices, triangles, margin } => SolidSpec::TriMesh {
                vertices: vertices.iter().map(point).collect(),
                triangles: triangles.clone(),
                margin: margin * factor,
            },
            SolidSpec::HalfSpace { normal } => SolidSpec::HalfSpace { normal: *normal },
        }
    }

    fn shape(&self) -> Result<Box<dyn Shape>, Error> {
        Ok(match self {
            SolidSpec::Ball { radius } => Box::new(Ball::new(positive("radius", *radius)?)),
            SolidSpec::Cuboid { size, rounding } => {
                size.iter().try_for_each(|x| positive("size", *x).map(|_| ()))?;
                round(Cuboid::new(glam(size) * 0.5), *rounding)?
            }
            SolidSpec::Capsule { from, to, radius } => {
                finite("from", from)?;
                finite("to", to)?;
                Box::new(Capsule::new(glam(from), glam(to), positive("radius", *radius)?))
            }
            SolidSpec::Cylinder { radius, height, rounding } => {
                let (half, radius) = (0.5 * positive("height", *height)?, positive("radius", *radius)?);
                round(Cylinder::new(half, radius), *rounding)?
            }
            SolidSpec::Cone { radius, height, rounding } => {
                let (half, radius) = (0.5 * positive("height", *height)?, positive("radius", *radius)?);
                round(Cone::new(half, radius), *rounding)?
            }
            SolidSpec::ConvexHull { points, rounding } => {
                points.iter().try_for_each(|p| finite("points", p))?;
                round(hull(points)?, *rounding)?
            }
            SolidSpec::TriMesh { vertices, triangles, .. } => {
                vertices.iter().try_for_each(|p| finite("vertices", p))?;
                let number = |v: usize| u32::try_from(v).ok().filter(|_| v < vertices.len());
                let numbers = triangles.iter().map(|[a, b, c]| Some([number(*a)?, number(*b)?, number(*c)?]));
                let numbers: Vec<[u32; 3]> = numbers
                    .collect::<Option<_>>()
                    .ok_or_else(|| wrong("triangles", "numbers of vertices, counted from 0"))?;
                let mesh = TriMesh::new(vertices.iter().map(glam).collect(), numbers);
                Box::new(mesh.map_err(|_| wrong("triangles", "a list of at least one triangle"))?)
            }
            SolidSpec::HalfSpace { normal } => {
                finite("normal", normal)?;
                let length = length_of(&Vector3::from(*normal));
                if length == 0.0 {
                    return Err(wrong("normal", "a vector other than zero"));
                }
                Box::new(HalfSpace { normal: glam(&normal.map(|n| n / length)) })
            }
        })
    }
}

/// Whether points lie in a plane, within the rounding of their coordinates.
fn in_a_plane(points: &[[f64; 3]]) -> bool {
    let Some(&first) = points.first() else { return true };
    let rounding = slack(points.iter().flatten().copied());
    let from_first: Vec<Vector3<f64>> = points.iter().map(|p| Vector3::from(*p) - Vector3::from(first)).collect();
    let farthest = |height: &dyn Fn(&Vector3<f64>) -> f64| {
        let heights = from_first.iter().map(|p| (height(p), p));
        heights.max_by(|(a, _), (b, _)| a.total_cmp(b)).filter(|(height, _)| *height > rounding)
    };
    // from a point, from a line, from a plane
    let Some((length, along)) = farthest(&|p| length_of(p)) else { return true };
    let along = along / length;
    let Some((length, across)) = farthest(&|p| length_of(&along.cross(p))) else { return true };
    let normal = along.cross(across) / length;
    farthest(&|p| normal.dot(p).abs()).is_none()
}

/// The length of a vector, which may be as small as 1e-150.
fn length_of(v: &Vector3<f64>) -> f64 {
    libm::hypot(libm::hypot(v.x, v.y), v.z)
}

/// The convex hull of points that do not lie in a plane.
fn hull(points: &[[f64; 3]]) -> Result<ConvexPolyhedron, Error> {
    let flat = || wrong("points", "at least four points that do not lie in a plane");
    if in_a_plane(points) {
        return Err(flat());
    }
    let points: Vec<Glam> = points.iter().map(glam).collect();
    // at size 1, since parry knows no smaller polyhedra than some 10⁻⁸
    let low = points.iter().fold(Glam::INFINITY, |m, p| m.min(*p));
    let high = points.iter().fold(Glam::NEG_INFINITY, |m, p| m.max(*p));
    let unit = to_unit(0.5 * (high - low).max_element());
    let points: Vec<Glam> = points.iter().map(|p| *p * unit).collect();
    let hull = ConvexPolyhedron::from_convex_hull(&points).and_then(|hull| hull.scaled(Glam::splat(1.0 / unit)));
    hull.ok_or_else(flat)
}

/// A shape, rounded if it is to be.
fn round<S>(inner_shape: S, rounding: f64) -> Result<Box<dyn Shape>, Error>
where
    S: Shape,
    RoundShape<S>: Shape,
{
    if rounding == 0.0 {
        return Ok(Box::new(inner_shape));
    }
    Ok(Box::new(RoundShape { inner_shape, border_radius: positive("rounding", rounding)? }))
}

fn glam(v: &[f64; 3]) -> Glam {
    to_glam3(&Vector3::from(*v))
}

fn wrong(field: &str, must: &'static str) -> Error {
    Error::Field { field: field.into(), must }
}

fn positive(field: &str, value: f64) -> Result<f64, Error> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(wrong(field, "positive and finite")) }
}

fn finite(field: &str, value: &[f64; 3]) -> Result<(), Error> {
    if value.iter().all(|x| x.is_finite()) { Ok(()) } else { Err(wrong(field, "finite")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_the_distance_it_should_have() {
        let distance =
            |spec: &SolidSpec, at: [f64; 3]| spec.solid([0.0; 3], Side::Outside).unwrap().distance(&at.into());
        let tetrahedron = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let faces = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let cases = [
            (SolidSpec::Ball { radius: 1.0 }, [0.0, 0.0, 3.0], 2.0),
            (SolidSpec::Cuboid { size: [2.0, 4.0, 6.0], rounding: 0.0 }, [0.0, 0.0, 4.0], 1.0),
            (SolidSpec::Cuboid { size: [2.0, 4.0, 6.0], rounding: 0.5 }, [0.0, 3.0, 0.0], 0.5),
            (SolidSpec::Capsule { from: [0.0; 3], to: [1.0, 0.0, 0.0], radius: 0.5 }, [2.0, 0.0, 0.0], 0.5),
            (SolidSpec::Cylinder { radius: 1.0, height: 4.0, rounding: 0.0 }, [0.0, 0.0, 3.0], 1.0),
            (SolidSpec::Cylinder { radius: 1.0, height: 4.0, rounding: 0.25 }, [2.0, 0.0, 0.0], 0.75),
            (SolidSpec::Cone { radius: 1.0, height: 2.0, rounding: 0.0 }, [0.0, 0.0, 3.0], 2.0),
            (SolidSpec::ConvexHull { points: tetrahedron.clone(), rounding: 0.0 }, [-1.0, 0.1, 0.1], 1.0),
            (
                SolidSpec::TriMesh { vertices: tetrahedron.clone(), triangles: faces.clone(), margin: 0.0 },
                [-1.0, 0.1, 0.1],
                1.0,
            ),
            (SolidSpec::TriMesh { vertices: tetrahedron, triangles: faces, margin: 0.25 }, [-1.0, 0.1, 0.1], 0.75),
            (SolidSpec::HalfSpace { normal: [0.0, 0.0, 2.0] }, [5.0, 5.0, 1.5], 1.5),
        ];
        for (spec, at, expected) in cases {
            // rounding of the quarter turn of cylinders and cones, and of parry's own projections
            assert!((distance(&spec, at) - expected).abs() < 1e-12, "{spec:?}");
        }
    }

    #[test]
    fn a_wrong_field_is_named() {
        let error = SolidSpec::Cone { radius: 1.0, height: 0.0, rounding: 0.0 }.solid([0.0; 3], Side::Inside);
        assert_eq!(error.unwrap_err(), Error::Field { field: "height".into(), must: "positive and finite" });
        let flat = SolidSpec::ConvexHull { points: vec![[0.0; 3]; 3], rounding: 0.0 };
        assert!(flat.solid([0.0; 3], Side::Inside).is_err());
    }

    #[test]
    fn a_convex_hull_needs_points_that_do_not_lie_in_a_plane() {
        let hull = |points: &[[f64; 3]], scale: f64| {
            let points = points.iter().map(|p| p.map(|x| x * scale)).collect();
            SolidSpec::ConvexHull { points, rounding: 0.0 }.solid([0.0; 3], Side::Outside)
        };
        let at = |x: f64, y: f64, height: f64| [x, y, 0.3 * x - 0.7 * y + height];
        for scale in [1.0, 1e-150, 1e150] {
            for height in [0.0, 1e-17] {
                let flat =
                    [at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.0), at(0.0, 1.0, 0.0), at(1.0, 1.0, height), at(0.3, 0.1, 0.0)];
                assert!(matches!(hull(&flat, scale), Err(Error::Field { .. })), "{height}");
                assert!(matches!(hull(&flat.map(|[x, ..]| [x, x, 0.1 * x]), scale), Err(Error::Field { .. })));
            }
            let thin = [at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.0), at(0.0, 1.0, 0.0), at(1.0, 1.0, 1e-6)];
            let distance = hull(&thin, scale).unwrap().distance(&Vector3::from(at(0.5, 0.5, -1.0)).map(|x| x * scale));
            assert!((distance / scale - 1.0 / 1.58_f64.sqrt()).abs() < 1e-6, "{scale:e}: {distance}");
        }
        assert!(hull(&[[0.0; 3]; 5], 1.0).is_err() && hull(&[], 1.0).is_err());
    }
}

//! Shapes in space as plain data, as scene files have them.
mod parallel;
mod rims;
mod wires;

use super::{
    Side, Solid,
    convert::{Frame, to_glam3},
    polytope::Polytope,
};
use crate::{
    Error,
    plane::{LENGTHS, MUST_HAVE_SQUARE},
};
use nalgebra::{Matrix3, Vector3};
use parry3d_f64::{
    math::Vector as Glam,
    shape::{Ball, Capsule, Cone, Cuboid, Cylinder, HalfSpace, RoundShape, Shape, TriMesh},
};

/// A shape in space as plain data: the content of `shape = { … }` in a scene file.
///
/// Lengths \[L\]. Shapes with a size are centred at the origin; `rounding` is the width of a border added around the
/// shape, as swept by a ball of that radius; 0 for none.
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
    /// A shape bounded by triangles, counter-clockwise as seen from outside.
    TriMesh {
        /// Vertices.
        vertices: Vec<[f64; 3]>,
        /// Triples of numbers of vertices.
        triangles: Vec<[usize; 3]>,
        /// How far the table keeps away from the triangles, on whichever side it lies: see [`Solid::kept_off`].
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
    /// [`Error::Field`] for a field that is wrong: a size must be between 10⁻¹⁵⁰ and 10¹⁵⁰, a border and a coordinate no
    /// larger; otherwise as [`Solid::new`].
    ///
    /// ```
    /// use geometry::{Vector3, parry::{Side, SolidSpec}};
    /// let can = SolidSpec::Cylinder { radius: 1.0, height: 2.0, rounding: 0.0 };
    /// let room = can.solid([0.0, 0.0, 1.0], Side::Inside)?;
    /// assert!((room.distance(&Vector3::new(0.0, 0.0, 0.25)) - 0.25).abs() < 1e-15);
    /// # Ok::<(), geometry::Error>(())
    /// ```
    pub fn solid(&self, center: [f64; 3], side: Side) -> Result<Solid, Error> {
        in_range("center", &center)?;
        // parry's axes of revolution lie along x₂; a quaternion for the quarter turn would be inexact
        let upright = Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
        let rotation = match self {
            SolidSpec::Cylinder { .. } | SolidSpec::Cone { .. } => upright,
            _ => Matrix3::identity(),
        };
        let frame = Frame { rotation, translation: center.into() };
        let placed = |shape: &dyn Shape| Solid::placed(shape, &frame, side);
        match self {
            SolidSpec::Ball { radius } => placed(&Ball::new(size("radius", *radius)?)),
            SolidSpec::Cuboid { size: edges, rounding } => {
                edges.iter().try_for_each(|x| size("size", *x).map(|_| ()))?;
                placed(&*round(Cuboid::new(glam(edges) * 0.5), *rounding)?)
            }
            SolidSpec::Capsule { from, to, radius } => {
                in_range("from", from)?;
                in_range("to", to)?;
                placed(&Capsule::new(glam(from), glam(to), size("radius", *radius)?))
            }
            SolidSpec::Cylinder { radius, height, rounding } => {
                let (half, radius) = (0.5 * size("height", *height)?, size("radius", *radius)?);
                placed(&*round(Cylinder::new(half, radius), *rounding)?)
            }
            SolidSpec::Cone { radius, height, rounding } => {
                let (half, radius) = (0.5 * size("height", *height)?, size("radius", *radius)?);
                placed(&*round(Cone::new(half, radius), *rounding)?)
            }
            SolidSpec::ConvexHull { points, rounding } => {
                Solid::polytope(&hull(points)?, border("rounding", *rounding)?, &frame, side)
            }
            SolidSpec::TriMesh { vertices, triangles, margin } => {
                vertices.iter().try_for_each(|p| in_range("vertices", p))?;
                let number = |v: usize| u32::try_from(v).ok().filter(|_| v < vertices.len());
                let numbers = triangles.iter().map(|[a, b, c]| Some([number(*a)?, number(*b)?, number(*c)?]));
                let numbers: Vec<[u32; 3]> = numbers
                    .collect::<Option<_>>()
                    .ok_or_else(|| wrong("triangles", "vertex numbers, counted from 0"))?;
                let mesh = TriMesh::new(vertices.iter().map(glam).collect(), numbers);
                let solid = placed(&mesh.map_err(|_| wrong("triangles", "a list of at least one triangle"))?)?;
                if border("margin", *margin)? == 0.0 { Ok(solid) } else { solid.kept_off(*margin) }
            }
            SolidSpec::HalfSpace { normal } => {
                in_range("normal", normal)?;
                let [x, y, z] = *normal;
                let length = libm::hypot(libm::hypot(x, y), z);
                if length == 0.0 {
                    return Err(wrong("normal", "a vector other than zero"));
                }
                placed(&HalfSpace { normal: glam(&normal.map(|n| n / length)) })
            }
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
}

/// The convex hull of points that do not lie in a plane.
fn hull(points: &[[f64; 3]]) -> Result<Polytope, Error> {
    points.iter().try_for_each(|p| in_range("points", p))?;
    let points: Vec<Vector3<f64>> = points.iter().map(|p| Vector3::from(*p)).collect();
    Polytope::hull(&points).ok_or_else(|| wrong("points", "at least four points that do not lie in a plane"))
}

/// A shape, perhaps rounded.
fn round<S>(inner_shape: S, rounding: f64) -> Result<Box<dyn Shape>, Error>
where
    S: Shape,
    RoundShape<S>: Shape,
{
    let border_radius = border("rounding", rounding)?;
    Ok(if border_radius == 0.0 { Box::new(inner_shape) } else { Box::new(RoundShape { inner_shape, border_radius }) })
}

fn glam(v: &[f64; 3]) -> Glam {
    to_glam3(&Vector3::from(*v))
}

fn wrong(field: &str, must: &'static str) -> Error {
    Error::Field { field: field.into(), must }
}

/// A size must be one of [`LENGTHS`].
fn size(field: &str, value: f64) -> Result<f64, Error> {
    if LENGTHS.contains(&value) { Ok(value) } else { Err(wrong(field, MUST_HAVE_SQUARE)) }
}

/// A border may be as narrow as one likes, but no wider than the greatest of [`LENGTHS`].
fn border(field: &str, value: f64) -> Result<f64, Error> {
    if (0.0..=*LENGTHS.end()).contains(&value) { Ok(value) } else { Err(wrong(field, "between 0 and 1e150")) }
}

/// No coordinate may be larger than the greatest of [`LENGTHS`].
fn in_range(field: &str, value: &[f64; 3]) -> Result<(), Error> {
    let is_one = |x: &f64| x.abs() <= *LENGTHS.end();
    if value.iter().all(is_one) { Ok(()) } else { Err(wrong(field, "made of numbers between -1e150 and 1e150")) }
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
        assert_eq!(error.unwrap_err(), Error::Field { field: "height".into(), must: "between 1e-150 and 1e150" });
        let flat = SolidSpec::ConvexHull { points: vec![[0.0; 3]; 3], rounding: 0.0 };
        assert!(flat.solid([0.0; 3], Side::Inside).is_err());
    }
}

//! Shapes as plain data, as scene files have them.
use super::{Side, contour::Contour, convert::Frame, planar::assemble};
use crate::{Error, Piece, plane::cross};
use nalgebra::{Matrix2, Vector2};
use parry2d_f64::{
    math::Vector as Glam,
    shape::{Ball, Capsule, Cuboid, HalfSpace, HeightField, Polyline, RoundShape, Segment, Shape, TriMesh},
};

/// A planar shape as plain data: the content of `shape = { … }` in a scene file.
///
/// Lengths \[L\]. Every shape is described in its own coordinates: a shape given by its size is centred at the origin, others lie where
/// their vertices are.
#[derive(Clone, Debug, PartialEq)]
pub enum ShapeSpec {
    /// `ball`
    Ball {
        /// Radius.
        radius: f64,
    },
    /// `cuboid`: a rectangle.
    Cuboid {
        /// Half of its width and height.
        half_extents: [f64; 2],
    },
    /// `capsule`: all points within `radius` of a segment; the stadium.
    Capsule {
        /// One end of the segment.
        a: [f64; 2],
        /// The other end.
        b: [f64; 2],
        /// Radius.
        radius: f64,
    },
    /// `segment`: a wall on both of its sides.
    Segment {
        /// One end.
        a: [f64; 2],
        /// The other end.
        b: [f64; 2],
    },
    /// `triangle`
    Triangle {
        /// Its corners, in either sense.
        vertices: [[f64; 2]; 3],
    },
    /// `polyline`: a polygon of any form if closed, a wall on both of its sides if not.
    Polyline {
        /// Its corners, in either sense.
        vertices: Vec<[f64; 2]>,
        /// Whether the last corner is joined to the first.
        closed: bool,
    },
    /// `convex-polygon`
    ConvexPolygon {
        /// Its corners, in either sense.
        vertices: Vec<[f64; 2]>,
    },
    /// `round-cuboid`: a rectangle with a border around it.
    RoundCuboid {
        /// Half of the inner width and height.
        half_extents: [f64; 2],
        /// Width of the border, and radius of the rounded corners.
        border_radius: f64,
    },
    /// `round-triangle`
    RoundTriangle {
        /// Corners of the inner triangle, in either sense.
        vertices: [[f64; 2]; 3],
        /// Width of the border, and radius of the rounded corners.
        border_radius: f64,
    },
    /// `round-convex-polygon`
    RoundConvexPolygon {
        /// Corners of the inner polygon, in either sense.
        vertices: Vec<[f64; 2]>,
        /// Width of the border, and radius of the rounded corners.
        border_radius: f64,
    },
    /// `half-space`: everything behind the line through the origin.
    HalfSpace {
        /// Normal of the line, out of the shape, of any length.
        normal: [f64; 2],
    },
    /// `trimesh`: bounded by the edges that belong to one triangle only.
    TriMesh {
        /// Its vertices.
        vertices: Vec<[f64; 2]>,
        /// Triples of numbers of vertices, in either sense.
        triangles: Vec<[usize; 3]>,
    },
    /// `heightfield`: a graph over `−scale₁/2 … scale₁/2`, with its inside below. It is an open chain, which other pieces or a lattice must
    /// continue.
    HeightField {
        /// Heights at equal distances, multiplied by `scale₂`.
        heights: Vec<f64>,
        /// Width of the whole, and unit of height.
        scale: [f64; 2],
    },
    /// `compound`: the union of some shapes.
    Compound(
        /// Its members.
        Vec<Placed>,
    ),
}

/// A shape, turned and moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// The shape.
    pub shape: ShapeSpec,
    /// The translation \[L\].
    pub translation: [f64; 2],
    /// The angle by which it is turned first, counter-clockwise, in radians.
    pub rotation: f64,
}

impl From<ShapeSpec> for Placed {
    fn from(shape: ShapeSpec) -> Self {
        Placed { shape, translation: [0.0; 2], rotation: 0.0 }
    }
}

impl Placed {
    /// The boundary of the shape, with the table inside or outside of it.
    ///
    /// # Errors
    /// [`Error::Field`] for a field that is wrong, with its name as a path: `half_extents[1]`,
    /// `compound[0].translation`; [`Error::SamePoint`] for a segment without length; otherwise as [`pieces`](super::pieces).
    ///
    /// ```
    /// use geometry::{parry::{Placed, ShapeSpec, Side}, Table};
    /// let square = Placed::from(ShapeSpec::Cuboid { half_extents: [1.0, 1.0] });
    /// let table = Table::new(square.pieces(Side::Inside)?)?;
    /// assert_eq!(table.area(), 4.0);
    /// # Ok::<(), geometry::Error>(())
    /// ```
    pub fn pieces(&self, side: Side) -> Result<Vec<Box<dyn Piece>>, Error> {
        let mut contours = vec![];
        let whole = Frame { rotation: Matrix2::identity(), translation: Vector2::zeros() };
        self.contours(&whole, "", &mut contours)?;
        assemble(contours, side)
    }

    /// The same shape with its position, both `factor` times as large.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Placed {
        Placed {
            shape: self.shape.scaled(factor),
            translation: self.translation.map(|x| x * factor),
            rotation: self.rotation,
        }
    }

    /// The outlines of the shape or of its members; `path` leads to its fields.
    fn contours(&self, frame: &Frame<2>, path: &str, contours: &mut Vec<Contour>) -> Result<(), Error> {
        let at = Fields { path };
        at.vector("translation", &self.translation)?;
        at.finite("rotation", self.rotation)?;
        let (sin, cos) = (libm::sin(self.rotation), libm::cos(self.rotation));
        let own = Frame { rotation: Matrix2::new(cos, -sin, sin, cos), translation: self.translation.into() };
        let frame = frame.after(&own);
        if let ShapeSpec::Compound(members) = &self.shape {
            if members.is_empty() {
                return Err(at.wrong("compound", "a list of at least one shape"));
            }
            let in_member = |i: usize| format!("{path}compound[{i}].");
            return members.iter().enumerate().try_for_each(|(i, m)| m.contours(&frame, &in_member(i), contours));
        }
        contours.push(self.shape.contour(&frame, &at)?);
        Ok(())
    }
}

impl ShapeSpec {
    /// The same shape, `factor` times as large.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> ShapeSpec {
        let by = |x: &f64| x * factor;
        let point = |p: &[f64; 2]| p.map(|x| x * factor);
        let points = |all: &[[f64; 2]]| all.iter().map(point).collect();
        match self {
            ShapeSpec::Ball { radius } => ShapeSpec::Ball { radius: by(radius) },
            ShapeSpec::Cuboid { half_extents } => ShapeSpec::Cuboid { half_extents: point(half_extents) },
            ShapeSpec::Capsule { a, b, radius } => ShapeSpec::Capsule { a: point(a), b: point(b), radius: by(radius) },
            ShapeSpec::Segment { a, b } => ShapeSpec::Segment { a: point(a), b: point(b) },
            ShapeSpec::Triangle { vertices } => ShapeSpec::Triangle { vertices: vertices.map(|v| point(&v)) },
            ShapeSpec::Polyline { vertices, closed } => {
                ShapeSpec::Polyline { vertices: points(vertices), closed: *closed }
            }
            ShapeSpec::ConvexPolygon { vertices } => ShapeSpec::ConvexPolygon { vertices: points(vertices) },
            ShapeSpec::RoundCuboid { half_extents, border_radius } => {
                ShapeSpec::RoundCuboid { half_extents: point(half_extents), border_radius: by(border_radius) }
            }
            ShapeSpec::RoundTriangle { vertices, border_radius } => {
                ShapeSpec::RoundTriangle { vertices: vertices.map(|v| point(&v)), border_radius: by(border_radius) }
            }
            ShapeSpec::RoundConvexPolygon { vertices, border_radius } => {
                ShapeSpec::RoundConvexPolygon { vertices: points(vertices), border_radius: by(border_radius) }
            }
            ShapeSpec::HalfSpace { normal } => ShapeSpec::HalfSpace { normal: *normal },
            ShapeSpec::TriMesh { vertices, triangles } => {
                ShapeSpec::TriMesh { vertices: points(vertices), triangles: triangles.clone() }
            }
            ShapeSpec::HeightField { heights, scale } => {
                ShapeSpec::HeightField { heights: heights.clone(), scale: point(scale) }
            }
            ShapeSpec::Compound(members) => ShapeSpec::Compound(members.iter().map(|m| m.scaled(factor)).collect()),
        }
    }

    fn contour(&self, frame: &Frame<2>, at: &Fields<'_>) -> Result<Contour, Error> {
        let shape: Box<dyn Shape> = match self {
            ShapeSpec::Ball { radius } => Box::new(Ball::new(at.positive("radius", *radius)?)),
            ShapeSpec::Cuboid { half_extents } => Box::new(Cuboid::new(at.extents("half_extents", half_extents)?)),
            ShapeSpec::RoundCuboid { half_extents, border_radius } => Box::new(RoundShape {
                inner_shape: Cuboid::new(at.extents("half_extents", half_extents)?),
                border_radius: at.positive("border_radius", *border_radius)?,
            }),
            ShapeSpec::Capsule { a, b, radius } => {
                at.vector("a", a)?;
                at.vector("b", b)?;
                Box::new(Capsule::new(glam(a), glam(b), at.positive("radius", *radius)?))
            }
            ShapeSpec::Segment { a, b } => {
                at.vector("a", a)?;
                at.vector("b", b)?;
                if a == b {
                    return Err(Error::SamePoint { field: at.named("b"), other: "a".into() });
                }
                Box::new(Segment::new(glam(a), glam(b)))
            }
            ShapeSpec::Triangle { vertices } => {
                let points = at.convex("vertices", vertices)?;
                return Ok(Contour::convex("triangle", &points, 0.0, frame));
            }
            ShapeSpec::ConvexPolygon { vertices } => {
                let points = at.convex("vertices", vertices)?;
                return Ok(Contour::convex("convex polygon", &points, 0.0, frame));
            }
            ShapeSpec::RoundTriangle { vertices, border_radius } => {
                let points = at.convex("vertices", vertices)?;
                let radius = at.positive("border_radius", *border_radius)?;
                return Ok(Contour::convex("round triangle", &points, radius, frame));
            }
            ShapeSpec::RoundConvexPolygon { vertices, border_radius } => {
                let points = at.convex("vertices", vertices)?;
                let radius = at.positive("border_radius", *border_radius)?;
                return Ok(Contour::convex("round convex polygon", &points, radius, frame));
            }
            ShapeSpec::Polyline { vertices, closed } => Box::new(polyline(vertices, *closed, at)?),
            ShapeSpec::HalfSpace { normal } => {
                at.vector("normal", normal)?;
                let length = libm::hypot(normal[0], normal[1]);
                if length == 0.0 {
                    return Err(at.wrong("normal", "a vector other than zero"));
                }
                Box::new(HalfSpace { normal: Glam::new(normal[0] / length, normal[1] / length) })
            }
            ShapeSpec::TriMesh { vertices, triangles } => Box::new(mesh(vertices, triangles, at)?),
            ShapeSpec::HeightField { heights, scale } => {
                if heights.len() < 2 {
                    return Err(at.wrong("heights", "a list of at least two numbers"));
                }
                for (i, h) in heights.iter().enumerate() {
                    at.finite(&format!("heights[{i}]"), *h)?;
                }
                let scale = at.extents("scale", scale)?;
                Box::new(HeightField::new(heights.clone(), scale))
            }
            ShapeSpec::Compound(_) => return Err(at.wrong("compound", "unfolded before its members")),
        };
        let contour = Contour::of(&shape.as_typed_shape(), frame)?;
        let contour = contour.ok_or_else(|| at.wrong("shape", "made of segments and arcs"))?;
        if let ShapeSpec::Polyline { closed: true, .. } = self { contour.closed() } else { Ok(contour) }
    }
}

fn glam(v: &[f64; 2]) -> Glam {
    Glam::new(v[0], v[1])
}

fn polyline(vertices: &[[f64; 2]], closed: bool, at: &Fields<'_>) -> Result<Polyline, Error> {
    at.points("vertices", vertices, if closed { 3 } else { 2 })?;
    let number = |i: usize| u32::try_from(i).map_err(|_| at.wrong("vertices", "at most 2³² points"));
    let n = vertices.len();
    let edges = (0..if closed { n } else { n - 1 }).map(|i| Ok([number(i)?, number((i + 1) % n)?]));
    let edges = edges.collect::<Result<Vec<[u32; 2]>, Error>>()?;
    Ok(Polyline::new(vertices.iter().map(glam).collect(), Some(edges)))
}

fn mesh(vertices: &[[f64; 2]], triangles: &[[usize; 3]], at: &Fields<'_>) -> Result<TriMesh, Error> {
    at.points("vertices", vertices, 3)?;
    let mut numbers = vec![];
    for (i, triangle) in triangles.iter().enumerate() {
        let known = |&v: &usize| u32::try_from(v).ok().filter(|_| v < vertices.len());
        let [Some(a), Some(b), Some(c)] = [0, 1, 2].map(|k| known(&triangle[k])) else {
            return Err(at.wrong(&format!("triangles[{i}]"), "three vertex numbers, counted from 0"));
        };
        numbers.push([a, b, c]);
    }
    TriMesh::new(vertices.iter().map(glam).collect(), numbers)
        .map_err(|_| at.wrong("triangles", "a list of at least one triangle"))
}

/// Checks fields and names those that are wrong.
struct Fields<'a> {
    path: &'a str,
}

impl Fields<'_> {
    fn named(&self, field: &str) -> String {
        format!("{}{field}", self.path)
    }
    fn wrong(&self, field: &str, must: &'static str) -> Error {
        Error::Field { field: self.named(field), must }
    }
    fn finite(&self, field: &str, value: f64) -> Result<f64, Error> {
        if value.is_finite() { Ok(value) } else { Err(self.wrong(field, "finite")) }
    }
    fn positive(&self, field: &str, value: f64) -> Result<f64, Error> {
        if value > 0.0 && value.is_finite() { Ok(value) } else { Err(self.wrong(field, "positive and finite")) }
    }
    fn vector(&self, field: &str, value: &[f64; 2]) -> Result<(), Error> {
        value.iter().enumerate().try_for_each(|(i, x)| self.finite(&format!("{field}[{i}]"), *x).map(|_| ()))
    }
    fn extents(&self, field: &str, value: &[f64; 2]) -> Result<Glam, Error> {
        let [x, y] = [0, 1].map(|i| self.positive(&format!("{field}[{i}]"), value[i]));
        Ok(Glam::new(x?, y?))
    }
    fn points(&self, field: &str, value: &[[f64; 2]], least: usize) -> Result<(), Error> {
        if value.len() < least {
            let must = if least == 3 { "a list of at least three points" } else { "a list of at least two points" };
            return Err(self.wrong(field, must));
        }
        value.iter().enumerate().try_for_each(|(i, p)| self.vector(&format!("{field}[{i}]"), p))
    }
    /// The corners of a convex polygon.
    fn convex(&self, field: &str, value: &[[f64; 2]]) -> Result<Vec<Vector2<f64>>, Error> {
        self.points(field, value, 3)?;
        let n = value.len();
        let edge = |i: usize| Vector2::from(value[(i + 1) % n]) - Vector2::from(value[i % n]);
        let (mut left, mut right, mut reversals) = (false, false, 0);
        for i in 0..n {
            let (before, after) = (edge(i), edge(i + 1));
            if after == Vector2::zeros() {
                return Err(self.wrong(&format!("{field}[{}]", (i + 2) % n), "another point than the one before"));
            }
            // lengths may be as small as 1e-150: their products must not vanish
            let size = before.amax().max(after.amax());
            let turn = cross((before / size).into(), (after / size).into());
            left |= turn > 0.0;
            right |= turn < 0.0;
            // around a convex polygon, x rises once and falls once
            reversals += usize::from(
                (before.x > 0.0 || (before.x == 0.0 && before.y > 0.0))
                    != (after.x > 0.0 || (after.x == 0.0 && after.y > 0.0)),
            );
        }
        if left == right || reversals > 2 {
            return Err(self.wrong(field, "the corners of a convex polygon, in order"));
        }
        Ok(value.iter().map(|&p| p.into()).collect())
    }
}

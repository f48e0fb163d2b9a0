//! Tables inside or outside of any shape in space.
mod convex;
mod field;

use super::{Side, convert::Frame, distance::Distance, mesh::Mesh};
use crate::{Boundary, Error, Hit, Line};
use convex::Convex;
use field::{Offset, Spatial};
use nalgebra::{Isometry3, Vector3};
use parry3d_f64::shape::{Shape, SharedShape, TypedShape};

/// The table inside or outside of a shape in space.
///
/// Exact rays for ball, cuboid, half-space, capsule, cylinder, cone, convex polyhedron, triangle mesh, height field and
/// voxels, and for compounds of convex shapes (as unions; members may overlap). Rounded shapes and shapes of your own go
/// through distance queries: a certified march to the first hit, accurate like the shape's own projection.
///
/// A triangle mesh must be oriented consistently; closed ones may be inside out. An open one is a wall on one side: the
/// table outside sees the counter-clockwise faces. The inside of a height field is what lies below it.
///
/// Pieces: the faces of a cuboid, `2·axis + side`; of a cylinder lateral surface 0, lower cap 1, upper cap 2; of a
/// cone lateral surface 0, base 1; of a convex polyhedron its faces; of a mesh its triangles of positive area, in their
/// order; of a compound its members; otherwise 0.
///
/// ```
/// use geometry::{parry::{parry3d_f64::shape::Cylinder, Side, Solid}, Boundary, Line, Vector3};
/// use nalgebra::Isometry3;
/// let can = Solid::new(&Cylinder::new(1.0, 2.0), &Isometry3::identity(), Side::Inside)?;
/// let path = Line { point: Vector3::new(0.0, 0.5, 0.0), velocity: Vector3::new(1.0, 0.0, 0.0) };
/// let hit = can.first_hit(&path).unwrap();
/// assert_eq!((hit.time, hit.normal), (2.0, Vector3::new(-1.0, 0.0, 0.0)));
/// # Ok::<(), geometry::Error>(())
/// ```
#[derive(Debug)]
pub struct Solid {
    members: Vec<Member>,
    side: Side,
}

#[derive(Debug)]
struct Member {
    body: Body,
    distance: Distance<3>,
}

/// Who finds the first hit.
#[derive(Debug)]
enum Body {
    Convex(Convex),
    Mesh(Mesh),
    Distance,
}

/// The boundary as seen from a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// Distance from the boundary \[L\], negative outside the table.
    pub distance: f64,
    /// The closest point of the boundary \[L\].
    pub point: Vector3<f64>,
    /// Unit normal there, into the table.
    pub normal: Vector3<f64>,
}

fn unsupported(shape: &'static str, why: &'static str) -> Error {
    Error::Shape { shape, why }
}

impl Solid {
    /// The boundary of a shape in a pose, with the table on the given side.
    ///
    /// # Errors
    /// [`Error::Shape`] for shapes without volume (segments, polylines, single triangles; give them a border), meshes
    /// that are not oriented, and the inside of a compound with members that are not convex;
    /// [`Error::Parameter`] for sizes that are not positive and finite.
    pub fn new(shape: &dyn Shape, pose: &Isometry3<f64>, side: Side) -> Result<Solid, Error> {
        let mut members = vec![];
        add(shape, &Frame::from(pose), side, &mut members)?;
        if side == Side::Inside && members.len() > 1 && members.iter().any(|m| !matches!(m.body, Body::Convex(_))) {
            return Err(unsupported("compound", "the inside of a union is known for convex members only"));
        }
        Ok(Solid { members, side })
    }

    /// The side on which the table lies.
    pub fn side(&self) -> Side {
        self.side
    }

    /// Distance, closest point and normal, seen from anywhere.
    ///
    /// Inside a union of overlapping shapes the distance is a lower bound: that from the farthest wall among the
    /// members that contain the point.
    pub fn closest(&self, point: &Vector3<f64>) -> Closest {
        let of = |m: &Member| m.closest(point, self.side);
        // both for the table outside (nearest obstacle) and inside (deepest of the members around the point)
        let better = |a: &Closest, b: &Closest| match self.side {
            Side::Outside => a.distance < b.distance,
            Side::Inside => a.distance > b.distance,
        };
        let mut best = of(&self.members[0]);
        for member in &self.members[1..] {
            let other = of(member);
            if better(&other, &best) {
                best = other;
            }
        }
        best
    }

    /// Distance from the boundary \[L\], negative outside the table; see [`Solid::closest`].
    pub fn distance(&self, point: &Vector3<f64>) -> f64 {
        self.closest(point).distance
    }

    /// Whether a point lies in the table, off the boundary.
    pub fn contains(&self, point: &Vector3<f64>) -> bool {
        self.distance(point) > 0.0
    }

    /// A box around the boundary: least and greatest coordinates, infinite for a half-space.
    pub fn extent(&self) -> [Vector3<f64>; 2] {
        let boxes = self.members.iter().map(|m| m.distance.extent());
        boxes.fold([Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY)], |[a, b], [c, d]| {
            [a.inf(&c), b.sup(&d)]
        })
    }

    /// Out of a union of convex shapes: through each shape entered on the way, until one is left for nothing.
    fn leave(&self, path: &Line<3>) -> Option<Hit<3>> {
        let convex = || {
            self.members.iter().enumerate().filter_map(|(i, m)| match &m.body {
                Body::Convex(convex) => Some((i, convex)),
                _ => None,
            })
        };
        let mut best: Option<(usize, f64, usize)> = None; // member, time, face
        loop {
            let reached = best.map_or(0.0, |b| b.1);
            let at = path.at(reached);
            let farther = convex()
                .filter(|(_, c)| c.contains(&at))
                .filter_map(|(i, c)| c.exit(path).map(|(t, face)| (i, t, face)))
                .filter(|(_, t, _)| best.is_none() || *t > reached)
                .max_by(|a, b| a.1.total_cmp(&b.1));
            match farther {
                Some(next) => best = Some(next),
                None => break,
            }
        }
        let (member, time, face) = best?;
        let Body::Convex(convex) = &self.members[member].body else { return None };
        Some(self.hit_convex(member, convex, path, time, face))
    }

    fn hit_convex(&self, member: usize, convex: &Convex, path: &Line<3>, time: f64, face: usize) -> Hit<3> {
        let (point, outward) = convex.land(face, &path.at(time));
        Hit {
            time,
            point,
            normal: if self.side == Side::Outside { outward } else { -outward },
            piece: if self.members.len() > 1 { member } else { face },
            corner: convex.on_edge(face, &point),
        }
    }
}

impl Boundary<3> for Solid {
    fn first_hit(&self, path: &Line<3>) -> Option<Hit<3>> {
        if self.side == Side::Inside && matches!(self.members[0].body, Body::Convex(_)) {
            return self.leave(path);
        }
        let mut first: Option<Hit<3>> = None;
        for (i, member) in self.members.iter().enumerate() {
            let hit = match &member.body {
                Body::Convex(convex) => {
                    convex.entry(path).map(|(time, face)| self.hit_convex(i, convex, path, time, face))
                }
                Body::Mesh(mesh) => mesh.first(path).map(|(k, time)| {
                    let (point, corner) = mesh.land(k, &path.at(time));
                    let piece = if self.members.len() > 1 { i } else { k };
                    Hit { time, point, normal: mesh.normals[k], piece, corner }
                }),
                Body::Distance => member.distance.first(path).map(|time| {
                    let (point, normal, _) = member.distance.closest(&path.at(time));
                    Hit { time, point, normal, piece: i, corner: false }
                }),
            };
            if let Some(hit) = hit
                && first.is_none_or(|f| hit.time < f.time)
            {
                first = Some(hit);
            }
        }
        first
    }
}

impl Member {
    fn closest(&self, point: &Vector3<f64>, side: Side) -> Closest {
        if let Body::Convex(convex) = &self.body
            && let Some((foot, outward, off)) = convex.nearest_face(point)
        {
            let sign = if side == Side::Outside { 1.0 } else { -1.0 };
            return Closest { distance: sign * off, point: foot, normal: outward * sign };
        }
        let (foot, normal, distance) = self.distance.closest(point);
        Closest { distance, point: foot, normal }
    }
}

/// Adds the simple members of a shape.
fn add(shape: &dyn Shape, frame: &Frame<3>, side: Side, members: &mut Vec<Member>) -> Result<(), Error> {
    let outside = side == Side::Outside;
    let exact = |convex: Convex, members: &mut Vec<Member>| {
        members.push(Member { body: Body::Convex(convex), distance: field::distance(shape, frame, side) });
    };
    let mesh = |vertices: Vec<Vector3<f64>>, triangles: &[[usize; 3]], loose| {
        let vertices = vertices.iter().map(|y| frame.point(y)).collect();
        let mesh = Mesh::new(vertices, triangles, outside, loose)?;
        let distance = field::mesh_distance(&mesh, side)?;
        Ok::<Member, Error>(Member { body: Body::Mesh(mesh), distance })
    };
    let round = |inner: &dyn Shape, radius: f64| {
        positive("the border radius", radius)?;
        Ok::<Member, Error>(Member { body: Body::Distance, distance: Offset::distance(inner, radius, frame, side)? })
    };
    match shape.as_typed_shape() {
        TypedShape::Ball(ball) => {
            positive("the radius", ball.radius)?;
            exact(Convex::ball(frame.translation, ball.radius), members);
        }
        TypedShape::Cuboid(cuboid) => exact(Convex::cuboid(cuboid, frame)?, members),
        TypedShape::HalfSpace(half) => exact(Convex::half_space(half, frame), members),
        TypedShape::Capsule(capsule) => exact(Convex::capsule(capsule, frame)?, members),
        TypedShape::Cylinder(cylinder) => exact(Convex::cylinder(cylinder, frame)?, members),
        TypedShape::Cone(cone) => exact(Convex::cone(cone, frame)?, members),
        TypedShape::ConvexPolyhedron(hull) => {
            let (points, triangles) = hull.to_trimesh();
            let inner = field::hull(&points, &triangles)?;
            members.push(Member {
                body: Body::Convex(Convex::polyhedron(hull, frame)),
                distance: inner.placed(frame, side),
            });
        }
        TypedShape::TriMesh(m) => {
            let vertices = m.vertices().iter().map(|&v| super::convert::from_glam3(v)).collect();
            let triangles: Vec<[usize; 3]> = m.indices().iter().map(|t| t.map(|v| v as usize)).collect();
            members.push(mesh(vertices, &triangles, false)?);
        }
        TypedShape::HeightField(h) => {
            let (vertices, triangles) = field::height_field(h);
            members.push(mesh(vertices, &triangles, false)?);
        }
        TypedShape::Voxels(v) => {
            let (vertices, triangles) = field::voxels(v);
            members.push(mesh(vertices, &triangles, true)?);
        }
        TypedShape::Compound(compound) => {
            for (pose, member) in compound.shapes() {
                let member: &SharedShape = member;
                add(&**member, &frame.after(&Frame::from(pose)), side, members)?;
            }
        }
        TypedShape::RoundCuboid(r) => members.push(round(&r.inner_shape, r.border_radius)?),
        TypedShape::RoundTriangle(r) => members.push(round(&r.inner_shape, r.border_radius)?),
        TypedShape::RoundCylinder(r) => members.push(round(&r.inner_shape, r.border_radius)?),
        TypedShape::RoundCone(r) => members.push(round(&r.inner_shape, r.border_radius)?),
        TypedShape::RoundConvexPolyhedron(r) => members.push(round(&r.inner_shape, r.border_radius)?),
        TypedShape::Segment(_) => return Err(unsupported("segment", "a curve is no wall in space: use a capsule")),
        TypedShape::Polyline(_) => return Err(unsupported("polyline", "a curve is no wall in space: use capsules")),
        TypedShape::Triangle(_) => {
            return Err(unsupported(
                "triangle",
                "it has no volume: use a round triangle, or a mesh seen from one side",
            ));
        }
        TypedShape::Custom(_) => {
            members.push(Member { body: Body::Distance, distance: Spatial::distance(shape, frame, side) });
        }
    }
    Ok(())
}

/// A size must be positive and finite.
fn positive(name: &'static str, value: f64) -> Result<(), Error> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(Error::Parameter { name, must: "positive and finite", value })
    }
}

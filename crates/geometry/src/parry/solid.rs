//! Tables inside or outside of any shape in space.
pub(super) mod area;
pub(super) mod bound;
mod convex;
mod field;
mod nearest;
mod parallel;
mod rim;
mod rounded;
mod strata;

use super::{
    Side,
    convert::{Frame, from_glam3},
    distance::Distance,
    feet::Feet,
    first::first_of,
    mesh::Mesh,
    polytope::Polytope,
};
use crate::{
    Boundary, BoxTree, Error, Extent, Hit, Line,
    plane::{finite, has_square, has_squares, is_finite, slack},
    walls::{CORNER, ConvexBody},
};
use convex::Convex;
pub(in crate::parry) use convex::Figure;
use field::Spatial;
use nalgebra::{Isometry3, Vector3};
use parallel::Parallel;
use parry3d_f64::shape::{ConvexPolyhedron, Shape, SharedShape, TypedShape};
use rounded::Rounded;

/// From this many sizes away the side is taken from a point beside the boundary: coordinates resolve its size only to a millionth.
const FAR: f64 = 1e9;

/// The table inside or outside of a shape in space.
///
/// Exact ray solvers for ball, cuboid, half-space, capsule, cylinder, cone, convex polyhedron, their rounded forms, triangle mesh,
/// height field and voxels, and for compounds of convex shapes (as unions; members may overlap). Shapes of your own go through distance
/// queries: a certified march to the first hit, as accurate as the shape's own projection.
///
/// A triangle mesh must be oriented consistently; closed ones may be inside out, and may have several parts: one inside another bounds
/// a cavity. An open one is a one-sided wall: the table outside sees the counter-clockwise faces. Where triangles with opposite
/// orientations coincide, there is a wall with the table on both sides. The inside of a height field is the region below it.
///
/// Pieces: the faces of a cuboid, `2·axis + side`; of a cylinder lateral surface 0, lower cap 1, upper cap 2; of a cone lateral surface
/// 0, base 1; of a convex polyhedron its faces; of a mesh its triangles of positive area, in their order, and then the second parts of
/// those that are split at a vertex on one of their sides; of a compound its members; otherwise 0.
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
    members: Vec<Body>,
    side: Side,
    /// Members of a union that touch others.
    feet: Feet,
}

/// What finds the first hit, and what gives the distance where that does not.
#[derive(Debug)]
enum Body {
    Convex(Convex, Distance<3>),
    Rounded(Rounded),
    Mesh(Mesh, Distance<3>),
    Parallel(Parallel),
    Distance(Distance<3>),
}

/// The point of the boundary closest to a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest {
    /// Distance from the boundary \[L\], negative outside the table.
    pub distance: f64,
    /// The closest point of the boundary \[L\].
    pub point: Vector3<f64>,
    /// Unit normal there, into the table. It is 0 for a point of a mesh on triangles between which there is no table: where two of its
    /// parts touch.
    pub normal: Vector3<f64>,
}

fn unsupported(shape: &'static str, why: &'static str) -> Error {
    Error::Shape { shape, why }
}

impl Solid {
    /// The boundary of a shape in a pose, with the table on the given side.
    ///
    /// # Errors
    /// [`Error::Shape`] for shapes without volume (segments, polylines, single triangles; give them a border), obstacles no thicker than
    /// the rounding of their coordinates, and the inside of a compound with members that are not convex; [`Error::Triangle`] for
    /// triangles of a mesh that do not form a surface or are not oriented alike, and closed meshes with contradictory parts or that run
    /// through themselves; [`Error::Length`] for a size, or a greatest coordinate of the boundary, that is not between 10⁻¹⁵⁰ and 10¹⁵⁰,
    /// since squares would over- or underflow, and for a border that is not positive or is wider than that; [`Error::Parameter`] for a
    /// translation that is not finite.
    pub fn new(shape: &dyn Shape, pose: &Isometry3<f64>, side: Side) -> Result<Solid, Error> {
        finite("translation", &pose.translation.vector)?;
        Solid::placed(shape, &Frame::from(pose), side)
    }

    /// The boundary of a convex polyhedron in a frame, perhaps rounded.
    pub(super) fn polytope(polytope: &Polytope, rounding: f64, frame: &Frame<3>, side: Side) -> Result<Solid, Error> {
        Solid::of(vec![Body::polytope(polytope, rounding, frame, side)?], side)
    }

    /// The boundary of a shape in a frame.
    pub(super) fn placed(shape: &dyn Shape, frame: &Frame<3>, side: Side) -> Result<Solid, Error> {
        let mut members = vec![];
        add(shape, frame, side, &mut members)?;
        if side == Side::Inside && members.len() > 1 && members.iter().any(|m| !matches!(m, Body::Convex(..))) {
            return Err(unsupported("compound", "the inside of a union is known for convex members only"));
        }
        Solid::of(members, side)
    }

    fn of(members: Vec<Body>, side: Side) -> Result<Solid, Error> {
        let boxes: Vec<Extent<3>> = members.iter().map(Body::extent).collect();
        has_squares(boxes.iter().copied())?;
        let tree = BoxTree::new(boxes.iter().copied());
        let reach = 2.0 * slack([tree.size()]);
        let standing = boxes.iter().enumerate().filter(|(k, _)| members.len() > 1 && members[*k].has_edges());
        let standing = standing.map(|(k, extent)| (k, extent.grown(reach)));
        let feet = Feet::new(&tree, standing, |other, extent| members[other].stays_out_of(extent, side));
        Ok(Solid { members, side, feet })
    }

    /// The table for the centre of a ball of radius `margin` \[L\] in this one: all points farther than that from the triangles of
    /// meshes, height fields and voxels. (For other shapes see [`SolidSpec::parallel`](super::SolidSpec::parallel).)
    ///
    /// A ball that touches triangles on both sides of an edge at once, where the table is bent like the inside of a corner, is in a
    /// corner. Behind an open mesh there is no table, but its triangles also keep off a ball that comes round its rim.
    ///
    /// # Errors
    /// [`Error::Shape`] for other shapes, [`Error::Length`] unless the margin is positive and at most 10¹⁵⁰.
    ///
    /// ```
    /// use geometry::{parry::{parry3d_f64::shape::{Cuboid, TriMesh}, Side, Solid}, Boundary, Line, Vector3};
    /// use nalgebra::Isometry3;
    /// let (vertices, triangles) = Cuboid::new([1.0, 1.0, 1.0].into()).to_trimesh();
    /// let crate_ = TriMesh::new(vertices, triangles).unwrap();
    /// let room = Solid::new(&crate_, &Isometry3::identity(), Side::Inside)?.kept_off(0.25)?;
    /// let path = Line { point: Vector3::new(0.0, 0.5, 0.0), velocity: Vector3::new(1.0, 0.0, 0.0) };
    /// let hit = room.first_hit(&path).unwrap();
    /// assert_eq!((hit.time, hit.normal), (0.75, Vector3::new(-1.0, 0.0, 0.0)));
    /// # Ok::<(), geometry::Error>(())
    /// ```
    pub fn kept_off(self, margin: f64) -> Result<Solid, Error> {
        let Solid { members, side, .. } = self;
        let parallel = |body| match body {
            Body::Mesh(mesh, distance) => Parallel::new(mesh, distance, margin).map(Body::Parallel),
            _ => Err(unsupported(
                "solid",
                "kept_off is for surfaces of triangles only; around other shapes, use SolidSpec::parallel",
            )),
        };
        Solid::of(members.into_iter().map(parallel).collect::<Result<_, _>>()?, side)
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
        let of = |m: &Body| m.closest(point, self.side);
        // serves both the table outside (nearest obstacle) and inside (deepest of the members around the point)
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
        let (distance, beside) = (self.closest(point).distance, self.beside(point));
        if beside == *point { distance } else { distance.abs().copysign(self.closest(&beside).distance) }
    }

    /// A point on the same side of the boundary and not far from it: seen from [`FAR`] away, the boundary's shape is lost in rounding.
    fn beside(&self, point: &Vector3<f64>) -> Vector3<f64> {
        if point.amax() <= FAR * self.size() {
            return *point;
        }
        self.extent().beside(point)
    }

    /// How far off the boundary \[L\] a point may lie and still count as on it: the rounding of its coordinates and of those of the
    /// walls.
    pub fn slack(&self, point: &Vector3<f64>) -> f64 {
        slack([self.size(), point.amax()])
    }

    /// The largest of the numbers \[L\] that define it: for a half-space, a coordinate of the point given on its plane.
    pub fn size(&self) -> f64 {
        let sizes = self.members.iter().map(|member| {
            if let Body::Convex(convex, _) = member {
                return convex.size();
            }
            let Extent { min, max } = member.extent();
            min.amax().max(max.amax())
        });
        sizes.fold(0.0, f64::max)
    }

    /// Whether a point lies in the table, off the boundary.
    pub fn contains(&self, point: &Vector3<f64>) -> bool {
        is_finite(point) && self.closest(&self.beside(point)).distance > 0.0
    }

    /// A box around the boundary, infinite for a half-space.
    pub fn extent(&self) -> Extent<3> {
        self.members.iter().map(Body::extent).fold(Extent::EMPTY, Extent::union)
    }

    fn meshes(&self) -> impl Iterator<Item = &Mesh> {
        self.members.iter().filter_map(|body| match body {
            Body::Mesh(mesh, _) => Some(mesh),
            _ => None,
        })
    }

    /// Whether it has triangles with the table on both sides.
    pub(super) fn has_two_sides(&self) -> bool {
        self.meshes().any(Mesh::has_two_sides)
    }

    /// Whether a point of a wall with this normal lies where such a triangle meets that wall.
    pub(super) fn meets_a_sheet(&self, point: &Vector3<f64>, normal: &Vector3<f64>) -> bool {
        self.meshes().any(|mesh| mesh.meets_a_sheet(point, normal))
    }

    /// Whether it is an obstacle with edges, which may stand on other walls. The table inside of a convex solid needs no such test: a
    /// path that comes to its surface hits it.
    pub(super) fn may_stand(&self) -> bool {
        self.side == Side::Outside && self.members.iter().any(Body::has_edges)
    }

    /// Whether its surface is known to stay out of a box.
    pub(super) fn stays_out_of(&self, extent: &Extent<3>) -> bool {
        self.members.iter().all(|member| member.stays_out_of(extent, self.side))
    }

    /// Whether a point lies on its exact convex members, to within `near`; beside an edge, to within a strip.
    pub(super) fn has_on_it(&self, point: &Vector3<f64>, near: f64) -> bool {
        self.convex().any(|(_, convex)| convex.off(point).abs() <= near)
    }

    /// Whether it stands at a point of a wall with this normal, to within `near`.
    pub(super) fn stands_at(&self, point: &Vector3<f64>, normal: &Vector3<f64>, near: f64) -> bool {
        self.convex().any(|(_, convex)| convex.stands_at(point, normal, near))
    }

    /// Whether another member of a union stands where one is hit.
    fn is_foot(&self, path: &Line<3>, hit: &Hit<3>) -> bool {
        let outward = if self.side == Side::Outside { hit.normal } else { -hit.normal };
        let size = path.point.amax().max(hit.point.amax());
        self.feet.any_at(&hit.point, CORNER * size, |k| match &self.members[k] {
            Body::Convex(convex, _) if k != hit.piece => convex.stands_at(&hit.point, &outward, CORNER * size),
            _ => false,
        })
    }

    /// The exact convex members, with their numbers.
    fn convex(&self) -> impl Iterator<Item = (usize, &Convex)> {
        self.members.iter().enumerate().filter_map(|(i, member)| match member {
            Body::Convex(convex, _) => Some((i, convex)),
            _ => None,
        })
    }

    /// Its figure, if it is one that walls in lanes support.
    pub(super) fn figure(&self) -> Option<Figure> {
        match &self.members[..] {
            [Body::Convex(convex, _)] => convex.figure(),
            _ => None,
        }
    }

    /// Its surfaces, if it is a single convex body that walls in lanes support.
    pub(super) fn body(&self) -> Option<ConvexBody> {
        match &self.members[..] {
            [Body::Convex(convex, _)] => convex.body(self.side),
            [Body::Mesh(mesh, _)] => mesh.body(0.0),
            [Body::Parallel(parallel)] => parallel.body(),
            _ => None,
        }
    }

    /// Leaves a union of convex shapes: through each shape entered on the way, until one is left without another being entered.
    fn leave(&self, path: &Line<3>) -> Option<Hit<3>> {
        let mut best: Option<(usize, f64, usize)> = None; // member, time, face
        loop {
            let reached = best.map_or(0.0, |b| b.1);
            let at = path.at(reached);
            let farther = self
                .convex()
                .filter(|(_, c)| c.contains(&at))
                .filter_map(|(i, c)| c.exit(path).map(|(t, face)| (i, t, face)))
                .filter(|(_, t, _)| best.is_none() || *t > reached)
                .max_by(|a, b| a.1.total_cmp(&b.1));
            let Some(next) = farther else { break };
            best = Some(next);
            if self.members.len() == 1 {
                break;
            }
        }
        let (member, time, face) = best?;
        let Body::Convex(convex, _) = &self.members[member] else { return None };
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
        if self.side == Side::Inside && matches!(self.members[0], Body::Convex(..)) {
            let hit = self.leave(path)?;
            return Some(Hit { corner: hit.corner || self.is_foot(path, &hit), ..hit });
        }
        let several = self.members.len() > 1;
        let hits = self.members.iter().enumerate().filter_map(|(i, member)| match member {
            Body::Convex(convex, _) => {
                convex.entry(path).map(|(time, face)| self.hit_convex(i, convex, path, time, face))
            }
            Body::Rounded(rounded) => rounded.first(path, self.side).map(|time| {
                let (point, outward) = rounded.land(&path.at(time));
                let normal = if self.side == Side::Outside { outward } else { -outward };
                Hit { time, point, normal, piece: i, corner: false }
            }),
            Body::Mesh(mesh, _) => mesh.first(path).map(|(k, time)| {
                let (point, corner) = mesh.land(k, &path.at(time));
                Hit { time, point, normal: mesh.normals[k], piece: if several { i } else { k }, corner }
            }),
            Body::Parallel(parallel) => parallel.first(path).map(|(k, time)| {
                let (point, normal, corner) = parallel.land(k, &path.at(time));
                Hit { time, point, normal, piece: if several { i } else { k }, corner }
            }),
            Body::Distance(distance) => distance.first(path).map(|time| {
                let (point, normal, _) = distance.closest(&path.at(time));
                Hit { time, point, normal, piece: i, corner: false }
            }),
        });
        let hit = first_of(path, hits)?;
        // a single mesh has checked for that already
        let corner =
            hit.corner || (several && (self.meets_a_sheet(&hit.point, &hit.normal) || self.is_foot(path, &hit)));
        Some(Hit { corner, ..hit })
    }
}

impl Body {
    /// A convex polyhedron, perhaps rounded.
    fn polytope(polytope: &Polytope, rounding: f64, frame: &Frame<3>, side: Side) -> Result<Body, Error> {
        if rounding > 0.0 {
            return Rounded::polytope(polytope, rounding, frame).map(Body::Rounded);
        }
        let distance = field::polytope(polytope)?.placed(frame, side);
        Ok(Body::Convex(Convex::polytope(polytope, frame), distance))
    }

    /// Whether it is an exact convex solid with edges.
    fn has_edges(&self) -> bool {
        matches!(self, Body::Convex(convex, _) if convex.has_edges())
    }

    /// Whether its surface is known to stay out of a box.
    fn stays_out_of(&self, extent: &Extent<3>, side: Side) -> bool {
        let is_apart = |convex: &Convex| {
            // the box lies within, or in front of a plane
            let off = || extent.corners().map(|corner| convex.off(&corner));
            off().all(|off| off < 0.0) || (convex.is_half_space() && off().all(|off| off > 0.0))
        };
        let (middle, half) = (extent.min * 0.5 + extent.max * 0.5, extent.max * 0.5 - extent.min * 0.5);
        matches!(self, Body::Convex(convex, _) if is_apart(convex))
            || self.closest(&middle, side).distance.abs() > half.norm()
    }

    fn closest(&self, point: &Vector3<f64>, side: Side) -> Closest {
        let distance = match self {
            Body::Convex(convex, distance) => {
                if let Some((foot, outward, off)) = convex.nearest_face(point) {
                    let sign = if side == Side::Outside { 1.0 } else { -1.0 };
                    return Closest { distance: sign * off, point: foot, normal: outward * sign };
                }
                distance
            }
            Body::Rounded(rounded) => return rounded.closest(point, side),
            Body::Parallel(parallel) => return parallel.closest(point),
            Body::Mesh(mesh, distance) => return nearest::closest(mesh, distance, point),
            Body::Distance(distance) => distance,
        };
        let (foot, normal, distance) = distance.closest(point);
        Closest { distance, point: foot, normal }
    }

    fn extent(&self) -> Extent<3> {
        match self {
            Body::Rounded(rounded) => rounded.extent(),
            Body::Parallel(parallel) => parallel.extent(),
            Body::Convex(convex, _) if convex.is_half_space() => Extent::WHOLE,
            Body::Convex(_, distance) | Body::Mesh(_, distance) | Body::Distance(distance) => distance.extent(),
        }
    }
}

/// Adds the simple members of a shape.
fn add(shape: &dyn Shape, frame: &Frame<3>, side: Side, members: &mut Vec<Body>) -> Result<(), Error> {
    let outside = side == Side::Outside;
    let exact = |convex: Convex, members: &mut Vec<Body>| {
        members.push(Body::Convex(convex, field::distance(shape, frame, side)));
    };
    // narrow rooms are exact
    let thick = |name: &'static str, widths: [f64; 2], convex: Convex| {
        let why = "it is no thicker than the rounding of its coordinates: paths would pass through it";
        let is_thin = outside && convex.is_too_thin(widths[0].min(widths[1]));
        if is_thin { Err(unsupported(name, why)) } else { Ok(convex) }
    };
    let mesh = |vertices: Vec<Vector3<f64>>, triangles: &[[usize; 3]], loose| {
        let mesh = Mesh::new(&vertices, frame, triangles, outside, loose)?;
        let distance = field::mesh_distance(&mesh, side)?;
        Ok::<Body, Error>(Body::Mesh(mesh, distance))
    };
    let round = |rounded: Result<Rounded, Error>| rounded.map(Body::Rounded);
    match shape.as_typed_shape() {
        TypedShape::Ball(ball) => {
            has_square("the radius", ball.radius)?;
            exact(Convex::ball(frame.translation, ball.radius), members);
        }
        TypedShape::Cuboid(cuboid) => {
            let least = 2.0 * from_glam3(cuboid.half_extents).min();
            exact(thick("cuboid", [least; 2], Convex::cuboid(cuboid, frame)?)?, members);
        }
        TypedShape::HalfSpace(half) => exact(Convex::half_space(half, frame), members),
        TypedShape::Capsule(capsule) => exact(Convex::capsule(capsule, frame)?, members),
        TypedShape::Cylinder(cylinder) => {
            let widths = [2.0 * cylinder.half_height, 2.0 * cylinder.radius];
            exact(thick("cylinder", widths, Convex::cylinder(cylinder, frame)?)?, members);
        }
        TypedShape::Cone(cone) => {
            let widths = [2.0 * cone.half_height, 2.0 * cone.radius];
            exact(thick("cone", widths, Convex::cone(cone, frame)?)?, members);
        }
        TypedShape::ConvexPolyhedron(hull) => {
            members.push(Body::polytope(&polytope(hull)?, 0.0, frame, side)?);
        }
        TypedShape::TriMesh(m) => {
            let vertices = m.vertices().iter().map(|&v| from_glam3(v)).collect();
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
        TypedShape::RoundCuboid(r) => members.push(round(Rounded::cuboid(&r.inner_shape, r.border_radius, frame))?),
        TypedShape::RoundTriangle(r) => members.push(round(Rounded::triangle(&r.inner_shape, r.border_radius, frame))?),
        TypedShape::RoundCylinder(r) => members.push(round(Rounded::cylinder(&r.inner_shape, r.border_radius, frame))?),
        TypedShape::RoundCone(r) => members.push(round(Rounded::cone(&r.inner_shape, r.border_radius, frame))?),
        TypedShape::RoundConvexPolyhedron(r) => {
            members.push(round(Rounded::polytope(&polytope(&r.inner_shape)?, r.border_radius, frame))?);
        }
        TypedShape::Segment(_) => return Err(unsupported("segment", "a curve is no wall in space: use a capsule")),
        TypedShape::Polyline(_) => return Err(unsupported("polyline", "a curve is no wall in space: use capsules")),
        TypedShape::Triangle(_) => {
            return Err(unsupported(
                "triangle",
                "it has no volume: use a round triangle, or a mesh seen from one side",
            ));
        }
        TypedShape::Custom(_) => {
            members.push(Body::Distance(Spatial::distance(shape, frame, side)));
        }
    }
    Ok(())
}

/// Uses only its points: what parry joins into faces need not lie in a plane.
fn polytope(hull: &ConvexPolyhedron) -> Result<Polytope, Error> {
    let points: Vec<Vector3<f64>> = hull.points().iter().map(|&p| from_glam3(p)).collect();
    Polytope::hull(&points).ok_or_else(|| unsupported("convex polyhedron", "its points lie in a plane"))
}

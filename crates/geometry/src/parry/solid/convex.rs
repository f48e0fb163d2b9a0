//! Convex solids as intersections of half-spaces, balls, tubes and cones: exact chords.
mod standing;

use super::super::convert::{Frame, from_glam3};
use crate::{
    Error, Line,
    chord::is_chord,
    parry::{Side, polytope::Polytope},
    plane::{has_square, slack},
    surface::any_across,
    walls::{CORNER, ConvexBody},
};
use nalgebra::Vector3;
use parry3d_f64::shape::{Capsule, Cone, Cuboid, Cylinder, HalfSpace};
use std::collections::HashMap;

/// A convex solid.
#[derive(Clone, Debug)]
pub(super) struct Convex {
    kind: Kind,
    /// The edges of each face; none where faces meet only at right angles, so that an edge is as far away as the face beyond it.
    edges: Vec<Vec<Edge>>,
    /// The largest of its coordinates; for a half-space, that of the point given on its plane.
    size: f64,
    slack: f64,
    /// A point within this distance of an edge lies on it.
    near: f64,
}

#[derive(Clone, Debug)]
enum Kind {
    /// The intersection of the convex sides of these faces.
    Intersection(Vec<Face>),
    /// The hull of two balls.
    Capsule(Box<Pill>),
}

#[derive(Clone, Debug)]
struct Pill {
    /// The tube, and the planes through its ends, normals outwards.
    tube: [Face; 3],
    balls: [Face; 2],
}

/// A surface with a convex side.
#[derive(Clone, Copy, Debug)]
enum Face {
    Plane {
        through: Vector3<f64>,
        normal: Vector3<f64>,
    },
    Ball {
        center: Vector3<f64>,
        radius: f64,
    },
    /// An infinite cylinder.
    Tube {
        through: Vector3<f64>,
        axis: Vector3<f64>,
        radius: f64,
    },
    /// An infinite cone: its apex, the unit axis into it, and the tangent of its half-angle.
    Nappe {
        apex: Vector3<f64>,
        axis: Vector3<f64>,
        slope: f64,
    },
}

/// The figures that walls in lanes support.
#[derive(Clone, Copy, Debug)]
pub(in crate::parry) enum Figure {
    Ball {
        center: Vector3<f64>,
        radius: f64,
    },
    /// A box with its sides along the axes, between two corners.
    Cuboid {
        low: Vector3<f64>,
        high: Vector3<f64>,
    },
    /// The half-space below a plane perpendicular to an axis, or above it where its outward normal does not point upwards.
    HalfSpace {
        axis: usize,
        upwards: bool,
        at: f64,
    },
    /// A cylinder with flat ends about a unit vector.
    Cylinder {
        center: Vector3<f64>,
        axis: Vector3<f64>,
        radius: f64,
        half_height: f64,
    },
}

/// Where two faces meet.
#[derive(Clone, Copy, Debug)]
enum Edge {
    /// A line along a unit vector.
    Straight { through: Vector3<f64>, along: Vector3<f64> },
    /// A circle around an axis.
    Round { center: Vector3<f64>, axis: Vector3<f64>, radius: f64 },
}

impl Edge {
    /// The distance of a point from it.
    fn distance(&self, x: &Vector3<f64>) -> f64 {
        match self {
            Edge::Straight { through, along } => along.cross(&(x - through)).norm(),
            Edge::Round { center, axis, radius } => {
                let w = x - center;
                libm::hypot(across(&w, axis).norm() - radius, w.dot(axis))
            }
        }
    }
}

/// Faces whose normals differ by no more than this continue one another: no intended angle is this small.
const SMOOTH: f64 = 1e-9;

/// The part of a line on the convex side of a face.
#[derive(Clone, Copy, Debug)]
struct Chord {
    enter: f64,
    exit: f64,
}

const WHOLE: Chord = Chord { enter: f64::NEG_INFINITY, exit: f64::INFINITY };

/// `A t² + 2 B t + C ≤ 0` with `A > 0` and the discriminant `B² − A C` given; `touches`: a start that lies inside up to rounding
/// always has a chord.
fn between(a: f64, b: f64, c: f64, discriminant: f64, touches: bool) -> Option<Chord> {
    if discriminant < 0.0 && !touches {
        return None;
    }
    let root = libm::sqrt(discriminant.max(0.0));
    let q = b.abs() + root;
    if q == 0.0 {
        return Some(Chord { enter: 0.0, exit: 0.0 });
    }
    if discriminant < -(a * c) {
        // both are so small that rounding spoils C as a product of the roots
        return Some(Chord { enter: (-b - root) / a, exit: (root - b) / a });
    }
    Some(if b < 0.0 { Chord { enter: c / q, exit: q / a } } else { Chord { enter: -q / a, exit: -c / q } })
}

impl Face {
    /// The distance of a point on the outer side; negative on the convex side.
    fn off(&self, x: &Vector3<f64>) -> f64 {
        match self {
            Face::Plane { through, normal } => normal.dot(&(x - through)),
            Face::Ball { center, radius } => (x - center).norm() - radius,
            Face::Tube { through, axis, radius } => across(&(x - through), axis).norm() - radius,
            Face::Nappe { apex, axis, slope } => {
                let w = x - apex;
                (across(&w, axis).norm() - slope * w.dot(axis)) / libm::sqrt(1.0 + slope * slope)
            }
        }
    }

    /// The closest point of the face, and the outward normal there.
    fn project(&self, x: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let unit = |w: Vector3<f64>, axis: &Vector3<f64>| {
            let length = w.norm();
            if length > 0.0 { w / length } else { any_across(axis) }
        };
        match self {
            Face::Plane { normal, .. } => (x - normal * self.off(x), *normal),
            Face::Ball { center, radius } => {
                let n = unit(x - center, &Vector3::x());
                (center + n * *radius, n)
            }
            Face::Tube { through, axis, radius } => {
                let w = x - through;
                let n = unit(across(&w, axis), axis);
                (through + axis * w.dot(axis) + n * *radius, n)
            }
            Face::Nappe { apex, axis, slope } => {
                let out = unit(across(&(x - apex), axis), axis);
                let n = (out - axis * *slope) / libm::sqrt(1.0 + slope * slope);
                (x - n * self.off(x), n)
            }
        }
    }

    /// Whether the path approaches the convex side at its start.
    fn approached(&self, path: &Line<3>) -> bool {
        self.project(&path.point).1.dot(&path.velocity) < 0.0
    }

    fn chord(&self, path: &Line<3>, slack: f64) -> Option<Chord> {
        let (x, v) = (&path.point, &path.velocity);
        let touches = self.off(x) <= slack;
        match self {
            Face::Plane { normal, .. } => {
                let (distance, speed) = (self.off(x), normal.dot(v));
                let time = -distance / speed;
                if speed > 0.0 {
                    Some(Chord { exit: time, ..WHOLE })
                } else if speed < 0.0 {
                    Some(Chord { enter: time, ..WHOLE })
                } else {
                    touches.then_some(WHOLE)
                }
            }
            Face::Ball { center, radius } => round(&(x - center), v, *radius, touches),
            Face::Tube { through, axis, radius } => {
                round(&across(&(x - through), axis), &across(v, axis), *radius, touches)
            }
            Face::Nappe { apex, axis, slope } => {
                let w = x - apex;
                let (g, down) = (w.dot(axis), v.dot(axis));
                let (w, v) = (across(&w, axis), across(v, axis));
                let k = *slope;
                let a = (v.norm() - k * down) * (v.norm() + k * down);
                let b = w.dot(&v) - k * k * g * down;
                let c = (w.norm() - k * g) * (w.norm() + k * g);
                // B² − AC without cancellation
                let (m, turn) = (k * (v * g - w * down).norm(), w.cross(&v).norm());
                let discriminant = (m - turn) * (m + turn);
                if a > 0.0 {
                    let Chord { enter, exit } = between(a, b, c, discriminant, touches)?;
                    let chord = Chord { enter: self.nearer(path, enter, slack), exit: self.nearer(path, exit, slack) };
                    return (g - b / a * down >= 0.0).then_some(chord);
                }
                // one end lies at infinity, in the direction of the axis
                if a == 0.0 {
                    // parallel to a generator: relative to a point beside the apex nothing cancels; it crosses the double cone
                    // once, in the mirror nappe if it leans away from the axis
                    let beside = -g / down;
                    let w = w + v * beside;
                    let lean = w.dot(&v);
                    let end = if lean * down < 0.0 {
                        beside - w.norm_squared() / (2.0 * lean)
                    } else if touches && down != 0.0 {
                        // along the generator itself: starting at the apex
                        beside
                    } else {
                        return None;
                    };
                    return Some(if down > 0.0 {
                        Chord { enter: self.nearer(path, end, slack), ..WHOLE }
                    } else {
                        Chord { exit: self.nearer(path, end, slack), ..WHOLE }
                    });
                }
                // steeper than the cone: through both nappes
                let root = libm::sqrt(discriminant.max(0.0));
                let q = -(b + if b < 0.0 { -root } else { root });
                let roots = if q == 0.0 { [0.0; 2] } else { [q / a, c / q] };
                Some(if down > 0.0 {
                    Chord { enter: self.nearer(path, roots[0].max(roots[1]), slack), ..WHOLE }
                } else {
                    Chord { exit: self.nearer(path, roots[0].min(roots[1]), slack), ..WHOLE }
                })
            }
        }
    }

    /// A crossing time improved by one step of Newton's method: coefficients of the quadratic that are differences lose some
    /// digits.
    fn nearer(&self, path: &Line<3>, time: f64, slack: f64) -> f64 {
        let view = |time: f64| {
            let [point, rest] = path.at_exactly(time);
            let (_, normal) = self.project(&point);
            (self.off(&point) + normal.dot(&rest), normal.dot(&path.velocity))
        };
        let (height, rise) = view(time);
        let next = time - height / rise;
        let is_short = (height / rise).abs() * path.velocity.norm() <= slack;
        // at grazing incidence the step is long although the height is small, and past the middle of a chord it leads away
        if is_short || (height.abs() <= slack && view(next).0.abs() <= 0.5 * height.abs()) { next } else { time }
    }
}

/// The chord of a ball or, in the plane across its axis, of a tube.
fn round(w: &Vector3<f64>, v: &Vector3<f64>, radius: f64, touches: bool) -> Option<Chord> {
    let (a, b) = (v.norm_squared(), w.dot(v));
    if a == 0.0 {
        return touches.then_some(WHOLE);
    }
    let c = (w.norm() - radius) * (w.norm() + radius);
    let (reach, miss) = (radius * libm::sqrt(a), w.cross(v).norm());
    let chord = between(a, b, c, (reach - miss) * (reach + miss), touches)?;
    let exit = if is_chord([a, b, c], radius * radius) { -2.0 * b / a } else { chord.exit };
    Some(Chord { exit, ..chord })
}

/// The axis along which a unit vector points, and whether it points towards greater coordinates.
fn level(normal: &Vector3<f64>) -> Option<(usize, bool)> {
    let axis = normal.iamax();
    (normal.abs() == Vector3::ith(axis, 1.0)).then_some((axis, normal[axis] > 0.0))
}

/// The part of `w` perpendicular to a unit vector.
fn across(w: &Vector3<f64>, axis: &Vector3<f64>) -> Vector3<f64> {
    w - axis * w.dot(axis)
}

impl Convex {
    fn of(kind: Kind, size: f64) -> Convex {
        Convex { kind, edges: vec![], size, slack: slack([size]), near: CORNER * size }
    }

    /// The same solid with these edges of its faces.
    fn with_edges(self, edges: Vec<Vec<Edge>>) -> Convex {
        Convex { edges, ..self }
    }

    pub(super) fn ball(center: Vector3<f64>, radius: f64) -> Convex {
        Convex::of(Kind::Intersection(vec![Face::Ball { center, radius }]), center.amax() + radius)
    }

    pub(super) fn cuboid(cuboid: &Cuboid, frame: &Frame<3>) -> Result<Convex, Error> {
        let half = from_glam3(cuboid.half_extents);
        let mut faces = vec![];
        for i in 0..3 {
            has_square("an edge", 2.0 * half[i])?;
            for sign in [-1.0, 1.0] {
                let mut e = Vector3::zeros();
                e[i] = sign;
                faces.push(Face::Plane { through: frame.point(&(e * half[i])), normal: frame.direction(&e) });
            }
        }
        Ok(Convex::of(Kind::Intersection(faces), frame.translation.amax() + half.norm()))
    }

    pub(super) fn half_space(half: &HalfSpace, frame: &Frame<3>) -> Convex {
        let normal = frame.direction(&from_glam3(half.normal));
        let face = Face::Plane { through: frame.translation, normal: normal / normal.norm() };
        Convex::of(Kind::Intersection(vec![face]), frame.translation.amax())
    }

    /// Its figure, if it is a simple one.
    pub(super) fn figure(&self) -> Option<Figure> {
        let Kind::Intersection(faces) = &self.kind else { return None };
        match faces[..] {
            [Face::Ball { center, radius }] => Some(Figure::Ball { center, radius }),
            [Face::Plane { through, normal }] => {
                let (axis, upwards) = level(&normal)?;
                Some(Figure::HalfSpace { axis, upwards, at: through[axis] })
            }
            [
                Face::Tube { through, axis, radius },
                Face::Plane { through: bottom, .. },
                Face::Plane { through: top, .. },
            ] => Some(Figure::Cylinder { center: through, axis, radius, half_height: 0.5 * axis.dot(&(top - bottom)) }),
            [_, _, _, _, _, _] => {
                let mut ends = [[None; 2]; 3];
                for face in faces {
                    let Face::Plane { through, normal } = face else { return None };
                    let (axis, upwards) = level(normal)?;
                    ends[axis][usize::from(upwards)] = Some(through[axis]);
                }
                let corner = |end: usize| Some(Vector3::new(ends[0][end]?, ends[1][end]?, ends[2][end]?));
                Some(Figure::Cuboid { low: corner(0)?, high: corner(1)? })
            }
            _ => None,
        }
    }

    /// Its surfaces, with the table inside or outside; `None` for a cone from outside.
    pub(super) fn body(&self, side: Side) -> Option<ConvexBody> {
        let faces = match &self.kind {
            Kind::Intersection(faces) => faces,
            Kind::Capsule(pill) => {
                let [Face::Ball { center: a, radius }, Face::Ball { center: b, .. }] = pill.balls else { return None };
                return Some(ConvexBody::Capsule { ends: [a, b], radius });
            }
        };
        let (mut planes, mut round) = (vec![], None);
        if let [Face::Nappe { apex, axis, slope }, Face::Plane { through: base, .. }] = faces[..] {
            return (side == Side::Inside).then_some(ConvexBody::Cone { apex, axis, slope, base });
        }
        for face in faces {
            match *face {
                Face::Plane { through, normal } => planes.push([through, normal]),
                Face::Ball { center, radius } => round = Some((center, None, radius)),
                Face::Tube { through, axis, radius } => round = Some((through, Some(axis), radius)),
                Face::Nappe { .. } => return None,
            }
        }
        Some(ConvexBody::Intersection { planes, round })
    }

    /// Whether it is a half-space: all others are bounded.
    pub(super) fn is_half_space(&self) -> bool {
        matches!(&self.kind, Kind::Intersection(faces) if matches!(faces[..], [Face::Plane { .. }]))
    }

    pub(super) fn cylinder(cylinder: &Cylinder, frame: &Frame<3>) -> Result<Convex, Error> {
        has_square("the height", 2.0 * cylinder.half_height)?;
        has_square("the radius", cylinder.radius)?;
        let axis = frame.direction(&Vector3::y());
        let cap = |sign: f64| Face::Plane {
            through: frame.point(&(Vector3::y() * (sign * cylinder.half_height))),
            normal: axis * sign,
        };
        let tube = Face::Tube { through: frame.translation, axis, radius: cylinder.radius };
        let size = frame.translation.amax() + cylinder.half_height + cylinder.radius;
        Ok(Convex::of(Kind::Intersection(vec![tube, cap(-1.0), cap(1.0)]), size))
    }

    pub(super) fn cone(cone: &Cone, frame: &Frame<3>) -> Result<Convex, Error> {
        has_square("the height", 2.0 * cone.half_height)?;
        has_square("the radius", cone.radius)?;
        let down = frame.direction(&-Vector3::y());
        let apex = frame.point(&(Vector3::y() * cone.half_height));
        let middle = frame.point(&(Vector3::y() * -cone.half_height));
        let base = Face::Plane { through: middle, normal: down };
        let nappe = Face::Nappe { apex, axis: down, slope: cone.radius / (2.0 * cone.half_height) };
        let size = frame.translation.amax() + cone.half_height + cone.radius;
        let rim = Edge::Round { center: middle, axis: down, radius: cone.radius };
        Ok(Convex::of(Kind::Intersection(vec![nappe, base]), size).with_edges(vec![vec![rim]; 2]))
    }

    pub(super) fn capsule(capsule: &Capsule, frame: &Frame<3>) -> Result<Convex, Error> {
        let radius = capsule.radius;
        has_square("the radius", radius)?;
        let [a, b] = [capsule.segment.a, capsule.segment.b].map(|p| frame.point(&from_glam3(p)));
        let length = (b - a).norm();
        if length == 0.0 {
            return Ok(Convex::ball(a, radius));
        }
        let axis = (b - a) / length;
        let tube = [
            Face::Tube { through: a, axis, radius },
            Face::Plane { through: a, normal: -axis },
            Face::Plane { through: b, normal: axis },
        ];
        let balls = [a, b].map(|center| Face::Ball { center, radius });
        Ok(Convex::of(Kind::Capsule(Box::new(Pill { tube, balls })), a.amax().max(b.amax()) + radius))
    }

    pub(super) fn polytope(polytope: &Polytope, frame: &Frame<3>) -> Convex {
        let planes = polytope.faces.iter().map(|face| Face::Plane {
            through: frame.point(&polytope.corners[face.top]),
            normal: frame.direction(&face.normal),
        });
        let size = polytope.corners.iter().map(|p| frame.point(p).amax()).fold(0.0, f64::max);
        let normals: HashMap<[usize; 2], &Vector3<f64>> =
            polytope.faces.iter().flat_map(|face| face.sides().map(|side| (side, &face.normal))).collect();
        let edges = polytope.faces.iter().map(|face| {
            let smooth = |[a, b]: [usize; 2]| normals.get(&[b, a]).is_some_and(|n| (face.normal - *n).norm() <= SMOOTH);
            let straight = |side: [usize; 2]| {
                let [a, b] = side.map(|k| frame.point(&polytope.corners[k]));
                Edge::Straight { through: a, along: (b - a).normalize() }
            };
            face.sides().filter(|side| !smooth(*side)).map(straight).collect()
        });
        Convex::of(Kind::Intersection(planes.collect()), size).with_edges(edges.collect())
    }

    pub(super) fn size(&self) -> f64 {
        self.size
    }

    /// How far a point may be off a face and still count as on it, for a path with this start.
    fn slack(&self, path: &Line<3>) -> f64 {
        self.slack + slack([path.point.amax()])
    }

    /// Where the line enters and leaves, with the faces.
    fn chord(&self, path: &Line<3>) -> Option<[(f64, usize); 2]> {
        let slack = self.slack(path);
        let of = |faces: &[Face]| {
            let mut ends = [(f64::NEG_INFINITY, 0), (f64::INFINITY, 0)];
            for (i, face) in faces.iter().enumerate() {
                let Chord { enter, exit } = face.chord(path, slack)?;
                if enter > ends[0].0 {
                    ends[0] = (enter, i);
                }
                if exit < ends[1].0 {
                    ends[1] = (exit, i);
                }
            }
            Some(ends)
        };
        match &self.kind {
            Kind::Intersection(faces) => of(faces),
            Kind::Capsule(pill) => {
                let Pill { tube, balls } = &**pill;
                let parts = [of(tube).filter(|[enter, exit]| enter.0 < exit.0), of(&balls[..1]), of(&balls[1..])];
                let parts = parts.into_iter().flatten();
                parts.reduce(|[a, b], [c, d]| [(a.0.min(c.0), 0), (b.0.max(d.0), 0)])
            }
        }
    }

    /// The face with this number, for a point near it.
    fn face(&self, number: usize, at: &Vector3<f64>) -> Option<Face> {
        match &self.kind {
            Kind::Intersection(faces) => faces.get(number).copied(),
            Kind::Capsule(pill) => Some(match &**pill {
                Pill { tube, balls } if tube[1].off(at) > 0.0 => balls[0],
                Pill { tube, balls } if tube[2].off(at) > 0.0 => balls[1],
                Pill { tube, .. } => tube[0],
            }),
        }
    }

    /// How far a point lies outside; negative inside.
    pub(super) fn off(&self, x: &Vector3<f64>) -> f64 {
        match &self.kind {
            Kind::Intersection(faces) => faces.iter().map(|f| f.off(x)).fold(f64::NEG_INFINITY, f64::max),
            Kind::Capsule(_) => self.face(0, x).map_or(f64::INFINITY, |f| f.off(x)),
        }
    }

    /// Whether a point lies inside or, within rounding, on the surface.
    pub(super) fn contains(&self, x: &Vector3<f64>) -> bool {
        self.off(x) <= self.slack + slack([x.amax()])
    }

    /// When and through which face the path leaves.
    pub(super) fn exit(&self, path: &Line<3>) -> Option<(f64, usize)> {
        let [_, (exit, face)] = self.chord(path)?;
        (exit < f64::INFINITY).then_some((exit.max(0.0), face))
    }

    /// When and through which face the path comes in from outside.
    pub(super) fn entry(&self, path: &Line<3>) -> Option<(f64, usize)> {
        let [(enter, number), (exit, _)] = self.chord(path)?;
        let slack = self.slack(path);
        let speed = path.velocity.norm();
        // a chord shorter than rounding cuts an edge that the path has just left, or is a touch; for paths from afar, only the
        // solid's own rounding counts, or thin solids would be passed through
        let shortest = if enter * speed > slack { self.slack } else { slack };
        let real = (exit - enter) * speed > shortest && enter > f64::NEG_INFINITY;
        let starts_on_it = || {
            let face = self.face(number, &path.point);
            exit > 0.0 && face.is_some_and(|f| f.off(&path.point) >= -slack && f.approached(path))
        };
        (real && (enter > 0.0 || starts_on_it())).then_some((enter.max(0.0), number))
    }

    /// A point projected onto a face, and the outward normal there.
    pub(super) fn land(&self, face: usize, x: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        self.face(face, x).map_or((*x, Vector3::zeros()), |f| f.project(x))
    }

    /// Whether a point of one face lies on an edge of it, within rounding.
    ///
    /// Where faces meet at a small angle, a whole strip beside their edge lies on both of them within rounding.
    pub(super) fn on_edge(&self, face: usize, x: &Vector3<f64>) -> bool {
        match &self.kind {
            Kind::Intersection(faces) => {
                let is_near = |edge: &Edge| edge.distance(x) <= self.near;
                (faces.iter().enumerate().any(|(i, f)| i != face && f.off(x).abs() <= self.near)
                    && self.edges.get(face).is_none_or(|own| own.iter().any(is_near)))
                    || matches!(faces[face], Face::Nappe { apex, .. } if (x - apex).norm() <= self.near)
            }
            Kind::Capsule(_) => false,
        }
    }

    /// Whether a solid of this width is no thicker than some roundings of its coordinates: a chord through it would count as a touch, and
    /// paths would pass. The bound is that for hulls of points.
    pub(super) fn is_too_thin(&self, width: f64) -> bool {
        width <= 4.0 * self.slack
    }

    /// For points whose closest point of the surface is that of the nearest face: closest point, outward normal, and distance
    /// outside.
    pub(super) fn nearest_face(&self, x: &Vector3<f64>) -> Option<(Vector3<f64>, Vector3<f64>, f64)> {
        let face = match &self.kind {
            Kind::Capsule(_) => self.face(0, x)?,
            Kind::Intersection(faces) => {
                let nearest = faces.iter().max_by(|a, b| a.off(x).total_cmp(&b.off(x)))?;
                if faces.len() > 1 && nearest.off(x) > 0.0 {
                    return None;
                }
                *nearest
            }
        };
        let (point, normal) = face.project(x);
        Some((point, normal, face.off(x)))
    }
}

//! Shapes in space whose hits are measured, and what is true of them.
use super::convex::Core;
use super::number::big;
use super::rays::Random;
use super::solids::{Edge, outward};
use super::space::Face;
use billiards::geometry::{
    Error, Vector3,
    parry::{
        Side, Solid, SolidSpec,
        parry3d_f64::{
            math::Vector as Glam,
            shape::{
                Ball, Capsule, Cone, ConvexPolyhedron, Cuboid as Brick, Cylinder, RoundShape, Shape, TriMesh, Triangle,
            },
        },
    },
};
use core::f64::consts::PI;
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

/// How the library is told of a body.
pub(crate) enum Source {
    /// As a shape of parry, lying as it is.
    Straight(Box<dyn Shape>),
    /// As a shape of parry, turned.
    Turned(Box<dyn Shape>),
    /// As plain data.
    Spec(SolidSpec),
    /// As triangles, for the centre of a ball of some radius.
    KeptOff(Box<TriMesh>, f64),
}

/// What a turned shape is turned by, of any length.
const TURN: [f64; 4] = [0.8, 0.3, -0.2, 0.4];
/// No turn.
const STRAIGHT: [f64; 4] = [1.0, 0.0, 0.0, 0.0];
/// The quarter turn that lays the second axis on the third.
const UPRIGHT: [f64; 4] = [1.0, 1.0, 0.0, 0.0];

impl Source {
    /// By which quaternion, of any length, the body is turned.
    pub(crate) fn turn(&self) -> [f64; 4] {
        match self {
            // the truth is about the rounded one
            Source::Turned(_) => {
                let q = Source::rotation(TURN).into_inner();
                [q.w, q.i, q.j, q.k]
            }
            Source::Spec(SolidSpec::Cylinder { .. } | SolidSpec::Cone { .. }) => UPRIGHT,
            Source::Straight(_) | Source::Spec(_) | Source::KeptOff(..) => STRAIGHT,
        }
    }
    fn rotation([w, i, j, k]: [f64; 4]) -> UnitQuaternion<f64> {
        UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k))
    }

    /// The library's boundary of the body, moved.
    ///
    /// # Errors
    /// None, but that the library's constructors may have some.
    pub(crate) fn solid(&self, center: [f64; 3], side: Side) -> Result<Solid, Error> {
        let pose = |turn| Isometry3::from_parts(Translation3::from(Vector3::from(center)), Source::rotation(turn));
        match self {
            Source::Straight(shape) => Solid::new(&**shape, &pose(STRAIGHT), side),
            Source::Turned(shape) => Solid::new(&**shape, &pose(TURN), side),
            Source::Spec(spec) => spec.solid(center, side),
            Source::KeptOff(mesh, margin) => Solid::new(&**mesh, &pose(STRAIGHT), side)?.kept_off(*margin),
        }
    }
}

/// A body in the unit of length of a frame.
pub(crate) struct Sample {
    pub(crate) name: &'static str,
    pub(crate) source: Source,
    pub(crate) faces: Vec<Face>,
    /// A point of it.
    pub(crate) middle: [f64; 3],
    /// Places on edges, or where round parts begin, of the body of size 1.
    pub(crate) edge: Option<Edge>,
    /// Whether the library numbers the faces as they are here.
    pub(crate) numbered: bool,
    /// The side of it on which the table lies; both where there is none.
    pub(crate) only: Option<Side>,
}

/// Faces of the box with these half edges.
fn box_faces(half: [f64; 3]) -> Vec<Face> {
    let face = |k: usize| {
        let normal = outward(k);
        Face::plane(core::array::from_fn(|i| normal[i] * half[i]), normal)
    };
    (0..6).map(face).collect()
}

pub(super) fn box_edge(random: &mut Random) -> [f64; 3] {
    let mut place = [0.5, 0.375, 0.25].map(|half| half * random.sign());
    place[random.below(3)] *= random.uniform();
    place
}

fn rim(random: &mut Random, [radius, height]: [f64; 2]) -> [f64; 3] {
    let angle = random.between(-PI, PI);
    [radius * libm::cos(angle), height, radius * libm::sin(angle)]
}

/// The corners and the faces of a tetrahedron, counter-clockwise as seen from outside.
const CORNERS: [[f64; 3]; 4] = [[-0.3, -0.2, -0.4], [0.9, 0.1, -0.3], [-0.1, 0.8, -0.2], [0.1, 0.2, 0.7]];
const TRIANGLES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

fn tetrahedron_edge(random: &mut Random) -> [f64; 3] {
    let [a, b] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]][random.below(6)];
    let s = random.uniform();
    core::array::from_fn(|i| CORNERS[a][i] + s * (CORNERS[b][i] - CORNERS[a][i]))
}

/// Bodies of half a unit or so; vertices of a turned mesh would be rounded where they come to lie.
pub(crate) fn samples(scale: f64) -> Option<Vec<Sample>> {
    let by = |x: f64| x * scale;
    let corners = CORNERS.map(|p| p.map(by));
    let unit = CORNERS.map(|p| Glam::new(p[0], p[1], p[2]));
    let glam: Vec<Glam> = corners.iter().map(|p| Glam::new(p[0], p[1], p[2])).collect();
    let sides = || TRIANGLES.iter().map(|t| Face::through(t.map(|k| corners[k as usize]))).collect();
    let ends = [[-0.4, 0.1, 0.2], [0.3, -0.2, 0.5]].map(|p| p.map(by));
    let [a, b] = ends.map(|p| Glam::new(p[0], p[1], p[2]));
    let cap = |height: f64, up: f64| Face::plane([0.0, by(height), 0.0], [0.0, up, 0.0]);
    let middle_of_four = core::array::from_fn(|i| 0.25 * (0..4).map(|k| corners[k][i]).sum::<f64>());
    let mut samples = vec![
        Sample {
            name: "ball",
            source: Source::Straight(Box::new(Ball::new(by(0.75)))),
            faces: vec![Face::Round { core: Core::Point([0.0; 3]), radius: by(0.75) }],
            middle: [0.0; 3],
            edge: None,
            numbered: true,
            only: None,
        },
        Sample {
            name: "box",
            source: Source::Turned(Box::new(Brick::new(Glam::new(by(0.5), by(0.375), by(0.25))))),
            faces: box_faces([0.5, 0.375, 0.25].map(by)),
            middle: [0.0; 3],
            edge: Some(box_edge),
            numbered: true,
            only: None,
        },
        Sample {
            name: "cylinder",
            source: Source::Turned(Box::new(Cylinder::new(by(0.5), by(0.75)))),
            faces: vec![Face::Round { core: Core::Axis, radius: by(0.75) }, cap(-0.5, -1.0), cap(0.5, 1.0)],
            middle: [0.0; 3],
            edge: Some(|random| {
                let height = 0.5 * random.sign();
                rim(random, [0.75, height])
            }),
            numbered: true,
            only: None,
        },
        Sample {
            name: "cone",
            source: Source::Turned(Box::new(Cone::new(by(0.5), by(0.75)))),
            faces: vec![Face::Cone { apex: by(0.5), slope: big(by(0.75)) / big(by(1.0)) }, cap(-0.5, -1.0)],
            middle: [0.0, by(-0.25), 0.0],
            edge: Some(|random| rim(random, [0.75, -0.5])),
            numbered: true,
            only: None,
        },
        Sample {
            name: "capsule",
            source: Source::Straight(Box::new(Capsule::new(a, b, by(0.5)))),
            faces: vec![Face::Round { core: Core::Segment(ends), radius: by(0.5) }],
            middle: ends[0],
            edge: None,
            numbered: true,
            only: None,
        },
        Sample {
            name: "convex hull",
            source: Source::Straight(Box::new(ConvexPolyhedron::from_convex_hull(&unit)?.scaled(Glam::splat(scale))?)),
            faces: sides(),
            middle: middle_of_four,
            edge: Some(tetrahedron_edge),
            numbered: false,
            only: None,
        },
        Sample {
            name: "mesh",
            source: Source::Straight(Box::new(TriMesh::new(glam, TRIANGLES.to_vec()).ok()?)),
            faces: sides(),
            middle: middle_of_four,
            edge: Some(tetrahedron_edge),
            numbered: true,
            only: None,
        },
    ];
    samples.extend(specified(scale));
    samples.extend(rounded(scale)?);
    samples.extend(kept_off(scale)?);
    Some(samples)
}

/// Bodies as scenes name them, their axes along those of space.
fn specified(scale: f64) -> [Sample; 3] {
    let by = |x: f64| x * scale;
    let cap = |height: f64, up: f64| Face::plane([0.0, by(height), 0.0], [0.0, up, 0.0]);
    [
        Sample {
            name: "upright cylinder",
            source: Source::Spec(SolidSpec::Cylinder { radius: by(0.75), height: by(1.0), rounding: 0.0 }),
            faces: vec![Face::Round { core: Core::Axis, radius: by(0.75) }, cap(-0.5, -1.0), cap(0.5, 1.0)],
            middle: [0.0; 3],
            edge: Some(|random| rim(random, [0.75, 0.5])),
            numbered: true,
            only: None,
        },
        Sample {
            name: "upright cone",
            source: Source::Spec(SolidSpec::Cone { radius: by(0.75), height: by(1.0), rounding: 0.0 }),
            faces: vec![Face::Cone { apex: by(0.5), slope: big(by(0.75)) / big(by(1.0)) }, cap(-0.5, -1.0)],
            middle: [0.0, by(-0.25), 0.0],
            edge: Some(|random| rim(random, [0.75, -0.5])),
            numbered: true,
            only: None,
        },
        Sample {
            name: "half-space",
            source: Source::Spec(SolidSpec::HalfSpace { normal: [1.0, -3.0, 7.0] }),
            faces: vec![Face::plane([0.0; 3], [1.0, -3.0, 7.0])],
            middle: [by(-0.1), by(0.3), by(-0.7)],
            edge: None,
            numbered: true,
            only: None,
        },
    ]
}

/// A box whose edges are rounded by an eighth has these half edges inside.
const BRICK: [f64; 3] = [0.5, 0.3, 0.2];
/// The radius of a cylinder inside, or of the base of a cone, and half the height.
const TURNED: [f64; 2] = [0.6, 0.4];

/// Bodies with a border of an eighth; aimed at are the places where its round parts begin.
fn rounded(scale: f64) -> Option<Vec<Sample>> {
    let by = |x: f64| x * scale;
    let border = 0.125;
    let border_radius = by(border);
    let [radius, half] = TURNED.map(by);
    let points: Vec<Glam> = CORNERS.iter().map(|p| Glam::new(p[0], p[1], p[2])).collect();
    let hull = ConvexPolyhedron::from_convex_hull(&points)?.scaled(Glam::splat(scale))?;
    let corners = CORNERS.map(|p| p.map(by));
    let triangles = TRIANGLES.map(|t| t.map(|k| corners[k as usize]));
    let [a, b, c, _] = corners.map(|p| Glam::new(p[0], p[1], p[2]));
    // a flat one has two sides
    let [top, bottom] = [[0, 1, 2], [2, 1, 0]].map(|t| t.map(|k: usize| corners[k]));
    let center = |of: &[[f64; 3]]| core::array::from_fn(|i| of.iter().map(|p| p[i]).sum::<f64>() / of.len() as f64);
    let sample = |name, source, core, middle, edge| Sample {
        name,
        source,
        faces: vec![Face::Round { core, radius: border_radius }],
        middle,
        edge,
        numbered: true,
        only: None,
    };
    let begins_on_box: Edge = |random| {
        let mut place = BRICK.map(|half| half * random.sign());
        let along = random.below(3);
        place[along] *= random.uniform();
        let beyond = (along + 1 + random.below(2)) % 3;
        place[beyond] += 0.125 * place[beyond].signum();
        place
    };
    let begins_on_cylinder: Edge = |random| {
        let [radius, height] = TURNED;
        let out = random.below(2) as f64 * 0.125;
        let side = random.sign();
        rim(random, [radius + out, side * (height + 0.125 - out)])
    };
    let begins_on_cone: Edge = |random| rim(random, [TURNED[0], -TURNED[1] - 0.125]);
    let turned_box = RoundShape { inner_shape: Brick::new(Glam::from(BRICK.map(by))), border_radius };
    Some(vec![
        sample(
            "round box",
            Source::Turned(Box::new(turned_box)),
            Core::Brick(BRICK.map(by)),
            [0.0; 3],
            Some(begins_on_box),
        ),
        sample(
            "upright round box",
            Source::Spec(SolidSpec::Cuboid { size: BRICK.map(|x| 2.0 * by(x)), rounding: border_radius }),
            Core::Brick(BRICK.map(by)),
            [0.0; 3],
            Some(begins_on_box),
        ),
        sample(
            "round cylinder",
            Source::Turned(Box::new(RoundShape { inner_shape: Cylinder::new(half, radius), border_radius })),
            Core::Turned(vec![[0.0, -half], [radius, -half], [radius, half], [0.0, half]]),
            [0.0; 3],
            Some(begins_on_cylinder),
        ),
        sample(
            "upright round cylinder",
            Source::Spec(SolidSpec::Cylinder { radius, height: 2.0 * half, rounding: border_radius }),
            Core::Turned(vec![[0.0, -half], [radius, -half], [radius, half], [0.0, half]]),
            [0.0; 3],
            Some(begins_on_cylinder),
        ),
        sample(
            "round cone",
            Source::Turned(Box::new(RoundShape { inner_shape: Cone::new(half, radius), border_radius })),
            Core::Turned(vec![[0.0, -half], [radius, -half], [0.0, half]]),
            [0.0, by(-0.2), 0.0],
            Some(begins_on_cone),
        ),
        sample(
            "upright round cone",
            Source::Spec(SolidSpec::Cone { radius, height: 2.0 * half, rounding: border_radius }),
            Core::Turned(vec![[0.0, -half], [radius, -half], [0.0, half]]),
            [0.0, by(-0.2), 0.0],
            Some(begins_on_cone),
        ),
        sample(
            "round hull",
            Source::Straight(Box::new(RoundShape { inner_shape: hull, border_radius })),
            Core::Hull(triangles.to_vec()),
            center(&corners),
            None,
        ),
        sample(
            "round triangle",
            Source::Straight(Box::new(RoundShape { inner_shape: Triangle::new(a, b, c), border_radius })),
            Core::Hull(vec![top, bottom]),
            center(&corners[..3]),
            None,
        ),
    ])
}

/// Bodies of triangles, which keep the centre of a ball of an eighth off.
fn kept_off(scale: f64) -> Option<[Sample; 2]> {
    let by = |x: f64| x * scale;
    let margin = by(0.125);
    let corners = CORNERS.map(|p| p.map(by));
    let glam = corners.map(|p| Glam::new(p[0], p[1], p[2])).to_vec();
    let triangles = TRIANGLES.map(|t| t.map(|k| corners[k as usize]));
    let half = [0.5, 0.375, 0.25];
    let (vertices, faces) = Brick::new(Glam::from(half.map(by))).to_trimesh();
    Some([
        Sample {
            name: "mesh, kept off",
            source: Source::KeptOff(Box::new(TriMesh::new(glam, TRIANGLES.to_vec()).ok()?), margin),
            faces: vec![Face::Round { core: Core::Hull(triangles.to_vec()), radius: margin }],
            middle: corners[0],
            edge: None,
            numbered: false,
            only: Some(Side::Outside),
        },
        Sample {
            name: "box of triangles, kept off",
            source: Source::KeptOff(Box::new(TriMesh::new(vertices, faces).ok()?), margin),
            faces: box_faces(half.map(|half| by(half - 0.125))),
            middle: [0.0; 3],
            edge: Some(|random| {
                let place = box_edge(random);
                core::array::from_fn(|i| place[i] * ([0.375, 0.25, 0.125][i] / [0.5, 0.375, 0.25][i]))
            }),
            numbered: false,
            only: Some(Side::Inside),
        },
    ])
}

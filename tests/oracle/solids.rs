//! Walls in space whose hits are measured.
use super::errors::{Errors, GAMMA_SQUARED, NEAR};
use super::number::{Big, Vector, add, big, dot, norm, scale, small, sub, vector, vector_product};
use super::rays::{Foot, Kind, Random, aimed_in_space};
use super::space::{Body, Core, Face, Meeting};
use super::subjects::Frame;
use billiards::BallLaw;
use billiards::geometry::{
    Boundary, Error, Line, Vector3, WallHit, Walls,
    parry::{
        Side, Solid,
        parry3d_f64::{
            math::Vector as Glam,
            shape::{Ball, Capsule, Cone, ConvexPolyhedron, Cuboid as Brick, Cylinder, Shape, TriMesh},
        },
    },
    walls::{Cuboid, Slab, Sphere},
};
use billiards::laws::{RoughBall, Specular};
use core::f64::consts::PI;
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

/// Whose hits are measured.
pub(crate) struct Room<'a> {
    pub(crate) name: String,
    /// How large it is, its distance from the origin included, and without.
    size: f64,
    extent: f64,
    truth: &'a Body,
    /// Whether the pieces are numbered as the faces of the truth are.
    numbered: bool,
    /// A point of the body, and random places on its edges, in its own coordinates.
    middle: [f64; 3],
    edge: Option<Edge>,
    /// The answer; infinite time for none.
    hit: &'a dyn Fn(&Line<3>) -> WallHit<f64, 3>,
}

type Edge = fn(&mut Random) -> [f64; 3];

/// Measures with so many rays of a kind.
pub(crate) fn measure(room: &Room<'_>, kind: Kind, count: usize, random: &mut Random) -> Errors {
    let mut errors = Errors::default();
    for _ in 0..count {
        let foot = foot(room, kind, random);
        let mut path = aimed_in_space(&foot, room.extent, kind, random);
        // from within the table
        for _ in 0..8 {
            if room.truth.clearance(&vector(path.point.into())) > 0.0 {
                break;
            }
            path.point = foot.point + (path.point - foot.point) * 0.5;
        }
        errors.look_in_space(room, &path);
    }
    errors
}

/// A place of the boundary at which a ray is aimed.
fn foot(room: &Room<'_>, kind: Kind, random: &mut Random) -> Foot {
    match room.edge.filter(|_| kind == Kind::Vertex) {
        Some(edge) => {
            let off = room.extent * random.decade(-16.0, -3.0);
            let scale = room.extent;
            room.truth.foot(edge(random).map(|x| x * scale + off * random.between(-1.0, 1.0)))
        }
        None => room.truth.foot(room.truth.any_place(room.middle, room.extent, random)),
    }
}

impl Errors {
    fn look_in_space(&mut self, room: &Room<'_>, path: &Line<3>) {
        let (x, v) = (vector(path.point.into()), vector(path.velocity.into()));
        let speed = small(&norm(&v));
        let ulp = f64::EPSILON * room.size.max(path.point.amax());
        // only paths that start in the table, off the boundary, ask something
        if room.truth.clearance(&x) <= NEAR * ulp {
            self.undecided += 1;
            return;
        }
        let hit = (room.hit)(path);
        let hits = hit.time < f64::INFINITY;
        let truth = match room.truth.meet(&x, &v, 64.0 * room.extent) {
            Meeting::Crosses(crossing) if crossing.depth <= NEAR * ulp => None,
            Meeting::Misses(distance) if distance <= NEAR * ulp => None,
            Meeting::Crosses(crossing) => Some(crossing),
            Meeting::Misses(_) => {
                if hits {
                    self.wrong(path, &format!("hits at {}, but there is nothing", hit.time));
                }
                return;
            }
        };
        let Some(truth) = truth else {
            self.undecided += 1;
            return;
        };
        if !hits {
            self.wrong(path, &format!("missed: hit at {}", small(&truth.time)));
            return;
        }
        if hit.corner || truth.from_edge <= NEAR * ulp {
            self.at_vertices += 1;
            return;
        }
        if room.numbered && hit.piece != truth.face as f64 {
            self.wrong(path, &format!("hits piece {}, not {}", hit.piece, truth.face));
            return;
        }
        let sine = -small(&dot(&v, &truth.normal)) / speed;
        let unit = f64::EPSILON.max(truth.curvature.abs() * ulp).max(ulp / room.extent);
        let off = small(&norm(&sub(&vector(hit.point), &truth.point)));
        let turned = small(&norm(&sub(&vector(hit.unit_normal()), &truth.normal)));
        let late = small(&(big(hit.time) - &truth.time)).abs() * speed;
        let spin = [0.375, -0.25, 0.5].map(|w| w * speed);
        let gamma = libm::sqrt(GAMMA_SQUARED);
        let rough = [0.5, -0.75, 0.25];
        let along = RoughBall::along(gamma, rough.into());
        let after = [
            collided(&Specular, &hit, path, spin),
            collided(&RoughBall::no_slip(gamma), &hit, path, spin),
            collided(&along, &hit, path, spin),
        ];
        let roughness = [Roughness::None, Roughness::All, Roughness::Along(vector(rough))];
        // where the rough direction is nearly normal to the wall, its part in the wall turns by more than the normal does
        let rough = Vector3::from(rough).normalize();
        let in_wall = rough.cross(&Vector3::from(hit.unit_normal())).norm();
        let missed = |law: usize| {
            let exact = bounced(&v, &vector(spin), &truth.normal, gamma, &roughness[law]);
            let off = [0, 1].map(|k| norm(&sub(&vector(after[law][k]), &exact[k])));
            small(&norm(&off)) / (unit * speed)
        };
        self.add(sine, [late / ulp, off / ulp, turned / unit, missed(0), missed(1), missed(2) * in_wall]);
    }
}

/// Velocity and spin after a collision.
fn collided(law: &impl BallLaw<3, 3>, hit: &WallHit<f64, 3>, path: &Line<3>, spin: [f64; 3]) -> [[f64; 3]; 2] {
    let (mut v, mut w) = (path.velocity.into(), spin);
    law.collide(hit, &mut v, &mut w);
    [v, w]
}

/// In which directions along a wall it is rough.
enum Roughness {
    None,
    All,
    /// The part of a vector that lies in the wall.
    Along(Vector<3>),
}

/// The same in 200 bits: in each rough direction `t` the velocity `a = v·t` and the spin `b = W·(ν × t)` turn like those of a
/// disk, `a⁺ = c a + s b`, `b⁺ = s a − c b` with `c = (1−γ²)/(1+γ²)`, `s = 2γ/(1+γ²)`.
fn bounced(v: &Vector<3>, spin: &Vector<3>, n: &Vector<3>, gamma: f64, roughness: &Roughness) -> [Vector<3>; 2] {
    let flat = |a: &Vector<3>| sub(a, &scale(n, &dot(a, n)));
    let unit = |a: &Vector<3>| scale(a, &(big(1.0) / norm(a)));
    let directions = match roughness {
        Roughness::None => vec![],
        Roughness::Along(d) => vec![unit(&flat(d))],
        Roughness::All => {
            let t = unit(&vector_product(n, &vector([0.0, 0.6, 0.8])));
            vec![vector_product(n, &t), t]
        }
    };
    let gamma = big(gamma);
    let square = &gamma * &gamma;
    let [c, s] = [(big(1.0) - &square) / (big(1.0) + &square), big(2.0) * &gamma / (big(1.0) + &square)];
    let mut after = [sub(v, &scale(n, &(big(2.0) * dot(v, n)))), spin.clone()];
    for t in directions {
        let u = vector_product(n, &t);
        let [a, b]: [Big; 2] = [dot(v, &t), dot(spin, &u)];
        after[0] = add(&after[0], &scale(&t, &(&c * &a + &s * &b - &a)));
        after[1] = add(&after[1], &scale(&u, &(&s * &a - &c * &b - &b)));
    }
    after
}

/// A body in the unit of length of a frame, as a shape of the library.
struct Sample {
    name: &'static str,
    shape: Box<dyn Shape>,
    faces: Vec<Face>,
    middle: [f64; 3],
    edge: Option<Edge>,
    numbered: bool,
    turned: bool,
}

/// Faces of the box with these half edges.
fn box_faces(half: [f64; 3]) -> Vec<Face> {
    let face = |k: usize| {
        let normal = outward(k);
        Face::plane(core::array::from_fn(|i| normal[i] * half[i]), normal)
    };
    (0..6).map(face).collect()
}

fn box_edge(random: &mut Random) -> [f64; 3] {
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

/// Shapes of half a unit or so.
fn shapes(scale: f64) -> Option<Vec<Sample>> {
    let by = |x: f64| x * scale;
    let corners = CORNERS.map(|p| p.map(by));
    let unit = CORNERS.map(|p| Glam::new(p[0], p[1], p[2]));
    let glam: Vec<Glam> = corners.iter().map(|p| Glam::new(p[0], p[1], p[2])).collect();
    let sides = || TRIANGLES.iter().map(|t| Face::through(t.map(|k| corners[k as usize]))).collect();
    let ends = [[-0.4, 0.1, 0.2], [0.3, -0.2, 0.5]].map(|p| p.map(by));
    let [a, b] = ends.map(|p| Glam::new(p[0], p[1], p[2]));
    let cap = |height: f64, up: f64| Face::plane([0.0, by(height), 0.0], [0.0, up, 0.0]);
    let middle_of_four = core::array::from_fn(|i| 0.25 * (0..4).map(|k| corners[k][i]).sum::<f64>());
    Some(vec![
        Sample {
            name: "ball",
            shape: Box::new(Ball::new(by(0.75))),
            faces: vec![Face::Round { core: Core::Point([0.0; 3]), radius: by(0.75) }],
            middle: [0.0; 3],
            edge: None,
            numbered: true,
            turned: false,
        },
        Sample {
            name: "box",
            shape: Box::new(Brick::new(Glam::new(by(0.5), by(0.375), by(0.25)))),
            faces: box_faces([0.5, 0.375, 0.25].map(by)),
            middle: [0.0; 3],
            edge: Some(box_edge),
            numbered: true,
            turned: true,
        },
        Sample {
            name: "cylinder",
            shape: Box::new(Cylinder::new(by(0.5), by(0.75))),
            faces: vec![Face::Round { core: Core::Axis, radius: by(0.75) }, cap(-0.5, -1.0), cap(0.5, 1.0)],
            middle: [0.0; 3],
            edge: Some(|random| {
                let height = 0.5 * random.sign();
                rim(random, [0.75, height])
            }),
            numbered: true,
            turned: true,
        },
        Sample {
            name: "cone",
            shape: Box::new(Cone::new(by(0.5), by(0.75))),
            faces: vec![Face::Cone { apex: by(0.5), slope: big(by(0.75)) / big(by(1.0)) }, cap(-0.5, -1.0)],
            middle: [0.0, by(-0.25), 0.0],
            edge: Some(|random| rim(random, [0.75, -0.5])),
            numbered: true,
            turned: true,
        },
        Sample {
            name: "capsule",
            shape: Box::new(Capsule::new(a, b, by(0.5))),
            faces: vec![Face::Round { core: Core::Segment(ends), radius: by(0.5) }],
            middle: ends[0],
            edge: None,
            numbered: true,
            turned: false,
        },
        Sample {
            name: "convex hull",
            shape: Box::new(ConvexPolyhedron::from_convex_hull(&unit)?.scaled(Glam::splat(scale))?),
            faces: sides(),
            middle: middle_of_four,
            edge: Some(tetrahedron_edge),
            numbered: false,
            turned: false,
        },
        Sample {
            name: "mesh",
            shape: Box::new(TriMesh::new(glam, TRIANGLES.to_vec()).ok()?),
            faces: sides(),
            middle: middle_of_four,
            edge: Some(tetrahedron_edge),
            numbered: true,
            // its vertices would be rounded where they come to lie
            turned: false,
        },
    ])
}

/// What a turned shape is turned by, of any length.
const TURN: [f64; 4] = [0.8, 0.3, -0.2, 0.4];

/// Walls as they answer for one path.
fn ask(walls: &impl Walls<3>) -> impl Fn(&Line<3>) -> WallHit<f64, 3> {
    |path| walls.first_hit::<f64>(&path.point.into(), &path.velocity.into())
}

/// The axis of face `k` of a box, outwards.
fn outward(k: usize) -> [f64; 3] {
    let mut normal = [0.0; 3];
    normal[k / 2] = [-1.0, 1.0][k % 2];
    normal
}

/// Shows every subject in a frame.
///
/// # Errors
/// None, but that the library's constructors may have some.
pub(crate) fn each_room(frame: &Frame, mut show: impl FnMut(&Room<'_>)) -> Result<(), Error> {
    let by = |x: f64| x * frame.scale;
    let center = [frame.shift[0], frame.shift[1], 0.625 * frame.shift[0]];
    let straight = [1.0, 0.0, 0.0, 0.0];
    let (size, extent) = (frame.size(1.0), frame.scale);
    // the sums may round; the differences do not
    let (low, high) = (center[2], center[2] + by(1.0));
    let slab: Slab<3, 2> = Slab::new(low, high, [0, 1])?;
    let height = high - low;
    let planes = vec![Face::plane([0.0; 3], [0.0, 0.0, -1.0]), Face::plane([0.0, 0.0, height], [0.0, 0.0, 1.0])];
    let truth = Body::new(planes, straight, center, true);
    let room = Room {
        name: "slab (Slab)".into(),
        size,
        extent,
        truth: &truth,
        numbered: true,
        middle: [0.0, 0.0, 0.5 * height],
        edge: None,
        hit: &ask(&slab),
    };
    show(&room);

    let half = [0.5, 0.375, 0.25].map(by);
    let corners = [-1.0, 1.0].map(|sign| core::array::from_fn(|i| center[i] + sign * half[i]));
    let cuboid = Cuboid::<3>::new(corners[0], corners[1], [[0, 1], [2, 3], [4, 5]])?;
    let face = |k: usize| {
        let from_center = core::array::from_fn(|i| corners[k % 2][i] - center[i]);
        Face::plane(from_center, outward(k))
    };
    let truth = Body::new((0..6).map(face).collect(), straight, center, true);
    show(&Room {
        name: "box (Cuboid)".into(),
        truth: &truth,
        middle: [0.0; 3],
        edge: Some(box_edge),
        hit: &ask(&cuboid),
        ..room
    });

    let sphere = Sphere::<3>::new(center.into(), by(0.75), 0)?;
    let round = Face::Round { core: Core::Point([0.0; 3]), radius: by(0.75) };
    let truth = Body::new(vec![round], straight, center, true);
    show(&Room { name: "ball (Sphere)".into(), truth: &truth, middle: [0.0; 3], hit: &ask(&sphere), ..room });

    for kind in &shapes(frame.scale).ok_or(Error::Empty)? {
        let [w, i, j, k] = if kind.turned { TURN } else { straight };
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k));
        // the truth is about the rounded one
        let q = rotation.quaternion();
        let turn = [q.w, q.i, q.j, q.k];
        let pose = Isometry3::from_parts(Translation3::from(Vector3::from(center)), rotation);
        for (side, place) in [(Side::Inside, "inside"), (Side::Outside, "outside")] {
            let solid = Solid::new(&*kind.shape, &pose, side)?;
            let hit = |path: &Line<3>| {
                let mut found = WallHit::never(path.point.into());
                if let Some(hit) = solid.first_hit(path) {
                    found.time = hit.time;
                    found.point = hit.point.into();
                    found.normal = hit.normal.into();
                    found.piece = hit.piece as f64;
                    found.corner = hit.corner;
                }
                found
            };
            let truth = Body::new(kind.faces.clone(), turn, center, side == Side::Inside);
            let name = format!("{}, {place} (Solid)", kind.name);
            let &Sample { numbered, middle, edge, .. } = kind;
            show(&Room { name, size, extent, truth: &truth, numbered, middle, edge, hit: &hit });
        }
    }
    Ok(())
}

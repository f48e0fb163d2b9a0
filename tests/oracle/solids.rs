//! Walls in space whose hits are measured.
use super::convex::Core;
use super::errors::{Errors, GAMMA_SQUARED, NEAR};
use super::number::{Big, Vector, add, big, dot, norm, scale, small, sub, vector, vector_product};
use super::rays::{Foot, Kind, Random, aimed_in_space};
use super::samples::{Sample, box_edge, samples};
use super::space::{Body, Face, Meeting};
use super::subjects::Frame;
use billiards::BallLaw;
use billiards::geometry::{
    Boundary, Error, Line, Vector3, WallHit, Walls, WithWalls,
    parry::{self, Side},
    walls::{Cuboid, Scatterers, Slab, Sphere},
};
use billiards::laws::{RoughBall, Specular};
use std::sync::LazyLock;

/// The direction along which one of the balls is rough.
const ROUGH: [f64; 3] = [0.5, -0.75, 0.25];
/// The balls whose collisions are checked: no-slip, and rough along a direction. Made once: their coefficients are searched for.
static BALLS: LazyLock<[RoughBall; 2]> = LazyLock::new(|| {
    let gamma = libm::sqrt(GAMMA_SQUARED);
    [RoughBall::no_slip(gamma).unwrap(), RoughBall::along(gamma, ROUGH.into()).unwrap()]
});

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

pub(crate) type Edge = fn(&mut Random) -> [f64; 3];

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
        let [no_slip, along] = &*BALLS;
        let after = [
            collided(&Specular, &hit, path, spin),
            collided(no_slip, &hit, path, spin),
            collided(along, &hit, path, spin),
        ];
        let roughness = [Roughness::None, Roughness::All, Roughness::Along(vector(ROUGH))];
        // where the rough direction is nearly normal to the wall, its part in the wall turns by more than the normal does
        let rough = Vector3::from(ROUGH).normalize();
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

/// Walls as they answer for one path.
fn ask(walls: &impl Walls<3>) -> impl Fn(&Line<3>) -> WallHit<f64, 3> {
    |path| walls.first_hit::<f64>(&path.point.into(), &path.velocity.into())
}

/// The axis of face `k` of a box, outwards.
pub(super) fn outward(k: usize) -> [f64; 3] {
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

    for sample in &samples(frame.scale).ok_or(Error::Empty)? {
        for (side, place) in [(Side::Inside, "inside"), (Side::Outside, "outside")] {
            if sample.only.is_some_and(|only| only != side) {
                continue;
            }
            let solid = sample.source.solid(center, side)?;
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
            let truth = Body::new(sample.faces.clone(), sample.source.turn(), center, side == Side::Inside);
            let name = format!("{}, {place} (Solid)", sample.name);
            let &Sample { numbered, middle, edge, .. } = sample;
            let room = Room { name, size, extent, truth: &truth, numbered, middle, edge, hit: &hit };
            show(&room);
            let name = format!("{}, {place} (walls)", sample.name);
            let alone = parry::Room::new(vec![sample.source.solid(center, side)?]);
            alone.with_walls(AsWalls { room: Room { name, numbered: false, ..room }, show: &mut show });
        }
    }
    let scatterers = Scatterers::new([(center.into(), by(0.75), 0)])?;
    let round = Face::Round { core: Core::Point([0.0; 3]), radius: by(0.75) };
    let truth = Body::new(vec![round], straight, center, false);
    let name = "ball, outside (Scatterers)".into();
    show(&Room { name, truth: &truth, middle: [0.0; 3], hit: &ask(&scatterers), ..room });
    Ok(())
}

/// Shows the walls of a room that consists of one solid, if they are others than that.
struct AsWalls<'a, S> {
    room: Room<'a>,
    show: &'a mut S,
}

impl<S: FnMut(&Room<'_>)> WithWalls<3> for AsWalls<'_, S> {
    type Output = ();
    fn run<W: Walls<3>>(self, walls: &W) {
        if !core::any::type_name::<W>().contains("ByLane") {
            (self.show)(&Room { hit: &ask(walls), ..self.room });
        }
    }
}

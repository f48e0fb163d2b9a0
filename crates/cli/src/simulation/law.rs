//! Converts the laws that scenes name to those that the engine applies.

use billiards::BallLaw;
use billiards::collision_laws::laws::{NoSlip, PerSurface, RandomGrassmannian, Restitution, RoughPlane};
use billiards::collision_laws::{self, AnyLaw, Contact, LOST_DIRECTION, Roughness, StrictLaw};
use billiards::geometry::{Figure, GOLDEN_RATIO, Piece, Vector2, Vector3, WallHit};
use billiards::laws::{Custom, Disk, Mirror, PerPiece, RoughBall, Specular};
use lanes::Lane;
use nalgebra::SVector;

use super::scale::to_unity;
use crate::scene::LawKind;

/// The law of a disk on all pieces of a planar table.
#[derive(Clone, Debug)]
pub(crate) enum PlanarLaw {
    /// The same everywhere.
    Uniform(Disk),
    /// One per piece.
    PerPiece(PerPiece),
}

impl BallLaw<2, 1> for PlanarLaw {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        match self {
            PlanarLaw::Uniform(law) => law.collide(hit, velocity, spin),
            PlanarLaw::PerPiece(law) => law.collide(hit, velocity, spin),
        }
    }
    #[inline(always)]
    fn collide_along_axis<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        match self {
            PlanarLaw::Uniform(law) => law.collide_along_axis(hit, velocity, spin),
            PlanarLaw::PerPiece(law) => law.collide_along_axis(hit, velocity, spin),
        }
    }
    #[inline(always)]
    fn collide_in_frame<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        match self {
            PlanarLaw::Uniform(law) => law.collide_in_frame(hit, velocity, spin),
            PlanarLaw::PerPiece(law) => law.collide_in_frame(hit, velocity, spin),
        }
    }
    #[inline(always)]
    fn is_strict(&self) -> bool {
        match self {
            PlanarLaw::Uniform(law) => law.is_strict(),
            PlanarLaw::PerPiece(law) => law.is_strict(),
        }
    }
    fn mirror(&self) -> Option<Mirror> {
        match self {
            PlanarLaw::Uniform(law) => law.mirror(),
            PlanarLaw::PerPiece(law) => BallLaw::<2, 1>::mirror(law),
        }
    }
}

impl PlanarLaw {
    /// The laws of numbered pieces for a disk with γ.
    ///
    /// # Errors
    /// A parameter of a law is wrong.
    pub(crate) fn new<'a>(
        pieces: impl IntoIterator<Item = (&'a LawKind, &'a dyn Piece)>,
        gamma: f64,
    ) -> Result<PlanarLaw, String> {
        let kinds: Vec<Simple> = pieces.into_iter().map(|(kind, piece)| Simple::of(kind, piece)).collect();
        // computing the digits of a law takes milliseconds, so it is done once for each law, not for each piece
        let mut known: Vec<(Simple, Disk)> = vec![];
        let mut disk = |kind: &Simple| {
            if let Some((_, disk)) = known.iter().find(|(other, _)| other == kind) {
                return Ok(*disk);
            }
            let disk = kind.disk(gamma)?;
            known.push((*kind, disk));
            Ok::<_, String>(disk)
        };
        Ok(match &kinds[..] {
            [] => PlanarLaw::Uniform(disk(&Simple::Specular)?),
            [first, rest @ ..] if rest.iter().all(|kind| kind == first) => PlanarLaw::Uniform(disk(first)?),
            [first, rest @ ..] => {
                let first = disk(first)?;
                PlanarLaw::PerPiece(PerPiece::new(first, rest.iter().map(disk).collect::<Result<Vec<_>, _>>()?))
            }
        })
    }
}

/// A law that is one matrix for a disk in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Simple {
    Specular,
    NoSlip,
    Restitution { normal: f64, tangential: f64 },
}

impl Simple {
    /// The contact plane is a line, so either all of it is rough or nothing.
    fn of(kind: &LawKind, piece: &dyn Piece) -> Simple {
        match kind {
            LawKind::Specular | LawKind::Random { rank: 0, .. } => Simple::Specular,
            LawKind::NoSlip | LawKind::Random { .. } => Simple::NoSlip,
            LawKind::Rough(directions) => {
                let smooth = directions.iter().all(|d| is_normal_to(d, piece));
                if smooth { Simple::Specular } else { Simple::NoSlip }
            }
            LawKind::Restitution { normal, tangential } => {
                Simple::Restitution { normal: *normal, tangential: *tangential }
            }
        }
    }

    fn disk(&self, gamma: f64) -> Result<Disk, String> {
        let disk = match *self {
            Simple::Specular => Disk::new(&Specular, gamma),
            Simple::NoSlip => Disk::new(&NoSlip, gamma),
            Simple::Restitution { normal, tangential } => {
                Disk::new(&Restitution::new(normal, tangential).map_err(|error| error.to_string())?, gamma)
            }
        };
        disk.map_err(|error| error.to_string())
    }
}

/// Whether a direction is normal to a straight piece, within rounding: it is so in many places of it.
fn is_normal_to(direction: &[f64], piece: &dyn Piece) -> bool {
    let size = direction.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let d = Vector2::new(direction[0], direction[1]) / size;
    let most = LOST_DIRECTION * d.norm();
    match piece.figure() {
        Figure::Ray { direction, .. } | Figure::Line { direction, .. } => {
            d.dot(&direction).abs() <= most * direction.norm()
        }
        // no wave has a period that fits these
        _ => (1..=PLACES).all(|k| {
            let s = piece.length() * libm::fmod(f64::from(k) * GOLDEN_RATIO, 1.0);
            d.perp(&piece.landing_at(s).normal).abs() <= most
        }),
    }
}

/// Number of places in which a piece is looked at, at multiples of the golden section of its length.
const PLACES: i32 = 16;

/// Random rough directions as a function of the contact point in the user's coordinates.
#[derive(Clone, Copy, Debug)]
struct Drawn {
    law: RandomGrassmannian<3>,
    place: Place,
}

impl StrictLaw<3> for Drawn {
    fn roughness(&self, contact: &Contact<3>) -> Roughness<3> {
        let Place { shift, factor, .. } = self.place;
        self.law.roughness(&Contact { point: (contact.point + shift) / factor, ..*contact })
    }
}

/// The engine's coordinates in space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Radius of the ball, in the engine's unit of length.
    pub(crate) radius: f64,
    /// Position of the engine's origin, in its unit.
    pub(crate) shift: Vector3<f64>,
    /// The engine's lengths per those of the user.
    pub(crate) factor: f64,
}

/// The law of a ball on all walls of a table in space.
#[derive(Clone, Debug)]
pub(crate) enum SpatialLaw {
    /// Specular everywhere.
    Specular,
    /// Rough along some directions, the same everywhere.
    Rough(RoughBall),
    /// Any laws, one per wall.
    Any(Box<Custom<PerSurface<AnyLaw<3>>, 3>>),
}

impl BallLaw<3, 3> for SpatialLaw {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 3>, velocity: &mut [F; 3], spin: &mut [F; 3]) {
        match self {
            SpatialLaw::Specular => Specular.collide(hit, velocity, spin),
            SpatialLaw::Rough(law) => law.collide(hit, velocity, spin),
            SpatialLaw::Any(law) => law.collide(hit, velocity, spin),
        }
    }
    #[inline(always)]
    fn is_strict(&self) -> bool {
        match self {
            SpatialLaw::Specular | SpatialLaw::Rough(_) => true,
            SpatialLaw::Any(law) => law.is_strict(),
        }
    }
    fn mirror(&self) -> Option<Mirror> {
        matches!(self, SpatialLaw::Specular).then(Mirror::specular)
    }
}

impl SpatialLaw {
    /// The laws of numbered walls for a ball with γ, whose centre is at places of the engine.
    ///
    /// # Errors
    /// A parameter of a law is wrong.
    pub(crate) fn new(walls: &[&LawKind], gamma: f64, place: &Place) -> Result<SpatialLaw, String> {
        let walls: Vec<&LawKind> = walls.iter().map(|kind| plain(kind)).collect();
        let first = walls.first().copied().unwrap_or(&LawKind::Specular);
        let rough = |ball: Result<RoughBall, _>| {
            ball.map(SpatialLaw::Rough).map_err(|error: billiards::Error| error.to_string())
        };
        if walls.iter().all(|kind| *kind == first) {
            match first {
                LawKind::Specular => return Ok(SpatialLaw::Specular),
                LawKind::NoSlip => return rough(RoughBall::no_slip(gamma)),
                LawKind::Rough(directions) => {
                    if let [one] = &directions[..] {
                        return rough(RoughBall::along(gamma, space(one)));
                    }
                }
                _ => {}
            }
        }
        let any = |kind: &LawKind| {
            let law = match kind {
                LawKind::Random { rank, seed } => {
                    RandomGrassmannian::new(*rank, *seed).map(|law| AnyLaw::new(Drawn { law, place: *place }))
                }
                other => any_law(other),
            };
            law.map_err(|error| error.to_string())
        };
        let mut laws = PerSurface::new(any(first)?);
        for (wall, kind) in walls.iter().enumerate() {
            laws = laws.with(wall, any(kind)?);
        }
        let ball = Custom::ball(laws, gamma).and_then(|law| law.with_radius(place.radius));
        let law = ball.map_err(|error| error.to_string())?;
        // none of them depends on the unit of the slip
        Ok(SpatialLaw::Any(Box::new(law.with_scaled_slip())))
    }
}

/// A law in space by its plain name, if it has one: the engine treats those specially.
fn plain(kind: &LawKind) -> &LawKind {
    match kind {
        LawKind::Random { rank: 0, .. } => &LawKind::Specular,
        LawKind::Random { rank: 2, .. } => &LawKind::NoSlip,
        LawKind::Rough(directions) if directions.is_empty() => &LawKind::Specular,
        LawKind::Restitution { normal, tangential } if *normal == 1.0 && *tangential == -1.0 => &LawKind::Specular,
        LawKind::Restitution { normal, tangential } if *normal == 1.0 && *tangential == 1.0 => &LawKind::NoSlip,
        other => other,
    }
}

/// A law in its general form, for any two bodies.
///
/// # Errors
/// A parameter is wrong. Whether rough directions are independent in a contact plane is not checked.
pub(crate) fn any_law<const N: usize>(kind: &LawKind) -> Result<AnyLaw<N>, collision_laws::Error> {
    Ok(match kind {
        LawKind::Specular => AnyLaw::new(Specular),
        LawKind::NoSlip => AnyLaw::new(NoSlip),
        LawKind::Rough(directions) => {
            let directions: Vec<_> = directions.iter().map(|d| SVector::from_fn(|i, _| d[i])).collect();
            AnyLaw::new(RoughPlane::new(&directions)?)
        }
        LawKind::Random { rank, seed } => AnyLaw::new(RandomGrassmannian::new(*rank, *seed)?),
        LawKind::Restitution { normal, tangential } => AnyLaw::new(Restitution::new(*normal, *tangential)?),
    })
}

/// A direction in space, of a length near one.
fn space(direction: &[f64]) -> Vector3<f64> {
    let factor = to_unity(direction.iter().copied());
    Vector3::from_fn(|i, _| direction[i] * factor)
}

/// Whether a strict law turns no velocity into spin on any of `walls` walls: a spinning ball that hits them straight on leaves straight on.
/// That suffices: a law that turns velocity into spin also turns spin into velocity, since it conserves the energy.
pub(crate) fn keeps_spin<const N: usize, const S: usize>(law: &impl BallLaw<N, S>, walls: usize) -> bool {
    let unit = |i: usize| move |k: usize| if i == k { 1.0 } else { 0.0 };
    let stays_straight = |wall: usize, axis: usize, about: usize| {
        let normal: [f64; N] = core::array::from_fn(unit(axis));
        let (mut velocity, mut spin) = (normal.map(|n| -n), core::array::from_fn(unit(about)));
        let hit = WallHit { normal, piece: wall as f64, ..WallHit::never([0.0; N]) };
        law.collide(&hit, &mut velocity, &mut spin);
        (0..N).all(|i| i == axis || velocity[i] == 0.0)
    };
    (0..walls).all(|wall| (0..N).all(|axis| (0..S).all(|about| stays_straight(wall, axis, about))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_law_in_space_is_the_same_by_whatever_name() {
        const PLACE: Place = Place { radius: 0.0, shift: Vector3::new(0.0, 0.0, 0.0), factor: 1.0 };
        let restitution = |tangential| LawKind::Restitution { normal: 1.0, tangential };
        let random = |rank| LawKind::Random { rank, seed: 7 };
        for kind in [restitution(-1.0), random(0), LawKind::Rough(vec![])] {
            let mixed = [&LawKind::Specular, &kind, &kind];
            assert!(matches!(SpatialLaw::new(&mixed, 0.6, &PLACE), Ok(SpatialLaw::Specular)), "{kind:?}");
        }
        for kind in [restitution(1.0), random(2)] {
            let mixed = [&LawKind::NoSlip, &kind, &kind];
            assert!(matches!(SpatialLaw::new(&mixed, 0.6, &PLACE), Ok(SpatialLaw::Rough(_))), "{kind:?}");
        }
        assert!(matches!(SpatialLaw::new(&[&random(1)], 0.6, &PLACE), Ok(SpatialLaw::Any(_))));
    }

    #[test]
    fn random_directions_depend_on_the_contact_point_of_the_user() {
        let contact = Vector3::new(0.625, 0.3125, 0.0);
        let after = |radius: f64, shift: [f64; 3], factor: f64| {
            let place = Place { radius: radius * factor, shift: Vector3::from(shift) * factor, factor };
            let law = SpatialLaw::new(&[&LawKind::Random { rank: 1, seed: 5 }], 0.6, &place).unwrap();
            let centre = (contact + Vector3::z() * radius) * factor - place.shift;
            let hit = WallHit {
                point: centre.into(),
                normal: [0.0, 0.0, 1.0],
                piece: 0.0,
                inverse: 1.0,
                ..WallHit::never([0.0; 3])
            };
            let (mut velocity, mut spin) = ([0.5, 0.25, -1.0], [0.25, 0.5, 0.0]);
            law.collide(&hit, &mut velocity, &mut spin);
            (velocity, spin)
        };
        let point = after(0.0, [0.0; 3], 1.0);
        assert_ne!(point.0[..2], [0.5, 0.25]);
        assert_eq!(after(0.25, [0.0; 3], 1.0), point);
        assert_eq!(after(0.25, [0.25; 3], 1.0), point);
        assert_eq!(after(0.25, [0.25; 3], 0.125), point);
    }

    #[test]
    fn a_disk_is_asked_what_the_engine_asks() {
        let law = Disk::new(&NoSlip, 0.7).unwrap();
        let forwards = PlanarLaw::Uniform(law);
        // the shorter method for normals along an axis: for a normal that is not along one, the two give different answers
        let hit = WallHit { normal: [0.6, 0.8], ..WallHit::never([0.0; 2]) };
        let answer = |ask: &dyn Fn(&mut [f64; 2], &mut [f64; 1])| {
            let (mut velocity, mut spin) = ([0.3, -0.9], [0.5]);
            ask(&mut velocity, &mut spin);
            (velocity, spin)
        };
        let short = answer(&|v, w| law.collide_along_axis(&hit, v, w));
        assert_ne!(short, answer(&|v, w| law.collide(&hit, v, w)));
        assert_eq!(short, answer(&|v, w| forwards.collide_along_axis(&hit, v, w)));
        let framed = answer(&|v, w| law.collide_in_frame(&hit, v, w));
        assert_eq!(framed, answer(&|v, w| forwards.collide_in_frame(&hit, v, w)));
        assert_eq!(law.is_strict(), forwards.is_strict());
        assert_eq!(law.mirror().is_some(), forwards.mirror().is_some());
    }
}

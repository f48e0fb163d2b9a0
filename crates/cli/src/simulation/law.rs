//! From the laws that scenes name to those that the engine applies.

use billiards::BallLaw;
use billiards::collision_laws::laws::{NoSlip, Restitution, Specular};
use billiards::geometry::{Figure, Piece, Vector2, WallHit};
use billiards::laws::{Disk, PerPiece};
use lanes::Lane;

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
}

impl PlanarLaw {
    /// The laws of numbered pieces for a disk with γ.
    pub(crate) fn new<'a>(pieces: impl IntoIterator<Item = (&'a LawKind, &'a dyn Piece)>, gamma: f64) -> PlanarLaw {
        let kinds: Vec<Simple> = pieces.into_iter().map(|(kind, piece)| Simple::of(kind, piece)).collect();
        let disk = |kind: &Simple| kind.disk(gamma);
        match &kinds[..] {
            [] => PlanarLaw::Uniform(Simple::Specular.disk(gamma)),
            [first, rest @ ..] if rest.iter().all(|kind| kind == first) => PlanarLaw::Uniform(disk(first)),
            [first, rest @ ..] => PlanarLaw::PerPiece(PerPiece::new(disk(first), rest.iter().map(disk))),
        }
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
    /// The contact plane is a line, so rough directions leave no choice but all or nothing.
    fn of(kind: &LawKind, piece: &dyn Piece) -> Simple {
        match kind {
            LawKind::Specular | LawKind::Random { rank: 0, .. } => Simple::Specular,
            LawKind::NoSlip | LawKind::Random { .. } => Simple::NoSlip,
            LawKind::Rough(directions) if directions.iter().all(|d| is_normal_to(d, piece)) => Simple::Specular,
            LawKind::Rough(_) => Simple::NoSlip,
            LawKind::Restitution { normal, tangential } => {
                Simple::Restitution { normal: *normal, tangential: *tangential }
            }
        }
    }

    fn disk(&self, gamma: f64) -> Disk {
        match *self {
            Simple::Specular => Disk::new(&Specular, gamma),
            Simple::NoSlip => Disk::new(&NoSlip, gamma),
            Simple::Restitution { normal, tangential } => match Restitution::new(normal, tangential) {
                Ok(law) => Disk::new(&law, gamma),
                // the scene has checked both coefficients
                Err(_) => Disk::new(&Specular, gamma),
            },
        }
    }
}

/// Whether a direction is normal to a straight piece, within rounding.
fn is_normal_to(direction: &[f64], piece: &dyn Piece) -> bool {
    let along = match piece.figure() {
        Figure::Segment { ends: [a, b] } => b - a,
        Figure::Ray { direction, .. } | Figure::Line { direction, .. } => direction,
        _ => return false,
    };
    let size = direction.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let d = Vector2::new(direction[0], direction[1]) / size;
    d.dot(&along).abs() <= 8.0 * f64::EPSILON * along.amax()
}

/// Whether a law conserves energy.
pub(crate) fn is_strict(kind: &LawKind) -> bool {
    match kind {
        LawKind::Restitution { normal, tangential } => *normal == 1.0 && tangential.abs() == 1.0,
        _ => true,
    }
}

//! A law of its own for each piece.
use super::{
    Mirror,
    coefficients::Table,
    disk::{Disk, in_frame, in_plane},
};
use crate::billiard::BallLaw;
use geometry::WallHit;
use lanes::Lane;

/// The disk laws of the pieces, by their numbers; pieces beyond the list have the last law of it.
///
/// ```
/// use billiards::{Collisions, Orbit, Planar, geometry::tables, laws::{Disk, PerPiece}};
/// use billiards::collision_laws::laws::{NoSlip, Specular};
///
/// // a rough floor, everything else smooth; a hoop trades its spin for its tangential velocity there
/// let law = PerPiece::new(Disk::new(&NoSlip, 1.0)?, [Disk::new(&Specular, 1.0)?]);
/// let square = Planar { table: tables::square(4.0)?, law };
/// let mut orbit = Orbit::<f64, 2, 1>::new([1.0, 1.0], [0.0, -1.0], [0.5], ());
/// square.run(&mut orbit, &Collisions(1), &mut ());
/// let [v1, v2] = orbit.velocity;
/// assert!((v1.abs() - 0.5).abs() < 1e-15 && (v2 - 1.0).abs() < 1e-15 && orbit.spin[0].abs() < 1e-15);
/// # Ok::<(), billiards::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct PerPiece {
    in_plane: Table,
    in_frame: Table,
    last: f64,
    /// Whether each of them is strict.
    strict: bool,
    /// Whether each of them is specular, by whatever name: then spin plays no part.
    specular: bool,
}

impl PerPiece {
    /// One law per piece; at least one.
    pub fn new(first: Disk, others: impl IntoIterator<Item = Disk>) -> PerPiece {
        let laws: Vec<Disk> = core::iter::once(first).chain(others).collect();
        let strict = laws.iter().all(BallLaw::is_strict);
        let specular = laws.iter().all(|law| law.mirror().is_some_and(Mirror::is_specular));
        let (in_plane, in_frame) = (laws.iter().map(|law| &law.in_plane), laws.iter().map(|law| &law.in_frame));
        PerPiece {
            in_plane: Table::new(in_plane),
            in_frame: Table::new(in_frame),
            last: (laws.len() - 1) as f64,
            strict,
            specular,
        }
    }
}

impl BallLaw<2, 1> for PerPiece {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        in_plane(self.in_plane.at(hit.piece.min(hit.piece.same(self.last))), hit, velocity, spin);
    }
    #[inline(always)]
    fn collide_in_frame<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        in_frame(self.in_frame.at(hit.piece.min(hit.piece.same(self.last))), velocity, spin);
    }
    #[inline(always)]
    fn is_strict(&self) -> bool {
        self.strict
    }
    fn mirror(&self) -> Option<Mirror> {
        self.specular.then(Mirror::specular)
    }
}

//! A law of its own for each piece.
use super::disk::{Disk, LaneMap, apply};
use crate::billiard::BallLaw;
use collision_laws::DiskMap;
use geometry::WallHit;
use lanes::Lane;

/// The disk laws of the pieces, by their numbers; pieces beyond the list have the last law of it.
#[derive(Clone, Debug)]
pub struct PerPiece(Vec<DiskMap>);

impl PerPiece {
    /// One law per piece; at least one.
    pub fn new(first: Disk, others: impl IntoIterator<Item = Disk>) -> PerPiece {
        PerPiece(core::iter::once(first).chain(others).map(|disk| disk.0).collect())
    }
}

impl BallLaw<2, 1> for PerPiece {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a piece number is a small integer")]
        let map = |lane: usize| &self.0[(hit.piece.lane(lane) as usize).min(self.0.len() - 1)];
        apply(&LaneMap::new(hit.time, map), hit, velocity, spin);
    }
}

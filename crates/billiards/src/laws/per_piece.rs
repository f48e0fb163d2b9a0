//! A law of its own for each piece.
use super::disk::{Change, Disk, apply, apply_in_frame};
use crate::billiard::BallLaw;
use geometry::WallHit;
use lanes::Lane;

/// The disk laws of the pieces, by their numbers; pieces beyond the list have the last law of it.
#[derive(Clone, Debug)]
pub struct PerPiece(Vec<Change>);

impl PerPiece {
    /// One law per piece; at least one.
    pub fn new(first: Disk, others: impl IntoIterator<Item = Disk>) -> PerPiece {
        PerPiece(core::iter::once(first).chain(others).map(|disk| disk.0).collect())
    }
}

impl PerPiece {
    /// The laws of the pieces hit.
    #[inline(always)]
    fn at<F: Lane>(&self, hit: &WallHit<F, 2>) -> Change<F> {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a piece number is a small integer")]
        let change = |lane: usize| &self.0[(hit.piece.lane(lane) as usize).min(self.0.len() - 1)];
        Change::by_lane(hit.time, change)
    }
}

impl BallLaw<2, 1> for PerPiece {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        apply(&self.at(hit), hit, velocity, spin);
    }
    #[inline(always)]
    fn collide_in_frame<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        apply_in_frame(&self.at(hit), velocity, spin);
    }
}

//! A law of its own for each piece.
use super::{
    Mirror,
    coefficients::Coefficients,
    disk::{Disk, in_frame, in_plane},
};
use crate::billiard::BallLaw;
use geometry::{WallHit, walls::number};
use lanes::{Lane, stored};

/// The disk laws of the pieces, by their numbers; pieces beyond the list have the last law of it.
#[derive(Clone, Debug)]
pub struct PerPiece {
    laws: Vec<Disk>,
    /// Whether each of them is.
    strict: bool,
    /// Whether each of them is specular, by whatever name: then spin has no part in anything.
    specular: bool,
}

impl PerPiece {
    /// One law per piece; at least one.
    pub fn new(first: Disk, others: impl IntoIterator<Item = Disk>) -> PerPiece {
        let laws: Vec<Disk> = core::iter::once(first).chain(others).collect();
        let strict = laws.iter().all(BallLaw::is_strict);
        let specular = laws.iter().all(|law| law.mirror().is_some_and(Mirror::is_specular));
        PerPiece { laws, strict, specular }
    }
}

impl PerPiece {
    /// The law of the piece hit in each lane.
    #[inline(always)]
    fn at<'a, F: Lane>(&'a self, hit: &WallHit<F, 2>) -> impl Fn(usize) -> &'a Disk + use<'a, F> {
        let [pieces] = stored(&[hit.piece]);
        move |lane| &self.laws[number(pieces[lane]).min(self.laws.len() - 1)]
    }
}

impl BallLaw<2, 1> for PerPiece {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        let laws = self.at(hit);
        in_plane(Coefficients::by_lane(hit.time, |lane| &laws(lane).in_plane), hit, velocity, spin);
    }
    #[inline(always)]
    fn collide_in_frame<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        let laws = self.at(hit);
        in_frame(Coefficients::by_lane(hit.time, |lane| &laws(lane).in_frame), velocity, spin);
    }
    #[inline(always)]
    fn is_strict(&self) -> bool {
        self.strict
    }
    fn mirror(&self) -> Option<Mirror> {
        self.specular.then(Mirror::specular)
    }
}

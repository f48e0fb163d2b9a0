//! Walls that look the same from each of their points: circle and strip.
use super::{WallHit, Walls};
use lanes::Lane;

/// A flight from wall to wall.
#[derive(Clone, Copy, Debug)]
pub struct Chord<F> {
    /// Time of flight; infinite where there is no hit.
    pub time: F,
    /// Where it ends.
    pub place: [F; 2],
    /// The tangential velocity in the frame there. The normal velocity is that of the start with the other sign.
    pub tangential: F,
}

/// Walls in the plane with a motion that takes every point of them to every other: what happens next depends on the
/// normal and the tangential velocity alone.
///
/// In these two numbers a long orbit needs no search for the next hit. The frame at a point with inward unit normal `n`
/// has the tangent `t = J n = (−n₂, n₁)`.
pub trait Homogeneous: Walls<2> {
    /// The place of a hit, as two numbers of the walls' choice.
    fn place<F: Lane>(&self, hit: &WallHit<F, 2>) -> [F; 2];
    /// Normal and tangential velocity on arrival at the first hit of the path `x + t v`: these two numbers are carried on
    /// for ever, so walls that can tell them better than by way of the rounded normal do.
    #[inline(always)]
    fn arrival<F: Lane>(&self, _x: &[F; 2], v: &[F; 2], hit: &WallHit<F, 2>) -> [F; 2] {
        let [n1, n2] = hit.unit_normal();
        [v[0] * n1 + v[1] * n2, v[1] * n1 - v[0] * n2]
    }
    /// The flight from a place with normal velocity `normal` ≥ 0 and tangential velocity `tangential`.
    fn chord<F: Lane>(&self, place: &[F; 2], normal: F, tangential: F) -> Chord<F>;
    /// What is hit at the end of a flight. The normal has length 1.
    fn landing<F: Lane>(&self, chord: &Chord<F>) -> WallHit<F, 2>;
}

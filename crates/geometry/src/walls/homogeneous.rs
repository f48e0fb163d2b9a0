//! Walls that look the same from each of their points: circle and strip.
use super::{WallHit, Walls};
use lanes::{Double, Lane, WHOLE};

/// A flight from wall to wall.
#[derive(Clone, Copy, Debug)]
pub struct Chord<F> {
    /// Time of flight \[T\]; infinite where there is no hit.
    pub time: F,
    /// Where it ends.
    pub place: [F; 2],
    /// The tangential velocity [L T⁻¹] in the frame there. The normal velocity is that of the start with the other sign.
    pub tangential: F,
}

/// What a chord of a circle does to the unit vector from the centre: it turns it by `u²/|u|²`, `u = −tangential + i normal`.
#[derive(Clone, Copy, Debug)]
pub struct Swing<F> {
    /// `u`, of any length.
    pub direction: [F; 2],
    /// `1/|u|²`
    pub inverse: F,
}

impl<F: Lane> Swing<F> {
    /// The swing of a chord with these velocities.
    #[inline(always)]
    pub fn new(normal: F, tangential: F) -> Self {
        let inverse = normal.same(1.0) / (tangential * tangential + normal * normal);
        Swing { direction: [-tangential, normal], inverse }
    }

    /// The place at the end of a chord from `place`.
    ///
    /// The place is multiplied by `u` twice, and not by the rounded `u²/|u|²`, which would be off by the same angle in every
    /// chord; the rounding errors that remain differ from place to place and average out.
    #[inline(always)]
    pub fn apply(&self, place: &[F; 2]) -> [F; 2] {
        let [u1, u2] = self.direction;
        let turned = |[e1, e2]: [F; 2]| [e1 * u1 - e2 * u2, e1 * u2 + e2 * u1];
        let [e1, e2] = turned(turned(*place));
        let (e1, e2) = (e1 * self.inverse, e2 * self.inverse);
        // one Newton step keeps the length at 1
        let scale = (e1 * e1 + e2 * e2) * -0.5 + 1.5;
        [e1 * scale, e2 * scale]
    }
}

impl Swing<f64> {
    /// The swing of a chord that recurs again and again, with an angle accurate to two digits more than `u` has.
    ///
    /// The length of `u` is free. So a few ulp are added to one component, and to the other the multiple of an ulp that corrects
    /// the angle best; one of these pairs fits almost exactly.
    pub fn recurring(normal: Double, tangential: Double) -> Self {
        const CHOICES: i32 = 16;
        let (n, t) = (normal.high, tangential.high);
        // the angle of `(−t, n)` changes by `n dt − t dn` in units of |u|²
        let (step_n, step_t) = (n.abs().next_up() - n.abs(), t.abs().next_up() - t.abs());
        let (by_n, by_t) = (t * step_n, n * step_t);
        let per_t = 1.0 / by_t;
        let off = n * tangential.low - t * normal.low;
        let enough = by_t.abs() / 16.0;
        let mut best = (off.abs(), n, t);
        for k in -CHOICES..=CHOICES {
            let off = off + f64::from(k) * by_n;
            let m = (off * per_t + WHOLE) - WHOLE;
            let (left, moves) = ((off - m * by_t).abs(), [f64::from(k) * step_n, m * step_t]);
            let [moved_n, moved_t] = [n + moves[0], t + moves[1]];
            let exact = moved_n - n == moves[0] && moved_t - t == moves[1];
            if exact && left < best.0 && m.abs() <= f64::from(CHOICES) {
                best = (left, moved_n, moved_t);
            }
            if best.0 <= enough {
                break;
            }
        }
        Swing::new(best.1, best.2)
    }
}

/// Walls in the plane with isometries that take every point of them to every other: what happens next depends on the normal and
/// the tangential velocity alone.
///
/// In terms of these two numbers a long orbit needs no search for the next hit. The frame at a point with inward unit normal `n`
/// has the tangent `t = J n = (−n₂, n₁)`.
pub trait Homogeneous: Walls<2> {
    /// Whether a flight only [turns](Swing) the place, a unit vector: the tangential velocity on arrival is then that of the
    /// departure. Otherwise it is the opposite.
    const ROUND: bool;

    /// The place of a hit, as two numbers of the walls' choice.
    fn place<F: Lane>(&self, hit: &WallHit<F, 2>) -> [F; 2];
    /// Normal and tangential velocity on arrival at the first hit of the path `x + t v`, where the unit normal is
    /// `normal`, in double-double precision, since these two numbers are carried on for ever.
    fn arrival(&self, x: &[f64; 2], v: &[f64; 2], normal: &[f64; 2]) -> [Double; 2];
    /// The flight from a place with normal velocity `normal` ≥ 0 and tangential velocity `tangential`.
    fn chord<F: Lane>(&self, place: &[F; 2], normal: F, tangential: F) -> Chord<F>;
    /// The same flight when its time is known: between straight walls all flights with this normal velocity take the same time.
    #[inline(always)]
    fn chord_of<F: Lane>(&self, time: F, place: &[F; 2], normal: F, tangential: F) -> Chord<F> {
        Chord { time, ..self.chord(place, normal, tangential) }
    }
    /// What is hit at the end of a flight. The normal has length 1.
    fn landing<F: Lane>(&self, chord: &Chord<F>) -> WallHit<F, 2>;
}

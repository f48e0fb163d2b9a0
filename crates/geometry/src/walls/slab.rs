//! The space between two parallel planes: strip and slab.
use super::{Chord, Homogeneous, WallHit, Walls};
use crate::Error;
use lanes::{Double, Lane, Mask};

/// `low < x_AXIS < high` in ℝᴺ, axes counted from 0.
#[derive(Clone, Debug)]
pub struct Slab<const N: usize, const AXIS: usize> {
    low: f64,
    high: f64,
    /// Numbers of the lower and of the upper wall.
    pieces: [f64; 2],
}

impl<const N: usize, const AXIS: usize> Slab<N, AXIS> {
    /// The slab between two heights \[L\], with the numbers of its lower and its upper wall.
    ///
    /// # Errors
    /// [`Error::Parameter`] unless `low < high`, both finite.
    pub fn new(low: f64, high: f64, pieces: [usize; 2]) -> Result<Self, Error> {
        if !(low < high && low.is_finite() && high.is_finite()) {
            return Err(Error::Parameter { name: "width", must: "positive and finite", value: high - low });
        }
        Ok(Slab { low, high, pieces: pieces.map(|p| p as f64) })
    }
}

impl<const N: usize, const AXIS: usize> Walls<N> for Slab<N, AXIS> {
    fn is_along_axes(&self) -> bool {
        true
    }

    fn are_parallel(&self) -> bool {
        true
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; N], v: &[F; N]) -> WallHit<F, N> {
        let zero = v[0].same(0.0);
        let one = zero.same(1.0);
        let up = zero.lt(v[AXIS]);
        let wall = up.select(zero.same(self.high), zero.same(self.low));
        // a start beyond the wall is due to rounding: it hits at time 0
        let distance = ((wall - x[AXIS]) * one.copysign(v[AXIS])).max(zero);
        let speed = v[AXIS].abs();
        let time = distance / speed;
        let mut point = *x;
        let mut normal = [zero; N];
        for i in 0..N {
            point[i] = x[i] + time * v[i];
        }
        point[AXIS] = wall;
        normal[AXIS] = (-one).copysign(-v[AXIS]);
        WallHit {
            // avoids 0/0 on the wall itself without a speed towards it
            time: zero.lt(speed).select(time, zero.same(f64::INFINITY)),
            point,
            normal,
            inverse: one,
            piece: up.select(zero.same(self.pieces[1]), zero.same(self.pieces[0])),
            corner: zero.never(),
        }
    }
}

/// A place is the side, −1 for the lower and 1 for the upper wall, and the coordinate along the walls.
impl<const AXIS: usize> Homogeneous for Slab<2, AXIS> {
    const ROUND: bool = false;

    #[inline(always)]
    fn place<F: Lane>(&self, hit: &WallHit<F, 2>) -> [F; 2] {
        [-hit.normal[AXIS], hit.point[1 - AXIS]]
    }
    /// The components along the axes, as they are.
    fn arrival(&self, _: &[f64; 2], v: &[f64; 2], [n1, n2]: &[f64; 2]) -> [Double; 2] {
        [v[0] * n1 + v[1] * n2, v[1] * n1 - v[0] * n2].map(Double::new)
    }
    #[inline(always)]
    fn chord<F: Lane>(&self, place: &[F; 2], normal: F, tangential: F) -> Chord<F> {
        self.chord_of(normal.same(self.high - self.low) / normal, place, normal, tangential)
    }
    #[inline(always)]
    fn chord_of<F: Lane>(&self, time: F, place: &[F; 2], _: F, tangential: F) -> Chord<F> {
        let [side, along] = *place;
        // t = J n with n = ∓ the axis
        let speed = tangential * side;
        let speed = if AXIS == 0 { -speed } else { speed };
        Chord { time, place: [-side, along + time * speed], tangential: -tangential }
    }
    #[inline(always)]
    fn landing<F: Lane>(&self, chord: &Chord<F>) -> WallHit<F, 2> {
        let [side, along] = chord.place;
        let zero = side.same(0.0);
        let up = zero.lt(side);
        let (mut point, mut normal) = ([along; 2], [zero; 2]);
        point[AXIS] = up.select(zero.same(self.high), zero.same(self.low));
        normal[AXIS] = -side;
        WallHit {
            time: chord.time,
            point,
            normal,
            inverse: zero.same(1.0),
            piece: up.select(zero.same(self.pieces[1]), zero.same(self.pieces[0])),
            corner: zero.never(),
        }
    }
}

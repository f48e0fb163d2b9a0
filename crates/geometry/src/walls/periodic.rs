//! Walls repeated by a lattice of translations.
use super::{WallHit, Walls};
use crate::lattice::Lattice;
use lanes::{Lane, Mask};

/// Walls on a channel or a flat torus: the particle is followed from unit cell to unit cell.
///
/// The walls inside must contain, besides those of the unit cell, every translate that reaches into it. A hit is
/// reported in the unit cell.
#[derive(Clone, Debug)]
pub struct Periodic<W> {
    walls: W,
    /// Per translation: the functional that counts it, and the vector.
    directions: Vec<([f64; 2], [f64; 2])>,
}

/// A flight through this many cells without a hit is taken never to end: the particle escapes along a corridor.
///
/// A direction that leaves a corridor does so within about 1/angle cells; those that need more than this form a
/// fraction below 10⁻⁶ of all.
const MOST_CELLS: usize = 10_000_000;

/// After so many cells, a power of two, a flight may be one along a corridor.
const PATIENCE: usize = 16;

impl<W> Periodic<W> {
    /// The walls in the unit cell of a lattice.
    pub fn new(walls: W, lattice: &Lattice) -> Self {
        let directions =
            lattice.vectors().iter().enumerate().map(|(i, v)| (lattice.functional(i), (*v).into())).collect();
        Periodic { walls, directions }
    }
}

impl<W: Walls<2>> Walls<2> for Periodic<W> {
    fn rounds_normals(&self) -> bool {
        self.walls.rounds_normals()
    }

    #[inline(always)]
    fn first_hit<F: Lane>(&self, x: &[F; 2], v: &[F; 2]) -> WallHit<F, 2> {
        let zero = v[0].same(0.0);
        let never = zero.same(f64::INFINITY);
        let one = zero.same(1.0);
        let mut x = *x;
        let mut flown = zero;
        let mut best = WallHit::never(x);
        let mut flying = !zero.never();
        let mut mark = x;
        for cells in 1..MOST_CELLS {
            let hit = self.walls.first_hit(&x, v);
            // when the path leaves the cell, and the step to the next one
            let (mut exit, mut step) = (never, [zero; 2]);
            for &([f, g], [lx, ly]) in &self.directions {
                let at = x[0] * f + x[1] * g;
                let speed = v[0] * f + v[1] * g;
                let up = zero.lt(speed);
                let to_go = up.select(one - at, at).max(zero);
                let time = to_go / speed.abs();
                let sooner = time.lt(exit) & (up | speed.lt(zero));
                exit = sooner.select(time, exit);
                let (sx, sy) = (up.select(zero.same(lx), zero.same(-lx)), up.select(zero.same(ly), zero.same(-ly)));
                step = [sooner.select(sx, step[0]), sooner.select(sy, step[1])];
            }
            // a hit within this cell, or in a direction that leaves none
            let here = flying & !exit.lt(hit.time);
            best = best.or(here, &WallHit { time: flown + hit.time, ..hit });
            flying = flying & !here;
            if !flying.any() {
                break;
            }
            flown = flying.select(flown + exit, flown);
            for i in 0..2 {
                x[i] = flying.select(x[i] + exit * v[i] - step[i], x[i]);
            }
            // a path that is back where it was, to the last bit, never hits (Brent's search for cycles)
            if cells > PATIENCE {
                let moved = |i: usize| x[i].lt(mark[i]) | mark[i].lt(x[i]);
                flying = flying & (moved(0) | moved(1));
            }
            if cells >= PATIENCE && cells.is_power_of_two() {
                mark = x;
            }
        }
        best
    }
}

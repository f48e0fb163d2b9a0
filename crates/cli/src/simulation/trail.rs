//! What is tracked along a watched orbit.

use billiards::geometry::WallHit;
use billiards::{Angle, Cell, Track};

use super::portraits::{PlanarPortraits, Portraits};

/// What a watched orbit tracks besides the time: in the plane x0 and the lattice cell, in space nothing.
pub(crate) trait Trail<const N: usize, const S: usize>: Track<f64, N, S> + Clone + Send {
    /// The type of portraits of such orbits.
    type Portraits: Portraits<N, S>;
    /// The spin position x0.
    fn angle(&self) -> f64;
    /// The accumulated translation.
    fn cell(&self) -> [f64; 2];
}

/// The trail of a disk in the plane.
#[derive(Clone, Debug)]
pub(crate) struct PlanarTrail {
    pub(crate) angle: Angle,
    pub(crate) cell: Option<Cell>,
}

impl Track<f64, 2, 1> for PlanarTrail {
    #[inline(always)]
    fn fly(&mut self, from: &[f64; 2], velocity: &[f64; 2], spin: &[f64; 1], hit: &WallHit<f64, 2>) {
        self.angle.fly(from, velocity, spin, hit);
        if let Some(cell) = &mut self.cell {
            cell.fly(from, velocity, spin, hit);
        }
    }
}

impl Trail<2, 1> for PlanarTrail {
    type Portraits = PlanarPortraits;
    fn angle(&self) -> f64 {
        self.angle.0.value()
    }
    fn cell(&self) -> [f64; 2] {
        self.cell.as_ref().map_or([0.0; 2], |cell| cell.cell)
    }
}

impl Trail<3, 3> for () {
    type Portraits = ();
    fn angle(&self) -> f64 {
        0.0
    }
    fn cell(&self) -> [f64; 2] {
        [0.0; 2]
    }
}

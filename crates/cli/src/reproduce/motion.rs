//! Orbits as the figures need them: every collision with its place in (x₀, x₁, x₂).

use std::sync::Arc;

use billiards::collision_laws::laws::NoSlip;
use billiards::geometry::Table;
use billiards::laws::Disk;
use billiards::observe::Watch;
use billiards::{Angle, BallLaw, Cell, Collision, Collisions, Conserved, Orbit, Planar};

use super::UNIFORM;

/// A collision, with the velocity after it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    /// Number of the piece.
    pub(super) piece: usize,
    /// Spin position and centre; on a lattice, unfolded in the plane and not reduced to the cell.
    pub(super) x: [f64; 3],
    /// `(v₀, v₁, v₂)`
    pub(super) v: [f64; 3],
    /// The unit normal, into the table.
    pub(super) normal: [f64; 2],
}

impl Hit {
    /// Where the disk's centre is.
    pub(super) fn place(&self) -> [f64; 2] {
        [self.x[1], self.x[2]]
    }

    /// `(v₀, v·t)`, with `t = J ν`.
    pub(super) fn tangential(&self) -> [f64; 2] {
        [self.v[0], self.v[2] * self.normal[0] - self.v[1] * self.normal[1]]
    }
}

/// A path from its start through its collisions.
#[derive(Clone, Debug)]
pub(super) struct Path {
    pub(super) start: [f64; 3],
    pub(super) hits: Vec<Hit>,
}

impl Path {
    /// The start and all collisions in (x₀, x₁, x₂).
    pub(super) fn points(&self) -> Vec<[f64; 3]> {
        core::iter::once(self.start).chain(self.hits.iter().map(|hit| hit.x)).collect()
    }

    /// The same in the plane.
    pub(super) fn plane(&self) -> Vec<[f64; 2]> {
        self.points().into_iter().map(|[_, a, b]| [a, b]).collect()
    }
}

/// A uniform disk without slip on a table.
pub(super) fn no_slip(table: Table) -> Planar<Disk> {
    no_slip_with(table, UNIFORM)
}

/// A disk with the given `γ` without slip on a table.
pub(super) fn no_slip_with(table: Table, gamma: f64) -> Planar<Disk> {
    Planar { table, law: Disk::new(&NoSlip, gamma).expect("a γ in range") }
}

/// Follows an orbit for a number of collisions, from `x = (x₀, x₁, x₂)` with velocity `v`.
pub(super) fn follow<L: BallLaw<2, 1>>(billiard: &Planar<L>, x: [f64; 3], v: [f64; 3], collisions: u64) -> Path {
    let mut hits = Vec::new();
    let mut note = |c_hit: &billiards::geometry::WallHit<f64, 2>, piece, x, v| {
        hits.push(Hit { piece, x, v, normal: c_hit.unit_normal() });
    };
    let (position, velocity, spin) = ([x[1], x[2]], [v[1], v[2]], [v[0]]);
    if let Some(lattice) = billiard.table.lattice() {
        let lattice = Arc::new(lattice.clone());
        let track = (Angle::new(x[0]), Cell::new(Arc::clone(&lattice), 0.0));
        let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>, _>::new(position, velocity, spin, track);
        let look = |c: &Collision<'_, 2, 1, Conserved<f64, 2>, (Angle, Cell)>| {
            let (o, by) = (c.orbit, lattice.translation(c.orbit.track.1.cell));
            let x = [o.track.0.0.value(), o.position[0] + by.x, o.position[1] + by.y];
            note(c.hit, c.piece(), x, [o.spin[0], o.velocity[0], o.velocity[1]]);
            core::ops::ControlFlow::Continue(())
        };
        billiard.run(&mut orbit, &Collisions(collisions), &mut Watch::new(look));
    } else {
        let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>, _>::new(position, velocity, spin, Angle::new(x[0]));
        let look = |c: &Collision<'_, 2, 1, Conserved<f64, 2>, Angle>| {
            let o = c.orbit;
            let x = [o.track.0.value(), o.position[0], o.position[1]];
            note(c.hit, c.piece(), x, [o.spin[0], o.velocity[0], o.velocity[1]]);
            core::ops::ControlFlow::Continue(())
        };
        billiard.run(&mut orbit, &Collisions(collisions), &mut Watch::new(look));
    }
    Path { start: x, hits }
}

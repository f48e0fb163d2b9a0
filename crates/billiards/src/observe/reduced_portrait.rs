//! The reduced phase portrait: where and how each collision leaves the wall.
use super::{Collision, Observer};
use crate::{merge::Merge, reduced::ReducedState};
use core::ops::ControlFlow;
use geometry::Table;

/// The [`ReducedState`] after each collision, in any collection of them.
///
/// ```
/// use billiards::{Collisions, Conserved, Orbit, Planar, laws::Disk};
/// use billiards::{collision_laws::laws::NoSlip, geometry::tables, observe::ReducedPortrait};
///
/// let table = tables::stadium(1.0, 1.0)?;
/// let stadium = Planar { table: table.clone(), law: Disk::new(&NoSlip, 0.5_f64.sqrt())? };
/// let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>>::new([0.1, 0.2], [0.6, 0.3], [0.4], ());
/// let mut portrait = ReducedPortrait::new(&table, vec![]);
/// stadium.run(&mut orbit, &Collisions(100), &mut portrait);
/// // points of the solid torus of the paper, arc length along the whole boundary first
/// let torus: Vec<[f64; 3]> = portrait.states().iter().map(|state| state.coordinates(&table)).collect();
/// assert!(torus.iter().all(|[s, ..]| (0.0..=table.perimeter()).contains(s)));
/// # Ok::<(), billiards::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct ReducedPortrait<'a, E> {
    table: &'a Table,
    states: E,
}

impl<'a, E: Extend<ReducedState>> ReducedPortrait<'a, E> {
    /// A portrait of orbits on `table` that goes into `states`.
    pub fn new(table: &'a Table, states: E) -> Self {
        ReducedPortrait { table, states }
    }

    /// The collection that it went into.
    pub fn states(&self) -> &E {
        &self.states
    }

    /// The collection that it went into.
    pub fn into_states(self) -> E {
        self.states
    }
}

impl<K, T, E: Extend<ReducedState>> Observer<2, 1, K, T> for ReducedPortrait<'_, E> {
    fn collision(&mut self, c: &Collision<'_, 2, 1, K, T>) -> ControlFlow<()> {
        self.states.extend(Some(ReducedState::after(self.table, c.hit, c.orbit)));
        ControlFlow::Continue(())
    }
}

impl<E: Merge> Merge for ReducedPortrait<'_, E> {
    fn merge(self, other: Self) -> Self {
        ReducedPortrait { states: self.states.merge(other.states), ..self }
    }
    fn next_orbit(&mut self) {
        self.states.next_orbit();
    }
}

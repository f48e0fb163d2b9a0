//! The raw record: every collision as a row of plain numbers.
use super::{Collision, Observer};
use crate::{
    energy::EnergyKeeper,
    track::{InCell, Timed, Turned},
};
use core::{fmt, ops::ControlFlow};

/// A collision of a disk on a planar table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanarRow {
    /// Its number, from 1.
    pub n: u64,
    /// Time since the start \[T\].
    pub t: f64,
    /// Number of the piece hit.
    pub piece: usize,
    /// Scaled spin position `x₀ = γ R θ` \[L\].
    pub x0: f64,
    /// Position of the centre \[L\]; on a lattice in the table's cell.
    pub x: [f64; 2],
    /// Scaled spin `v₀ = γ R θ̇` after the collision [L T⁻¹].
    pub v0: f64,
    /// Velocity of the centre after the collision [L T⁻¹].
    pub v: [f64; 2],
    /// The translation accumulated on a lattice, in multiples of its vectors; `None` unless a [`Cell`](crate::Cell) tracks
    /// it.
    pub cell: Option<[i64; 2]>,
}

/// A collision of a ball in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpatialRow {
    /// Its number, from 1.
    pub n: u64,
    /// Time since the start \[T\].
    pub t: f64,
    /// Number of the piece hit.
    pub piece: usize,
    /// Position of the centre \[L\].
    pub x: [f64; 3],
    /// Velocity of the centre after the collision [L T⁻¹].
    pub v: [f64; 3],
    /// Scaled spin `W = γ R ω` after the collision, an axial vector in the space frame [L T⁻¹].
    pub w: [f64; 3],
}

/// Hands a row per collision to a function, which may stop the run: a file that cannot be written, say. Velocities are
/// [restored](crate::Orbit::restored).
///
/// In the plane the orbit needs a track with time and spin position, such as `(Clock, Angle)`, on a lattice
/// `(Clock, (Angle, Cell))`; in space a [`Clock`](crate::Clock).
///
/// ```
/// use billiards::{Angle, Clock, Collisions, Conserved, Orbit, Planar, laws::Disk};
/// use billiards::{collision_laws::laws::NoSlip, geometry::tables, observe::{PlanarRow, Record}};
/// use std::ops::ControlFlow;
///
/// let square = Planar { table: tables::square(1.0)?, law: Disk::new(&NoSlip, 1.0)? };
/// let track = (Clock::new(0.0), Angle::new(0.0));
/// let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>, _>::new([0.5, 0.5], [0.25, -1.0], [0.5], track);
/// let mut rows = vec![];
/// square.run(&mut orbit, &Collisions(3), &mut Record::new(|row: PlanarRow| {
///     rows.push(row);
///     ControlFlow::Continue(())
/// }));
/// // γ = 1: spin and tangential velocity change places
/// let first = rows[0];
/// assert_eq!((first.t, first.x, first.x0), (0.5, [0.625, 0.0], 0.25));
/// assert_eq!((first.piece, first.v0, first.v), (0, -0.25, [-0.5, 1.0]));
/// # Ok::<(), billiards::Error>(())
/// ```
pub struct Record<F>(F);

impl<F> Record<F> {
    /// An observer that calls `sink` for each collision.
    pub fn new<Row>(sink: F) -> Self
    where
        F: FnMut(Row) -> ControlFlow<()>,
    {
        Record(sink)
    }
}

impl<F> fmt::Debug for Record<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Record")
    }
}

impl<K, T, F> Observer<2, 1, K, T> for Record<F>
where
    K: EnergyKeeper<f64, 2, 1>,
    T: Timed + Turned + InCell,
    F: FnMut(PlanarRow) -> ControlFlow<()>,
{
    #[inline]
    fn collision(&mut self, c: &Collision<'_, 2, 1, K, T>) -> ControlFlow<()> {
        let (o, (v, w)) = (c.orbit, c.orbit.restored());
        #[allow(clippy::cast_possible_truncation, reason = "a count of cells")]
        let cell = o.track.cell().map(|cell| cell.map(|k| k as i64));
        self.0(PlanarRow {
            n: c.n,
            t: o.track.time(),
            piece: c.piece(),
            x0: o.track.angle(),
            x: o.position,
            v0: w[0],
            v,
            cell,
        })
    }
}

impl<K, T, F> Observer<3, 3, K, T> for Record<F>
where
    K: EnergyKeeper<f64, 3, 3>,
    T: Timed,
    F: FnMut(SpatialRow) -> ControlFlow<()>,
{
    #[inline]
    fn collision(&mut self, c: &Collision<'_, 3, 3, K, T>) -> ControlFlow<()> {
        let (o, (v, w)) = (c.orbit, c.orbit.restored());
        self.0(SpatialRow { n: c.n, t: o.track.time(), piece: c.piece(), x: o.position, v, w })
    }
}

//! Where a particle is and how it moves.
use crate::{
    energy::EnergyKeeper,
    track::{Timed, Track},
};
use lanes::Lane;

/// The state of a ball between two collisions, or of as many as there are lanes.
///
/// `S` is the number of spin components that the scene needs: 0 for a point, 1 for a disk, 3 for a ball in space. The tables of
/// [`Planar`](crate::Planar) run a disk and those of [`Spatial`](crate::Spatial) a ball; for a point under
/// [`Specular`](crate::laws::Specular) the spin stays 0. A point without spin runs on [`Walls`](geometry::Walls) of your choice:
///
/// ```
/// use billiards::{Billiard, Collisions, Orbit, laws::Specular, run};
/// use billiards::geometry::walls::Slab;
///
/// let strip = Slab::<2, 1>::new(0.0, 1.0, [0, 1])?;
/// let mut point = Orbit::<f64, 2, 0>::new([0.0, 0.5], [1.0, -1.0], [], ());
/// run(&Billiard { walls: &strip, law: &Specular }, &mut point, &Collisions(3), &mut ());
/// assert_eq!((point.position, point.velocity), ([2.5, 0.0], [1.0, 1.0]));
/// # Ok::<(), billiards::Error>(())
/// ```
///
/// `K` keeps the energy, `T` tracks what grows along the path; both are `()` where not needed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit<F, const N: usize, const S: usize, K = (), T = ()> {
    /// Position of the centre \[L\].
    pub position: [F; N],
    /// Velocity of the centre [L T⁻¹]. Round walls and keepers of the energy take squares of speeds, so speeds should lie between 10⁻¹⁵⁰
    /// and 10¹⁵⁰.
    pub velocity: [F; N],
    /// Scaled spin `γ R ω` [L T⁻¹]: kinetic energy is `(m/2)(|velocity|² + |spin|²)`.
    pub spin: [F; S],
    /// Keeps the energy where the law conserves it, and between round walls the [digits](crate::Recurring) of the velocity that are
    /// rounded off here. It belongs to this motion: to change position, velocity or spin make a new orbit, and to store an orbit in a
    /// file store its [bits](crate::Conserved::to_bits) too.
    pub keeper: K,
    /// What is tracked along the path.
    pub track: T,
}

impl<F: Lane, const N: usize, const S: usize, K: EnergyKeeper<F, N, S>, T: Track<F, N, S>> Orbit<F, N, S, K, T> {
    /// The orbit that starts at `position` with `velocity` and scaled `spin`.
    ///
    /// The table is not consulted: the position must lie in it, on a lattice in its [cell](geometry::Table::cell), or the answers of the
    /// walls are meaningless. [`Planar::orbit`](crate::Planar::orbit) and [`Spatial::orbit`](crate::Spatial::orbit) check this; starts on
    /// a wall come from [`Starts`](crate::Starts) and [`ReducedState`](crate::ReducedState). A path from a corner may end there at once,
    /// as rounding hides that it leaves the end of one of the walls: begin it a little later.
    #[inline]
    pub fn new(position: [F; N], velocity: [F; N], spin: [F; S], track: T) -> Self {
        Orbit { position, velocity, spin, keeper: K::new(&velocity, &spin), track }
    }
}

impl<const N: usize, const S: usize, K: EnergyKeeper<f64, N, S>, T> Orbit<f64, N, S, K, T> {
    /// Velocity and spin with the energy of the start to the last digit: `|E − E₀| ≤ 2⁻⁵¹ E₀` wherever the orbit is.
    ///
    /// The orbit itself goes on without this correction: its energy is restored at every [`BEAT`](crate::BEAT)th collision, and in
    /// between it is off by the rounding since then, up to 10⁻¹⁴. All components grow by the same factor, except a spin that is what it
    /// was at the start: the specular law leaves that alone, and so does this, unless nearly all energy is spin. What is right already
    /// stays as it is, and so does everything where no energy is kept.
    ///
    /// ```
    /// use billiards::{Collisions, Conserved, Orbit, Planar, laws::Disk};
    /// use billiards::{collision_laws::laws::NoSlip, geometry::tables};
    ///
    /// let stadium = Planar { table: tables::stadium(1.0, 1.0)?, law: Disk::new(&NoSlip, 0.7)? };
    /// let mut orbit: Orbit<f64, 2, 1, Conserved<f64, 2>> = Orbit::new([0.1, 0.2], [0.6, 0.8], [0.5], ());
    /// stadium.run(&mut orbit, &Collisions(1_000_003), &mut ());
    /// let ([v1, v2], [w]) = orbit.restored();
    /// assert!((v1 * v1 + v2 * v2 + w * w - 1.25).abs() <= 2.0 * f64::EPSILON);
    /// # Ok::<(), billiards::Error>(())
    /// ```
    pub fn restored(&self) -> ([f64; N], [f64; S]) {
        let (mut velocity, mut spin) = (self.velocity, self.spin);
        let lack = self.keeper.lack(&velocity, &spin);
        if lack.abs() > f64::EPSILON {
            let [of_velocity, of_spin] = self.keeper.shares(&velocity, &spin).map(|share| 0.5 * lack * share);
            for v in &mut velocity {
                *v += *v * of_velocity;
            }
            for w in &mut spin {
                *w += *w * of_spin;
            }
        }
        (velocity, spin)
    }
}

impl<const N: usize, const S: usize, K: EnergyKeeper<f64, N, S>, T: Timed> Orbit<f64, N, S, K, T> {
    /// Where the centre is at `time` \[T\], on the flight that begins here: `x + (t − t₀) v`, with the [restored](Orbit::restored)
    /// velocity. For times before that flight it is where the flight begins; beyond the end of the flight no collision is applied, and a
    /// lattice has no cells.
    ///
    /// A run up to a [`Time`](crate::Time) leaves the orbit at its last collision before; this tells how far it has come since.
    ///
    /// ```
    /// use billiards::{Clock, Orbit, Planar, Time, laws::Specular};
    /// use billiards::geometry::tables;
    ///
    /// let strip = Planar { table: tables::strip(1.0)?, law: Specular };
    /// let mut orbit = Orbit::<_, 2, 1, (), _>::new([0.0, 0.5], [1.0, 1.0], [0.0], Clock::new(0.0));
    /// strip.run(&mut orbit, &Time(2.25), &mut ());
    /// assert_eq!((orbit.position, orbit.track.0.value()), ([1.5, 0.0], 1.5)); // the next wall is hit at 2.5
    /// assert_eq!(orbit.position_at(2.25), [2.25, 0.75]);
    /// # Ok::<(), billiards::Error>(())
    /// ```
    pub fn position_at(&self, time: f64) -> [f64; N] {
        let (velocity, _) = self.restored();
        let flown = (time - self.track.time()).max(0.0);
        core::array::from_fn(|i| self.position[i] + velocity[i] * flown)
    }
}

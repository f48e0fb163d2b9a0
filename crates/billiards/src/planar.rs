//! A disk on a planar table: the billiard of the paper, ready to run.
use crate::{
    Error,
    billiard::BallLaw,
    energy::{EnergyKeeper, Keeping},
    error::finite,
    horizon::{Horizon, HorizonOn},
    in_lanes::InLanes,
    limit::{LaneLimit, Limit},
    observe::{LaneObserver, Observer},
    orbit::Orbit,
    run::RunOn,
    side_by_side::{Finished, ManyOn},
    start::Start,
    stop::Outcome,
    track::{Track, Tracking},
    with_motion::{OnWalls, WithMotion},
};
use geometry::{Table, Vector2, WallHit};

/// A table and a disk's law. The centre of the disk moves in the table as a point.
#[derive(Clone, Debug)]
pub struct Planar<L> {
    /// The region of centres.
    pub table: Table,
    /// What a collision does.
    pub law: L,
}

impl<L> Planar<L> {
    /// The orbit that starts at `position` with `velocity` and scaled `spin`. On a lattice it starts at the equivalent point of the
    /// [cell](Table::cell) in which paths are followed, which is the unit cell for most: a [`Cell`](crate::Cell) in the track counts from
    /// there.
    ///
    /// ```
    /// use billiards::{Error, Orbit, Planar, geometry::tables, laws::Specular};
    ///
    /// let torus = Planar { table: tables::sinai_torus(0.25, 1.0)?, law: Specular };
    /// let orbit: Orbit<f64, 2, 1> = torus.orbit([-0.875, 0.125], [1.0, 0.5], [0.0], ())?;
    /// assert_eq!(orbit.position, [0.125, 0.125]);
    /// let in_the_disk = torus.orbit::<(), ()>([0.5, 0.625], [1.0, 0.5], [0.0], ());
    /// assert!(matches!(in_the_disk, Err(Error::Outside { .. })));
    /// let nowhere = torus.orbit::<(), ()>([0.125, 0.125], [1.0, f64::NAN], [0.0], ());
    /// assert!(matches!(nowhere, Err(Error::NotFinite { quantity: "velocity", .. })));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Outside`] unless the position lies in the table, off the boundary; [`Error::NotFinite`] for a velocity or spin that is not
    /// finite.
    pub fn orbit<K, T>(
        &self,
        position: [f64; 2],
        velocity: [f64; 2],
        spin: [f64; 1],
        track: T,
    ) -> Result<Orbit<f64, 2, 1, K, T>, Error>
    where
        K: EnergyKeeper<f64, 2, 1>,
        T: Track<f64, 2, 1>,
    {
        let at = self.table.home(&position.into());
        if !self.table.contains(&at) {
            return Err(Error::Outside { position: position.to_vec() });
        }
        finite("velocity", &velocity)?;
        finite("spin", &spin)?;
        Ok(Orbit::new(at.into(), velocity, spin, track))
    }
}

impl<L: BallLaw<2, 1>> Planar<L> {
    /// Applies `then` to the fastest motion that the table has.
    pub fn with_motion<A: WithMotion<2, 1>>(&self, then: A) -> A::Output {
        self.table.with_walls(OnWalls { law: &self.law, then })
    }

    /// Runs an orbit on the fastest walls that the table has. It must start in the table, as [`Planar::orbit`] ensures. On a lattice
    /// it is first brought into the [cell](Table::cell) in which paths are followed, which its tracks see as a flight of zero time.
    ///
    /// Run in parts, an orbit has the bits that it has in a single run; but in a circle and in a strip, where each run finds the frame of
    /// the wall anew ([`Rolling`](crate::Rolling)), only up to rounding. A [`Billiard`](crate::Billiard) on a
    /// [`Sphere`](geometry::walls::Sphere) or a [`Slab`](geometry::walls::Slab) has the same bits there, too, and takes longer.
    ///
    /// ```
    /// use billiards::{Clock, Collisions, Conserved, Orbit, Planar, Stop, laws::Disk};
    /// use billiards::{collision_laws::laws::NoSlip, geometry::tables};
    ///
    /// // a uniform disk (γ² = 1/2) in the strip 0 < x₂ < 1, starting downwards at an angle
    /// let strip = Planar { table: tables::strip(1.0)?, law: Disk::new(&NoSlip, 0.5_f64.sqrt())? };
    /// let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>, _>::new([0.0, 0.5], [0.6, -0.8], [0.0], Clock::new(0.0));
    /// let outcome = strip.run(&mut orbit, &Collisions(1000), &mut ());
    /// assert_eq!(outcome.stop, Stop::Finished);
    /// assert!(orbit.position[0].abs() < 3.0); // a thousand bounces later it is still near: no-slip orbits are bounded
    /// # Ok::<(), billiards::Error>(())
    /// ```
    pub fn run<K, T, O>(&self, orbit: &mut Orbit<f64, 2, 1, K, T>, limit: &impl Limit<T>, observer: &mut O) -> Outcome
    where
        K: EnergyKeeper<f64, 2, 1>,
        T: Track<f64, 2, 1> + Clone,
        O: Observer<2, 1, K, T>,
    {
        if let Some(home) = way_home(&self.table, &orbit.position) {
            orbit.track.fly(&orbit.position, &[0.0; 2], &orbit.spin, &home);
            orbit.position = home.point;
        }
        self.with_motion(RunOn { orbit, limit, observer })
    }

    /// Runs many orbits side by side; see [`run_side_by_side`](crate::run_side_by_side).
    pub fn run_side_by_side<K: Keeping<2, 1>, T: Tracking<2, 1>, O: LaneObserver<2, 1, K, T>>(
        &self,
        orbits: &mut dyn Iterator<Item = Orbit<f64, 2, 1, K, T>>,
        limit: &impl LaneLimit<2, 1, T>,
        observer: &mut O,
        finished: &mut dyn FnMut(Finished<2, 1, K, T>),
    ) {
        let mut orbits = orbits.map(|mut orbit| {
            if let Some(home) = way_home(&self.table, &orbit.position) {
                let mut track = T::In::<f64>::all(&orbit.track, 0.0);
                track.fly(&orbit.position, &[0.0; 2], &orbit.spin, &home);
                (orbit.track, orbit.position) = (track.one(0), home.point);
            }
            orbit
        });
        self.with_motion(ManyOn { orbits: &mut orbits, limit, observer, finished });
    }

    /// For how many collisions the digits of an orbit are right on this table of the given size \[L\], up to the limit
    /// `[collisions, time]`; see [`Horizon::of`]. On a lattice it starts at the equivalent point of the [cell](Table::cell), as in a run.
    ///
    /// ```
    /// use billiards::{Planar, Start, geometry::tables, laws::Specular};
    ///
    /// let start = Start { position: [0.1, 0.2], velocity: [0.6, 0.8], spin: [0.0] };
    /// let looked_at = [1000.0, f64::INFINITY];
    /// let stadium = Planar { table: tables::stadium(1.0, 1.0)?, law: Specular }.horizon(start, 4.0, looked_at);
    /// assert!(stadium.lost && stadium.collisions < 60);
    /// let square = Planar { table: tables::square(1.0)?, law: Specular }.horizon(start, 1.0, looked_at);
    /// assert!(!square.lost && square.error < 1e-9);
    /// # Ok::<(), billiards::Error>(())
    /// ```
    pub fn horizon(&self, start: Start<2, 1>, size: f64, limit: [f64; 2]) -> Horizon {
        let position = way_home(&self.table, &start.position).map_or(start.position, |home| home.point);
        let start = Start { position, ..start };
        self.with_motion(HorizonOn { walls: &self.table, start, size, limit })
    }
}

/// The equivalent of a position in the cell of a table on a lattice, as a hit at time 0; `None` if it already lies there.
fn way_home(table: &Table, position: &[f64; 2]) -> Option<WallHit<f64, 2>> {
    let (cell, position) = (table.cell()?, Vector2::from(*position));
    // a hit on an edge may lie beyond it by a rounding, and goes on from there
    (!cell.holds(&position)).then(|| WallHit { time: 0.0, ..WallHit::never(cell.home(&position).0.into()) })
}

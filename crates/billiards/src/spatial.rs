//! A ball on a table in space, ready to run.
use crate::{
    Error,
    billiard::BallLaw,
    energy::{EnergyKeeper, Keeping},
    error::finite,
    horizon::{Horizon, HorizonOn},
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
use geometry::tables::SpatialTable;

/// A table in space and a ball's law. The centre of the ball moves in the table as a point.
#[derive(Clone, Debug)]
pub struct Spatial<L> {
    /// The region of centres.
    pub table: SpatialTable,
    /// What a collision does.
    pub law: L,
}

impl<L> Spatial<L> {
    /// The orbit that starts at `position` with `velocity` and scaled `spin`.
    ///
    /// # Errors
    /// [`Error::Outside`] unless the position lies in the table, off the boundary; [`Error::NotFinite`] for a velocity or spin that is not
    /// finite.
    pub fn orbit<K, T>(
        &self,
        position: [f64; 3],
        velocity: [f64; 3],
        spin: [f64; 3],
        track: T,
    ) -> Result<Orbit<f64, 3, 3, K, T>, Error>
    where
        K: EnergyKeeper<f64, 3, 3>,
        T: Track<f64, 3, 3>,
    {
        if !self.table.contains(&position.into()) {
            return Err(Error::Outside { position: position.to_vec() });
        }
        finite("velocity", &velocity)?;
        finite("spin", &spin)?;
        Ok(Orbit::new(position, velocity, spin, track))
    }
}

impl<L: BallLaw<3, 3>> Spatial<L> {
    /// Applies `then` to the fastest motion that the table has.
    pub fn with_motion<A: WithMotion<3, 3>>(&self, then: A) -> A::Output {
        self.table.with_walls(OnWalls { law: &self.law, then })
    }

    /// Runs an orbit. It must start in the table, as [`Spatial::orbit`] ensures.
    ///
    /// ```
    /// use billiards::{Clock, Collisions, Conserved, Orbit, Spatial, Stop, laws::RoughBall};
    /// use billiards::geometry::tables;
    ///
    /// // a uniform ball (γ² = 2/5) between two parallel planes never gets far
    /// let slab = Spatial { table: tables::slab(1.0)?, law: RoughBall::no_slip(0.4_f64.sqrt())? };
    /// let (velocity, spin) = ([0.3, -0.2, -0.8], [0.1, 0.4, 0.2]);
    /// let mut orbit = Orbit::<_, 3, 3, Conserved<_, 3>, _>::new([0.0, 0.0, 0.5], velocity, spin, Clock::new(0.0));
    /// let outcome = slab.run(&mut orbit, &Collisions(1000), &mut ());
    /// assert_eq!(outcome.stop, Stop::Finished);
    /// assert!(orbit.position[0].abs() + orbit.position[1].abs() < 3.0);
    /// # Ok::<(), billiards::Error>(())
    /// ```
    pub fn run<K, T, O>(&self, orbit: &mut Orbit<f64, 3, 3, K, T>, limit: &impl Limit<T>, observer: &mut O) -> Outcome
    where
        K: EnergyKeeper<f64, 3, 3>,
        T: Track<f64, 3, 3> + Clone,
        O: Observer<3, 3, K, T>,
    {
        self.with_motion(RunOn { orbit, limit, observer })
    }

    /// Runs many orbits side by side; see [`run_side_by_side`](crate::run_side_by_side).
    ///
    /// ```
    /// use billiards::{CanonicalSpatial, Collisions, Conserved, Orbit, Spatial, Starts, geometry::tables, laws::RoughBall};
    ///
    /// let ball = Spatial { table: tables::ball(1.0)?, law: RoughBall::no_slip(0.4_f64.sqrt())? };
    /// let canonical = CanonicalSpatial::new(&ball.table, 1.0, 7).unwrap();
    /// let mut orbits = (0..100).map(|i| canonical.start(i).orbit(()));
    /// let mut energies = vec![];
    /// ball.run_side_by_side(&mut orbits, &Collisions(1000), &mut (), &mut |finished| {
    ///     let orbit: Orbit<f64, 3, 3, Conserved<f64, 3>> = finished.orbit;
    ///     energies.push(orbit.velocity.iter().chain(&orbit.spin).map(|v| v * v).sum::<f64>());
    /// });
    /// assert!(energies.len() == 100 && energies.iter().all(|energy| (energy - 1.0).abs() < 1e-14));
    /// # Ok::<(), billiards::Error>(())
    /// ```
    pub fn run_side_by_side<K: Keeping<3, 3>, T: Tracking<3, 3>, O: LaneObserver<3, 3, K, T>>(
        &self,
        orbits: &mut dyn Iterator<Item = Orbit<f64, 3, 3, K, T>>,
        limit: &impl LaneLimit<3, 3, T>,
        observer: &mut O,
        finished: &mut dyn FnMut(Finished<3, 3, K, T>),
    ) {
        self.with_motion(ManyOn { orbits, limit, observer, finished });
    }

    /// For how many collisions the digits of an orbit are right on this table of the given size \[L\], up to the limit
    /// `[collisions, time]`; see [`Horizon::of`].
    pub fn horizon(&self, start: Start<3, 3>, size: f64, limit: [f64; 2]) -> Horizon {
        self.with_motion(HorizonOn { walls: &self.table, start, size, limit })
    }
}

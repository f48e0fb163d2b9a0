//! Time reversal.
use crate::{billiard::BallLaw, energy::EnergyKeeper, orbit::Orbit, track::Track};
use geometry::WallHit;
use lanes::Lane;

/// Turns an orbit around that has just collided at `hit`: `R(x, v⁺) = (x, −C v⁺)`.
///
/// A strict law is an involution, so `C v⁺` is the velocity `v⁻` with which the orbit arrived, and `−v⁻` points into the table and back
/// to where it came from: `T⁻¹ = R T R` for the billiard map `T`, and `R R = 1`. Laws that are not involutions have no such reversal.
///
/// The energy keeper starts anew; what is tracked goes on, so that the time still grows and the spin position goes back.
///
/// ```
/// use billiards::{Collision, Collisions, Conserved, Orbit, Planar, laws::Disk, observe::Watch, reverse};
/// use billiards::{collision_laws::laws::NoSlip, geometry::{WallHit, tables}};
/// use std::ops::ControlFlow;
///
/// let stadium = Planar { table: tables::stadium(1.0, 1.0)?, law: Disk::new(&NoSlip, 0.5_f64.sqrt())? };
/// let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>>::new([0.1, 0.2], [0.6, 0.3], [0.4], ());
/// let (mut last, mut there) = (None::<WallHit<f64, 2>>, [0.0; 2]);
/// let mut watch = Watch::new(|c: &Collision<'_, 2, 1, _, _>| {
///     if c.n == 1 {
///         there = c.orbit.position;
///     }
///     last = Some(*c.hit);
///     ControlFlow::Continue(())
/// });
/// stadium.run(&mut orbit, &Collisions(10), &mut watch);
/// reverse(&stadium.law, &mut orbit, &last.expect("ten collisions"));
/// stadium.run(&mut orbit, &Collisions(9), &mut ());
/// let [x1, x2] = orbit.position;
/// assert!((x1 - there[0]).abs() + (x2 - there[1]).abs() < 1e-9);
/// # Ok::<(), billiards::Error>(())
/// ```
pub fn reverse<L, F, const N: usize, const S: usize, K, T>(
    law: &L,
    orbit: &mut Orbit<F, N, S, K, T>,
    hit: &WallHit<F, N>,
) where
    L: BallLaw<N, S>,
    F: Lane,
    K: EnergyKeeper<F, N, S>,
    T: Track<F, N, S>,
{
    law.collide(hit, &mut orbit.velocity, &mut orbit.spin);
    orbit.velocity = orbit.velocity.map(|v| -v);
    orbit.spin = orbit.spin.map(|w| -w);
    orbit.keeper = K::new(&orbit.velocity, &orbit.spin);
}

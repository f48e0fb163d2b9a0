//! The velocity phase portrait: the reduced phase space without the position.
use super::{Collision, Observer};
use crate::{energy::square_speed, merge::Merge};
use core::ops::ControlFlow;

/// A point `(v₀, v·t)/|(v₀, v)|` of the unit disk per collision, with `t = J ν` and the velocities after it.
///
/// The points go into any collection: a `Vec` keeps them, a [`Density`](super::Density) counts them. Reference: Cox and
/// Feres, *No-slip billiards in dimension two*, §1: the projection of the solid torus onto its disk; they draw it for the
/// hexagon.
///
/// ```
/// use billiards::{Collisions, Conserved, Orbit, Planar, laws::Disk};
/// use billiards::{collision_laws::laws::NoSlip, geometry::tables, observe::{Density, VelocityPortrait}};
///
/// let hexagon = Planar { table: tables::hexagon(1.0)?, law: Disk::new(&NoSlip, 0.5_f64.sqrt())? };
/// let mut orbit = Orbit::<_, 2, 1, Conserved<_, 2>>::new([0.1, 0.2], [0.6, 0.3], [0.4], ());
/// let mut portrait = (VelocityPortrait::new(vec![]), VelocityPortrait::new(Density::disk(256)));
/// hexagon.run(&mut orbit, &Collisions(1000), &mut portrait);
/// let (points, density) = (portrait.0.into_points(), portrait.1.into_points());
/// assert!(points.iter().all(|[v0, vt]| v0 * v0 + vt * vt < 1.0));
/// assert_eq!(density.total(), 1000);
/// # Ok::<(), billiards::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct VelocityPortrait<E>(E);

impl<E: Extend<[f64; 2]>> VelocityPortrait<E> {
    /// A portrait that goes into `points`.
    pub fn new(points: E) -> Self {
        VelocityPortrait(points)
    }

    /// What it went into.
    pub fn points(&self) -> &E {
        &self.0
    }

    /// What it went into.
    pub fn into_points(self) -> E {
        self.0
    }
}

impl<K, T, E: Extend<[f64; 2]>> Observer<2, 1, K, T> for VelocityPortrait<E> {
    #[inline(always)]
    fn collision(&mut self, c: &Collision<'_, 2, 1, K, T>) -> ControlFlow<()> {
        let (o, [n1, n2]) = (c.orbit, c.hit.unit_normal());
        let unit = 1.0 / square_speed(&o.velocity, &o.spin).sqrt();
        let vt = o.velocity[1] * n1 - o.velocity[0] * n2;
        self.0.extend(Some([o.spin[0] * unit, vt * unit]));
        ControlFlow::Continue(())
    }
}

impl<E: Merge> Merge for VelocityPortrait<E> {
    fn merge(self, other: Self) -> Self {
        VelocityPortrait(self.0.merge(other.0))
    }
    fn next_orbit(&mut self) {
        self.0.next_orbit();
    }
}

//! The velocity phase portrait: the reduced phase space without the position.
use super::{Collision, Density, LaneObserver, Observer};
use crate::{
    energy::{Keeping, square_speed},
    merge::Merge,
    orbit::Orbit,
    track::Tracking,
};
use core::ops::ControlFlow;
use geometry::WallHit;
use lanes::{Lane, MOST_LANES};

/// A point `(v₀, v·t)/|(v₀, v)|` of the unit disk per collision, with `t = J ν` and the velocities after it.
///
/// The points go into any collection: a `Vec` keeps them, a [`Density`] counts them, also of many orbits
/// [side by side](crate::run_side_by_side). Reference: Cox and
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

    /// The collection that it went into.
    pub fn points(&self) -> &E {
        &self.0
    }

    /// The collection that it went into.
    pub fn into_points(self) -> E {
        self.0
    }
}

/// `(v₀, v·t)/|(v₀, v)|`
#[inline(always)]
fn point<F: Lane, K, T>(hit: &WallHit<F, 2>, orbit: &Orbit<F, 2, 1, K, T>) -> [F; 2] {
    let ([n1, n2], [v1, v2], [v0]) = (hit.unit_normal(), orbit.velocity, orbit.spin);
    let unit = v0.same(1.0) / square_speed(&orbit.velocity, &orbit.spin).sqrt();
    [v0 * unit, (v2 * n1 - v1 * n2) * unit]
}

impl<K, T, E: Extend<[f64; 2]>> Observer<2, 1, K, T> for VelocityPortrait<E> {
    #[inline(always)]
    fn collision(&mut self, c: &Collision<'_, 2, 1, K, T>) -> ControlFlow<()> {
        self.0.extend(Some(point(c.hit, c.orbit)));
        ControlFlow::Continue(())
    }
}

/// Many orbits side by side are counted in the same cells, each point where it arises.
impl<K: Keeping<2, 1>, T: Tracking<2, 1>> LaneObserver<2, 1, K, T> for VelocityPortrait<Density> {
    /// The lanes with an orbit.
    type View<F: Lane> = F::Mask;
    fn nobody<F: Lane>(&self, zero: F) -> F::Mask {
        zero.never()
    }
    fn begin<F: Lane>(&mut self, view: &mut F::Mask, here: F::Mask, _: u64, _: &Orbit<f64, 2, 1, K, T>) {
        *view = *view | here;
    }
    fn end<F: Lane>(&mut self, view: &mut F::Mask, here: F::Mask) {
        *view = *view & !here;
    }
    #[inline(always)]
    fn collision<F: Lane>(
        &mut self,
        view: &mut F::Mask,
        hit: &WallHit<F, 2>,
        orbit: &Orbit<F, 2, 1, K::In<F>, T::In<F>>,
    ) {
        let Self(density) = self;
        let layer = hit.time.same(density.layer(0));
        let mut cells = [0.0; MOST_LANES];
        density.cells(density.near(point(hit, orbit)), layer, *view).store(&mut cells);
        density.count(&cells[..F::LANES]);
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

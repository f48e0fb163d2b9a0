//! A motion for one orbit, behind a pointer.
use crate::{
    billiard::{BallLaw, Billiard},
    rolling::Rolling,
};
use geometry::{Homogeneous, WallHit, Walls};

/// Walls and a law for one orbit, behind a pointer.
///
/// ```
/// use billiards::{Billiard, Bounce, laws::Specular};
/// use billiards::geometry::{Vector2, walls::{Cuboid, Sphere}};
///
/// /// The time of the first three flights, whatever the walls.
/// fn time(billiard: &dyn Bounce<2, 0>, mut position: [f64; 2], mut velocity: [f64; 2]) -> f64 {
///     let mut time = 0.0;
///     for _ in 0..3 {
///         let hit = billiard.first_hit(&position, &velocity);
///         billiard.collide(&hit, &mut velocity, &mut []);
///         (position, time) = (hit.point, time + hit.time);
///     }
///     time
/// }
/// let circle = Sphere::new(Vector2::zeros(), 5.0, 0)?;
/// let square = Cuboid::new([-5.0; 2], [5.0; 2], [[3, 1], [0, 2]])?;
/// let billiards: [&dyn Bounce<2, 0>; 2] =
///     [&Billiard { walls: &circle, law: &Specular }, &Billiard { walls: &square, law: &Specular }];
/// let [in_circle, in_square] = billiards.map(|billiard| time(billiard, [0.0; 2], [3.0, 4.0]));
/// assert!((in_circle - 5.0).abs() < 1e-14); // half a diameter and two
/// assert!((in_square - 3.75).abs() < 1e-14); // top, right, bottom
/// # Ok::<(), billiards::Error>(())
/// ```
pub trait Bounce<const N: usize, const S: usize>: Sync {
    /// The first hit of the path from `position` \[L\] with `velocity` [L T⁻¹]; its time is infinite where there is none.
    fn first_hit(&self, position: &[f64; N], velocity: &[f64; N]) -> WallHit<f64, N>;
    /// What the hit does to velocity and scaled spin [L T⁻¹].
    fn collide(&self, hit: &WallHit<f64, N>, velocity: &mut [f64; N], spin: &mut [f64; S]);
}

impl<W: Walls<N>, L: BallLaw<N, S>, const N: usize, const S: usize> Bounce<N, S> for Billiard<'_, W, L> {
    fn first_hit(&self, position: &[f64; N], velocity: &[f64; N]) -> WallHit<f64, N> {
        self.walls.first_hit(position, velocity)
    }
    fn collide(&self, hit: &WallHit<f64, N>, velocity: &mut [f64; N], spin: &mut [f64; S]) {
        self.law.collide(hit, velocity, spin);
    }
}

impl<W: Homogeneous, L: BallLaw<2, 1>> Bounce<2, 1> for Rolling<'_, W, L> {
    fn first_hit(&self, position: &[f64; 2], velocity: &[f64; 2]) -> WallHit<f64, 2> {
        self.walls.first_hit(position, velocity)
    }
    fn collide(&self, hit: &WallHit<f64, 2>, velocity: &mut [f64; 2], spin: &mut [f64; 1]) {
        self.law.collide(hit, velocity, spin);
    }
}

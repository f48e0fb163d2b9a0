//! A billiard: a table's walls and a ball's law.
use crate::{
    creep::{creeps, follows, meets_a_vertex},
    energy::{Arrived, EnergyKeeper, taxicab, taxicab_with_spin},
    laws::Mirror,
    orbit::Orbit,
    stop::{GRAZING, ROUNDED, Stop, ended, has_stalled},
    track::Track,
};
use geometry::{WallHit, Walls};
use lanes::{Lane, dot};

/// What a collision with the wall does to a ball, in lanes: the law as the engine's loop applies it.
///
/// `S` is the number of components of the scaled spin `γ R ω` that the law needs (see [`Orbit`]). The [`laws`](crate::laws) turn laws of
/// [`collision_laws`] into ball laws. In the plane and in space a borrowed law, `&L`, is a ball law too, so that several billiards can
/// share one.
///
/// ```
/// use billiards::{BallLaw, Billiard, Collisions, Orbit, run};
/// use billiards::geometry::{Vector2, WallHit, walls::Sphere};
/// use billiards::lanes::{Lane, dot};
///
/// /// A smooth wall that brakes the spin: `v⁺ = v − 2 (v·ν) ν`, `v₀⁺ = k v₀`.
/// struct Brake(f64);
/// impl BallLaw<2, 1> for Brake {
///     #[inline(always)]
///     fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
///         // ν = ι n: the normal n has any length, and ι = 1/|n|
///         let twice = dot(velocity, &hit.normal) * (hit.inverse * hit.inverse) * 2.0;
///         for (v, n) in velocity.iter_mut().zip(hit.normal) {
///             *v = *v - twice * n;
///         }
///         spin[0] = spin[0] * self.0;
///     }
/// }
/// let circle = Sphere::new(Vector2::zeros(), 4.0, 0)?;
/// let mut orbit = Orbit::<f64, 2, 1>::new([0.0, 0.0], [0.0, 1.0], [1.0], ());
/// run(&Billiard { walls: &circle, law: &Brake(0.5) }, &mut orbit, &Collisions(3), &mut ());
/// assert_eq!((orbit.position, orbit.velocity, orbit.spin), ([0.0, 4.0], [0.0, -1.0], [0.125]));
/// # Ok::<(), billiards::Error>(())
/// ```
pub trait BallLaw<const N: usize, const S: usize>: Sync {
    /// Turns the velocity and the scaled spin [L T⁻¹] before a collision into those after it. The normal of the hit, of any length, points
    /// into the table, and so must the velocity after it: otherwise the orbit ends, as [`Stop::IntoWall`].
    ///
    /// The result must depend on the arguments alone. Lanes without an orbit are computed, too, and discarded.
    fn collide<F: Lane>(&self, hit: &WallHit<F, N>, velocity: &mut [F; N], spin: &mut [F; S]);

    /// The same, to the last bit, at a hit whose normal is a unit vector along an axis: for laws that need a shorter chain of products
    /// there.
    #[inline(always)]
    fn collide_along_axis<F: Lane>(&self, hit: &WallHit<F, N>, velocity: &mut [F; N], spin: &mut [F; S]) {
        self.collide(hit, velocity, spin);
    }

    /// The same in the plane, for the normal and the tangential component of the velocity in the frame of a hit with
    /// unit normal `n` and tangent `J n`.
    ///
    /// A [`Rolling`](crate::Rolling) motion calls it in place of [`collide`](BallLaw::collide). A law that knows its map in this frame
    /// answers without a detour through the coordinates of the plane.
    #[inline(always)]
    fn collide_in_frame<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; S])
    where
        Self: BallLaw<2, S>,
    {
        let [n1, n2] = hit.normal;
        let [vn, vt] = *velocity;
        let mut v = [vn * n1 - vt * n2, vn * n2 + vt * n1];
        BallLaw::<2, S>::collide(self, hit, &mut v, spin);
        *velocity = [v[0] * n1 + v[1] * n2, v[1] * n1 - v[0] * n2];
    }

    /// Whether it always reverses the velocity's component along the normal and conserves the energy, as every strict law does: then an
    /// error of the energy can be corrected there sooner, and the speed need not be computed again.
    #[inline(always)]
    fn is_strict(&self) -> bool {
        false
    }

    /// What it does in the frame of a hit in the plane, if it is an involution and the same at every hit; `None` otherwise.
    fn mirror(&self) -> Option<Mirror> {
        None
    }
}

/// Walls and a law: the billiard map, in the coordinates of the plane or of space.
#[derive(Clone, Copy, Debug)]
pub struct Billiard<'a, W, L> {
    /// What can be hit.
    pub walls: &'a W,
    /// What a hit does.
    pub law: &'a L,
}

/// How an orbit gets from one collision to the next.
///
/// [`Billiard`] needs no more than the orbit itself; [`Rolling`](crate::Rolling) carries coordinates of its own. Code for either is a
/// [`WithMotion`](crate::WithMotion).
pub trait Motion<const N: usize, const S: usize> {
    /// Whether a step is so short that a CPU, which looks ahead over some hundred instructions, reaches the next step of the same orbits
    /// before the last one is done, unless many orbits take turns.
    const IS_SHORT: bool = false;
    /// What is carried from collision to collision besides the orbit.
    type Carried<F: Lane>: Copy;
    /// What a flight yields besides the hit.
    type Arrival<F: Lane>: Copy;

    /// Orbits that start from anywhere, as many as `zero` has lanes.
    fn start<F: Lane>(&self, zero: F) -> Self::Carried<F>;
    /// Another orbit starts, or goes on, in the lanes `new`.
    fn restart<F: Lane, K: EnergyKeeper<f64, N, S>, T>(
        &self,
        carried: &mut Self::Carried<F>,
        new: F::Mask,
        orbit: &mut Orbit<f64, N, S, K, T>,
    );
    /// The flight from where the orbit is to its next hit.
    fn flight<F: Lane, K: EnergyKeeper<F, N, S>, T>(
        &self,
        orbit: &Orbit<F, N, S, K, T>,
        carried: &Self::Carried<F>,
    ) -> (WallHit<F, N>, Self::Arrival<F>);
    /// Moves the orbit to the hit and through the collision there. Returns whether it leaves the wall at so flat an angle that the next
    /// flight cannot be told from rounding, or has stalled: under a strict law, whether the normal speed is not above `slow` [L T⁻¹].
    fn collide<F: Lane, K: EnergyKeeper<F, N, S>, T: Track<F, N, S>>(
        &self,
        orbit: &mut Orbit<F, N, S, K, T>,
        carried: &mut Self::Carried<F>,
        hit: &WallHit<F, N>,
        arrival: &Self::Arrival<F>,
        slow: F,
    ) -> F::Mask;
    /// The normal speed [L T⁻¹] up to which an orbit of these velocities counts as grazing, under a strict law.
    fn slow(&self, velocity: &[f64; N], spin: &[f64; S]) -> f64;
    /// Why an orbit that hits nothing ends: it escapes, it has stalled, it runs along a wall, it ends where two of them meet, or its
    /// velocity is not a number.
    fn without_hit(&self, _position: [f64; N], velocity: [f64; N]) -> Stop {
        ended(&velocity, Stop::Escaped)
    }
    /// The normal speed [L T⁻¹] with which orbits have left the last wall, if their law is not strict: a strict one lets nothing into a
    /// wall.
    fn leaving<F: Lane>(&self, carried: &Self::Carried<F>) -> F;
    /// Writes into the orbit what `collide` has only carried along; called when the orbit is looked at.
    #[inline(always)]
    fn settle<F: Lane, K, T>(&self, _: &mut Orbit<F, N, S, K, T>, _: &Self::Carried<F>) {}
}

/// The normal speed up to which an orbit of these velocities grazes under a strict law. Spin that never becomes velocity does not count.
pub(crate) fn slow<const N: usize, const S: usize>(
    law: &impl BallLaw<N, S>,
    velocity: &[f64; N],
    spin: &[f64; S],
) -> f64 {
    let is_specular = law.mirror().is_some_and(Mirror::is_specular);
    GRAZING * if is_specular { taxicab(velocity) } else { taxicab_with_spin(velocity, spin) }
}

impl<W: Walls<N>, L: BallLaw<N, S>, const N: usize, const S: usize> Motion<N, S> for Billiard<'_, W, L> {
    /// The normal speed with which orbits have left the last wall, if the law is not strict.
    type Carried<F: Lane> = F;
    type Arrival<F: Lane> = F;

    fn start<F: Lane>(&self, zero: F) -> F {
        zero
    }
    #[inline(always)]
    fn restart<F: Lane, K: EnergyKeeper<f64, N, S>, T>(&self, _: &mut F, _: F::Mask, _: &mut Orbit<f64, N, S, K, T>) {}
    #[inline(always)]
    fn flight<F: Lane, K: EnergyKeeper<F, N, S>, T>(&self, orbit: &Orbit<F, N, S, K, T>, _: &F) -> (WallHit<F, N>, F) {
        let owed = orbit.keeper.owed(&orbit.velocity, &orbit.spin);
        (self.walls.first_hit(&orbit.position, &orbit.velocity), owed)
    }
    #[inline(always)]
    fn collide<F: Lane, K: EnergyKeeper<F, N, S>, T: Track<F, N, S>>(
        &self,
        orbit: &mut Orbit<F, N, S, K, T>,
        leaving: &mut F,
        hit: &WallHit<F, N>,
        owed: &F,
        slow: F,
    ) -> F::Mask {
        orbit.track.fly(&orbit.position, &orbit.velocity, &orbit.spin, hit);
        orbit.position = hit.point;
        let normal_speed = dot(&orbit.velocity, &hit.normal);
        let reverses = self.law.is_strict();
        let (owed, before) =
            if reverses { (*owed, slow) } else { (orbit.keeper.rounded_off(*owed), taxicab(&orbit.velocity)) };
        let arrived = Arrived { owed, normal_speed, reverses };
        if self.walls.is_along_axes() {
            self.law.collide_along_axis(hit, &mut orbit.velocity, &mut orbit.spin);
        } else {
            self.law.collide(hit, &mut orbit.velocity, &mut orbit.spin);
        }
        if self.walls.rounds_normals() {
            orbit.keeper.straighten(&mut orbit.velocity, hit, &arrived);
        }
        if reverses && self.walls.are_parallel() {
            orbit.keeper.leave_along(&mut orbit.velocity, &mut orbit.spin, hit, &arrived);
        } else {
            orbit.keeper.leave(&mut orbit.velocity, hit, &arrived);
        }
        if self.law.is_strict() {
            return !slow.lt((normal_speed * hit.inverse).abs());
        }
        // a ball that a law leaves moving into the wall counts as flat, too
        *leaving = dot(&orbit.velocity, &hit.normal) * hit.inverse;
        let after = taxicab(&orbit.velocity);
        let flat = !(after.max(before) * ROUNDED).lt(*leaving);
        let speeds = [normal_speed * hit.inverse, *leaving];
        flat | creeps(hit, speeds, [before, after]) | has_stalled(&orbit.velocity)
    }
    fn slow(&self, velocity: &[f64; N], spin: &[f64; S]) -> f64 {
        slow(self.law, velocity, spin)
    }
    fn leaving<F: Lane>(&self, leaving: &F) -> F {
        *leaving
    }
    fn without_hit(&self, position: [f64; N], velocity: [f64; N]) -> Stop {
        let why = if follows(self.walls, &position, &velocity) {
            Stop::Grazing
        } else if meets_a_vertex(self.walls, &position, &velocity) {
            Stop::Corner
        } else {
            Stop::Escaped
        };
        ended(&velocity, why)
    }
}

//! Any law of [`collision_laws`], yours included, for a ball against a fixed wall.
use super::checked_gamma;
use crate::{Error, billiard::BallLaw};
use collision_laws::{CollisionLaw, Contact, Delassus};
use geometry::{WallHit, walls::number};
use lanes::{Lane, MOST_LANES, stored};
use nalgebra::{SVector, Unit, Vector2, Vector3};

/// Below this, γ counts as 0: the rim of a spinning ball would be so much faster than anything else that half of the digits
/// of the contact velocity were lost.
const LEAST_GAMMA: f64 = 1.0 / (1_u64 << 26) as f64;

/// Any [`CollisionLaw`] for a ball: linear or not, the same everywhere or a field over the boundary, per piece, random.
///
/// A billiard with any law is that of a disk in the plane or of a ball in space, with its spin; [`Specular`](super::Specular) runs in any
/// dimension, also for points.
///
/// The law sees the contact as [`collision_laws`] describes it: the point where the ball touches the wall (its centre is at
/// the hit, so this is `centre − R ν`), the unit normal ν, and the number of the piece as surface label. It is called for one lane after
/// another, idle lanes included: its impulse must be a [pure function](CollisionLaw) of its arguments, or results would depend on how
/// many lanes a CPU has. [`Disk`](super::Disk), [`Specular`](super::Specular) and [`RoughBall`](super::RoughBall) are faster for the laws
/// that they cover.
///
/// If a law [is strict](CollisionLaw::is_strict), the engine knows what rounding must not change, as it does for those.
///
/// The contact velocity of a spinning ball is `u = v − (1/γ) W × ν` with the scaled spin `W = γ R ω`, so it is right to about
/// `ε/γ` of the speed. In the limit γ → 0 of a point (γ < 2⁻²⁶ here) the slip is measured in the units of the spin: the tangential parts
/// of `u` and of the impulse are `γ u` and `p/γ`. Strict laws and restitution are unaffected by this change of units, and may use it for
/// any γ ([`with_scaled_slip`](Self::with_scaled_slip)); laws that are affected, such as friction, have no limit there.
///
/// ```
/// use billiards::{BallLaw, laws::{Custom, Disk}};
/// use billiards::collision_laws::{Contact, Roughness, laws::{Field, NoSlip}};
/// use billiards::geometry::{Walls, walls::Slab};
///
/// // a floor that is rough on its right half
/// let law = Field::new(|c: &Contact<2>| if c.point.x > 0.0 { Roughness::Rough } else { Roughness::Smooth });
/// let law = Custom::disk(law, 0.5_f64.sqrt())?;
/// let strip = Slab::<2, 1>::new(0.0, 1.0, [0, 1])?;
///
/// let hit = strip.first_hit(&[0.5, 0.5], &[0.25, -1.0]);
/// let (mut velocity, mut spin) = ([0.25, -1.0], [0.5]);
/// law.collide(&hit, &mut velocity, &mut spin);
/// let (mut same_velocity, mut same_spin) = ([0.25, -1.0], [0.5]);
/// Disk::new(&NoSlip, 0.5_f64.sqrt())?.collide(&hit, &mut same_velocity, &mut same_spin);
/// assert!((velocity[0] - same_velocity[0]).abs() < 1e-15 && (spin[0] - same_spin[0]).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Custom<L, const N: usize> {
    law: L,
    mass: f64,
    radius: f64,
    gamma: f64,
    /// The weight of a velocity of the centre along the wall in the slip: 1, or γ where γ is almost zero.
    centre: f64,
    /// The weight of a scaled spin in the slip: 1/γ times that.
    rim: f64,
    /// The eigenvalues of the Delassus operator of the slip, along the normal and on the wall.
    yields: [f64; 2],
    /// Whether the law is strict at every contact.
    strict: bool,
}

impl<L: CollisionLaw<2>> Custom<L, 2> {
    /// `law` for a disk with mass distribution parameter γ, of mass 1 and radius 0: the centre touches the wall.
    ///
    /// # Errors
    /// [`Error::Ball`] unless γ is finite and not negative.
    pub fn disk(law: L, gamma: f64) -> Result<Self, Error> {
        Custom::new(law, gamma)
    }
}

impl<L: CollisionLaw<3>> Custom<L, 3> {
    /// `law` for a ball in space with mass distribution parameter γ, of mass 1 and radius 0: the centre touches the wall.
    ///
    /// # Errors
    /// [`Error::Ball`] unless γ is finite and not negative.
    pub fn ball(law: L, gamma: f64) -> Result<Self, Error> {
        Custom::new(law, gamma)
    }
}

impl<L, const N: usize> Custom<L, N> {
    fn new(law: L, gamma: f64) -> Result<Self, Error>
    where
        L: CollisionLaw<N>,
    {
        let gamma = checked_gamma(gamma)?;
        let (centre, rim) = if gamma < LEAST_GAMMA { (gamma, 1.0) } else { (1.0, 1.0 / gamma) };
        let strict = law.is_strict();
        Ok(Custom { law, mass: 1.0, radius: 0.0, gamma, centre, rim, yields: yields(1.0, centre, rim), strict })
    }

    /// The same for a ball of mass `mass` \[M\]: impulses are that much larger.
    ///
    /// # Errors
    /// [`Error::Ball`] unless it is positive, and the inverse contact mass `1/m` and `(1 + 1/γ²)/m` in the range of numbers.
    pub fn with_mass(self, mass: f64) -> Result<Self, Error> {
        let ball = Custom { mass, yields: yields(mass, self.centre, self.rim), ..self };
        if ball.delassus().is_singular() {
            let must = "positive, and such that 1/m and (1 + 1/γ²)/m neither overflow nor underflow";
            return Err(Error::Ball { quantity: "mass", must, value: mass });
        }
        Ok(ball)
    }

    /// The same for a ball of radius `radius` \[L\], which touches the wall that far from its centre.
    ///
    /// # Errors
    /// [`Error::Ball`] unless it is finite and not negative.
    pub fn with_radius(self, radius: f64) -> Result<Self, Error> {
        if radius.is_finite() && radius >= 0.0 {
            return Ok(Custom { radius, ..self });
        }
        Err(Error::Ball { quantity: "radius", must: "finite and not negative", value: radius })
    }

    /// The same for a law that does not depend on the units of the slip, such as strict laws and restitution: if γ is below 1, the law
    /// works with the tangential parts of `γ u` and `p/γ`, and is accurate to rounding for any γ, not to `ε/γ` of the speed.
    #[must_use]
    pub fn with_scaled_slip(self) -> Self {
        if self.gamma >= 1.0 {
            return self;
        }
        let (centre, rim) = (self.gamma, 1.0);
        Custom { centre, rim, yields: yields(self.mass, centre, rim), ..self }
    }

    /// The Delassus operator, of the slip along the wall.
    #[inline(always)]
    fn delassus(&self) -> Delassus<N> {
        let [normal, tangent] = self.yields;
        Delassus::Isotropic { normal, tangent }
    }

    /// The changes of velocity and of slip by a collision in one lane, `p/m` split along the normal and the wall, at a
    /// velocity `v` of the centre and a velocity `rim` of the rim along the wall, as a scaled spin has it.
    #[inline(always)]
    fn kick(
        &self,
        at: &Places<N>,
        lane: usize,
        v: &SVector<f64, N>,
        rim: impl Fn(&SVector<f64, N>) -> SVector<f64, N>,
    ) -> Kick<N>
    where
        L: CollisionLaw<N>,
    {
        let normal = in_lane(&at.normal, lane);
        let point = in_lane(&at.point, lane) - normal * self.radius;
        let surface = number(at.piece[0][lane]);
        let contact = Contact { point, normal: Unit::new_unchecked(normal), surface };

        let along = normal * normal.dot(v);
        let u = along + (v - along) * self.centre + rim(&normal) * self.rim;
        let p = self.law.impulse(&contact, &self.delassus(), &u) / self.mass;
        let push = normal * normal.dot(&p);
        let grip = p - push;
        Kick { normal, velocity: push + grip * self.centre, rim: grip * self.rim }
    }
}

/// The inverse contact mass of a ball along the normal, and along the wall for a slip in which velocities of the centre and scaled spins
/// have these weights.
fn yields(mass: f64, centre: f64, rim: f64) -> [f64; 2] {
    [1.0 / mass, (centre * centre + rim * rim) / mass]
}

/// Where the collisions are, lane by lane.
struct Places<const N: usize> {
    point: [[f64; MOST_LANES]; N],
    normal: [[f64; MOST_LANES]; N],
    piece: [[f64; MOST_LANES]; 1],
}

impl<const N: usize> Places<N> {
    #[inline(always)]
    fn of<F: Lane>(hit: &WallHit<F, N>) -> Self {
        Places { point: stored(&hit.point), normal: stored(&hit.unit_normal()), piece: stored(&[hit.piece]) }
    }
}

/// The vector in one lane.
#[inline(always)]
fn in_lane<const N: usize>(of: &[[f64; MOST_LANES]; N], lane: usize) -> SVector<f64, N> {
    SVector::from(of.each_ref().map(|x| x[lane]))
}

/// Adds what has been found lane by lane.
#[inline(always)]
fn add<F: Lane, const K: usize>(to: &mut [F; K], changes: &[[f64; MOST_LANES]; K]) {
    for (x, change) in to.iter_mut().zip(changes) {
        *x = *x + x.load(change);
    }
}

/// What a collision does to a ball.
struct Kick<const N: usize> {
    normal: SVector<f64, N>,
    /// The change of the velocity of the centre.
    velocity: SVector<f64, N>,
    /// The change of the velocity of the rim that the scaled spin makes.
    rim: SVector<f64, N>,
}

impl<L: CollisionLaw<2> + Sync> BallLaw<2, 1> for Custom<L, 2> {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        let (at, before, spins) = (Places::of(hit), stored(velocity), stored(spin));
        let (mut kicks, mut turns) = (before, spins);
        for lane in 0..F::LANES {
            let w = spins[0][lane];
            // the contact is at −R ν: a counter-clockwise spin moves it along −J ν
            let kick = self.kick(&at, lane, &in_lane(&before, lane), |n| Vector2::new(n.y, -n.x) * w);
            (kicks[0][lane], kicks[1][lane]) = (kick.velocity.x, kick.velocity.y);
            turns[0][lane] = -kick.normal.perp(&kick.rim);
        }
        add(velocity, &kicks);
        add(spin, &turns);
    }
    #[inline(always)]
    fn is_strict(&self) -> bool {
        self.strict
    }
}

impl<L: CollisionLaw<3> + Sync> BallLaw<3, 3> for Custom<L, 3> {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 3>, velocity: &mut [F; 3], spin: &mut [F; 3]) {
        let (at, before, spins) = (Places::of(hit), stored(velocity), stored(spin));
        let (mut kicks, mut turns) = (before, spins);
        for lane in 0..F::LANES {
            let w: Vector3<f64> = in_lane(&spins, lane);
            let kick = self.kick(&at, lane, &in_lane(&before, lane), |n| n.cross(&w));
            let turn = kick.rim.cross(&kick.normal);
            for i in 0..3 {
                (kicks[i][lane], turns[i][lane]) = (kick.velocity[i], turn[i]);
            }
        }
        add(velocity, &kicks);
        add(spin, &turns);
    }
    #[inline(always)]
    fn is_strict(&self) -> bool {
        self.strict
    }
}

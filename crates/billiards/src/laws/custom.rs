//! Any law of [`collision_laws`], yours included, for a ball against a fixed wall.
use crate::{Error, billiard::BallLaw};
use collision_laws::{CollisionLaw, Contact, Fixed, Pair, Twist, bodies::Ball};
use geometry::WallHit;
use lanes::Lane;
use nalgebra::{SVector, Unit, Vector2, Vector3};

/// Below this, γ cannot be told from 0: what it changes is 2⁻⁶⁰ of the velocities, less than their rounding.
const LEAST_GAMMA: f64 = 1.0 / (1_u64 << 60) as f64;

/// Any [`CollisionLaw`] for a ball: linear or not, the same everywhere or a field over the boundary, per piece, random.
///
/// The law sees the contact as [`collision_laws`] describes it: the point where the ball touches the wall (its centre is at
/// the hit, so this is `centre − R ν`), the unit normal ν, and the number of the piece as surface label. It runs one lane
/// after the other; [`Disk`](super::Disk), [`Specular`](super::Specular) and [`RoughBall`](super::RoughBall) are the fast
/// ways of the laws that they cover.
///
/// The spin is scaled, `γ R ω`, so γ = 0 is the limit of a point and no special case: for a point without radius the law is
/// that of an infinitely light rotation.
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
/// Disk::new(&NoSlip, 0.5_f64.sqrt()).collide(&hit, &mut same_velocity, &mut same_spin);
/// assert!((velocity[0] - same_velocity[0]).abs() < 1e-15 && (spin[0] - same_spin[0]).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Custom<L, const N: usize> {
    law: L,
    /// The ball in units of its radius: nothing but the contact point depends on the radius.
    ball: Ball<N>,
    radius: f64,
}

impl<L: CollisionLaw<2>> Custom<L, 2> {
    /// `law` for a disk with mass distribution parameter γ, of mass 1 and radius 0: the centre touches the wall.
    ///
    /// # Errors
    /// [`Error::Law`] unless γ is finite and not negative.
    pub fn disk(law: L, gamma: f64) -> Result<Self, Error> {
        Custom::new(law, gamma)
    }
}

impl<L: CollisionLaw<3>> Custom<L, 3> {
    /// `law` for a ball in space with mass distribution parameter γ, of mass 1 and radius 0: the centre touches the wall.
    ///
    /// # Errors
    /// [`Error::Law`] unless γ is finite and not negative.
    pub fn ball(law: L, gamma: f64) -> Result<Self, Error> {
        Custom::new(law, gamma)
    }
}

impl<L, const N: usize> Custom<L, N> {
    fn new(law: L, gamma: f64) -> Result<Self, Error> {
        let gamma = if (0.0..LEAST_GAMMA).contains(&gamma) { LEAST_GAMMA } else { gamma };
        // a negative γ must not pass as its square
        let square = if gamma < 0.0 { gamma } else { gamma * gamma };
        Ok(Custom { law, ball: Ball::with_gamma_squared(1.0, 1.0, square)?, radius: 0.0 })
    }

    /// The same for a ball of mass `mass` \[M\]: impulses are that much larger.
    ///
    /// # Errors
    /// [`Error::Law`] unless it is positive and finite.
    pub fn with_mass(self, mass: f64) -> Result<Self, Error> {
        let gamma = self.ball.gamma();
        Ok(Custom { ball: Ball::with_gamma_squared(mass, 1.0, gamma * gamma)?, ..self })
    }

    /// The same for a ball of radius `radius` \[L\], which touches the wall that far from its centre.
    ///
    /// # Errors
    /// [`Error::Radius`] unless it is finite and not negative.
    pub fn with_radius(self, radius: f64) -> Result<Self, Error> {
        if radius.is_finite() && radius >= 0.0 { Ok(Custom { radius, ..self }) } else { Err(Error::Radius { radius }) }
    }

    /// The ball at its contact with the wall in one lane.
    fn pair<F: Lane>(&self, hit: &WallHit<F, N>, lane: usize) -> Pair<Ball<N>, Fixed, N> {
        let normal = SVector::from(hit.unit_normal().map(|n| n.lane(lane)));
        let centre = SVector::from(hit.point.map(|x| x.lane(lane)));
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a piece number is a small integer")]
        let surface = hit.piece.lane(lane) as usize;
        let contact =
            Contact { point: centre - normal * self.radius, normal: Unit::new_unchecked(normal), surface };
        Pair::new(contact, (self.ball, -normal), (Fixed, SVector::zeros()))
    }
}

/// Puts a number into one lane.
#[inline(always)]
fn put<F: Lane>(to: &mut F, lane: usize, value: f64) {
    let old = *to;
    *to = old.each(|k| if k == lane { value } else { old.lane(k) });
}

impl<L: CollisionLaw<2> + Sync> BallLaw<2, 1> for Custom<L, 2> {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 2>, velocity: &mut [F; 2], spin: &mut [F; 1]) {
        for lane in 0..F::LANES {
            let v = Vector2::from(velocity.map(|v| v.lane(lane)));
            let before = self.ball.with_scaled_spin(v, spin[0].lane(lane));
            let (after, ()): (Twist<2>, ()) = self.pair(hit, lane).collide(&self.law, &(before, ())).velocities;
            put(&mut velocity[0], lane, after.linear.x);
            put(&mut velocity[1], lane, after.linear.y);
            put(&mut spin[0], lane, self.ball.scaled_spin(&after));
        }
    }
}

impl<L: CollisionLaw<3> + Sync> BallLaw<3, 3> for Custom<L, 3> {
    #[inline(always)]
    fn collide<F: Lane>(&self, hit: &WallHit<F, 3>, velocity: &mut [F; 3], spin: &mut [F; 3]) {
        for lane in 0..F::LANES {
            let [v, w] = [&*velocity, &*spin].map(|x| Vector3::from(x.map(|x| x.lane(lane))));
            let before = self.ball.with_scaled_spin(v, w);
            let (after, ()): (Twist<3>, ()) = self.pair(hit, lane).collide(&self.law, &(before, ())).velocities;
            let turned = self.ball.scaled_spin(&after);
            for i in 0..3 {
                put(&mut velocity[i], lane, after.linear[i]);
                put(&mut spin[i], lane, turned[i]);
            }
        }
    }
}

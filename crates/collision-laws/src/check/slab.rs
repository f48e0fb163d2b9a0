//! A whole step of a billiard: if a law's directions vary from place to place, or turn with the body, only flight and collision together
//! show whether the measure is preserved.

use super::jacobian_determinant;
use crate::{CollisionLaw, Contact, Fixed, Pair, bodies::Ball};
use nalgebra::{DVector, Quaternion, UnitQuaternion, Vector2, Vector3};

/// A ball between two planes, which let its centre rise by `height`: it flies from the floor to the ceiling and collides there.
///
/// ```
/// use collision_laws::{CollisionLaw, Contact, bodies::Ball, check::{Slab, SlabState}, laws::{Grooved, Restitution}};
/// use nalgebra::{UnitQuaternion, Vector2, Vector3};
///
/// let slab = Slab { ball: Ball::uniform(2.0, 0.7)?, height: 1.5 };
/// let spin = Vector3::new(0.27, 0.35, -0.18);
/// let state = SlabState::new(Vector2::new(0.2, -0.3), UnitQuaternion::identity(), Vector2::new(0.31, -0.22), spin);
///
/// // a rough direction that turns from place to place keeps the measure, a loss of speed does not
/// let grooves = |at: &Contact<3>| Vector3::new(libm::cos(at.point.x), libm::sin(at.point.x), 0.0);
/// let kept = slab.determinant(&|_| Box::new(Grooved::new(grooves)), &state, 1e-3);
/// assert!((kept.abs() - 1.0).abs() < 1e-9);
/// let lost = slab.determinant(&|_| Box::new(Restitution::new(1.0, 0.5).unwrap()), &state, 1e-3);
/// assert!((lost.abs() - 0.25).abs() < 1e-9); // each of two components of the slip is halved
/// # Ok::<(), collision_laws::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab {
    /// The ball.
    pub ball: Ball<3>,
    /// How far its centre rises \[L\].
    pub height: f64,
}

/// The law at a collision, given how the ball has turned.
pub type LawOfOrientation<'a> = &'a dyn Fn(&UnitQuaternion<f64>) -> Box<dyn CollisionLaw<3>>;

/// A ball on the floor of a [`Slab`] on its way up, at unit speed, spin included.
#[derive(Clone, Debug, PartialEq)]
pub struct SlabState {
    orientation: UnitQuaternion<f64>,
    /// Place, rotation relative to `orientation`, tangential velocity, scaled spin.
    coordinates: DVector<f64>,
}

impl SlabState {
    /// The state with this place of the centre \[L\], orientation of the ball, and tangential velocity and scaled spin `W = γ R ω` in
    /// units of the speed. If these leave no speed for rising, everything that follows is NaN.
    pub fn new(
        place: Vector2<f64>,
        orientation: UnitQuaternion<f64>,
        tangential: Vector2<f64>,
        spin: Vector3<f64>,
    ) -> Self {
        let mut coordinates = DVector::zeros(10);
        coordinates.rows_mut(0, 2).copy_from(&place);
        coordinates.rows_mut(5, 2).copy_from(&tangential);
        coordinates.rows_mut(7, 3).copy_from(&spin);
        SlabState { orientation, coordinates }
    }
}

/// The coordinates `(x₁, x₂, γ R · rotation, v₁, v₂, W)` of a ball in flight, one by one.
struct Parts {
    place: Vector2<f64>,
    rotation: Vector3<f64>,
    velocity: Vector3<f64>,
    spin: Vector3<f64>,
}

impl Parts {
    fn of(coordinates: &DVector<f64>) -> Parts {
        let part = |i: usize| Vector3::new(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
        let rise = (1.0 - coordinates.rows(5, 5).norm_squared()).sqrt();
        let place = Vector2::new(coordinates[0], coordinates[1]);
        let velocity = Vector3::new(coordinates[5], coordinates[6], rise);
        Parts { place, rotation: part(2), velocity, spin: part(7) }
    }
}

impl Slab {
    /// `γ R`, of which the scaled spin is a multiple.
    fn scale(&self) -> f64 {
        self.ball.gamma() * self.ball.radius()
    }

    /// The orientation of the ball when it meets the ceiling, and the velocity of its contact point there.
    pub fn meeting(&self, state: &SlabState) -> (UnitQuaternion<f64>, Vector3<f64>) {
        let Parts { velocity, spin, .. } = Parts::of(&state.coordinates);
        let omega = spin / self.scale();
        let turned = rotation_by(omega * (self.height / velocity.z)) * state.orientation;
        (turned, velocity + omega.cross(&(Vector3::z() * self.ball.radius())))
    }

    /// The determinant of the step, flight and collision, in ten coordinates in which the canonical measure is Lebesgue measure: place,
    /// `γ R` times the rotation from a fixed orientation, tangential velocity and scaled spin. It is ±1 for strict laws (Cox & Feres,
    /// Section 1), and is computed as by [`jacobian_determinant`], with that `step`.
    pub fn determinant(&self, law: LawOfOrientation<'_>, state: &SlabState, step: f64) -> f64 {
        let (image, _) = self.meeting(state);
        jacobian_determinant(|x| self.step(law, x, [&state.orientation, &image]), &state.coordinates, step)
    }

    /// The step. Orientations are exponential coordinates about `base` before it and about `image` after it.
    fn step(
        &self,
        law: LawOfOrientation<'_>,
        from: &DVector<f64>,
        [base, image]: [&UnitQuaternion<f64>; 2],
    ) -> DVector<f64> {
        let (ball, scale) = (self.ball, self.scale());
        let Parts { place, rotation, velocity, spin } = Parts::of(from);
        let time = self.height / velocity.z;
        let turned = rotation_by(spin / scale * time) * rotation_by(rotation / scale) * base;
        let centre = Vector3::new(place.x, place.y, 0.0) + velocity * time;
        let arm = Vector3::z() * ball.radius();
        let ceiling = Contact { point: centre + arm, normal: -Vector3::z_axis(), surface: 0 };
        let pair = Pair::new(ceiling, (ball, arm), (Fixed, Vector3::zeros()));
        let after = pair.collide(&*law(&turned), &(ball.with_scaled_spin(velocity, spin), ())).velocities.0;
        let mut to = DVector::zeros(10);
        to.rows_mut(0, 2).copy_from(&centre.xy());
        to.rows_mut(2, 3).copy_from(&(vector_of(&(turned * image.inverse())) * scale));
        to.rows_mut(5, 2).copy_from(&after.linear.xy());
        to.rows_mut(7, 3).copy_from(&ball.scaled_spin(&after));
        to
    }
}

/// The rotation by a vector: about its direction, by its length (radians).
fn rotation_by(w: Vector3<f64>) -> UnitQuaternion<f64> {
    let angle = w.norm();
    let factor = if angle > 0.0 { libm::sin(0.5 * angle) / angle } else { 0.5 };
    UnitQuaternion::new_unchecked(Quaternion::from_parts(libm::cos(0.5 * angle), w * factor))
}

/// The vector of a rotation by less than a half turn.
fn vector_of(rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
    let (v, w) = (rotation.vector().into_owned(), rotation.scalar());
    let size = v.norm();
    if size > 0.0 { v * (2.0 * libm::atan2(size * w.signum(), w.abs()) / size) } else { v }
}

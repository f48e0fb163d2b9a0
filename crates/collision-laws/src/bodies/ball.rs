//! A ball: a rotationally symmetric body with a spherical surface.

use super::{in_range, positive};
use crate::{Body, Delassus, Error, Twist};
use nalgebra::{SVector, Unit};

/// A ball (N = 2: a disk) with mass distribution parameter `γ`.
///
/// `γ² = 2λ/R²`, where `λ·1` is the matrix of second moments per unit mass; the moment of inertia about any 2-plane is
/// `m γ² R²`. The contact lies on the sphere, so its arm is `±R ν`, and `K = ν νᵀ/m + (1 + 1/γ²)/m · (1 − ν νᵀ)`.
///
/// An arm `a ν` of another length describes a smaller or larger sphere around the same inertia: the eigenvalue on the contact plane is
/// `1/m + a²/(m γ² R²)`. An arm that is not along `ν` is not a contact of a ball: `K` would not match the velocities that an impulse
/// causes, and the law would not conserve energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball<const N: usize> {
    mass: f64,
    radius: f64,
    gamma: f64,
    moment: f64,
    /// The power of two next to the radius. Lengths in this unit lose no digit, and spins become about as large as speeds: the square of
    /// an angular velocity, or `p/(m γ² R²)`, may leave the range of numbers even where the energy does not.
    unit: f64,
}

impl<const N: usize> Ball<N> {
    /// A ball with any mass distribution that depends on the distance from the centre alone, given by `γ²`.
    ///
    /// # Errors
    /// [`Error::NotPositive`] if the mass, the radius or `γ²` is not positive and finite, [`Error::TooSmall`] if `m γ²` or the moment of
    /// inertia `m γ² R²` is so small that it loses digits, [`Error::TooLarge`] if one of them is more than 1.8e308.
    pub fn with_gamma_squared(mass: f64, radius: f64, gamma_squared: f64) -> Result<Self, Error> {
        let mass = positive("the mass", mass)?;
        let radius = positive("the radius", radius)?;
        let gamma_squared = positive("gamma squared", gamma_squared)?;
        // twice the spin energy over the square of the speed of the rim; if this and the moment are in range, so is m γ² R, which lies
        // between
        let share = in_range("the mass times gamma squared", mass * gamma_squared)?;
        let moment = in_range("the moment of inertia", share * radius * radius)?;
        let unit = libm::ldexp(1.0, libm::frexp(radius).1);
        Ok(Self { mass, radius, gamma: gamma_squared.sqrt(), moment, unit })
    }

    /// A solid ball of uniform density, `γ² = 2/(N+2)`.
    ///
    /// # Errors
    /// Those of [`with_gamma_squared`](Self::with_gamma_squared).
    pub fn uniform(mass: f64, radius: f64) -> Result<Self, Error> {
        Self::with_gamma_squared(mass, radius, 2.0 / (N + 2) as f64)
    }

    /// A hollow ball (N = 2: a hoop), all mass on the sphere, `γ² = 2/N`: the largest that the radius allows.
    ///
    /// # Errors
    /// Those of [`with_gamma_squared`](Self::with_gamma_squared).
    pub fn shell(mass: f64, radius: f64) -> Result<Self, Error> {
        Self::with_gamma_squared(mass, radius, 2.0 / N as f64)
    }

    /// The mass `m`.
    #[inline]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// The radius `R`.
    #[inline]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The mass distribution parameter `γ`.
    #[inline]
    pub fn gamma(&self) -> f64 {
        self.gamma
    }

    /// The moment of inertia `m γ² R²` about any 2-plane.
    #[inline]
    pub fn moment(&self) -> f64 {
        self.moment
    }
}

impl<const N: usize> Body<N> for Ball<N> {
    type Velocity = Twist<N>;

    #[inline]
    fn inner_product(&self, v: &Twist<N>, w: &Twist<N>) -> f64 {
        let moment = self.moment / self.unit / self.unit;
        self.mass * v.linear.dot(&w.linear) + 0.5 * moment * (v.spin() * self.unit).dot(&(w.spin() * self.unit))
    }

    #[inline]
    fn apply_impulse(&self, arm: &SVector<f64, N>, p: &SVector<f64, N>, v: &Twist<N>) -> Twist<N> {
        v.kicked(p / self.mass, &(p / (self.moment / self.unit)), &(arm / self.unit))
    }

    #[inline]
    fn delassus(&self, arm: &SVector<f64, N>, normal: &Unit<SVector<f64, N>>) -> Delassus<N> {
        let along = arm.dot(normal);
        Delassus::Isotropic { normal: 1.0 / self.mass, tangent: 1.0 / self.mass + (along / self.moment) * along }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Contact, Fixed, Pair, check, laws::NoSlip};
    use nalgebra::{Vector2, Vector3};

    /// A disk of radius 1 at unit speed and its scaled copies, of any size and speed, behave alike.
    #[test]
    fn neither_size_nor_speed_of_a_disk_matters() {
        let collide = |radius: f64, speed: f64| {
            let contact = Contact::new(Vector2::zeros(), Vector2::y(), 0).unwrap();
            let disk = Ball::<2>::uniform(1.0, radius).unwrap();
            let pair = Pair::new(contact, (disk, Vector2::new(0.0, -radius)), (Fixed, Vector2::zeros()));
            let before = (Twist::planar(Vector2::new(0.6, -0.8) * speed, 0.5 * (speed / radius)), ());
            let after = pair.try_collide(&NoSlip, &before).unwrap().velocities;
            let v = after.0.linear / speed;
            let energies = [before, after].map(|v| pair.kinetic_energy(&v) / speed / speed);
            ([v.x, v.y, after.0.angular_velocity() * radius / speed], energies)
        };
        let (expected, [energy, _]) = collide(1.0, 1.0);
        for radius in [1e-150, 1e-100, 1.0, 1e100, 1e150] {
            for speed in [1e-150, 1e-30, 1e5, 1e10, 1e150] {
                let (found, energies) = collide(radius, speed);
                let close = |a: f64, b: f64| (a - b).abs() <= 1e-14;
                assert!(
                    (0..3).all(|i| close(found[i], expected[i])),
                    "{radius:e} {speed:e}: {found:?} for {expected:?}"
                );
                assert!(energies.iter().all(|e| close(*e, energy)), "{radius:e} {speed:e}: {energies:?} for {energy}");
            }
        }
    }

    #[test]
    fn a_moment_of_inertia_without_all_its_digits_is_refused() {
        let refused = Ball::<2>::uniform(1.0, 1e-160).unwrap_err();
        assert!(matches!(refused, Error::TooSmall { value, .. } if value > 0.0), "{refused}");
        assert!(Ball::<2>::uniform(1.0, 1e-150).is_ok());
        // a product of ordinary size, with an intermediate result that is not
        for (mass, radius, gamma_squared) in [(1e-150, 1e150, 1e-172), (1e-150, 1e150, 1e-180)] {
            let refused = Ball::<2>::with_gamma_squared(mass, radius, gamma_squared).unwrap_err();
            assert!(matches!(refused, Error::TooSmall { quantity: "the mass times gamma squared", .. }), "{refused}");
        }
        let refused = Ball::<2>::with_gamma_squared(1e150, 1e-100, 1e165).unwrap_err();
        assert_eq!(refused, Error::TooLarge { quantity: "the mass times gamma squared" });
        let refused = Ball::<2>::uniform(1.0, 1e160).unwrap_err();
        assert_eq!(refused, Error::TooLarge { quantity: "the moment of inertia" });
    }

    #[test]
    fn an_arm_of_any_length_along_the_normal_keeps_the_energy() {
        let normal = Vector3::new(0.48, -0.6, 0.64);
        let contact = Contact::new(Vector3::zeros(), normal, 0).unwrap();
        let ball = Ball::<3>::uniform(2.0, 1.0).unwrap();
        for length in [-1.0, -0.5, 0.25, 3.0, 0.0] {
            let arm = normal * length;
            assert!(check::body(&ball, &contact, &arm, check::Samples::default()).worst() < 1e-14, "{length}");
            let pair = Pair::new(contact, (ball, arm), (Fixed, Vector3::zeros()));
            let before = (Twist::spatial(Vector3::new(1.0, 2.0, 3.0) - normal * 9.0, Vector3::new(3.0, 2.0, -1.0)), ());
            let after = pair.try_collide(&NoSlip, &before).unwrap();
            let [energy, kept] = [before, after.velocities].map(|v| pair.kinetic_energy(&v));
            assert!((kept - energy).abs() < 1e-13 * energy, "{length}");
        }
    }
}

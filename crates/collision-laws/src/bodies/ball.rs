//! A ball: a rotationally symmetric body with a spherical surface.

use super::positive;
use crate::{Body, Delassus, Error, Twist};
use nalgebra::{SVector, Unit};

/// A ball (N = 2: a disk) with mass distribution parameter `γ`.
///
/// `γ² = 2λ/R²`, where `λ·1` is the matrix of second moments per unit mass; the moment of inertia about any 2-plane is
/// `m γ² R²`. The contact lies on the sphere, so its arm is `±R ν`, and `K = ν νᵀ/m + (1 + 1/γ²)/m · (1 − ν νᵀ)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball<const N: usize> {
    mass: f64,
    radius: f64,
    gamma: f64,
    moment: f64,
}

impl<const N: usize> Ball<N> {
    /// A ball with any mass distribution that depends on the distance from the centre alone, given by `γ²`.
    ///
    /// # Errors
    /// [`Error::NotPositive`] if the mass, the radius, `γ²` or the moment of inertia `m γ² R²` is not positive and finite.
    pub fn with_gamma_squared(mass: f64, radius: f64, gamma_squared: f64) -> Result<Self, Error> {
        let mass = positive("the mass", mass)?;
        let radius = positive("the radius", radius)?;
        let gamma_squared = positive("gamma squared", gamma_squared)?;
        let moment = positive("the moment of inertia", mass * gamma_squared * radius * radius)?;
        Ok(Self { mass, radius, gamma: gamma_squared.sqrt(), moment })
    }

    /// A solid ball of uniform density, `γ² = 2/(N+2)`.
    ///
    /// # Errors
    /// [`Error::NotPositive`].
    pub fn uniform(mass: f64, radius: f64) -> Result<Self, Error> {
        Self::with_gamma_squared(mass, radius, 2.0 / (N + 2) as f64)
    }

    /// A hollow ball (N = 2: a hoop), all mass on the sphere, `γ² = 2/N`: the largest that the radius allows.
    ///
    /// # Errors
    /// [`Error::NotPositive`].
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
        self.mass * v.linear.dot(&w.linear) + 0.5 * self.moment * v.spin().dot(w.spin())
    }

    #[inline]
    fn contact_velocity(&self, arm: &SVector<f64, N>, v: &Twist<N>) -> SVector<f64, N> {
        v.at(arm)
    }

    #[inline]
    fn apply_impulse(&self, arm: &SVector<f64, N>, p: &SVector<f64, N>, v: &Twist<N>) -> Twist<N> {
        v.kicked(p / self.mass, &(p / self.moment), arm)
    }

    #[inline]
    fn delassus(&self, _: &SVector<f64, N>, _: &Unit<SVector<f64, N>>) -> Delassus<N> {
        Delassus::Isotropic {
            normal: 1.0 / self.mass,
            tangent: 1.0 / self.mass + (self.radius / self.moment) * self.radius,
        }
    }
}

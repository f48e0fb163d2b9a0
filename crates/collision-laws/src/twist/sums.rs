//! Sums and multiples of velocities: those of a rigid body form a vector space.

use super::Twist;
use std::ops::{Add, Mul, Neg, Sub};

/// `v + w`, coordinate by coordinate \[L T⁻¹, T⁻¹\]; the spin is exactly skew again.
///
/// A strict collision acts on the velocities of the pair as a reflection, so it leaves the mean of those before and after unchanged:
///
/// ```
/// use collision_laws::{Contact, Fixed, Pair, Twist, bodies::Ball, laws::NoSlip};
/// use nalgebra::Vector2;
///
/// let contact = Contact::new(Vector2::zeros(), Vector2::new(0.0, 1.0), 0)?;
/// let pair = Pair::new(contact, (Ball::<2>::shell(1.0, 1.0)?, Vector2::new(0.0, -1.0)), (Fixed, Vector2::zeros()));
/// let before = Twist::planar(Vector2::new(0.75, -1.0), 0.25);
/// let (after, ()) = pair.collide(&NoSlip, &(before, ())).velocities;
/// let kept = (before + after) * 0.5;
/// assert_eq!(kept, Twist::planar(Vector2::new(0.25, 0.0), -0.25)); // it rolls
/// assert_eq!(pair.collide(&NoSlip, &(kept, ())).velocities.0, kept);
/// # Ok::<(), collision_laws::Error>(())
/// ```
impl<const N: usize> Add for Twist<N> {
    type Output = Self;

    #[inline]
    fn add(self, w: Self) -> Self {
        Self { linear: self.linear + w.linear, spin: self.spin + w.spin }
    }
}

/// `v − w`, coordinate by coordinate \[L T⁻¹, T⁻¹\]; the spin is exactly skew again.
impl<const N: usize> Sub for Twist<N> {
    type Output = Self;

    #[inline]
    fn sub(self, w: Self) -> Self {
        Self { linear: self.linear - w.linear, spin: self.spin - w.spin }
    }
}

/// The velocity `−v` of the motion run backwards.
impl<const N: usize> Neg for Twist<N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { linear: -self.linear, spin: -self.spin }
    }
}

/// `v c`, coordinate by coordinate; the spin is exactly skew again.
impl<const N: usize> Mul<f64> for Twist<N> {
    type Output = Self;

    #[inline]
    fn mul(self, c: f64) -> Self {
        Self { linear: self.linear * c, spin: self.spin * c }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TangentVector;
    use nalgebra::Vector4;

    /// Two velocities in four dimensions whose sums and multiples are rounded.
    fn two() -> [Twist<4>; 2] {
        [0.1, -0.7].map(|x| {
            let spin: Vec<f64> = (1..7).map(|k| x / f64::from(k)).collect();
            Twist::with_spin_coordinates(Vector4::new(x, x / 3.0, x / 7.0, x / 9.0), &spin).unwrap()
        })
    }

    #[test]
    fn sums_and_multiples_of_velocities_are_those_of_their_coordinates() {
        let [v, w] = two();
        let by_coordinates = |f: fn(f64, f64) -> f64| -> Vec<f64> {
            v.coordinates().into_iter().zip(w.coordinates()).map(|(v, w)| f(v, w)).collect()
        };
        assert_eq!((v + w).coordinates(), by_coordinates(|v, w| v + w));
        assert_eq!((v - w).coordinates(), by_coordinates(|v, w| v - w));
        assert_eq!((-v).coordinates(), by_coordinates(|v, _| -v));
        assert_eq!((v * 0.3).coordinates(), by_coordinates(|v, _| v * 0.3));
    }

    #[test]
    fn the_spin_of_sums_and_multiples_is_exactly_skew() {
        let [v, w] = two();
        for made in [v + w, v - w, -v, v * 0.3] {
            assert_eq!(made.spin().transpose(), -made.spin());
        }
    }
}

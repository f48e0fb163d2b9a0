//! The contact map `J` of a pair by its columns, for products that keep their digits where large terms cancel.
//!
//! At a long arm `r`, a spin moves the touching point far faster than the body moves as a whole, by `Ω r`. Across the arm the body yields
//! so easily that an error of this velocity does not matter; but `Ω r` has nothing along the arm, and if its terms were rounded, what they
//! leave there would be taken for an approach of the bodies. Rounding of the coordinates of a velocity is harmless: `Ω r` stays across the
//! arm for every skew `Ω`.

use crate::{Body, Pair, product::product};
use lanes::Double;
use nalgebra::{DVector, SVector};

/// `J`, the matrix from the [coordinates](Pair::coordinates) of the velocities to the contact velocity.
pub(crate) struct ContactMap<const N: usize>(Vec<SVector<f64, N>>);

impl<const N: usize> ContactMap<N> {
    /// That of a pair; its entries, 0, ±1 and coordinates of the arms, are exact for rigid bodies.
    pub(crate) fn of<A: Body<N>, B: Body<N>>(pair: &Pair<A, B, N>) -> Self {
        Self(pair.basis().map(|v| pair.contact_velocity(&v)).collect())
    }

    /// `J x`, rounded once, however much cancels.
    pub(crate) fn times(&self, x: &DVector<f64>) -> SVector<f64, N> {
        SVector::from_fn(|i, _| {
            let mut sum = Double::new(0.0);
            for (column, x) in self.0.iter().zip(x) {
                let (product, error) = product(column[i], *x);
                sum.add(product);
                sum.add(error);
            }
            sum.value()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Contact, Fixed, TangentVector, Twist,
        bodies::{Inertia, RigidBody},
    };
    use nalgebra::{SMatrix, Vector2, Vector3};

    #[test]
    fn a_spin_about_the_arm_does_not_move_its_end() {
        for unit in [0, -300, 500].map(|k| libm::ldexp(1.0, k)) {
            let arm = Vector3::new(0.3, 0.1, 0.7) * unit;
            let body = RigidBody::<3>::new(1.0, Inertia::Tensor(SMatrix::identity())).unwrap();
            let contact = Contact::new(Vector3::zeros(), Vector3::x(), 0).unwrap();
            let pair = Pair::new(contact, (body, arm), (Fixed, Vector3::zeros()));
            let v = (Twist::spatial(Vector3::zeros(), arm * 3.0), ());
            // 3 r is rounded
            let exact = |i: usize, j: usize| {
                let w = v.0.angular_velocity();
                Double::product(w[i], arm[j]).plus(-Double::product(w[j], arm[i])).value()
            };
            let expected = Vector3::new(exact(1, 2), exact(2, 0), exact(0, 1));
            let found = ContactMap::of(&pair).times(&pair.coordinates(&v));
            assert_eq!(found, expected, "{unit:e}");
            assert_ne!(v.0.at(&arm), expected, "{unit:e}: no test: nothing is lost in rounding");
        }
    }

    #[test]
    fn near_the_end_of_the_range_of_numbers_products_are_rounded_as_usual() {
        let body = RigidBody::<2>::new(1.0, Inertia::Moment(1.0)).unwrap();
        let contact = Contact::new([0.0; 2].into(), [1.0, 0.0].into(), 0).unwrap();
        let pair = Pair::new(contact, (body, [0.0, 1e305].into()), (Fixed, [0.0; 2].into()));
        let u = ContactMap::of(&pair).times(&pair.coordinates(&(Twist::planar([1.0, 2.0].into(), 0.3), ())));
        assert_eq!(u, Vector2::new(-0.3e305, 2.0));
    }
}

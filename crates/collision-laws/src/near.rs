//! Equality within rounding, by the traits of [`approx`]: each number against its counterpart, as `nalgebra` does it for its own types.

use crate::{DiskMap, Twist};
use approx::{AbsDiffEq, RelativeEq, UlpsEq};

impl<const N: usize> AbsDiffEq for Twist<N> {
    type Epsilon = f64;

    fn default_epsilon() -> f64 {
        f64::default_epsilon()
    }

    fn abs_diff_eq(&self, other: &Self, epsilon: f64) -> bool {
        self.linear.abs_diff_eq(&other.linear, epsilon) && self.spin().abs_diff_eq(other.spin(), epsilon)
    }
}

impl<const N: usize> RelativeEq for Twist<N> {
    fn default_max_relative() -> f64 {
        f64::default_max_relative()
    }

    fn relative_eq(&self, other: &Self, epsilon: f64, max_relative: f64) -> bool {
        self.linear.relative_eq(&other.linear, epsilon, max_relative)
            && self.spin().relative_eq(other.spin(), epsilon, max_relative)
    }
}

impl<const N: usize> UlpsEq for Twist<N> {
    fn default_max_ulps() -> u32 {
        f64::default_max_ulps()
    }

    fn ulps_eq(&self, other: &Self, epsilon: f64, max_ulps: u32) -> bool {
        self.linear.ulps_eq(&other.linear, epsilon, max_ulps) && self.spin().ulps_eq(other.spin(), epsilon, max_ulps)
    }
}

impl DiskMap {
    fn coefficients(&self) -> [f64; 5] {
        [self.spin_spin, self.spin_tangent, self.tangent_spin, self.tangent_tangent, self.normal]
    }
}

impl AbsDiffEq for DiskMap {
    type Epsilon = f64;

    fn default_epsilon() -> f64 {
        f64::default_epsilon()
    }

    fn abs_diff_eq(&self, other: &Self, epsilon: f64) -> bool {
        self.coefficients()[..].abs_diff_eq(&other.coefficients()[..], epsilon)
    }
}

impl RelativeEq for DiskMap {
    fn default_max_relative() -> f64 {
        f64::default_max_relative()
    }

    fn relative_eq(&self, other: &Self, epsilon: f64, max_relative: f64) -> bool {
        self.coefficients()[..].relative_eq(&other.coefficients()[..], epsilon, max_relative)
    }
}

impl UlpsEq for DiskMap {
    fn default_max_ulps() -> u32 {
        f64::default_max_ulps()
    }

    fn ulps_eq(&self, other: &Self, epsilon: f64, max_ulps: u32) -> bool {
        self.coefficients()[..].ulps_eq(&other.coefficients()[..], epsilon, max_ulps)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::{
        assert_abs_diff_eq, assert_abs_diff_ne, assert_relative_eq, assert_relative_ne, assert_ulps_eq, assert_ulps_ne,
    };
    use nalgebra::{SVector, Vector2, Vector4};

    #[test]
    fn a_twist_is_near_another_only_if_each_coordinate_of_velocity_and_spin_is() {
        let spin = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let twist = |linear: SVector<f64, 4>, spin: &[f64]| Twist::with_spin_coordinates(linear, spin).unwrap();
        let v = Vector4::new(1.0, -2.0, 3.0, -4.0);
        let exact = twist(v, &spin);
        assert_ulps_eq!(twist(v.map(f64::next_up), &spin.map(f64::next_down)), exact, epsilon = 0.0, max_ulps = 1);
        for i in 0..4 {
            let mut off = v;
            off[i] *= 1.01;
            assert_relative_eq!(twist(off, &spin), exact, max_relative = 0.02);
            assert_relative_ne!(twist(off, &spin), exact, max_relative = 0.005);
            assert_ulps_ne!(twist(off, &spin), exact);
            assert_abs_diff_ne!(twist(off, &spin), exact, epsilon = 0.005);
        }
        for i in 0..6 {
            let mut off = spin;
            off[i] *= 1.01;
            assert_abs_diff_eq!(twist(v, &off), exact, epsilon = 0.1);
            assert_abs_diff_ne!(twist(v, &off), exact, epsilon = 0.005);
            assert_relative_ne!(twist(v, &off), exact, max_relative = 0.005);
        }
    }

    #[test]
    fn what_is_no_number_is_near_nothing() {
        let none = Twist::translation(Vector2::new(0.0, f64::NAN));
        assert_abs_diff_ne!(none, none, epsilon = 1e300);
        assert_relative_ne!(none, none, max_relative = 1e300);
    }

    #[test]
    fn unless_told_otherwise_near_is_what_it_is_for_numbers() {
        assert_eq!(Twist::<2>::default_epsilon(), f64::default_epsilon());
        assert_eq!(Twist::<2>::default_max_relative(), f64::default_max_relative());
        assert_eq!(Twist::<2>::default_max_ulps(), f64::default_max_ulps());
        assert_eq!(DiskMap::default_epsilon(), f64::default_epsilon());
        assert_eq!(DiskMap::default_max_relative(), f64::default_max_relative());
        assert_eq!(DiskMap::default_max_ulps(), f64::default_max_ulps());
    }

    #[test]
    fn a_disk_map_is_near_another_only_if_each_coefficient_is() {
        let map = |c: [f64; 5]| DiskMap {
            spin_spin: c[0],
            spin_tangent: c[1],
            tangent_spin: c[2],
            tangent_tangent: c[3],
            normal: c[4],
        };
        let exact = [1.0, 2.0, -3.0, 4.0, -1.0];
        assert_ulps_eq!(map(exact.map(f64::next_up)), map(exact), epsilon = 0.0, max_ulps = 1);
        for i in 0..5 {
            let mut off = exact;
            off[i] *= 1.01;
            assert_relative_eq!(map(off), map(exact), max_relative = 0.02);
            assert_relative_ne!(map(off), map(exact), max_relative = 0.005);
            assert_abs_diff_eq!(map(off), map(exact), epsilon = 0.1);
            assert_abs_diff_ne!(map(off), map(exact), epsilon = 0.005);
            assert_ulps_ne!(map(off), map(exact));
        }
    }
}

//! Normals whose length is known to more digits than f64 has.
//!
//! A reflection in a normal whose length is off by a rounding error changes the energy by the same relative amount in every
//! collision with that wall, always in the same direction.
use lanes::{Double, two_prod, two_sum};

/// The neighbour of a unit normal, or the normal itself, whose length is nearest to 1.
///
/// A normal with another last digit is as good, and on average two fifths of the length's error are gone.
pub(super) fn most_unit(normal: [f64; 2]) -> [f64; 2] {
    let mut best = normal;
    for a in near(normal[0]) {
        for b in near(normal[1]) {
            if excess([a, b]).abs() < excess(best).abs() {
                best = [a, b];
            }
        }
    }
    best
}

/// A normal `n` along a unit vector, and `ι` of at most 15 bits such that `|n| ι = 1` to over three digits beyond the precision of `n`.
///
/// The components of `n` round differently for each length between 1 and 2: one in some thousand lengths fits.
pub(super) fn of_known_length(unit: [f64; 2]) -> ([f64; 2], f64) {
    const LENGTHS: u32 = 1 << 14;
    const ENOUGH: f64 = f64::EPSILON / 4096.0;
    let mut best = (f64::INFINITY, unit, 1.0);
    for k in 0..LENGTHS {
        let inverse = 1.0 - 0.5 * f64::from(k) / f64::from(LENGTHS);
        let long = unit.map(|n| n / inverse);
        let off = product_excess(long, inverse);
        for a in near(long[0]) {
            for b in near(long[1]) {
                let moved = (long[0] * (a - long[0]) + long[1] * (b - long[1])) * (2.0 * inverse * inverse);
                if (off + moved).abs() < best.0 {
                    best = ((off + moved).abs(), [a, b], inverse);
                }
            }
        }
        if best.0 <= ENOUGH {
            break;
        }
    }
    (best.1, best.2)
}

/// `x` and the numbers next to it.
fn near(x: f64) -> [f64; 3] {
    if x == 0.0 { [x; 3] } else { [x, x.next_down(), x.next_up()] }
}

/// `|n|²` as an exact sum, except for terms of 10⁻³².
fn square(n: [f64; 2]) -> [f64; 2] {
    let ((a, a_rest), (b, b_rest)) = (two_prod(n[0], n[0]), two_prod(n[1], n[1]));
    let (high, rest) = two_sum(a, b);
    [high, rest + (a_rest + b_rest)]
}

/// `|n|² − 1`
fn excess(n: [f64; 2]) -> f64 {
    let mut sum = Double::new(-1.0);
    for part in square(n) {
        sum.add(part);
    }
    sum.value()
}

/// `|n|² ι² − 1`
fn product_excess(n: [f64; 2], inverse: f64) -> f64 {
    let [high, low] = square(n);
    let (i_high, i_low) = two_prod(inverse, inverse);
    let (product, rest) = two_prod(high, i_high);
    (product - 1.0) + (rest + (high * i_low + low * i_high))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn directions() -> impl Iterator<Item = [f64; 2]> {
        (0..100).map(|k| 0.0628 * f64::from(k)).map(|angle| [libm::cos(angle), libm::sin(angle)])
    }

    #[test]
    fn the_most_unit_normal_is_a_neighbour_that_is_nearer_to_length_1() {
        let (mut before, mut after) = (0.0, 0.0);
        for normal in directions() {
            let unit = most_unit(normal);
            assert!(excess(unit).abs() <= excess(normal).abs());
            for i in 0..2 {
                assert!(normal[i].next_down() <= unit[i] && unit[i] <= normal[i].next_up());
            }
            before += excess(normal).abs();
            after += excess(unit).abs();
        }
        // nine choices instead of one leave three fifths
        assert!(after < 0.65 * before, "{after:e} of {before:e}");
    }

    #[test]
    fn a_normal_of_known_length_has_the_direction_and_an_inverse_right_to_nineteen_digits() {
        for unit in directions() {
            let (n, inverse) = of_known_length(unit);
            assert!(
                product_excess(n, inverse).abs() <= f64::EPSILON / 4096.0,
                "{unit:?}: {:e}",
                product_excess(n, inverse)
            );
            let turned = (n[0] * unit[1] - n[1] * unit[0]) * inverse;
            assert!(turned.abs() <= 2.0 * f64::EPSILON, "{unit:?}: {turned:e}");
        }
    }

    #[test]
    fn a_normal_along_an_axis_stays_as_it_is() {
        for unit in [[1.0, 0.0], [0.0, -1.0]] {
            assert_eq!(of_known_length(unit), (unit, 1.0));
        }
    }
}

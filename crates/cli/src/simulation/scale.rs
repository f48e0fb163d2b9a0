//! Powers of two that bring a scene to a size near one.
//!
//! The engine scales exactly: multiplying all lengths or all speeds by a power of two changes no digit. So a scene
//! with lengths of 10¹⁵⁰ runs as one with lengths near 1, in which nothing over- or underflows, and results are
//! reported in the user's units without any loss of digits.

/// The power of two that brings the largest of some numbers into [1, 2); 1 if all are zero.
pub(crate) fn to_unity(numbers: impl IntoIterator<Item = f64>) -> f64 {
    let largest = numbers.into_iter().filter(|x| x.is_finite()).fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest == 0.0 {
        return 1.0;
    }
    let (_, exponent) = libm::frexp(largest);
    libm::ldexp(1.0, 1 - exponent)
}

/// The powers of two by which lengths and speeds are multiplied while an orbit runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    /// Factor of lengths.
    pub(crate) length: f64,
    /// Factor of speeds.
    pub(crate) speed: f64,
}

impl Scale {
    /// A time of the orbit in the user's unit.
    pub(crate) fn time_out(&self, time: f64) -> f64 {
        ratio(time, self.speed, self.length)
    }

    /// A time of the user in the orbit's unit; infinite if it is out of range.
    pub(crate) fn time_in(&self, time: f64) -> f64 {
        ratio(time, self.length, self.speed)
    }

    /// A length of the orbit in the user's unit.
    pub(crate) fn length_out(&self, length: f64) -> f64 {
        length / self.length
    }

    /// A speed of the orbit in the user's unit.
    pub(crate) fn speed_out(&self, speed: f64) -> f64 {
        speed / self.speed
    }
}

/// `x · times / by` for `x ≥ 0` and powers of two whose quotient alone might over- or underflow: of two steps that lead in opposite
/// directions, the first one brings `x` nearer to 1.
fn ratio(x: f64, times: f64, by: f64) -> f64 {
    if (x > 1.0) == (by > 1.0) { x / by * times } else { x * times / by }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_number_comes_to_between_one_and_two() {
        for x in [1e-150, 0.1, 1.0, -3.0, 1e150] {
            let factor = to_unity([x, 0.5 * x]);
            assert!((1.0..2.0).contains(&(x * factor).abs()));
            assert_eq!(libm::frexp(factor).0, 0.5, "a power of two");
        }
        assert_eq!(to_unity([0.0, f64::INFINITY]), 1.0);
    }

    #[test]
    fn scaling_back_is_exact() {
        let scale = Scale { length: to_unity([1e150]), speed: to_unity([1e-150]) };
        assert_eq!(scale.length_out(1e150 * scale.length), 1e150);
        assert_eq!(scale.speed_out(3e-150 * scale.speed), 3e-150);
        assert_eq!(scale.time_out(scale.time_in(7e299)), 7e299);
    }

    #[test]
    fn a_time_within_the_range_of_numbers_is_not_lost_on_the_way() {
        let powers = [-997, -498, -1, 0, 1, 498, 997].map(|exponent| libm::ldexp(1.0, exponent));
        for (length, speed) in powers.into_iter().flat_map(|length| powers.map(|speed| (length, speed))) {
            let scale = Scale { length, speed };
            let by = libm::frexp(speed).1 - libm::frexp(length).1;
            for exponent in (-1022..=1023).filter(|exponent| (-1022..=1023).contains(&(exponent + by))) {
                let [time, other] = [exponent, exponent + by].map(|exponent| libm::ldexp(1.0, exponent));
                assert_eq!((scale.time_out(time), scale.time_in(other)), (other, time), "{scale:?}");
            }
        }
    }
}

//! What an orbit keeps of its velocity between round walls.
use crate::{in_lanes::InLanes, laws::Mirror};
use lanes::{Double, Lane};

/// Spin and velocity in the frame of a round wall, right after a collision, under a law that [undoes itself](Mirror): they come
/// back at every second collision, in all of these digits.
///
/// The velocity of an [orbit](crate::Orbit) is rounded. A run that continued from there would turn by another angle at each collision,
/// 10⁻¹⁶ off, so the first run stores here what it has found from the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recurring<F = f64> {
    pub(crate) normal: Double<F>,
    pub(crate) spin: Double<F>,
    pub(crate) tangential: Double<F>,
}

/// Two velocities no farther apart than this fraction of the speed are the same motion. The rounding of position and velocity, from which
/// the velocity in the frame is computed, changes it by about 3 ε.
const SAME: f64 = 16.0 * f64::EPSILON;

impl<F: Lane> Recurring<F> {
    /// Nothing is known, as at rest, in as many lanes as `zero` has.
    pub(crate) fn nothing(zero: F) -> Self {
        let zero = Double::new(zero);
        Recurring { normal: zero, spin: zero, tangential: zero }
    }
}

impl Recurring {
    /// The motion that was `seen`, rounded, in the digits that are known, or in those after the next collision if these fit; as it was
    /// seen, if it is another motion.
    pub(crate) fn recall(&self, seen: Recurring, mirror: &Mirror) -> Recurring {
        let [spin, tangential] = mirror.apply([self.spin, self.tangential]);
        let next = Recurring { spin, tangential, ..*self };
        [*self, next].into_iter().find(|known| known.is(&seen)).unwrap_or(seen)
    }

    fn is(&self, seen: &Recurring) -> bool {
        let [[n, w, t], [seen_n, seen_w, seen_t]] =
            [self, seen].map(|r| [r.normal.high, r.spin.high, r.tangential.high]);
        let square = seen_n * seen_n + seen_w * seen_w + seen_t * seen_t;
        let near = SAME * libm::sqrt(square);
        // where the path grazes, rounding changes the normal velocity much, but not its square
        (w - seen_w).abs() <= near && (t - seen_t).abs() <= near && (n * n - seen_n * seen_n).abs() <= SAME * square
    }
}

impl<F: Lane> InLanes<F> for Recurring<F> {
    type One = Recurring;
    fn one(&self, lane: usize) -> Recurring {
        Recurring { normal: self.normal.one(lane), spin: self.spin.one(lane), tangential: self.tangential.one(lane) }
    }
    fn all(one: &Recurring, zero: F) -> Self {
        let all = |x: &Double| Double::all(x, zero);
        Recurring { normal: all(&one.normal), spin: all(&one.spin), tangential: all(&one.tangential) }
    }
    fn put(&mut self, lane: usize, one: &Recurring) {
        self.normal.put(lane, &one.normal);
        self.spin.put(lane, &one.spin);
        self.tangential.put(lane, &one.tangential);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known() -> Recurring {
        let digits = |high: f64, low: f64| Double { high, low };
        Recurring { normal: digits(0.5, 1e-18), spin: digits(-0.25, 3e-18), tangential: digits(0.75, -2e-18) }
    }

    fn off(a: Recurring, b: Recurring) -> f64 {
        [(a.normal, b.normal), (a.spin, b.spin), (a.tangential, b.tangential)]
            .map(|(a, b)| a.plus(-b).value().abs())
            .into_iter()
            .fold(0.0, f64::max)
    }

    #[test]
    fn a_velocity_that_was_rounded_is_recalled_in_all_digits_before_and_after_a_collision() {
        let mirror = Mirror::no_slip(0.6);
        let [spin, tangential] = mirror.apply([known().spin, known().tangential]);
        for all in [known(), Recurring { spin, tangential, ..known() }] {
            let rounded = |x: Double, ulp: f64| Double::new(x.high + ulp * f64::EPSILON);
            let seen = Recurring {
                normal: rounded(all.normal, 2.0),
                spin: rounded(all.spin, -1.0),
                tangential: rounded(all.tangential, 2.0),
            };
            assert!(off(known().recall(seen, &mirror), all) < 1e-30);
        }
    }

    #[test]
    fn another_motion_is_taken_as_it_is() {
        let mirror = Mirror::specular();
        let other = Recurring { spin: Double::new(-0.25 + 1e-14), ..known() };
        assert_eq!(off(known().recall(other, &mirror), other), 0.0);
        assert_eq!(off(Recurring::nothing(0.0).recall(other, &mirror), other), 0.0);
    }
}

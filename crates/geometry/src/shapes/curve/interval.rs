//! Interval arithmetic: the values that a formula can take anywhere in a box, rounding included.
use core::f64::consts::{FRAC_PI_2, PI};
use core::ops::{Add, Div, Mul, Neg, Sub};

/// All real numbers from `low` to `high`.
///
/// Every operation returns an interval that contains all values the exact operation takes on its arguments: results are
/// widened by a unit in the last place, those of `libm`'s functions by two (they are accurate to less than one), and by four the hyperbolic
/// ones (accurate to less than three).
///
/// Outside its domain a function has no value. Where an interval lies only partly inside, perhaps because of rounding, the result is that
/// of the part inside; where none of it does, the result is [`Interval::ENTIRE`], about which nothing can be proved.
///
/// ```
/// use geometry::shapes::curve::Interval;
/// let x = Interval::new(-1.0, 2.0);
/// assert!((x * x).contains(-2.0)); // a product does not know that its factors are equal
/// assert!(!x.square().contains(-1e-300));
/// assert!((Interval::from(1.0) / Interval::from(3.0)).contains(1.0 / 3.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Least number.
    pub low: f64,
    /// Greatest number.
    pub high: f64,
}

/// The domain of square roots and logarithms.
const NOT_NEGATIVE: Interval = Interval { low: 0.0, high: f64::INFINITY };
/// The domain of arcsines and arccosines.
const SINES: Interval = Interval { low: -1.0, high: 1.0 };

impl From<f64> for Interval {
    fn from(a: f64) -> Interval {
        Interval { low: a, high: a }
    }
}

impl Interval {
    /// All real numbers: the enclosure of a value about which nothing is known.
    pub const ENTIRE: Interval = Interval { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// The numbers between `a` and `b`, in either order; everything if one is NaN.
    pub fn new(a: f64, b: f64) -> Interval {
        if a.is_nan() || b.is_nan() { Interval::ENTIRE } else { Interval { low: a.min(b), high: a.max(b) } }
    }

    /// Whether `a` belongs to it.
    pub fn contains(self, a: f64) -> bool {
        self.low <= a && a <= self.high
    }

    /// The smallest interval around both.
    #[must_use]
    pub fn union(self, other: Interval) -> Interval {
        Interval { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The greatest absolute value.
    pub fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// Its halves, lower and upper.
    pub(crate) fn halves(self) -> [Interval; 2] {
        let middle = 0.5 * (self.low + self.high);
        [Interval { low: self.low, high: middle }, Interval { low: middle, high: self.high }]
    }

    /// `high − low`
    pub fn width(self) -> f64 {
        self.high - self.low
    }

    /// Widened by some units in the last place.
    fn widened(low: f64, high: f64, units: u32) -> Interval {
        if low.is_nan() || high.is_nan() {
            return Interval::ENTIRE;
        }
        Interval { low: (0..units).fold(low, |a, _| a.next_down()), high: (0..units).fold(high, |a, _| a.next_up()) }
    }

    /// A function that rises, from `libm`.
    fn rising(self, f: impl Fn(f64) -> f64) -> Interval {
        Interval::widened(f(self.low), f(self.high), 2)
    }

    /// The image under `f` of the part in `domain`; everything if there is none.
    fn where_defined(self, domain: Interval, f: impl Fn(Interval) -> Interval) -> Interval {
        if self.high < domain.low || self.low > domain.high {
            return Interval::ENTIRE;
        }
        f(Interval { low: self.low.max(domain.low), high: self.high.min(domain.high) })
    }

    /// `|x|`
    #[must_use]
    pub fn abs(self) -> Interval {
        let low = if self.contains(0.0) { 0.0 } else { self.low.abs().min(self.high.abs()) };
        Interval { low, high: self.magnitude() }
    }

    /// `x²`
    #[must_use]
    pub fn square(self) -> Interval {
        let Interval { low, high } = self.abs();
        let square = Interval::widened(low * low, high * high, 1);
        Interval { low: square.low.max(0.0), high: square.high }
    }

    /// `xⁿ` for a whole `n`.
    #[must_use]
    pub fn powi(self, n: i32) -> Interval {
        if n < 0 {
            return Interval::from(1.0) / self.powi(n.saturating_neg());
        }
        if n == 0 {
            return Interval::from(1.0);
        }
        if n % 2 == 0 {
            return self.square().powi_positive(n / 2);
        }
        // odd powers rise
        let [low, high] = [self.low, self.high].map(|a| Interval::from(a).powi_positive(n));
        Interval { low: low.low, high: high.high }
    }

    /// `xⁿ` by repeated squaring, for an interval that does not change sign, and `n ≥ 1`.
    fn powi_positive(self, n: i32) -> Interval {
        let (mut power, mut rest, mut result) = (self, n, Interval::from(1.0));
        while rest > 0 {
            if rest % 2 == 1 {
                result = result * power;
            }
            rest /= 2;
            if rest > 0 {
                power = power.square();
            }
        }
        result
    }

    /// `xʸ`: [`powi`](Interval::powi) where `y` is one whole number, and else `exp(y ln x)` of the part of `x` that is not negative.
    ///
    /// Negative numbers have powers with whole exponents: where `x` reaches below 0 and there may be one among several `y`, this is
    /// everything.
    #[must_use]
    pub fn powf(self, y: Interval) -> Interval {
        let single = y.low == y.high;
        if let Some(n) = whole(y.low).filter(|_| single) {
            return self.powi(n);
        }
        let fractional = single && y.low % 1.0 != 0.0;
        // below 0 by rounding does not count
        if self.low < -4.0 * f64::EPSILON * self.magnitude() && !fractional {
            return Interval::ENTIRE;
        }
        self.where_defined(NOT_NEGATIVE, |x| (y * x.ln()).exp())
    }

    /// `√x`, of the part of `x` that is not negative.
    #[must_use]
    pub fn sqrt(self) -> Interval {
        self.where_defined(NOT_NEGATIVE, |x| {
            let root = Interval::widened(x.low.sqrt(), x.high.sqrt(), 1);
            Interval { low: root.low.max(0.0), high: root.high }
        })
    }

    /// `eˣ`
    #[must_use]
    pub fn exp(self) -> Interval {
        let exp = self.rising(libm::exp);
        Interval { low: exp.low.max(0.0), high: exp.high }
    }

    /// The natural logarithm of the part of `x` that is not negative, −∞ for 0.
    #[must_use]
    pub fn ln(self) -> Interval {
        self.where_defined(NOT_NEGATIVE, |x| x.rising(libm::log))
    }

    /// `cos x`
    #[must_use]
    pub fn cos(self) -> Interval {
        self.waves([libm::cos(self.low), libm::cos(self.high)], 0.0)
    }

    /// `sin x`
    #[must_use]
    pub fn sin(self) -> Interval {
        self.waves([libm::sin(self.low), libm::sin(self.high)], FRAC_PI_2)
    }

    /// `[sin x, cos x]`, at the cost of one of them.
    #[must_use]
    pub fn sin_cos(self) -> [Interval; 2] {
        let ((s, c), (t, d)) = (libm::sincos(self.low), libm::sincos(self.high));
        [self.waves([s, t], FRAC_PI_2), self.waves([c, d], 0.0)]
    }

    /// The range of a sine wave of amplitude 1 with these values at the ends and a crest at `crest`.
    fn waves(self, [a, b]: [f64; 2], crest: f64) -> Interval {
        let bounds = Interval::widened(a.min(b), a.max(b), 2);
        let high = if self.reaches(crest) { 1.0 } else { bounds.high.min(1.0) };
        let low = if self.reaches(crest - PI) { -1.0 } else { bounds.low.max(-1.0) };
        Interval { low, high }
    }

    /// Whether it may contain `angle + 2πk` for a whole number `k`, with room for rounding.
    fn reaches(self, angle: f64) -> bool {
        let room = 8.0 * f64::EPSILON * (1.0 + self.magnitude());
        let (low, high) = (self.low - room - angle, self.high + room - angle);
        !(low.is_finite() && high.is_finite()) || libm::floor(high / (2.0 * PI)) * (2.0 * PI) >= low
    }

    /// `tan x`; everything if a pole may lie inside.
    #[must_use]
    pub fn tan(self) -> Interval {
        if self.reaches(FRAC_PI_2) || self.reaches(-FRAC_PI_2) { Interval::ENTIRE } else { self.rising(libm::tan) }
    }

    /// The arcsine of the part of `x` in [−1, 1].
    #[must_use]
    pub fn asin(self) -> Interval {
        self.where_defined(SINES, |x| x.rising(libm::asin))
    }

    /// The arccosine of the part of `x` in [−1, 1].
    #[must_use]
    pub fn acos(self) -> Interval {
        self.where_defined(SINES, |x| Interval::widened(libm::acos(x.high), libm::acos(x.low), 2))
    }

    /// `arctan x`
    #[must_use]
    pub fn atan(self) -> Interval {
        self.rising(libm::atan)
    }

    /// `sinh x`
    #[must_use]
    pub fn sinh(self) -> Interval {
        Interval::widened(libm::sinh(self.low), libm::sinh(self.high), 4)
    }

    /// `cosh x`
    #[must_use]
    pub fn cosh(self) -> Interval {
        let size = self.abs();
        let cosh = Interval::widened(libm::cosh(size.low), libm::cosh(size.high), 4);
        Interval { low: cosh.low.max(1.0), high: cosh.high }
    }

    /// `tanh x`
    #[must_use]
    pub fn tanh(self) -> Interval {
        let tanh = Interval::widened(libm::tanh(self.low), libm::tanh(self.high), 4);
        Interval { low: tanh.low.max(-1.0), high: tanh.high.min(1.0) }
    }

    /// The angle of the points `(x, y)`, in [−π, π], where `self` is `y`.
    #[must_use]
    pub fn atan2(self, x: Interval) -> Interval {
        if self.contains(0.0) && x.low <= 0.0 {
            return Interval::widened(-PI, PI, 1);
        }
        let corners = [(self.low, x.low), (self.low, x.high), (self.high, x.low), (self.high, x.high)];
        let angles = corners.map(|(y, x)| Interval::from(libm::atan2(y, x)));
        let around = angles.into_iter().fold(angles[0], Interval::union);
        Interval::widened(around.low, around.high, 2)
    }
}

/// The value as an integer, if it is a whole number of up to 2³¹ − 1.
fn whole(y: f64) -> Option<i32> {
    let is_whole = y % 1.0 == 0.0 && y.abs() <= f64::from(i32::MAX);
    #[expect(clippy::cast_possible_truncation, reason = "a whole number within range: just checked")]
    is_whole.then_some(y as i32)
}

impl Neg for Interval {
    type Output = Interval;
    fn neg(self) -> Interval {
        Interval { low: -self.high, high: -self.low }
    }
}

impl Add for Interval {
    type Output = Interval;
    fn add(self, other: Interval) -> Interval {
        Interval::widened(self.low + other.low, self.high + other.high, 1)
    }
}

impl Sub for Interval {
    type Output = Interval;
    fn sub(self, other: Interval) -> Interval {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Interval;
    fn mul(self, other: Interval) -> Interval {
        // 0 · ∞ is 0 here: an infinite end stands for numbers of any size, not for ∞ itself
        let product = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let ends = [
            product(self.low, other.low),
            product(self.low, other.high),
            product(self.high, other.low),
            product(self.high, other.high),
        ];
        let low = ends.into_iter().fold(f64::INFINITY, f64::min);
        let high = ends.into_iter().fold(f64::NEG_INFINITY, f64::max);
        Interval::widened(low, high, 1)
    }
}

impl Div for Interval {
    type Output = Interval;
    /// Everything if the divisor contains 0.
    fn div(self, other: Interval) -> Interval {
        if other.contains(0.0) {
            return Interval::ENTIRE;
        }
        self * Interval::widened(1.0 / other.high, 1.0 / other.low, 1)
    }
}

impl Mul<f64> for Interval {
    type Output = Interval;
    fn mul(self, a: f64) -> Interval {
        self * Interval::from(a)
    }
}

impl Add<f64> for Interval {
    type Output = Interval;
    fn add(self, a: f64) -> Interval {
        self + Interval::from(a)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn interval() -> impl Strategy<Value = (Interval, f64)> {
        // an interval, small or large, and a point of it
        (-8.0..8.0, -12..2_i32, 0.0..=1.0).prop_map(|(low, e, part): (f64, i32, f64)| {
            let high = low + libm::exp2(f64::from(e));
            (Interval::new(low, high), (low + part * (high - low)).clamp(low, high))
        })
    }

    proptest! {
        #[test]
        fn every_operation_encloses_the_values_it_takes((a, x) in interval(), (b, y) in interval()) {
            prop_assert!((a + b).contains(x + y));
            prop_assert!((a - b).contains(x - y));
            prop_assert!((a * b).contains(x * y));
            prop_assert!((a / b).contains(x / y));
            prop_assert!(a.square().contains(x * x));
            prop_assert!(a.abs().contains(x.abs()));
            prop_assert!(a.powi(3).contains(x * x * x));
            prop_assert!(a.powi(4).contains((x * x) * (x * x)));
            prop_assert!(a.sin().contains(libm::sin(x)));
            prop_assert!(a.cos().contains(libm::cos(x)));
            prop_assert_eq!(a.sin_cos(), [a.sin(), a.cos()]);
            prop_assert!(a.tan().contains(libm::tan(x)));
            prop_assert!(a.atan().contains(libm::atan(x)));
            prop_assert!(a.exp().contains(libm::exp(x)));
            prop_assert!(a.sinh().contains(libm::sinh(x)));
            prop_assert!(a.cosh().contains(libm::cosh(x)));
            prop_assert!(a.tanh().contains(libm::tanh(x)));
            prop_assert!(a.atan2(b).contains(libm::atan2(x, y)));
            if x >= 0.0 {
                prop_assert!(a.sqrt().contains(x.sqrt()));
                prop_assert!(a.ln().contains(libm::log(x)));
                prop_assert!(a.powf(b).contains(libm::pow(x, y)));
            }
            if x.abs() <= 1.0 {
                prop_assert!(a.asin().contains(libm::asin(x)));
                prop_assert!(a.acos().contains(libm::acos(x)));
            }
        }

        #[test]
        fn powers_with_whole_exponents_of_any_size_enclose_those_of_negative_numbers(
            (a, x) in interval(),
            n in prop_oneof![-9..10_i32, -3000..3000_i32, Just(i32::MAX), Just(-i32::MAX)],
        ) {
            // near 1, where high powers do not vanish
            let (a, x) = (a * 0.125, x * 0.125);
            let power = libm::pow(x, f64::from(n));
            prop_assert!(a.powi(n).contains(power));
            prop_assert!(a.powf(f64::from(n).into()).contains(power));
            // one of these exponents is whole
            prop_assert!(a.powf(Interval::new(f64::from(n) - 0.25, f64::from(n) + 0.25)).contains(power));
        }

        #[test]
        fn of_numbers_outside_the_domain_of_a_function_nothing_is_known((a, _) in interval()) {
            // what is certainly negative, and certainly greater than 1
            let (negative, great) = (-a.abs() + -1e-300, a.abs() + 1.5);
            for of in [negative.sqrt(), negative.ln(), negative.powf(1.5.into()), (-great).asin(), great.asin(), great.acos()] {
                prop_assert_eq!(of, Interval::ENTIRE);
            }
            // zero is inside, and rounding beside it
            let touching = Interval::new(-1e-16, 1e-16);
            prop_assert!(touching.sqrt().magnitude() <= 2e-8 && touching.powf(1.5.into()).magnitude() <= 2e-24);
        }

        #[test]
        fn narrow_intervals_stay_narrow((a, x) in interval()) {
            let point = Interval::from(x);
            let wide = |i: Interval| i.width() / (1.0 + i.magnitude());
            // the widening itself: at most 2 units either way per operation
            prop_assert!(wide(point.sin()) <= 4.0 * f64::EPSILON);
            prop_assert!(wide(point.cos()) <= 4.0 * f64::EPSILON);
            prop_assert!(wide(point.powi(5)) <= 16.0 * f64::EPSILON);
            prop_assert!(a.sin().width() <= a.width() + 4.0 * f64::EPSILON + 2.0 * a.sin().width() * f64::from(u8::from(a.width() > 0.1)));
        }
    }
}

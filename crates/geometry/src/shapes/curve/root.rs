//! The root of a rising function in a bracket.

/// The `u` in `[low, high]` where a function changes from negative to positive, given its value and its slope (or an
/// estimate of it: only the speed depends on that).
///
/// Newton's method, with bisection wherever it leaves the bracket or does not halve its step.
pub(crate) fn rising_root(f: impl Fn(f64) -> [f64; 2], [low, high]: [f64; 2]) -> f64 {
    rising_root_near(0.5 * (low + high), f, [low, high], 0.0)
}

/// The same, starting from a guess in the bracket; a Newton step no longer than `enough` is the last.
pub(crate) fn rising_root_near(
    guess: f64,
    f: impl Fn(f64) -> [f64; 2],
    [mut low, mut high]: [f64; 2],
    enough: f64,
) -> f64 {
    let tolerance = f64::EPSILON * low.abs().max(high.abs());
    let mut u = guess;
    let mut last = high - low;
    // twice the bits of a mantissa: bisection alone would have finished, except for subnormal numbers
    for _ in 0..106 {
        let [value, slope] = f(u);
        if value == 0.0 {
            return u;
        }
        if value < 0.0 {
            low = u;
        } else {
            high = u;
        }
        let newton = u - value / slope;
        let fast = low <= newton && newton <= high && (newton - u).abs() <= 0.5 * last.abs();
        let next = if fast { newton } else { 0.5 * (low + high) };
        last = next - u;
        u = next;
        if last.abs() <= tolerance || (fast && last.abs() <= enough) {
            break;
        }
    }
    u
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_slope_costs_time_only() {
        let exact = rising_root(|u| [u * u - 2.0, 2.0 * u], [0.0, 2.0]);
        let wrong = rising_root(|u| [u * u - 2.0, 0.1], [0.0, 2.0]);
        assert!((exact - core::f64::consts::SQRT_2).abs() <= 2.0 * f64::EPSILON);
        assert!((wrong - exact).abs() <= 4.0 * f64::EPSILON);
    }
}

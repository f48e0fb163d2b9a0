//! The first root of a smooth function, found with certainty.
//!
//! A path crosses a curve where `h` rises through 0. Wherever `h'' ≤ c`, the parabola `h + h' τ + c τ²/2` lies above
//! the function, so that its root `τ = (√(h'² − 2 c h) − h')/c` comes before the function's: marching from root to root
//! cannot step over one. As soon as the bounds on `h''` prove that `h` rises steadily to its root, Newton's method
//! finishes. Six or seven evaluations are typical. Where `h''` is unbounded, as around a kink, bounds on `h'` lead past it, and where
//! that is unbounded too, as around a cusp, bounds on `h`.
use super::{Interval, rising_root};

/// A function of one real variable that is twice differentiable, with an enclosure of its second derivative.
///
/// ```
/// use geometry::shapes::curve::{Interval, Smooth, first_rise};
///
/// /// `t² − 2`
/// struct Square;
/// impl Smooth for Square {
///     fn jet(&self, t: f64) -> [f64; 2] {
///         [t * t - 2.0, 2.0 * t]
///     }
///     fn second_derivative(&self, _: Interval) -> Interval {
///         Interval::from(2.0)
///     }
/// }
/// // it falls through 0 at −√2, and rises at √2
/// let root = first_rise(&Square, Interval { low: -3.0, high: 3.0 }, 0.0).expect("it rises");
/// assert!((root - 2.0_f64.sqrt()).abs() <= 2.0 * f64::EPSILON);
/// assert_eq!(first_rise(&Square, Interval { low: -3.0, high: 1.0 }, 0.0), None);
/// ```
pub trait Smooth {
    /// Value and first derivative at `t`.
    fn jet(&self, t: f64) -> [f64; 2];

    /// An interval that contains the second derivative everywhere in `over`; the narrower, the faster.
    fn second_derivative(&self, over: Interval) -> Interval;

    /// An interval that contains the first derivative everywhere in `over`. It is asked for only where the second has no bound,
    /// and saves many short steps there.
    fn first_derivative(&self, _over: Interval) -> Interval {
        Interval::ENTIRE
    }

    /// An interval that contains the values everywhere in `over`. It is asked for only where neither derivative has a bound.
    fn value(&self, _over: Interval) -> Interval {
        Interval::ENTIRE
    }
}

/// Most marching steps. Paths need about three; only a path that runs along a curve within rounding needs many.
const STEPS: usize = 20_000;

/// After as many steps as the first number, every step whose count is a multiple of the second goes on looking for sharper bounds
/// although the next sharper ones are no better: just behind a cusp, bounds on a long stretch are far from those on a stretch as long as
/// the distance from the cusp.
const DOGGED: [usize; 2] = [32, 4];

/// A step is at least this fraction of the whole range. What it might skip is a touch of depth `c τ²/2`, which is below rounding: 2⁻⁶⁰
/// of the variation of `h`.
const LEAST_STEP: f64 = 1.0 / 1_073_741_824.0; // 2⁻³⁰

/// The first `t` in `over` at which `h` rises from negative to positive values; `None` if it never does.
///
/// A start with `h` in `[0, noise]` counts as lying on the curve: it is a crossing if `h` rises there, and is left
/// behind if it falls. A start with `h > noise` must first come down through 0.
///
/// A touch of zero within rounding may or may not be reported. If `h` stays within rounding of zero for so long that the steps run out,
/// the point reached is reported: it lies before any crossing.
pub fn first_rise(h: &impl Smooth, over: Interval, noise: f64) -> Option<f64> {
    let start = h.jet(over.low);
    if start[0] > noise {
        let entry = march(h, -1.0, over, start)?;
        march(h, 1.0, Interval { low: entry, high: over.high }, h.jet(entry))
    } else {
        march(h, 1.0, over, start)
    }
}

/// The first `t` at which `sign · h`, not positive at the start up to rounding, rises through 0; `here` is the jet of `h` at the start.
fn march(h: &impl Smooth, sign: f64, over: Interval, here: [f64; 2]) -> Option<f64> {
    let jet = |t: f64| h.jet(t).map(|a| sign * a);
    let signed = |over: Interval| if sign < 0.0 { -over } else { over };
    let second = |from: f64, to: f64| signed(h.second_derivative(Interval { low: from, high: to }));
    let rise = |from: f64, to: f64| signed(h.first_derivative(Interval { low: from, high: to })).high;
    let below = |from: f64, to: f64| signed(h.value(Interval { low: from, high: to })).high < 0.0;
    let least = LEAST_STEP * (over.high - over.low);
    let mut t = over.low;
    let mut here = here.map(|a| sign * a);
    // up to where h is certainly not positive
    let mut sure = t;
    let mut on = Stretch::new(here[0], [t, over.high], second, rise, below, least);
    for count in 0..STEPS {
        let dogged = count >= DOGGED[0] && count % DOGGED[1] == 0;
        let [value, slope] = here;
        if value.is_nan() {
            return None;
        }
        // at single places a formula may give 0/0
        let slope = if slope.is_nan() { 0.0 } else { slope };
        if value >= 0.0 && slope > 0.0 {
            // only a step of the least length can have gone too far by more than rounding
            return Some(if sure < t { rising_root(jet, [sure, t]) } else { t });
        }
        let value = value.min(0.0);
        let mut step = safe_step(value, slope, on.bend.high).max(safe_way(value, on.rise));
        // a bound on the part where the root may lie can be sharper than one on the whole stretch
        while step < 0.125 * (on.end - t) && on.end - t > 8.0 * least {
            let near = t + (4.0 * step).max(0.125 * (on.end - t));
            let sharp = second(t, near);
            let farther = safe_step(value, slope, sharp.high);
            if !dogged && (farther == 0.0 || (farther < 1.25 * step && is_bounded(on.bend))) {
                break;
            }
            on = Stretch { end: near, bend: sharp, ..on };
            step = farther.max(step);
        }
        if let Some(reach) = certain_reach(value, slope, on.bend)
            && t + reach <= on.end
        {
            return Some(newton(jet, t, [value, slope], [step, reach], on.bend));
        }
        sure = t + step;
        t = if sure < on.end { t + step.max(least) } else { on.end };
        if t >= over.high {
            return None;
        }
        here = jet(t);
        if t >= on.end {
            let end = (t + 4.0 * (step.min(over.high - t)).max(least)).min(over.high);
            on = Stretch::new(here[0], [t, end], second, rise, below, least);
        }
    }
    Some(t)
}

/// A stretch on which bounds on the function are known.
#[derive(Clone, Copy)]
struct Stretch {
    end: f64,
    /// An enclosure of `h''`.
    bend: Interval,
    /// An upper bound of `h'`; infinite where `bend` is enough.
    rise: f64,
}

fn is_bounded(bend: Interval) -> bool {
    bend.low.is_finite() && bend.high.is_finite()
}

impl Stretch {
    /// The whole stretch if `h''` is bounded there or a bound on `h'` leads through half of it, or else half of it, a quarter and so on.
    ///
    /// Interval arithmetic on a formula with a quotient or a root often finds no bound on a long stretch, and around a kink there is
    /// none.
    fn new(
        value: f64,
        [from, to]: [f64; 2],
        second: impl Fn(f64, f64) -> Interval,
        rise: impl Fn(f64, f64) -> f64,
        below: impl Fn(f64, f64) -> bool,
        least: f64,
    ) -> Stretch {
        let mut end = to;
        loop {
            let bend = second(from, end);
            if is_bounded(bend) {
                return Stretch { end, bend, rise: f64::INFINITY };
            }
            let rise = rise(from, end);
            // where `h` certainly is below 0, no bound on its slope is needed
            let rise = if rise == f64::INFINITY && below(from, end) { 0.0 } else { rise };
            // also ends for a stretch that is NaN
            if safe_way(value, rise) >= 0.5 * (end - from) || !(end - from > least) {
                return Stretch { end, bend, rise };
            }
            end = from + 0.5 * (end - from);
        }
    }
}

/// How far `h ≤ 0` certainly stays below 0, given `h' ≤ c`.
fn safe_way(value: f64, c: f64) -> f64 {
    if c <= 0.0 { f64::INFINITY } else { (-value / c).max(0.0) }
}

/// How far `h ≤ 0` certainly stays below 0, given `h'` and `h'' ≤ c`; nowhere if there is no bound `c`.
fn safe_step(value: f64, slope: f64, c: f64) -> f64 {
    if !(c < f64::INFINITY) {
        0.0
    } else if c > 0.0 {
        let root = (slope * slope - 2.0 * c * value).sqrt();
        if slope > 0.0 { -2.0 * value / (root + slope) } else { (root - slope) / c }
    } else if slope > 0.0 {
        -value / slope
    } else {
        f64::INFINITY
    }
}

/// An upper bound of the distance to a root up to which `h` rises steadily, if the bounds on `h''` prove that there is one and that
/// Newton's method converges to it from here.
fn certain_reach(value: f64, slope: f64, bend: Interval) -> Option<f64> {
    // Kantorovich's condition is that the ratio is at most 1/2; 1/4 makes every step shorter than half the last one
    let certain = slope > 0.0 && slope * slope >= 4.0 * bend.magnitude() * -value;
    let fall = (-bend.low).max(0.0);
    certain.then(|| -2.0 * value / (slope + (slope * slope - 2.0 * fall * -value).sqrt()))
}

/// The root in `t + [near, far]`, by Newton's method from `t`, where value and slope are known.
fn newton(
    jet: impl Fn(f64) -> [f64; 2],
    t: f64,
    [mut value, mut slope]: [f64; 2],
    [near, far]: [f64; 2],
    bend: Interval,
) -> f64 {
    let mut root = t;
    let mut last = f64::INFINITY;
    loop {
        let next = (root - value / slope).max(t + near).min(t + far);
        let step = (next - root).abs();
        // from here on, rounding alone moves it
        if step >= 0.5 * last || step.is_nan() {
            return root;
        }
        // the error that is left is at most h″ step² / 2h′
        if step * step * bend.magnitude() <= f64::EPSILON * next.abs() * slope {
            return next;
        }
        (root, last) = (next, step);
        [value, slope] = jet(root);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::cell::Cell;

    /// `−Π (rᵢ − t)` for given roots in rising order: negative at first, with a count of evaluations.
    struct Product<'a> {
        roots: &'a [f64],
        count: Cell<u32>,
    }

    impl Product<'_> {
        /// The product without the factors `i` and `j`.
        fn without<T: From<f64> + core::ops::Mul<Output = T> + core::ops::Sub<Output = T> + Copy>(
            &self,
            t: T,
            skip: [usize; 2],
        ) -> T {
            let factors = self.roots.iter().enumerate().filter(|(i, _)| !skip.contains(i));
            factors.fold(T::from(1.0), |product, (_, &r)| product * (T::from(r) - t))
        }
    }

    impl Smooth for Product<'_> {
        fn jet(&self, t: f64) -> [f64; 2] {
            self.count.set(self.count.get() + 1);
            let none = usize::MAX;
            let slope: f64 = (0..self.roots.len()).map(|i| self.without(t, [i, none])).sum();
            [-self.without(t, [none; 2]), slope]
        }
        fn first_derivative(&self, over: Interval) -> Interval {
            let none = usize::MAX;
            (0..self.roots.len()).fold(Interval::from(0.0), |sum, i| sum + self.without(over, [i, none]))
        }
        fn second_derivative(&self, over: Interval) -> Interval {
            let n = self.roots.len();
            let pairs = (0..n).flat_map(|i| (0..n).filter(move |&j| j != i).map(move |j| [i, j]));
            pairs.fold(Interval::from(0.0), |sum, skip| sum - self.without(over, skip))
        }
    }

    fn first(roots: &[f64], from: f64) -> (Option<f64>, u32) {
        let h = Product { roots, count: Cell::new(0) };
        let root = first_rise(&h, Interval::new(from, 10.0), 1e-15);
        (root, h.count.get())
    }

    #[test]
    fn the_first_root_is_found_however_close_the_next_one_is() {
        for gap in [1.0, 1e-2, 1e-4, 1e-6, 1e-7] {
            for r in [0.1, 1.0, 3.0, 7.3] {
                let (root, count) = first(&[r, r + gap, 9.0], 0.0);
                // where two roots are close, the function is flat: rounding in it moves the root by the rounding divided by the gap
                let off = (root.unwrap() - r).abs();
                assert!(off < 1e-14 + 1e-14 / gap, "{r} {gap}: {off:e}");
                assert!(count < 60, "{r} {gap}: {count} evaluations");
            }
        }
    }

    #[test]
    fn nothing_rises_where_times_are_no_numbers() {
        struct Unknown;
        impl Smooth for Unknown {
            fn jet(&self, t: f64) -> [f64; 2] {
                [t, 1.0]
            }
            fn second_derivative(&self, _over: Interval) -> Interval {
                Interval::ENTIRE
            }
        }
        for (low, high) in [(f64::NAN, 1.0), (-1.0, f64::NAN), (f64::NAN, f64::NAN), (-1.0, f64::INFINITY)] {
            let root = first_rise(&Unknown, Interval { low, high }, 1e-15);
            assert!(root.is_none_or(|t| !t.is_nan()), "[{low}, {high}]: {root:?}");
        }
    }

    #[test]
    fn a_function_that_falls_through_zero_first_is_followed_until_it_rises() {
        // starts positive, falls at 2 and rises at 3
        let (root, _) = first(&[1.0, 2.0, 3.0], 1.5);
        assert!((root.unwrap() - 3.0).abs() < 1e-14);
    }

    #[test]
    fn a_start_on_the_curve_is_left_behind_if_the_path_leads_inwards() {
        let (root, _) = first(&[1.0, 2.0, 3.0], 2.0);
        assert!((root.unwrap() - 3.0).abs() < 1e-14);
        // and is the crossing if the function rises there
        assert_eq!(first(&[1.0, 2.0, 3.0], 3.0).0, Some(3.0));
    }

    #[test]
    fn a_function_without_a_rise_has_none() {
        assert_eq!(first(&[1.0, 2.0], 1.5).0, None);
        assert_eq!(first(&[-1.0], 0.0).0, None);
    }

    #[test]
    fn a_double_root_costs_a_bounded_number_of_steps() {
        let (_, count) = first(&[4.0, 4.0, 9.0], 0.0);
        assert!(count < 200, "{count}");
    }

    #[test]
    fn a_root_is_found_where_the_second_derivative_has_no_bound_on_the_whole_way() {
        /// `t − 2` with an enclosure that gives no bounds on stretches longer than 1/4.
        struct Vague;
        impl Smooth for Vague {
            fn jet(&self, t: f64) -> [f64; 2] {
                [t - 2.0, 1.0]
            }
            fn second_derivative(&self, over: Interval) -> Interval {
                let vague = over.high - over.low > 0.25;
                if vague { Interval { low: f64::NEG_INFINITY, high: f64::INFINITY } } else { Interval::new(-1.0, 1.0) }
            }
        }
        assert_eq!(first_rise(&Vague, Interval::new(0.0, 10.0), 1e-15), Some(2.0));
    }

    #[test]
    fn a_kink_is_passed_in_a_few_steps() {
        /// `t + |t − 1|/2 − 2`, whose root is 5/3.
        struct Kinked(Cell<u32>);
        impl Smooth for Kinked {
            fn jet(&self, t: f64) -> [f64; 2] {
                self.0.set(self.0.get() + 1);
                [t + 0.5 * (t - 1.0).abs() - 2.0, if t < 1.0 { 0.5 } else { 1.5 }]
            }
            fn first_derivative(&self, over: Interval) -> Interval {
                let slope = |t: f64| if t < 1.0 { 0.5 } else { 1.5 };
                Interval::new(slope(over.low), slope(over.high))
            }
            fn second_derivative(&self, over: Interval) -> Interval {
                self.0.set(self.0.get() + 1);
                if over.contains(1.0) { Interval::ENTIRE } else { Interval::from(0.0) }
            }
        }
        let h = Kinked(Cell::new(0));
        let root = first_rise(&h, Interval::new(0.0, 10.0), 1e-15).unwrap();
        assert!((root - 5.0 / 3.0).abs() < 1e-15 && h.0.get() < 40, "{root} {}", h.0.get());
    }

    #[test]
    fn a_well_separated_root_takes_seven_evaluations() {
        let counts = (1..=80).map(|k| first(&[0.1 * f64::from(k), 9.0, 9.5], 0.0).1);
        let mean = counts.sum::<u32>() / 80;
        assert!(mean <= 8, "{mean}");
    }
}

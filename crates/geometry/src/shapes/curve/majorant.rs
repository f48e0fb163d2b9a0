//! The first root of a smooth function, for certain.
//!
//! A path crosses a curve where `h` rises through 0. Wherever `h'' ≤ c`, the parabola `h + h' τ + c τ²/2` lies above
//! the function, so that its root `τ = (√(h'² − 2 c h) − h')/c` comes before the function's: marching from root to root
//! cannot step over one. As soon as the bounds on `h''` prove that `h` rises steadily to its root, Newton's method
//! finishes. Six or seven evaluations are typical.
use super::Interval;

/// A function of one real variable that is twice differentiable, with an enclosure of its second derivative.
pub trait Smooth {
    /// Value and first derivative at `t`.
    fn jet(&self, t: f64) -> [f64; 2];

    /// An interval that contains the second derivative everywhere in `over`; the narrower, the faster.
    fn second_derivative(&self, over: Interval) -> Interval;
}

/// The marching steps allowed. Paths need about three; only one that creeps along a curve within rounding needs many.
const STEPS: usize = 20_000;

/// A step is at least this part of the whole range. What it might skip is a touch of depth `c τ²/2`, and that is
/// rounding: 2⁻⁵⁴ of what `h` varies by.
const LEAST_STEP: f64 = 1.0 / 134_217_728.0; // 2⁻²⁷

/// The first `t` in `over` at which `h` rises from negative to positive values; `None` if it never does.
///
/// A start with `h` in `[0, noise]` counts as lying on the curve: it is a crossing if `h` rises there, and is left
/// behind if it falls. A start with `h > noise` must first come down through 0.
///
/// A path that touches zero within rounding may or may not be reported, and one that creeps along it without end is
/// reported where it was when patience ran out: short of any crossing.
pub fn first_rise(h: &impl Smooth, over: Interval, noise: f64) -> Option<f64> {
    let from = if h.jet(over.low)[0] > noise { march(h, -1.0, over)? } else { over.low };
    march(h, 1.0, Interval { low: from, high: over.high })
}

/// The first `t` at which `sign · h`, not positive at the start but for rounding, rises through 0.
fn march(h: &impl Smooth, sign: f64, over: Interval) -> Option<f64> {
    let jet = |t: f64| h.jet(t).map(|a| sign * a);
    let second = |from: f64, to: f64| {
        let Interval { low, high } = h.second_derivative(Interval { low: from, high: to });
        if sign < 0.0 { Interval { low: -high, high: -low } } else { Interval { low, high } }
    };
    let least = LEAST_STEP * (over.high - over.low);
    let mut t = over.low;
    let (mut end, mut bend) = (over.high, second(t, over.high));
    for _ in 0..STEPS {
        let [value, slope] = jet(t);
        if value.is_nan() || slope.is_nan() {
            return None;
        }
        if value >= 0.0 && slope > 0.0 {
            return Some(t);
        }
        let value = value.min(0.0);
        let mut step = safe_step(value, slope, bend.high);
        // a bound for where the root may be is sharper than one for the whole way
        while step < 0.125 * (end - t) && end - t > 8.0 * least {
            end = t + (4.0 * step).max(0.125 * (end - t)).max(least);
            bend = second(t, end);
            step = safe_step(value, slope, bend.high);
        }
        if let Some(reach) = certain_reach(value, slope, bend.low)
            && t + reach <= end
        {
            return Some(newton(jet, t, [step, reach], over.high - over.low));
        }
        t = if t + step < end { t + step.max(least) } else { end };
        if t >= over.high {
            return None;
        }
        if t >= end {
            end = (t + 4.0 * (step.min(over.high - t)).max(least)).min(over.high);
            bend = second(t, end);
        }
    }
    Some(t)
}

/// How far `h ≤ 0` certainly stays below 0, given `h'` and `h'' ≤ c`.
fn safe_step(value: f64, slope: f64, c: f64) -> f64 {
    if c > 0.0 {
        let root = (slope * slope - 2.0 * c * value).sqrt();
        if slope > 0.0 { -2.0 * value / (root + slope) } else { (root - slope) / c }
    } else if slope > 0.0 {
        -value / slope
    } else {
        f64::INFINITY
    }
}

/// How far it is at most to a root up to which `h` rises steadily, if `h'' ≥ c` proves that there is one and that
/// Newton's method converges to it from here.
fn certain_reach(value: f64, slope: f64, c: f64) -> Option<f64> {
    let fall = (-c).max(0.0);
    // Kantorovich's condition is that the ratio is at most 1/2; 1/4 makes every step shorter than half the last one
    let certain = slope > 0.0 && slope * slope >= 4.0 * fall * -value;
    certain.then(|| -2.0 * value / (slope + (slope * slope - 2.0 * fall * -value).sqrt()))
}

/// The root in `t + [near, far]`, where the function rises.
fn newton(jet: impl Fn(f64) -> [f64; 2], t: f64, [near, far]: [f64; 2], range: f64) -> f64 {
    let [near, far] = [t + near, t + far];
    let mut root = near;
    let mut last = f64::INFINITY;
    loop {
        let [value, slope] = jet(root);
        let next = (root - value / slope).clamp(near.min(far), far.max(near));
        let step = (next - root).abs();
        // from here on, rounding alone moves it
        if step >= 0.5 * last || step.is_nan() {
            return root;
        }
        if step <= f64::EPSILON * range {
            return next;
        }
        (root, last) = (next, step);
    }
}

//! Where a curve that is otherwise smooth has kinks.
use super::Interval;

/// Parts no wider than this (radians) count as places: inside them everything is rounding.
const NARROW: f64 = 4.0 * f64::EPSILON;

/// More adjacent parts than this, where there are too many of them, do not show a kink, but rounding.
const BLURRED: usize = 64;

/// There is no kink where the slope changes by less than this many times what a calm second derivative may vary by, times the width: the
/// curve bends there at most a few times as much as elsewhere. (A calm one varies by up to a quarter of the greatest.)
const AS_ELSEWHERE: f64 = 16.0;

/// Nor is it there if the slope changes by more than this, in units of the curve's size: then the part is wide enough to hide one.
const SLIGHT: f64 = 1e-5;

/// Slopes that differ by so little over so short a part lead to the same points (in units of the curve's size), so that it does not matter
/// where in the part the kink lies.
const SAME_POINT: f64 = 16.0 * f64::EPSILON;

/// How much the first and the second derivative of a curve vary over a part of a turn \[L\]; infinitely where there is no bound.
#[derive(Clone, Copy)]
pub(super) struct Variation {
    pub(super) first: f64,
    pub(super) second: f64,
}

/// What such variations are compared with.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    /// By how much the second derivative may vary over a part that is calm \[L\].
    pub(super) calm: f64,
    /// The size of the curve \[L\].
    pub(super) size: f64,
}

/// The halves of a part that are not `calm`, or the part itself if it is a place.
fn rough(part: Interval, calm: impl Fn(Interval) -> bool) -> Vec<Interval> {
    if part.width() <= NARROW {
        return vec![part];
    }
    part.halves().into_iter().filter(|half| !calm(*half)).collect()
}

/// Where, within rounding, some parts of a turn are not `calm`, in rising order. `None` where more than `most` parts of one width are not.
pub(super) fn places(
    parts: impl Iterator<Item = Interval>,
    calm: impl Fn(Interval) -> bool,
    most: usize,
) -> Option<Vec<Interval>> {
    let mut parts: Vec<_> = parts.filter(|part| !calm(*part)).collect();
    while parts.iter().any(|part| part.width() > NARROW) {
        if parts.len() > most {
            return None;
        }
        parts = parts.into_iter().flat_map(|part| rough(part, &calm)).collect();
    }
    Some(parts)
}

/// The kinks in some parts of a turn, in rising order: places around which the second derivative has no bound, however narrow the part. It
/// has none either in parts next to a kink, where a formula that repeats its variable bounds too little; they are free of kinks if both
/// halves are calm. And it has none around a place where the argument of an absolute value touches 0: there is no kink if the slope is
/// continuous.
///
/// # Errors
/// About where a part is not calm for another reason (something hides there, or the curvature is unbounded, or rounding hides whether there
/// is a kink), or where more than `most` parts of one width are not.
pub(super) fn kinks(
    parts: impl Iterator<Item = Interval>,
    variation: impl Fn(Interval) -> Variation,
    scale: Scale,
    most: usize,
) -> Result<Vec<Interval>, f64> {
    let calm = |part: Interval| variation(part).second <= scale.calm;
    let mut open: Vec<_> = parts.filter(|part| !calm(*part)).collect();
    let mut places = vec![];
    // the kink in a blurred place, if there is one
    let kink_in = |place: Interval| {
        let (change, width) = (variation(place).first, place.width());
        if change <= AS_ELSEWHERE * scale.calm * width && change <= SLIGHT * scale.size {
            Ok(None)
        } else if change * width <= SAME_POINT * scale.size {
            Ok(Some(place))
        } else {
            Err(place.low)
        }
    };
    while open.iter().any(|part| part.width() > NARROW) {
        if open.len() > most {
            let mut blurred: Vec<_> =
                open.chunk_by(are_neighbours).filter(|run| run.len() > BLURRED).map(around).collect();
            // at the fringes of a wide one rounding blurs some parts, and others not
            blurred.sort_by(|a, b| b.width().total_cmp(&a.width()));
            for run in blurred {
                let [low, high] = [run.low - run.width(), run.high + run.width()];
                let (inside, clear): (Vec<_>, _) =
                    open.into_iter().partition(|part| low <= part.low && part.high <= high);
                open = clear;
                // none if a wider run has taken it
                if !inside.is_empty() {
                    places.extend(kink_in(around(&inside))?);
                }
            }
            if let Some(first) = open.first().filter(|_| open.len() > most) {
                return Err(first.low);
            }
        }
        let mut narrower = vec![];
        for part in open {
            let rest = rough(part, calm);
            // known to vary, and yet calm in halves
            if rest.is_empty() && variation(part).second.is_finite() {
                return Err(part.low);
            }
            narrower.extend(rest);
        }
        open = narrower;
    }
    places.extend(open);
    places.sort_by(|a, b| a.low.total_cmp(&b.low));
    // where a formula is flat, rounding blurs the places around a kink, not all of them
    Ok(places.chunk_by(|a, b| b.low - a.high <= BLURRED as f64 * NARROW).map(around).collect())
}

/// Whether not many parts of their width lie between two.
fn are_neighbours(a: &Interval, b: &Interval) -> bool {
    b.low - a.high <= BLURRED as f64 * a.width()
}

/// The smallest interval around parts in rising order, of which there is at least one.
fn around(parts: &[Interval]) -> Interval {
    Interval { low: parts[0].low, high: parts[parts.len() - 1].high }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::cell::Cell;

    /// Two parts about each of 2000 kinks.
    const MOST: usize = 4096;

    const SCALE: Scale = Scale { calm: 0.25, size: 1.0 };

    fn parts() -> impl Iterator<Item = Interval> {
        (0..64).map(|k| Interval::new(f64::from(k) / 8.0, f64::from(k + 1) / 8.0))
    }

    /// That of a straight line, or none that is known.
    fn straight_or_unknown(is_straight: bool) -> Variation {
        let size = if is_straight { 0.0 } else { f64::INFINITY };
        Variation { first: size, second: size }
    }

    #[test]
    fn kinks_are_found_within_rounding_also_between_parts() {
        let places = [0.0, 0.3, 2.5, 7.77];
        let found =
            kinks(parts(), |part| straight_or_unknown(!places.iter().any(|x| part.contains(*x))), SCALE, MOST).unwrap();
        assert_eq!(found.len(), places.len());
        for (found, x) in found.iter().zip(places) {
            assert!(found.contains(x) && found.width() <= 4.0 * NARROW, "{found:?}");
        }
    }

    #[test]
    fn a_spike_is_no_kink() {
        let spike = Interval::new(2.2, 2.2 + 1e-6);
        // calm are parts that do not meet the spike, and short parts of it
        let is_calm = |part: Interval| part.high < spike.low || part.low > spike.high || part.width() < 1e-8;
        let variation = |part: Interval| Variation { first: 1.0, second: if is_calm(part) { 0.0 } else { 1e6 } };
        assert!(kinks(parts(), variation, SCALE, MOST).is_err_and(|at| (at - 2.2).abs() < 0.125));
    }

    #[test]
    fn two_thousand_kinks_are_found_and_what_is_rough_everywhere_is_given_up_soon() {
        let looked = Cell::new(0_usize);
        let count = |part: Interval| {
            looked.set(looked.get() + 1);
            part
        };
        let variation = |part| straight_or_unknown(count(part).high < 1.0 || part.low > 3.0);
        let rough = kinks(parts(), variation, SCALE, MOST);
        assert!(rough.is_err() && looked.get() < 4 * MOST, "{looked:?}");
        let places: Vec<f64> = (0..2000).map(|k| 0.004 * f64::from(k)).collect();
        let near = |part: Interval| places[places.partition_point(|x| *x < part.low).min(1999)];
        let found = kinks(parts(), |part| straight_or_unknown(!part.contains(near(part))), SCALE, MOST).unwrap();
        assert_eq!(found.len(), places.len());
    }

    #[test]
    fn a_bend_without_bound_is_no_kink() {
        // a second derivative like x^(-1/2) varies on every scale
        let variation = |Interval { low, high }| Variation {
            first: 2.0 * (high.sqrt() - low.sqrt()),
            second: 1.0 / low.sqrt() - 1.0 / high.sqrt(),
        };
        assert!(kinks(parts(), variation, SCALE, MOST).is_err());
    }

    /// That of `|u|` for `u = x² − c`, where `x` counts from `middle`, as bounded if `x² − c` is written as `x·x − c` and has an error of
    /// `rounding`.
    fn of_parabola(part: Interval, middle: f64, c: f64, rounding: f64) -> Variation {
        let x = Interval { low: part.low - middle, high: part.high - middle };
        let u = x * x + Interval::new(-c - rounding, -c + rounding);
        if u.contains(0.0) {
            let slope = x * Interval::new(-2.0, 2.0);
            return Variation { first: slope.width(), second: f64::INFINITY };
        }
        Variation { first: 2.0 * part.width(), second: 0.0 }
    }

    #[test]
    fn parts_beside_a_kink_that_bounds_do_not_separate_from_it_are_no_spikes() {
        for k in 0..100 {
            let c = 0.01 + 0.037 * f64::from(k);
            let found = kinks(parts(), |part| of_parabola(part, 4.0, c, 1e-16), SCALE, MOST).unwrap();
            let [low, high] = found[..] else { panic!("{c}: {found:?}") };
            for (found, x) in [(low, 4.0 - c.sqrt()), (high, 4.0 + c.sqrt())] {
                assert!((0.5 * (found.low + found.high) - x).abs() < 1e-14 && found.width() < 1e-14, "{c}: {found:?}");
            }
        }
    }

    #[test]
    fn where_an_absolute_value_touches_zero_there_is_no_kink_and_where_it_almost_does_there_are_two() {
        let found = |c: f64| kinks(parts(), |part| of_parabola(part, 4.3, c, 1e-16), SCALE, MOST);
        for c in [0.0, 1e-17, -1e-17, -1e-12] {
            assert_eq!(found(c), Ok(vec![]), "{c}");
        }
        for c in [1e-13, 1e-12, 1e-11, 1e-10, 1e-8] {
            let [low, high] = found(c).unwrap()[..] else { panic!("{c}") };
            assert!(low.contains(4.3 - c.sqrt()) && high.contains(4.3 + c.sqrt()), "{c}: {low:?} {high:?}");
        }
    }

    #[test]
    fn what_rounding_leaves_undecided_is_named() {
        // a slope that jumps by 1 somewhere in a part of 10⁻⁷
        let place = Interval::new(2.2, 2.2 + 1e-7);
        let variation = |part: Interval| straight_or_unknown(part.high < place.low || part.low > place.high);
        let variation = |part: Interval| Variation {
            first: if variation(part).second > 0.0 { 1.0 } else { 0.0 },
            ..variation(part)
        };
        assert!(kinks(parts(), variation, SCALE, MOST).is_err_and(|at| (at - 2.2).abs() < 1e-6));
    }
}

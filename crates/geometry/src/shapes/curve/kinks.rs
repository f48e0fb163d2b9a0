//! Where a curve that is otherwise smooth has kinks.
use super::Interval;

/// Parts no wider than this (radians) count as places: inside them everything is rounding.
const NARROW: f64 = 4.0 * f64::EPSILON;

/// Where, within rounding, some parts of a turn are not `calm`, in rising order. `None` where more than `most` parts of one width are
/// not, or where a part is calm in halves, though not as a whole, and nothing `may_hide`.
pub(super) fn places(
    parts: impl Iterator<Item = Interval>,
    calm: impl Fn(Interval) -> bool,
    may_hide: bool,
    most: usize,
) -> Option<Vec<Interval>> {
    let mut parts: Vec<_> = parts.filter(|part| !calm(*part)).collect();
    while parts.iter().any(|part| part.width() > NARROW) {
        if parts.len() > most {
            return None;
        }
        let mut narrower = vec![];
        for part in parts {
            if part.width() <= NARROW {
                narrower.push(part);
                continue;
            }
            let middle = 0.5 * (part.low + part.high);
            let halves = [Interval { low: part.low, high: middle }, Interval { low: middle, high: part.high }];
            let before = narrower.len();
            narrower.extend(halves.into_iter().filter(|half| !calm(*half)));
            if narrower.len() == before && !may_hide {
                return None;
            }
        }
        parts = narrower;
    }
    Some(parts)
}

/// The kinks in some parts of a turn, in rising order: places around which parts are not `calm`, however narrow. `None` where a part is not
/// calm for another reason (something hides there, or the curvature is unbounded), or where there are too many.
pub(super) fn kinks(
    parts: impl Iterator<Item = Interval>,
    calm: impl Fn(Interval) -> bool,
    most: usize,
) -> Option<Vec<Interval>> {
    // what is calm in halves but not as a whole is no kink
    let places = places(parts, calm, false, most)?;
    let mut found: Vec<Interval> = vec![];
    for part in places {
        match found.last_mut() {
            Some(last) if part.low - last.high <= NARROW => last.high = part.high,
            _ => found.push(part),
        }
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::cell::Cell;

    /// Two parts about each of 2000 kinks.
    const MOST: usize = 4096;

    fn parts() -> impl Iterator<Item = Interval> {
        (0..64).map(|k| Interval::new(f64::from(k) / 8.0, f64::from(k + 1) / 8.0))
    }

    #[test]
    fn kinks_are_found_within_rounding_also_between_parts() {
        let places = [0.0, 0.3, 2.5, 7.77];
        let found = kinks(parts(), |part| !places.iter().any(|x| part.contains(*x)), MOST).unwrap();
        assert_eq!(found.len(), places.len());
        for (found, x) in found.iter().zip(places) {
            assert!(found.contains(x) && found.width() <= 4.0 * NARROW, "{found:?}");
        }
    }

    #[test]
    fn a_spike_is_no_kink() {
        let spike = Interval::new(2.2, 2.2 + 1e-6);
        // calm are parts that do not meet the spike, and short parts of it
        let calm = |part: Interval| part.high < spike.low || part.low > spike.high || part.width() < 1e-8;
        assert_eq!(kinks(parts(), calm, MOST), None);
    }

    #[test]
    fn two_thousand_kinks_are_found_and_what_is_rough_everywhere_is_given_up_soon() {
        let looked = Cell::new(0_usize);
        let count = |part: Interval| {
            looked.set(looked.get() + 1);
            part
        };
        let rough = kinks(parts(), |part| count(part).high < 1.0 || part.low > 3.0, MOST);
        assert!(rough.is_none() && looked.get() < 4 * MOST, "{looked:?}");
        let places: Vec<f64> = (0..2000).map(|k| 0.004 * f64::from(k)).collect();
        let near = |part: Interval| places[places.partition_point(|x| *x < part.low).min(1999)];
        let found = kinks(parts(), |part| !part.contains(near(part)), MOST).unwrap();
        assert_eq!(found.len(), places.len());
    }

    #[test]
    fn a_bend_without_bound_is_no_kink() {
        // a second derivative like x^(-1/2) varies on every scale
        let calm = |part: Interval| 1.0 / part.low.sqrt() - 1.0 / part.high.sqrt() <= 0.25;
        assert_eq!(kinks(parts(), calm, MOST), None);
    }
}

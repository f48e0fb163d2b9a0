//! Where a curve that is otherwise smooth has kinks.
use super::Interval;

/// Parts so narrow (radians) are places: what lies between them is rounding.
const NARROW: f64 = 4.0 * f64::EPSILON;

/// Parts looked at, at most. A kink takes a hundred; what takes more is no kink, but a bend that grows without end.
const MOST: usize = 20_000;

/// The places in some parts of a turn that are not `calm`, however narrow; `None` where there is no end of them.
pub(super) fn kinks(parts: impl Iterator<Item = Interval>, calm: impl Fn(Interval) -> bool) -> Option<Vec<Interval>> {
    let mut found: Vec<Interval> = vec![];
    let mut looked_at = 0;
    let mut open = vec![];
    for part in parts {
        open.push(part);
        while let Some(part) = open.pop() {
            looked_at += 1;
            if looked_at > MOST {
                return None;
            }
            if calm(part) {
                continue;
            }
            let middle = 0.5 * (part.low + part.high);
            if part.width() > NARROW {
                open.push(Interval { low: middle, high: part.high });
                open.push(Interval { low: part.low, high: middle });
                continue;
            }
            match found.last_mut() {
                Some(last) if part.low - last.high <= NARROW => last.high = part.high,
                _ => found.push(part),
            }
        }
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts() -> impl Iterator<Item = Interval> {
        (0..64).map(|k| Interval::new(f64::from(k) / 8.0, f64::from(k + 1) / 8.0))
    }

    #[test]
    fn kinks_are_found_within_rounding_also_between_parts() {
        let places = [0.0, 0.3, 2.5, 7.77];
        let found = kinks(parts(), |part| !places.iter().any(|x| part.contains(*x))).unwrap();
        assert_eq!(found.len(), places.len());
        for (found, x) in found.iter().zip(places) {
            assert!(found.contains(x) && found.width() <= 4.0 * NARROW, "{found:?}");
        }
    }

    #[test]
    fn a_bend_without_bound_is_no_kink() {
        // a second derivative like x^(-1/2) varies on every scale
        let calm = |part: Interval| 1.0 / part.low.sqrt() - 1.0 / part.high.sqrt() <= 0.25;
        assert_eq!(kinks(parts(), calm), None);
    }
}

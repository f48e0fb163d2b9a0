//! Where a curve that is otherwise smooth has kinks.
use super::Interval;

/// Parts so narrow (radians) are places: what lies between them is rounding.
const NARROW: f64 = 4.0 * f64::EPSILON;

/// The kinks in some parts of a turn: parts that are not `calm`, however narrow. `None` where a part is not calm for another reason:
/// something hides there, or a bend grows without end.
pub(super) fn kinks(parts: impl Iterator<Item = Interval>, calm: impl Fn(Interval) -> bool) -> Option<Vec<Interval>> {
    let mut found: Vec<Interval> = vec![];
    for part in parts {
        if !(calm(part) || search(part, &calm, &mut found)) {
            return None;
        }
    }
    Some(found)
}

/// Finds the kinks in a part that is not calm; whether there is one, and one in each half that is not calm.
fn search(part: Interval, calm: &impl Fn(Interval) -> bool, found: &mut Vec<Interval>) -> bool {
    if part.width() <= NARROW {
        match found.last_mut() {
            Some(last) if part.low - last.high <= NARROW => last.high = part.high,
            _ => found.push(part),
        }
        return true;
    }
    let middle = 0.5 * (part.low + part.high);
    let halves = [Interval { low: part.low, high: middle }, Interval { low: middle, high: part.high }];
    let calms = halves.map(calm);
    calms != [true; 2] && (0..2).all(|k| calms[k] || search(halves[k], calm, found))
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
    fn a_spike_is_no_kink() {
        let spike = Interval::new(2.2, 2.2 + 1e-6);
        // calm are parts that do not know of the spike, and those of it that are short
        let calm = |part: Interval| part.high < spike.low || part.low > spike.high || part.width() < 1e-8;
        assert_eq!(kinks(parts(), calm), None);
    }

    #[test]
    fn a_bend_without_bound_is_no_kink() {
        // a second derivative like x^(-1/2) varies on every scale
        let calm = |part: Interval| 1.0 / part.low.sqrt() - 1.0 / part.high.sqrt() <= 0.25;
        assert_eq!(kinks(parts(), calm), None);
    }
}

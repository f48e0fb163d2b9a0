//! Where the length of a polar curve is summed from.
use super::Interval;

/// Parts of a turn from which the length of a calm curve is tabulated.
const PARTS: usize = 32;

/// Over a part of which it is known to this part of the curve's size how long it is, or how far it rises and falls, nothing hides.
const KNOWN: f64 = 1e-4;

/// Halvings at most: nothing that a formula says is narrower.
const HALVINGS: u32 = 40;

/// Most parts of one width that are halved again: two about each of 2000 places. A formula with more varies everywhere, which shows at
/// any place.
const MOST: usize = 4096;

/// Angles in rising order from which the length of a curve `r(φ)` can be tabulated: those that cut a turn into some parts, and more
/// where between these `r′` may become what it is at none of them, so that a sum over places would miss it.
///
/// `sectors` cut the turn, with `r` and its derivatives in each; `jet` is what they are over any angles, and `size` the greatest radius.
pub(super) fn seeds(
    sectors: &[(Interval, [Interval; 3])],
    jet: impl Fn(Interval) -> [Interval; 3],
    size: f64,
) -> Vec<f64> {
    // the length is ∫ √(r² + r′²), which changes by no more than r′ does; of what is steep there may be no bound before it is cut narrow,
    // and where there never is one, at the tip of a cusp, r itself tells when to stop
    let known = |part: &Interval, [r, slope, _]: [Interval; 3]| {
        let width = slope.width();
        let change = if width.is_finite() { width * part.width() } else { r.width() };
        change <= KNOWN * size
    };
    let mut seeds: Vec<f64> = sectors.iter().step_by(sectors.len() / PARTS).map(|(sector, _)| sector.low).collect();
    seeds.extend(sectors.last().map(|(sector, _)| sector.high));
    let mut open: Vec<Interval> =
        sectors.iter().filter(|(sector, jet)| !known(sector, *jet)).map(|(sector, _)| *sector).collect();
    for _ in 0..HALVINGS {
        if open.is_empty() || open.len() > MOST {
            break;
        }
        let mut narrower = vec![];
        for Interval { low, high } in open {
            let middle = 0.5 * (low + high);
            seeds.extend([low, middle, high]);
            let halves = [Interval { low, high: middle }, Interval { low: middle, high }];
            narrower.extend(halves.into_iter().filter(|half| !known(half, jet(*half))));
        }
        open = narrower;
    }
    seeds.sort_by(f64::total_cmp);
    seeds.dedup();
    seeds
}

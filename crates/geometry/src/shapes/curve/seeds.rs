//! Where the length of a polar curve is summed from.
use super::Interval;

/// Parts of a turn from which the length of a calm curve is tabulated.
const PARTS: usize = 32;

/// Over a part of which it is known to this part of the curve's size how long it is, nothing hides.
const KNOWN: f64 = 1e-4;

/// Halvings at most: nothing that a formula says is narrower.
const HALVINGS: u32 = 40;

/// Most parts of one width that are halved again; a formula with more varies everywhere, which shows at any place.
const MOST: usize = 512;

/// Angles in rising order from which the length of a curve `r(φ)` can be tabulated: those that cut a turn into some parts, and more
/// where between these `r′` may become what it is at none of them, so that a sum over places would miss it.
///
/// `sectors` cut the turn, with what `r′` is in each; `slope` is what it is over any angles, and `size` the greatest radius.
pub(super) fn seeds(sectors: &[(Interval, Interval)], slope: impl Fn(Interval) -> Interval, size: f64) -> Vec<f64> {
    // the length is ∫ √(r² + r′²), which changes by no more than r′ does; where r′ has no bound, halving does not give it one
    let known = |part: &Interval, slope: Interval| {
        let width = slope.width();
        width * part.width() <= KNOWN * size || width == f64::INFINITY
    };
    let mut seeds: Vec<f64> = sectors.iter().step_by(sectors.len() / PARTS).map(|(sector, _)| sector.low).collect();
    seeds.extend(sectors.last().map(|(sector, _)| sector.high));
    let mut open: Vec<Interval> =
        sectors.iter().filter(|(sector, slope)| !known(sector, *slope)).map(|(sector, _)| *sector).collect();
    for _ in 0..HALVINGS {
        if open.is_empty() || open.len() > MOST {
            break;
        }
        let mut narrower = vec![];
        for Interval { low, high } in open {
            let middle = 0.5 * (low + high);
            seeds.extend([low, middle, high]);
            let halves = [Interval { low, high: middle }, Interval { low: middle, high }];
            narrower.extend(halves.into_iter().filter(|half| !known(half, slope(*half))));
        }
        open = narrower;
    }
    seeds.sort_by(f64::total_cmp);
    seeds.dedup();
    seeds
}

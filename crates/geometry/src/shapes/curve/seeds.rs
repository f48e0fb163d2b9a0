//! The angles from which the length of a polar curve is tabulated.
use super::Interval;

/// Parts of a turn from which the length of a calm curve is tabulated.
const PARTS: usize = 32;

/// Nothing hides in a part whose length, or whose range of radii, is known to this fraction of the curve's size.
const KNOWN: f64 = 1e-4;

/// Most halvings: no feature of a formula is narrower.
const HALVINGS: u32 = 40;

/// Most parts of one width that are halved again: two about each of 2000 places. A formula with more varies everywhere, which any sample
/// shows.
const MOST: usize = 4096;

/// Angles in rising order from which the length of a curve `r(φ)` can be tabulated: those that cut a turn into some parts, and more where
/// `r′` may take values between these that it has at none of them, so that a quadrature sum would miss them.
///
/// `sectors` cut the turn, with `r` and its derivatives in each; `jet` encloses them over any angles, and `size` is the greatest radius.
pub(super) fn seeds(
    sectors: &[(Interval, [Interval; 3])],
    jet: impl Fn(Interval) -> [Interval; 3],
    size: f64,
) -> Vec<f64> {
    // the length is ∫ √(r² + r′²), which changes by no more than r′ does; steep parts may have no bound until they are cut narrow, and
    // where there never is one, at the tip of a cusp, r itself decides when to stop
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
        for part in open {
            let halves = part.halves();
            seeds.extend([part.low, halves[0].high, part.high]);
            narrower.extend(halves.into_iter().filter(|half| !known(half, jet(*half))));
        }
        open = narrower;
    }
    seeds.sort_by(f64::total_cmp);
    seeds.dedup();
    seeds
}

//! The values that a radius and its derivatives may take over a stretch of a turn.
use super::{Interval, PolarFormula};
use core::f64::consts::PI;

/// Enclosures of `r`, `r′` and `r″` over parts of a turn, looked up instead of computed: over a long stretch they are
/// also narrower than what interval arithmetic finds in one evaluation.
#[derive(Clone, Debug)]
pub(super) struct Ranges {
    /// `runs[k][i]` covers `2ᵏ` parts from number `i` on.
    runs: Vec<Vec<[Interval; 3]>>,
}

/// Parts of a turn.
const PARTS: usize = 64;

impl Ranges {
    /// From enclosures over equal sectors.
    pub(super) fn new(sectors: &[[Interval; 3]]) -> Ranges {
        let both = |a: &[Interval; 3], b: &[Interval; 3]| [0, 1, 2].map(|i| a[i].union(b[i]));
        // a turn later a formula is the same up to rounding
        let room = |a: Interval| a + Interval::new(-1e-9, 1e-9) * a.magnitude();
        let part = |sectors: &[[Interval; 3]]| sectors[1..].iter().fold(sectors[0], |a, b| both(&a, b)).map(room);
        let mut runs = vec![sectors.chunks(sectors.len() / PARTS).map(part).collect::<Vec<_>>()];
        let mut length = 1;
        while length < PARTS {
            let last = &runs[runs.len() - 1];
            runs.push((0..PARTS).map(|i| both(&last[i], &last[(i + length) % PARTS])).collect());
            length *= 2;
        }
        Ranges { runs }
    }

    /// Enclosures over some angles.
    pub(super) fn of<F: PolarFormula>(&self, formula: &F, angles: Interval) -> [Interval; 3] {
        let [low, high] = [angles.low, angles.high].map(|angle| angle * (PARTS as f64 / (2.0 * PI)));
        // over a short stretch the formula itself is sharper; infinite angles have no parts
        if !(high - low >= 0.25 && low.abs().max(high.abs()) < 1e6) {
            return formula.jet_over(angles);
        }
        // room for the rounding of angles
        let [first, last] = [libm::floor(low - 1e-6), libm::floor(high + 1e-6)];
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "small whole numbers, not negative"
        )]
        let (start, count) =
            ((first - libm::floor(first / PARTS as f64) * PARTS as f64) as usize, (last - first) as usize + 1);
        if count >= PARTS {
            return self.runs[self.runs.len() - 1][0];
        }
        let level = count.ilog2() as usize;
        let run = &self.runs[level];
        let (a, b) = (&run[start % PARTS], &run[(start + count - (1 << level)) % PARTS]);
        let union = [0, 1, 2].map(|i| a[i].union(b[i]));
        // a part may have a kink where these angles have none
        if union[2].magnitude().is_finite() { union } else { formula.jet_over(angles) }
    }
}

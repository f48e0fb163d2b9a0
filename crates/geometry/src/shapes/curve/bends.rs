//! Where a curve about a centre bends more sharply than elsewhere, or has kinks.
use super::{
    Interval, PolarFormula,
    kinks::{Scale, Variation, kinks},
};

/// The bending of a curve in parts of a turn.
pub(super) struct Bends<'a, F> {
    formula: &'a F,
    /// The parts with `r` and its derivatives in each.
    parts: Vec<(Interval, [Interval; 3])>,
}

impl<'a, F: PolarFormula> Bends<'a, F> {
    pub(super) fn new(formula: &'a F, parts: Vec<(Interval, [Interval; 3])>) -> Bends<'a, F> {
        Bends { formula, parts }
    }

    /// What the bending of parts is compared with.
    fn scale(&self) -> Scale {
        let greatest = |of: &dyn Fn(&[Interval; 3]) -> f64| {
            self.parts.iter().map(|(_, jet)| of(jet)).filter(|size| size.is_finite()).fold(0.0, f64::max)
        };
        let bend = greatest(&|[r, _, second]| second.magnitude().max(r.magnitude()));
        Scale { calm: 0.25 * bend, size: greatest(&|[r, ..]| r.magnitude()) }
    }

    /// The kinks in some parts, if these are calm except for kinks.
    fn kinks_in(&self, parts: impl Iterator<Item = Interval>, most: usize) -> Option<Vec<Interval>> {
        let variation = |part| {
            let [_, slope, second] = self.formula.jet_over(part);
            Variation { first: slope.width(), second: second.width() }
        };
        kinks(parts, variation, self.scale(), most).ok()
    }

    /// The kinks, if all parts are calm except for these.
    pub(super) fn kinks(&self, most: usize) -> Option<Vec<Interval>> {
        let scale = self.scale();
        self.kinks_in(self.parts.iter().filter(|(_, jet)| !is_calm(jet, scale)).map(|(part, _)| *part), most)
    }

    /// The kinks, if there are any and the parts cut into `n` show them and nothing else that is not calm. (Bounds next to kinks that
    /// they cannot separate from the surroundings say nothing about how much a curve bends.)
    pub(super) fn hidden_kinks(&self, n: u32, most: usize) -> Option<Vec<Interval>> {
        self.kinks_in(self.parts.iter().flat_map(|(part, _)| cut(*part, n)), most).filter(|kinks| !kinks.is_empty())
    }

    /// As [`kinks`](Self::kinks), after cutting the parts that are not calm into quarters.
    pub(super) fn closer(&mut self, most: usize) -> Option<Vec<Interval>> {
        let scale = self.scale();
        let mut parts = vec![];
        for (part, jet) in self.parts.drain(..) {
            if is_calm(&jet, scale) {
                parts.push((part, jet));
                continue;
            }
            parts.extend(cut(part, 4).map(|quarter| (quarter, self.formula.jet_over(quarter))));
        }
        self.parts = parts;
        self.kinks(most)
    }
}

/// Whether the second derivative varies little over a part.
fn is_calm([.., second]: &[Interval; 3], scale: Scale) -> bool {
    second.width() <= scale.calm
}

/// An interval in `n` equal parts.
pub(super) fn cut(part: Interval, n: u32) -> impl Iterator<Item = Interval> {
    let at = move |k: u32| part.low + part.width() * (f64::from(k) / f64::from(n));
    (0..n).map(move |k| Interval::new(at(k), if k + 1 == n { part.high } else { at(k + 1) }))
}

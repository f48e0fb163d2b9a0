//! Where a curve about a centre bends more sharply than elsewhere, or has kinks.
use super::{Interval, PolarFormula, kinks::kinks};

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

    /// A test whether the second derivative varies little over a part.
    fn calm(&self) -> impl Fn(&[Interval; 3]) -> bool + use<F> {
        let bends = self.parts.iter().map(|(_, [r, _, second])| second.magnitude().max(r.magnitude()));
        let varies = 0.25 * bends.filter(|bend| bend.is_finite()).fold(0.0, f64::max);
        move |[.., second]| second.width() <= varies
    }

    /// The kinks, if all parts are calm except for these.
    pub(super) fn kinks(&self, most: usize) -> Option<Vec<Interval>> {
        let calm = self.calm();
        let rough = self.parts.iter().filter(|(_, jet)| !calm(jet)).map(|(part, _)| *part);
        kinks(rough, |part| calm(&self.formula.jet_over(part)), most)
    }

    /// The kinks, if there are any and the parts cut into `n` show them and nothing else that is not calm. (Bounds next to kinks that
    /// they cannot separate from the surroundings say nothing about how much a curve bends.)
    pub(super) fn hidden_kinks(&self, n: u32, most: usize) -> Option<Vec<Interval>> {
        let calm = self.calm();
        let parts = self.parts.iter().flat_map(|(part, _)| cut(*part, n));
        kinks(parts, |part| calm(&self.formula.jet_over(part)), most).filter(|kinks| !kinks.is_empty())
    }

    /// As [`kinks`](Self::kinks), after cutting the parts that are not calm into quarters.
    pub(super) fn closer(&mut self, most: usize) -> Option<Vec<Interval>> {
        let calm = self.calm();
        let mut parts = vec![];
        for (part, jet) in self.parts.drain(..) {
            if calm(&jet) {
                parts.push((part, jet));
                continue;
            }
            parts.extend(cut(part, 4).map(|quarter| (quarter, self.formula.jet_over(quarter))));
        }
        self.parts = parts;
        self.kinks(most)
    }
}

/// An interval in `n` equal parts.
pub(super) fn cut(part: Interval, n: u32) -> impl Iterator<Item = Interval> {
    let at = move |k: u32| part.low + part.width() * (f64::from(k) / f64::from(n));
    (0..n).map(move |k| Interval::new(at(k), if k + 1 == n { part.high } else { at(k + 1) }))
}

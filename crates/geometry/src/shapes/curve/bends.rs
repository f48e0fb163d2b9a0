//! Where a curve about a centre bends more narrowly than elsewhere, or has kinks.
use super::{Interval, PolarFormula, kinks::kinks};

/// How a curve bends in parts of a turn.
pub(super) struct Bends<'a, F> {
    formula: &'a F,
    /// The parts with `r` and its derivatives in each.
    parts: Vec<(Interval, [Interval; 3])>,
}

impl<'a, F: PolarFormula> Bends<'a, F> {
    pub(super) fn new(formula: &'a F, parts: Vec<(Interval, [Interval; 3])>) -> Bends<'a, F> {
        Bends { formula, parts }
    }

    /// Whether the second derivative differs little from what it is in the middle of a part.
    fn calm(&self) -> impl Fn(&[Interval; 3]) -> bool + use<F> {
        let bends = self.parts.iter().map(|(_, [r, _, second])| second.magnitude().max(r.magnitude()));
        let varies = 0.25 * bends.filter(|bend| bend.is_finite()).fold(0.0, f64::max);
        move |[.., second]| second.width() <= varies
    }

    /// The kinks, if but for those all parts are calm.
    pub(super) fn kinks(&self, most: usize) -> Option<Vec<Interval>> {
        let calm = self.calm();
        let rough = self.parts.iter().filter(|(_, jet)| !calm(jet)).map(|(part, _)| *part);
        kinks(rough, |part| calm(&self.formula.jet_over(part)), most)
    }

    /// Quarters in place of the parts that are not calm.
    pub(super) fn look_closer(&mut self) {
        let calm = self.calm();
        let mut parts = vec![];
        for (part, jet) in self.parts.drain(..) {
            if calm(&jet) {
                parts.push((part, jet));
                continue;
            }
            let at = |k: u32| part.low + part.width() * (f64::from(k) / 4.0);
            let quarters = (0..4).map(|k| Interval::new(at(k), if k == 3 { part.high } else { at(k + 1) }));
            parts.extend(quarters.map(|quarter| (quarter, self.formula.jet_over(quarter))));
        }
        self.parts = parts;
    }
}

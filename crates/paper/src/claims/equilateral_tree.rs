//! Which sequences of sides the orbits of the equilateral triangle have.
use crate::{
    Claim, Effort, Measurement, Quantity, Verdict,
    side_sequences::{self, word},
};
use std::collections::BTreeSet;

pub(super) const CLAIM: Claim = Claim {
    name: "equilateral-tree",
    place: "Figure 17",
    statement: "Up to the names of the sides, orbits of the equilateral triangle repeat 1212, 123123 or 121323; no orbit contains 12131, 121321, \
                1213232 or 1231232.",
    verdict: Verdict::Holds,
    general_gamma: Some("For γ² = 1/2 only: other disks have further sequences (not measured)."),
    measure,
};

/// The words of `length` letters in the repeated cycles, with sides named in the order of first appearance.
fn of_cycles(length: usize) -> BTreeSet<String> {
    let mut words = BTreeSet::new();
    for cycle in ["1212", "123123", "121323"] {
        for start in 0..cycle.len() {
            words.insert(word(cycle.bytes().cycle().skip(start).take(length).map(usize::from)));
        }
    }
    words
}

fn measure(effort: Effort) -> Measurement {
    let length = 9;
    let tree = side_sequences::tree(length, effort.of(2000, 50_000));
    let mut quantities = vec![];
    for letters in 2..=length {
        let found: BTreeSet<String> =
            tree.iter().filter(|n| n.occurs && n.word.len() == letters).map(|n| n.word.clone()).collect();
        let expected = of_cycles(letters);
        let label = |what: &str| format!("sequences of {letters} sides {what}");
        quantities.push(Quantity::count(label("found"), found.len(), expected.len()));
        quantities.push(Quantity::count(
            label("found that are in none of the three cycles"),
            found.difference(&expected).count(),
            0,
        ));
    }
    for word in ["12131", "121321", "1213232", "1231232"] {
        let share: f64 = tree.iter().filter(|node| node.word == word).map(|node| node.share).sum();
        quantities.push(Quantity::residual(format!("share of {word}"), share, 0.0));
    }
    quantities.into()
}

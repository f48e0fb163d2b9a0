//! The tree of side sequences of the equilateral triangle, by enumeration.
use super::super::motion::{follow, no_slip};
use super::super::portrait::{colour, starts};
use super::super::sheet::Sheet;
use super::super::{Drawing, Effort, Figure};
use super::equilateral::word;
use crate::picture::{Anchor, Colour, Style};
use billiards::geometry::tables;
use std::collections::BTreeMap;

pub(super) const FIGURE: Figure = Figure {
    name: "equilateral-tree",
    title: "Side sequences of the equilateral triangle",
    place: "Figure 17",
    caption: "All sequences of sides that occur, numbered in the order of their first hit, with the share of orbits below each; grey and struck \
              through, the continuations that no orbit makes. Not derived but counted. Three sequences begin at different places of the same \
              6-cycle 121323, so the leaves are those of the paper: a 4-cycle and two kinds of 6-cycles.",
    parameters: "Side 1, uniform disk, γ² = 1/2; 40 000 orbits (--quick 4000), canonical measure, seed 9, seven collisions each.",
    draw,
};

const LENGTH: usize = 7;

fn draw(effort: Effort) -> Drawing {
    let billiard = no_slip(tables::equilateral(1.0)?);
    let many = if effort == Effort::Quick { 4000 } else { 40_000 };
    let mut counts: BTreeMap<String, u64> = BTreeMap::new();
    for s in &starts(&billiard.table, 9, many)? {
        let (x, v) = (s.position, s.velocity);
        let path = follow(&billiard, [0.0, x[0], x[1]], [s.spin[0], v[0], v[1]], LENGTH as u64);
        let sides = word(&path, LENGTH);
        for length in 2..=sides.len() {
            *counts.entry(sides[..length].into()).or_default() += 1;
        }
    }
    let total = counts.get("12").copied().ok_or("no orbits")?;
    // rows: the words of full length, in order; a node stands in the middle of its rows
    let leaves: Vec<&String> = counts.keys().filter(|w| w.len() == LENGTH).collect();
    let row = |w: &str| {
        let rows: Vec<_> =
            leaves.iter().enumerate().filter(|(_, leaf)| leaf.starts_with(w)).map(|(i, _)| i as f64).collect();
        rows.iter().sum::<f64>() / rows.len() as f64
    };
    let (step, high) = (54.0, 31.0);
    let place = |length: usize, row: f64| [18.0 + step * (length - 2) as f64, 14.0 + high * row];
    let mut sheet = Sheet::new(step * 5.0 + 62.0, high * leaves.len() as f64 + 4.0);
    for (w, count) in counts.iter().filter(|(w, _)| leaves.iter().any(|leaf| leaf.starts_with(w.as_str()))) {
        let [x, y] = place(w.len(), row(w));
        if w.len() > 2 {
            let [a, b] = place(w.len() - 1, row(&w[..w.len() - 1]));
            sheet.svg.line([a + 17.0, b], [x - 17.0, y], Style::line(Colour::BLACK, 0.4));
        }
        sheet.label_as([x, y], 8.0, Anchor::Middle, w);
        let share = 100.0 * *count as f64 / total as f64;
        sheet.label_as([x, y + 8.0], 5.6, Anchor::Middle, &format!("{share:.1} %"));
        // the continuations that do not occur
        if w.len() < LENGTH {
            let last = w.chars().last();
            let none = ['1', '2', '3'].into_iter().filter(|c| Some(*c) != last).map(|c| format!("{w}{c}"));
            let none: Vec<_> = none
                .filter(|next| !counts.contains_key(next) && (w.contains('3') || !next.ends_with('3') || w.len() > 2))
                .collect();
            for next in none {
                let at = [x + 27.0, y - 8.0];
                let grey = Colour(0xa0, 0xa0, 0xa0);
                sheet.svg.text(
                    [at[0], at[1] + 2.0],
                    5.6,
                    Anchor::Middle,
                    &format!("<tspan fill=\"#909090\">{next}</tspan>"),
                );
                sheet.svg.line([at[0] - 11.0, at[1]], [at[0] + 11.0, at[1]], Style::line(grey, 0.4));
            }
        }
    }
    for (i, leaf) in leaves.iter().enumerate() {
        let kind = if !leaf.contains('3') {
            ("4-cycle", 0)
        } else if leaf.starts_with("123123") {
            ("6-cycle", 1)
        } else {
            ("6-cycle", 2)
        };
        let [x, y] = place(LENGTH, i as f64);
        sheet.svg.circle([x + 20.0, y], 1.6, Style::area(colour(kind.1)));
        sheet.label_as([x + 24.0, y], 6.0, Anchor::Start, &format!("\"{}\"", kind.0));
    }
    Ok(sheet.svg)
}

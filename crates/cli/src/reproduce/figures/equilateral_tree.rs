//! The tree of side sequences of the equilateral triangle, by enumeration.
use super::super::portrait::colour;
use super::super::sheet::Sheet;
use super::super::{Drawing, Effort, Figure};
use crate::picture::{Anchor, Colour, Style, WIDEST_DIGIT};
use paper::side_sequences;

pub(super) const FIGURE: Figure = Figure {
    name: "equilateral-tree",
    title: "Side sequences of the equilateral triangle",
    place: "Figure 17",
    caption: "All sequences of sides that occur, numbered in the order of their first hit, with the share of orbits below each; grey and struck \
              through, the continuations that no orbit makes. For each velocity of a sample all sequences are found, exactly, with the \
              intervals of starts that follow them. Three sequences begin at different places of the same \
              6-cycle 121323, so the leaves are those of the paper: a 4-cycle and two kinds of 6-cycles.",
    parameters: "Side 1, uniform disk, γ² = 1/2; 100 000 velocities, canonical measure, seven collisions each; one standard error of a share \
                 is 0.1 % or less.",
    draw,
};

const LENGTH: usize = 7;
/// Size of words that occur, and of all else.
const WORD: f64 = 8.0;
const SMALL: f64 = 5.6;

#[allow(clippy::unnecessary_wraps, reason = "other figures can fail")]
fn draw(_: Effort) -> Drawing {
    let nodes = side_sequences::tree(LENGTH, 100_000);
    // rows: the words of full length, in order; a node stands in the middle of its rows
    let leaves: Vec<&str> =
        nodes.iter().filter(|n| n.occurs && n.word.len() == LENGTH).map(|n| n.word.as_str()).collect();
    let row = |w: &str| {
        let rows: Vec<_> =
            leaves.iter().enumerate().filter(|(_, leaf)| leaf.starts_with(w)).map(|(i, _)| i as f64).collect();
        rows.iter().sum::<f64>() / rows.len() as f64
    };
    let (step, high) = (58.0, 31.0);
    let place = |length: usize, row: f64| [18.0 + step * (length - 2) as f64, 14.0 + high * row];
    // half of a word of this size, and some white, in the widest of the usual serif faces
    let half = |length: usize, size: f64| 2.0 + 0.5 * WIDEST_DIGIT * size * length as f64;
    let mut sheet = Sheet::new(step * 5.0 + 70.0, high * leaves.len() as f64 + 4.0);
    for node in nodes.iter().filter(|node| node.occurs) {
        let w = &node.word;
        let [x, y] = place(w.len(), row(w));
        if w.len() > 2 {
            let [a, b] = place(w.len() - 1, row(&w[..w.len() - 1]));
            sheet.svg.line(
                [a + half(w.len() - 1, WORD), b],
                [x - half(w.len(), WORD), y],
                Style::line(Colour::BLACK, 0.4),
            );
        }
        sheet.label_as([x, y], WORD, Anchor::Middle, w);
        sheet.label_as([x, y + 8.0], SMALL, Anchor::Middle, &format!("{:.1} %", 100.0 * node.share));
        // the continuations that do not occur
        if w.len() < LENGTH {
            let none =
                nodes.iter().filter(|n| !n.occurs && n.word.len() == w.len() + 1 && n.word.starts_with(w.as_str()));
            for next in none.map(|n| n.word.as_str()) {
                let at = [x + 0.5 * step, y - 8.0];
                let grey = Colour(0xa0, 0xa0, 0xa0);
                sheet.svg.text(
                    [at[0], at[1] + 2.0],
                    SMALL,
                    Anchor::Middle,
                    &format!("<tspan fill=\"#909090\">{next}</tspan>"),
                );
                let long = half(next.len(), SMALL);
                sheet.svg.line([at[0] - long, at[1]], [at[0] + long, at[1]], Style::line(grey, 0.4));
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
        sheet.svg.circle([x + half(LENGTH, WORD) + 2.0, y], 1.6, Style::area(colour(kind.1)));
        sheet.label_as([x + half(LENGTH, WORD) + 6.0, y], 6.0, Anchor::Start, &format!("\"{}\"", kind.0));
    }
    Ok(sheet.svg)
}

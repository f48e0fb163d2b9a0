//! The three kinds of orbits of the equilateral triangle.
use super::super::motion::{Path, follow, no_slip};
use super::super::portrait::{colour, starts};
use super::super::sheet::{LABEL, Sheet, fit};
use super::super::{Drawing, Effort, Figure};
use crate::picture::{Anchor, Style, Window};
use billiards::geometry::tables;
use paper::side_sequences;

pub(super) const FIGURE: Figure = Figure {
    name: "equilateral",
    title: "The equilateral triangle",
    place: "Figure 16",
    caption: "Every orbit without slip closes in the plane, after four collisions on two sides or after six on three sides, in one of two orders. \
              The rotation does not return. Reason: in this table the collisions and the identity form Klein's four-group.",
    parameters: "Side 1, uniform disk, γ² = 1/2. Of 600 orbits (canonical measure, seed 8) the one of each kind whose collisions lie furthest \
                 apart.",
    draw,
};

/// The smallest distance between two of the first six collisions.
fn apart(path: &Path, period: usize) -> f64 {
    let p: Vec<_> = path.hits.iter().take(period).map(super::super::motion::Hit::place).collect();
    let pairs = (0..p.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs.map(|(i, j)| libm::hypot(p[i][0] - p[j][0], p[i][1] - p[j][1])).fold(f64::INFINITY, f64::min)
}

fn draw(_: Effort) -> Drawing {
    let billiard = no_slip(tables::equilateral(1.0)?);
    let starts = starts(&billiard.table, 8, 600)?;
    let paths = starts.iter().map(|s| {
        let (x, v) = (s.position, s.velocity);
        follow(&billiard, [0.0, x[0], x[1]], [s.spin[0], v[0], v[1]], 13)
    });
    let paths: Vec<_> = paths.filter(|path| path.hits.len() == 13).collect();
    let side = 105.0;
    let height = side * libm::sqrt(3.0) / 2.0;
    let mut sheet = Sheet::new(3.0 * (side + 5.0) + 2.0, height + 20.0);
    for (i, (kind, period)) in [("1212", 4), ("123123", 6), ("121323", 6)].into_iter().enumerate() {
        let left = 3.0 + (side + 5.0) * i as f64;
        let sides = |path: &Path| side_sequences::word(path.hits.iter().take(kind.len()).map(|hit| hit.piece));
        let of_kind = paths.iter().filter(|path| sides(path) == kind);
        let best = of_kind.max_by(|a, b| apart(a, period).total_cmp(&apart(b, period)));
        let window = Window { low: [0.0, 0.0], high: [1.0, libm::sqrt(3.0) / 2.0] };
        let view = fit(window, [left, 3.0], side, height);
        sheet.chain(
            &view,
            best.ok_or("no orbit of this kind")?.plane().into_iter().skip(1),
            Style::line(colour(i), 0.7),
        );
        sheet.walls(&view, &billiard.table);
        sheet.label_as([left + 0.5 * side, height + 13.0], LABEL, Anchor::Middle, kind);
    }
    Ok(sheet.svg)
}

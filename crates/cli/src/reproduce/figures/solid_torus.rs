//! The reduced phase space as a solid torus.
use super::super::camera::{Camera, cross, dot, unit};
use super::super::motion::{follow, no_slip};
use super::super::portrait::{colour, starts};
use super::super::sheet::Sheet;
use super::super::{Drawing, Effort, Figure};
use crate::picture::{COLUMN, Colour, Style, View, Window};
use billiards::geometry::{Vector2, tables};
use core::f64::consts::TAU;

pub(super) const FIGURE: Figure = Figure {
    name: "solid-torus",
    title: "The reduced phase space is a solid torus",
    place: "Figure 3",
    caption: "Position on the boundary goes once around the torus; each disk across it holds the velocities (v₀, vₜ) after a collision \
              at that place. The points are those of a few orbits in the stadium: two that stay between the straight sides, and a \
              chaotic one. Forgetting the position projects the torus onto one disk, the velocity portrait of the other figures.",
    parameters: "Stadium with half length 1 and radius 1, uniform disk, γ² = 1/2; three orbits, 4000 collisions each (--quick 1200), ten sections.",
    draw,
};

/// Radii of the torus.
const RADII: [f64; 2] = [1.0, 0.36];

fn place(s: f64, [a, b]: [f64; 2]) -> [f64; 3] {
    let (sin, cos) = libm::sincos(TAU * s);
    let r = RADII[0] + RADII[1] * a;
    [r * cos, r * sin, RADII[1] * b]
}

fn draw(effort: Effort) -> Drawing {
    let billiard = no_slip(tables::stadium(1.0, 1.0)?);
    let table = &billiard.table;
    let (offsets, length) = (table.arc_length_offsets(), table.perimeter());
    let collisions = if effort == Effort::Quick { 1200 } else { 4000 };
    let mut points = Vec::new();
    let chaotic = starts(table, 3, 1)?;
    let begin = [
        ([0.0, -0.2, 0.0], [0.12, 0.05, 1.0]),
        ([0.0, 0.1, 0.0], [0.2, 0.16, 1.0]),
        (
            [0.0, chaotic[0].position[0], chaotic[0].position[1]],
            [chaotic[0].spin[0], chaotic[0].velocity[0], chaotic[0].velocity[1]],
        ),
    ];
    for (i, (x, v)) in begin.into_iter().enumerate() {
        let hits = follow(&billiard, x, unit(v), collisions).hits;
        // the caps are the odd pieces
        if i < 2 && hits.iter().any(|hit| hit.piece % 2 == 1) {
            return Err("an orbit leaves the straight sides".into());
        }
        for hit in hits {
            let [p1, p2] = hit.place();
            let s = offsets[hit.piece] + table.pieces()[hit.piece].arc_length_at(&Vector2::new(p1, p2));
            points.push((place(s / length, hit.tangential()), colour([1, 2, 0][i])));
        }
    }
    let camera = Camera::at(-62.0, 38.0);
    let mut sheet = Sheet::new(COLUMN, 168.0);
    let window = Window { low: [-1.44, -1.05], high: [1.44, 1.05] };
    let view = View::fit(window, [4.0, 3.0], COLUMN - 8.0, 160.0);
    let see = |p| camera.see(p);
    // far to near: the disks, each with the points of its sector
    let many = 10;
    let mut order: Vec<i32> = (0..many).collect();
    let section = |k: i32| f64::from(k) / f64::from(many);
    let depth = |k: &i32| camera.depth(place(section(*k), [0.0, 0.0]));
    order.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    silhouette(&mut sheet, &view, &camera);
    for k in order {
        let s = section(k);
        let rim = (0..72).map(|i| TAU * f64::from(i) / 72.0).map(|t| see(place(s, [libm::cos(t), libm::sin(t)])));
        let style = Style::line(Colour::BLACK, 0.35).filled(Colour::WHITE).with_opacity(0.8);
        sheet.region(&view, rim, style);
        let sector = |p: &[f64; 3]| {
            let turn = libm::atan2(p[1], p[0]) / TAU - s;
            (turn - libm::round(turn)).abs() <= 0.5 / f64::from(many)
        };
        for i in [0, 1, 2] {
            let ink = colour([0, 1, 2][i]);
            let dots = points.iter().filter(|(p, c)| *c == ink && sector(p)).map(|(p, _)| view.place(see(*p)));
            sheet.svg.dots(dots, if i == 0 { 0.45 } else { 0.6 }, ink, 0.8);
        }
    }
    let arc = (0..=30).map(|i| 0.595 + 0.09 * f64::from(i) / 30.0).map(|s| see(place(s, [1.35, -0.6])));
    let arc: Vec<_> = arc.collect();
    sheet.chain(&view, arc[..28].iter().copied(), Style::line(Colour::BLACK, 0.5));
    sheet.arrow(view.place(arc[26]), view.place(arc[30]), Colour::BLACK, 0.5);
    let [x, y] = view.place(arc[15]);
    sheet.label([x + 2.0, y + 9.0], "s");
    Ok(sheet.svg)
}

/// The visible outline of the torus, where lines of sight touch it.
fn silhouette(sheet: &mut Sheet, view: &View, camera: &Camera) {
    // the direction of view, from the depths of the unit vectors
    let w = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| camera.depth(axis));
    for side in [1.0, -1.0] {
        let points = (0..=180).map(|i| {
            let s = f64::from(i) / 180.0;
            let round = [-libm::sin(TAU * s), libm::cos(TAU * s), 0.0];
            let n = unit(cross(round, w));
            let out = [libm::cos(TAU * s), libm::sin(TAU * s), 0.0];
            camera.see(place(s, [side * dot(n, out), side * n[2]]))
        });
        let points: Vec<_> = points.collect();
        sheet.chain(view, points, Style::line(Colour(0x90, 0x90, 0x90), 0.5));
    }
}

//! Wave fronts in channels with curved walls.
use super::super::motion::{Path, follow, no_slip};
use super::super::portrait::colour;
use super::super::sheet::{Sheet, fit};
use super::super::{Drawing, Effort, Figure};
use crate::picture::{Anchor, Colour, Stroke, Style, Window};
use billiards::Planar;
use billiards::geometry::tables;
use billiards::laws::Specular;

pub(super) const FIGURE: Figure = Figure {
    name: "wave-fronts",
    title: "Wave fronts, specular and without slip",
    place: "Figure 19",
    caption: "Parallel rays (blue) set out upwards without spin from the dashed line; the thick line is the front after a fixed time. Walls that \
              bulge into the channel disperse it, walls that recede focus it, and it opens again behind the focus. Without slip both happen \
              more slowly: part of the motion goes into rotation.",
    parameters: "Channel of length 1 and height 1, arcs with sagitta 0.05 and −0.08; 21 rays from |x₁| ≤ 0.2, uniform disk, γ² = 1/2, \
                 unit speed; the fronts at time 2.15 (bulging) and 3.6 (receding).",
    draw,
};

/// Where an orbit at unit speed is at a time, and its path until then.
fn until(path: &Path, time: f64) -> Vec<[f64; 2]> {
    let (mut left, mut seen) = (time, vec![[path.start[1], path.start[2]]]);
    for pair in path.points().windows(2) {
        let d: [f64; 3] = core::array::from_fn(|k| pair[1][k] - pair[0][k]);
        let length = super::super::camera::dot(d, d).sqrt();
        let part = (left / length).min(1.0);
        seen.push([pair[0][1] + part * d[1], pair[0][2] + part * d[2]]);
        left -= length;
        if left <= 0.0 {
            break;
        }
    }
    seen
}

fn draw(_: Effort) -> Drawing {
    let (width, height) = (96.0, 84.0);
    let mut sheet = Sheet::new(4.0 * (width + 3.0) + 3.0, height + 18.0);
    let panels = [(0.05, true, 2.15), (0.05, false, 2.15), (-0.08, true, 3.6), (-0.08, false, 3.6)];
    for (i, (sagitta, specular, time)) in panels.into_iter().enumerate() {
        let left = 3.0 + (width + 3.0) * i as f64;
        let window = Window { low: [-0.69, -0.09], high: [0.69, 1.09] };
        let view = fit(window, [left, 3.0], width, height);
        let table = tables::channel(1.0, 1.0, sagitta)?;
        let ways: Vec<_> = (0..21)
            .map(|k| [0.0, 0.5 + 0.2 * (f64::from(k) / 10.0 - 1.0), 0.5])
            .map(|x| {
                let v = [0.0, 0.0, 1.0];
                let path = if specular {
                    follow(&Planar { table: table.clone(), law: Specular }, x, v, 8)
                } else {
                    follow(&no_slip(table.clone()), x, v, 8)
                };
                until(&path, time).into_iter().map(|[a, b]| [a - 0.5, b]).collect::<Vec<_>>()
            })
            .collect();
        sheet.within(&view, |sheet| {
            for way in &ways {
                sheet.chain(&view, way.iter().copied(), Style::line(colour(0), 0.22));
            }
            let front = ways.iter().filter_map(|way| way.last().copied());
            sheet.chain(&view, front, Style::line(colour(1), 1.0));
            sheet.dashed(view.place([-0.2, 0.5]), view.place([0.2, 0.5]), Style::line(Colour::BLACK, 0.6));
            for shift in [-1.0, 0.0, 1.0] {
                for stroke in crate::simulation::strokes::of(&table, 1.0) {
                    if let Stroke::Arc { center, radius, start, sweep } = stroke {
                        let center = [center[0] - 0.5 + shift, center[1]];
                        let moved = Stroke::Arc { center, radius, start, sweep };
                        sheet.svg.path(&moved.outline(&view), Style::line(Colour::BLACK, 0.8));
                    }
                }
            }
        });
        let name = if specular { "\"specular\"" } else { "\"no-slip\"" };
        sheet.label_as([left + 0.5 * width, height + 11.0], 8.0, Anchor::Middle, name);
    }
    Ok(sheet.svg)
}

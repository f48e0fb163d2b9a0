//! The velocity disk of the circle.
use super::super::portrait::{colour, disk, names};
use super::super::sheet::{Sheet, fit};
use super::super::{Drawing, Effort, Figure, UNIFORM};
use super::circle_caustics::orbit;
use crate::picture::{Anchor, Colour, Style, Window};
use core::f64::consts::{PI, TAU};

pub(super) const FIGURE: Figure = Figure {
    name: "circle-velocities",
    title: "The velocity disk of the circle",
    place: "Figure 15",
    caption: "Velocities (v₀, vₜ) after a collision. On the segment B the caustics coincide and orbits are those of a standard billiard; on the \
              dashed one the velocity reverses at each collision. On the ellipse n a flight makes the angle of a regular n-gon with the wall; \
              where it meets B the orbit is that n-gon. Right: the orbits at the intersections with n = 3, 4, 5 and one off B.",
    parameters: "Radius 1, uniform disk, γ² = 1/2. B: vₜ = √2 v₀; ellipse n: v₀² + vₜ²/cos²(π/n) = 1.",
    draw,
};

fn draw(_: Effort) -> Drawing {
    let mut sheet = Sheet::new(290.0, 172.0);
    let on_b = |n: f64| {
        let tan = libm::tan(PI / n);
        1.0 / libm::sqrt(UNIFORM * UNIFORM + 1.0 + tan * tan)
    };
    let view = disk(&mut sheet, [3.0, 3.0], 166.0, |sheet, view| {
        for n in 3..=7 {
            let height = libm::cos(PI / f64::from(n));
            let ellipse = (0..=120).map(|i| TAU * f64::from(i) / 120.0).map(|t| [libm::cos(t), height * libm::sin(t)]);
            sheet.chain(view, ellipse, Style::line(colour(0), 0.5));
            let t = 2.05 - 0.055 * f64::from(n - 3);
            let [x, y] = view.place([libm::cos(t), height * libm::sin(t)]);
            sheet.svg.circle([x, y], 4.0, Style::area(Colour::WHITE));
            sheet.label_as([x, y], 7.0, Anchor::Middle, &n.to_string());
        }
        let length = libm::sqrt(1.0 + UNIFORM * UNIFORM);
        let b = [UNIFORM / length, 1.0 / length];
        sheet.chain(view, [[-b[0], -b[1]], b], Style::line(colour(1), 1.0));
        let ends = [view.place([-b[1], b[0]]), view.place([b[1], -b[0]])];
        sheet.dashed(ends[0], ends[1], Style::line(colour(1), 0.7));
        for n in 3..=7 {
            let tau = on_b(f64::from(n));
            sheet.svg.circle(view.place([UNIFORM * tau, tau]), 1.5, Style::area(Colour::BLACK));
        }
        let [x, y] = view.place([0.18, 0.36]);
        sheet.label([x - 4.0, y - 2.0], "B");
    });
    names(&mut sheet, &view);
    let small = 52.0;
    for (i, n) in [3.0, 4.0, 5.0, 0.0].into_iter().enumerate() {
        let corner = [176.0 + (small + 4.0) * (i % 2) as f64, 20.0 + (small + 22.0) * (i / 2) as f64];
        let inner = fit(Window { low: [-1.0, -1.0], high: [1.0, 1.0] }, corner, small, small);
        let path = if n > 0.0 {
            let tau = on_b(n);
            orbit([UNIFORM * tau, tau], libm::tan(PI / n) * tau, 10)?
        } else {
            orbit([-0.3, 0.62], libm::sqrt(1.0 - 0.3 * 0.3 - 0.62 * 0.62), 40)?
        };
        sheet.chain(&inner, path.plane(), Style::line(colour(0), if n > 0.0 { 0.7 } else { 0.25 }));
        sheet.svg.circle(inner.place([0.0, 0.0]), inner.scale(), Style::line(Colour::BLACK, 0.6));
        let name = if n > 0.0 { format!("n = {n}") } else { "\"off\" B".into() };
        sheet.label_as([corner[0] + 0.5 * small, corner[1] + small + 8.0], 7.5, Anchor::Middle, &name);
    }
    Ok(sheet.svg)
}

//! The velocity phase portrait: velocities after collisions in the disk of (v0, v·t).
//!
//! The reduced phase space of a planar billiard is boundary × disk; forgetting the place on the boundary leaves the disk,
//! its horizontal axis the rotational and its vertical axis the tangential part of a velocity of length one.

use super::axes::{self, Axis, HAIRLINE, Label};
use super::grid::{Grid, Shading};
use super::ink::{Colour, ORBITS};
use super::svg::{Style, Svg};
use super::view::{View, Window};
use super::{COLUMN, File, Material, Needs, Picture, Velocities};

/// White around the unit disk, as a share of its radius.
const AROUND: f64 = 0.06;
/// White around the picture.
const MARGIN: f64 = 3.0;
/// Pixels of the grid for dense portraits: some 370 dots per inch in print.
const PIXELS: usize = 1000;

pub(super) const PICTURE: Picture = Picture {
    name: "velocity-portrait",
    summary: "velocities after each collision: rotational against tangential part (SVG; dense ones PNG too)",
    needs: Needs::Velocities,
    draw: |material: &Material| {
        let svg = |svg: Svg| File { name: "velocity-portrait.svg".into(), content: svg.to_string().into_bytes() };
        match &material.velocities {
            Velocities::Dots(dots) => vec![svg(draw(dots))],
            Velocities::Counted(grid) => {
                let mut raster = grid.shade(Shading::Log);
                raster.ring([0.0, 0.0], 1.0, grid.window(), Colour::BLACK);
                let png = File { name: "velocity-portrait.png".into(), content: raster.png() };
                vec![svg(dense(grid)), png]
            }
        }
    },
};

/// An empty grid for a dense portrait; add velocities with [`Grid::add`].
pub fn grid() -> Grid {
    Grid::new(Window::unit_disk(AROUND), PIXELS)
}

/// A portrait dot by dot, each orbit in its colour.
pub fn draw(orbits: &[Vec<[f64; 2]>]) -> Svg {
    framed(|svg, view| {
        let dots: usize = orbits.iter().map(Vec::len).sum();
        // The more dots, the smaller, so that curves stay curves.
        let (diameter, opacity) = match dots {
            0..=300 => (1.6, 1.0),
            301..=2000 => (1.0, 1.0),
            2001..=8000 => (0.7, 0.9),
            _ => (0.5, 0.8),
        };
        for (points, &colour) in orbits.iter().zip(ORBITS.iter().cycle()) {
            svg.dots(points.iter().map(|p| view.place(*p)), diameter, colour, opacity);
        }
    })
}

/// A dense portrait, shaded, in the same frame.
pub fn dense(grid: &Grid) -> Svg {
    framed(|svg, view| svg.image(&grid.shade(Shading::Log).png(), view.corner(), view.size()))
}

fn framed(content: impl FnOnce(&mut Svg, &View)) -> Svg {
    let window = Window::unit_disk(AROUND);
    let [left, below] = axes::MARGIN;
    let side = COLUMN - left - MARGIN;
    let view = View::fit(window, [left, MARGIN], side, side);
    let mut svg = Svg::new(COLUMN, side + MARGIN + below);
    let guide = Style::line(Colour::GUIDE, HAIRLINE);
    svg.line(view.place([-1.0, 0.0]), view.place([1.0, 0.0]), guide);
    svg.line(view.place([0.0, -1.0]), view.place([0.0, 1.0]), guide);
    content(&mut svg, &view);
    svg.circle(view.place([0.0, 0.0]), view.scale(), Style::line(Colour::BLACK, 0.6));
    let axis = |symbol: &str, index: &str| Axis::between(-1.0, 1.0, 4, Label::indexed(symbol, index));
    axes::draw(&mut svg, &view, &axis("v", "0"), &axis("v", "t"));
    svg
}

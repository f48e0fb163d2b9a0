//! The velocity phase portrait: velocities after collisions in the disk of (v0, v·t).
//!
//! The reduced phase space of a planar billiard is boundary × disk; forgetting the place on the boundary leaves the disk,
//! its horizontal axis the rotational and its vertical axis the tangential part of a velocity of length one.

use super::axes::{self, Axis, Label};
use super::cloud::Cloud;
use super::ink::Colour;
use super::png::Raster;
use super::svg::{Style, Svg};
use super::view::{View, Window};
use super::{COLUMN, File, Material, Needs, Picture};

/// White around the unit disk, as a fraction of its radius.
const AROUND: f64 = 0.06;
/// White around the picture.
const MARGIN: f64 = 3.0;
/// Pixels of the grid for dense portraits: some 370 dots per inch in print.
const PIXELS: usize = 1000;

pub(super) const PICTURE: Picture = Picture {
    name: "velocity-portrait",
    files: &["velocity-portrait.svg", "velocity-portrait.png"],
    needs: Needs::Velocities,
    draw: |material: &Material| {
        let none = cloud();
        let cloud = material.velocities.as_ref().unwrap_or(&none);
        let raster = cloud.shaded();
        let shaded = raster.as_ref().map(Raster::png);
        let svg = draw(cloud, shaded.as_deref()).to_string().into_bytes();
        let svg = File { name: "velocity-portrait.svg".into(), content: svg };
        let png = raster.map(|mut raster| {
            raster.ring([0.0, 0.0], 1.0, cloud.window(), Colour::BLACK);
            File { name: "velocity-portrait.png".into(), content: raster.png() }
        });
        [svg].into_iter().chain(png).collect()
    },
};

/// The unit disk, without points yet.
pub fn cloud() -> Cloud {
    Cloud::new(Window::unit_disk(AROUND), PIXELS)
}

/// Draws a portrait, each orbit in its colour, or from the image file `shaded` where points are counted.
fn draw(cloud: &Cloud, shaded: Option<&[u8]>) -> Svg {
    let window = Window::unit_disk(AROUND);
    let [left, below] = axes::MARGIN;
    let side = COLUMN - left - MARGIN;
    let view = View::fit(window, [left, MARGIN], side, side);
    let mut svg = Svg::new(COLUMN, side + MARGIN + below);
    cloud.draw(&mut svg, &view, shaded, |svg, guide| {
        svg.line(view.place([-1.0, 0.0]), view.place([1.0, 0.0]), guide);
        svg.line(view.place([0.0, -1.0]), view.place([0.0, 1.0]), guide);
    });
    svg.circle(view.place([0.0, 0.0]), view.scale(), Style::line(Colour::BLACK, 0.6));
    let axis = |symbol: &str, index: &str| Axis::between(-1.0, 1.0, 4, Label::indexed(symbol, index));
    axes::draw(&mut svg, &view, &axis("v", "0"), &axis("v", "t"));
    svg
}

//! The phase portrait of the billiard map: where the wall is hit, and how fast the particle then moves along it.
//!
//! The horizontal axis is arc length, all pieces laid end to end in the order of their numbers; the vertical one is the
//! tangential part of a velocity of length one, spin included, along t = J ν, against which s grows. For a specular point particle these
//! are, up to the sign of the second, the usual coordinates (s, sine of the angle with the normal), in which the map preserves area.

use super::axes::{self, Axis, Label};
use super::cloud::Cloud;
use super::svg::Svg;
use super::view::{View, Window};
use super::{COLUMN, File, Material, Needs, Picture};

/// Width of the portrait, where its height is 2.
pub const WIDTH: f64 = 2.6;
/// White above the picture.
const MARGIN: f64 = 3.0;
/// Pixels of the grid for dense portraits.
const PIXELS: usize = 1000;

pub(super) const PICTURE: Picture = Picture {
    name: "phase-portrait",
    files: &["phase-portrait.svg", "phase-portrait.png"],
    needs: Needs::Reduced,
    draw: |material: &Material| {
        let Some(reduced) = &material.reduced else { return Vec::new() };
        let shaded = reduced.cloud.shaded().map(|raster| raster.png());
        let svg = draw(reduced, shaded.as_deref()).to_string().into_bytes();
        let svg = File { name: "phase-portrait.svg".into(), content: svg };
        let png = shaded.map(|content| File { name: "phase-portrait.png".into(), content });
        [svg].into_iter().chain(png).collect()
    },
};

/// Points (s, v·t) of the reduced phase space.
#[derive(Clone, Debug)]
pub struct Reduced {
    cloud: Cloud,
    /// Arc length at the start of each piece, and the length of the whole boundary.
    offsets: Vec<f64>,
    length: f64,
}

impl Reduced {
    /// No points yet, on a boundary whose pieces start at these arc lengths.
    pub fn new(offsets: Vec<f64>, length: f64) -> Self {
        let window = Window { low: [0.0, -1.0], high: [WIDTH, 1.0] };
        Self { cloud: Cloud::new(window, PIXELS), offsets, length }
    }

    /// Its points: arc length, in units in which that of the whole boundary is [`WIDTH`], and tangential velocity.
    pub fn cloud(&self) -> &Cloud {
        &self.cloud
    }

    /// The same, mutable, for adding points.
    pub fn cloud_mut(&mut self) -> &mut Cloud {
        &mut self.cloud
    }
}

/// Draws a portrait, each orbit in its colour, or from the image file `shaded` where points are counted; thin lines separate the pieces.
fn draw(reduced: &Reduced, shaded: Option<&[u8]>) -> Svg {
    let [left, below] = axes::MARGIN;
    let width = COLUMN - left - axes::BESIDE;
    let view = View::fit(reduced.cloud.window(), [left, MARGIN], width, width);
    let [_, height] = view.size();
    let mut svg = Svg::new(COLUMN, height + MARGIN + below);
    let unit = WIDTH / reduced.length;
    reduced.cloud.draw(&mut svg, &view, shaded, |svg, guide| {
        // with very many pieces one would see nothing but lines
        if reduced.offsets.len() <= 32 {
            for s in reduced.offsets.iter().filter(|s| **s > 0.0) {
                svg.line(view.place([s * unit, -1.0]), view.place([s * unit, 1.0]), guide);
            }
        }
    });
    let x = Axis::between(0.0, reduced.length, 5, Label { symbol: "s".into(), index: String::new() }).stretched(unit);
    axes::draw(&mut svg, &view, &x, &Axis::between(-1.0, 1.0, 4, Label::indexed("v", "t")));
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn portraits_of_few_and_of_many_points_are_well_formed() {
        for count in [10_u32, 30_000] {
            let mut reduced = Reduced::new(vec![0.0, 1.0, 3.0], 4.0);
            for i in 0..count {
                reduced.cloud_mut().add(u64::from(i), [f64::from(i % 400) * 0.0065, 0.5]);
            }
            let material = Material { reduced: Some(reduced), ..Material::default() };
            let files = (PICTURE.draw)(&material);
            assert_eq!(files.len(), if count > 20_000 { 2 } else { 1 });
            let svg = std::str::from_utf8(&files[0].content).unwrap();
            roxmltree::Document::parse(svg).unwrap();
            // an image hides everything drawn before it
            let guides = svg.find(if count > 20_000 { "stroke=\"#8a8a8a\"" } else { "stroke=\"#d0d0d0\"" }).unwrap();
            assert!(svg.find("<image").is_none_or(|image| image < guides));
        }
    }
}

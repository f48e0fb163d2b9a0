//! Points by the thousand or by the million: dot by dot as long as that can be seen, then counted.

use billiards::observe::Density;

use super::grid::{Grid, Shading};
use super::ink::{Colour, ORBITS};
use super::png::Raster;
use super::svg::Svg;
use super::view::{View, Window};

/// Most dots drawn one by one.
pub const MOST_DOTS: usize = 20_000;

/// Points in a window, in the colours of their orbits.
#[derive(Clone, Debug)]
pub struct Cloud {
    window: Window,
    pixels: usize,
    /// The points, as long as none are counted.
    dots: Vec<([f64; 2], Colour)>,
    counted: Option<Grid>,
}

/// The layer of a [`Cloud::counter`] in which the points of an orbit are counted: that of its colour.
pub fn layer(orbit: u64) -> usize {
    #[allow(clippy::cast_possible_truncation, reason = "a remainder is below the number of colours")]
    let layer = (orbit % ORBITS.len() as u64) as usize;
    layer
}

impl Cloud {
    /// No points yet. Once they are too many to be drawn one by one, they are counted on a grid so many cells wide.
    pub fn new(window: Window, pixels: usize) -> Self {
        Self { window, pixels, dots: vec![], counted: None }
    }

    /// Adds a point of an orbit.
    pub fn add(&mut self, orbit: u64, point: [f64; 2]) {
        let colour = ORBITS[layer(orbit)];
        if self.is_crowded() {
            self.grid().add(point, colour);
        } else {
            self.dots.push((point, colour));
        }
    }

    /// Whether another point is one too many to be drawn as a dot.
    pub fn is_crowded(&self) -> bool {
        self.counted.is_some() || self.dots.len() >= MOST_DOTS
    }

    /// For counting points elsewhere, in the [`layer`] of their orbit.
    pub fn counter(&self) -> Density {
        Grid::new(self.window, self.pixels, &ORBITS).into_density()
    }

    /// Adds points that were counted by a [`counter`](Self::counter).
    pub fn merge(&mut self, counts: &Density) {
        self.grid().merge(counts);
    }

    /// Where points are counted from here on.
    fn grid(&mut self) -> &mut Grid {
        let Self { window, pixels, dots, counted } = self;
        counted.get_or_insert_with(|| {
            let mut grid = Grid::new(*window, *pixels, &ORBITS);
            dots.drain(..).for_each(|(point, colour)| grid.add(point, colour));
            grid
        })
    }

    /// The window.
    pub fn window(&self) -> Window {
        self.window
    }

    /// The counts, if the points are counted.
    pub fn counted(&self) -> Option<&Grid> {
        self.counted.as_ref()
    }

    /// The picture of the counts, if the points are counted.
    pub(super) fn shaded(&self) -> Option<Raster> {
        self.counted.as_ref().map(|grid| grid.shade(Shading::Log))
    }

    /// Draws the points into a view of the window, or what they are [`shaded`](Self::shaded) to.
    pub(super) fn draw(&self, svg: &mut Svg, view: &View, shaded: Option<&[u8]>) {
        if let Some(png) = shaded {
            return svg.image(png, view.corner(), view.size());
        }
        let dots = &self.dots;
        // The more dots, the smaller, so that curves stay curves.
        let (diameter, opacity) = match dots.len() {
            0..=300 => (1.6, 1.0),
            301..=2000 => (1.0, 1.0),
            2001..=8000 => (0.7, 0.9),
            _ => (0.5, 0.8),
        };
        for colour in ORBITS {
            let of_colour = dots.iter().filter(|dot| dot.1 == colour).map(|dot| view.place(dot.0));
            svg.dots(of_colour, diameter, colour, opacity);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_points_are_counted_and_none_is_lost() {
        let mut cloud = Cloud::new(Window::unit_disk(0.0), 16);
        for i in 0..=MOST_DOTS as u64 {
            assert!(cloud.counted().is_none());
            cloud.add(i, [0.5, 0.25]);
        }
        assert_eq!(cloud.counted().map(|grid| grid.clone().into_density().inside()), Some(MOST_DOTS as u64 + 1));
    }

    #[test]
    fn points_counted_elsewhere_are_counted_in_the_colour_of_their_orbit() {
        let mut cloud = Cloud::new(Window::unit_disk(0.0), 16);
        let mut counts = cloud.counter();
        counts.add_to([0.5, 0.25], counts.layer(layer(11)));
        cloud.merge(&counts);
        let mut same = Cloud::new(Window::unit_disk(0.0), 16);
        same.grid().add([0.5, 0.25], ORBITS[3]);
        let shade = |cloud: &Cloud| cloud.counted().map(|grid| grid.shade(Shading::Log));
        assert_eq!(shade(&cloud), shade(&same));
    }
}

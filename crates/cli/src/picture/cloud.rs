//! Points by the thousand or by the million: dot by dot as long as that can be seen, then counted.

use super::grid::{Grid, Shading};
use super::ink::{Colour, ORBITS};
use super::svg::Svg;
use super::view::{View, Window};

/// Most dots drawn one by one.
const MOST_DOTS: usize = 20_000;

/// Points in a window, in the colours of their orbits.
#[derive(Clone, Debug)]
pub struct Cloud {
    window: Window,
    pixels: usize,
    points: Points,
}

#[derive(Clone, Debug)]
enum Points {
    Dots(Vec<([f64; 2], Colour)>),
    Counted(Grid),
}

impl Cloud {
    /// No points yet. Once they are too many to be drawn one by one, they are counted on a grid so many cells wide.
    pub fn new(window: Window, pixels: usize) -> Self {
        Self { window, pixels, points: Points::Dots(Vec::new()) }
    }

    /// Adds a point of an orbit.
    pub fn add(&mut self, orbit: u64, point: [f64; 2]) {
        #[allow(clippy::cast_possible_truncation, reason = "a remainder is below the number of colours")]
        let colour = ORBITS[(orbit % ORBITS.len() as u64) as usize];
        match &mut self.points {
            Points::Counted(grid) => grid.add(point, colour),
            Points::Dots(dots) if dots.len() < MOST_DOTS => dots.push((point, colour)),
            Points::Dots(dots) => {
                let mut grid = Grid::new(self.window, self.pixels);
                for (point, colour) in dots.drain(..).chain([(point, colour)]) {
                    grid.add(point, colour);
                }
                self.points = Points::Counted(grid);
            }
        }
    }

    /// The window.
    pub fn window(&self) -> Window {
        self.window
    }

    /// The counts, if the points are counted.
    pub fn counted(&self) -> Option<&Grid> {
        match &self.points {
            Points::Counted(grid) => Some(grid),
            Points::Dots(_) => None,
        }
    }

    /// Draws the points into a view of the window.
    pub(super) fn draw(&self, svg: &mut Svg, view: &View) {
        let dots = match &self.points {
            Points::Counted(grid) => {
                return svg.image(&grid.shade(Shading::Log).png(), view.corner(), view.size());
            }
            Points::Dots(dots) => dots,
        };
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
        assert_eq!(cloud.counted().map(Grid::total), Some(MOST_DOTS as u64 + 1));
    }
}

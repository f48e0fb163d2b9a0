//! Points by the thousand or by the million: drawn dot by dot while dots can be told apart, then counted.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use billiards::observe::Density;

use super::axes::HAIRLINE;
use super::grid::{Grid, Shading};
use super::ink::{Colour, ORBITS};
use super::png::Raster;
use super::svg::{Style, Svg};
use super::view::{View, Window};

/// Most dots drawn one by one.
pub const MOST_DOTS: usize = 20_000;

/// Points in a window, in the colours of their orbits.
#[derive(Clone, Debug)]
pub struct Cloud {
    window: Window,
    pixels: usize,
    /// The points and their orbits, as long as none are counted.
    dots: Vec<([f64; 2], u64)>,
    counted: Option<Grid>,
}

/// The layer of a [`Cloud::counter`] in which the points of an orbit are counted: that of its colour.
pub fn layer(orbit: u64) -> usize {
    #[allow(clippy::cast_possible_truncation, reason = "a remainder is below the number of colours")]
    let layer = (orbit % ORBITS.len() as u64) as usize;
    layer
}

/// Points and their orbits, counted on a grid over a window.
fn on_grid(window: Window, pixels: usize, dots: &[([f64; 2], u64)]) -> Grid {
    let mut grid = Grid::new(window, pixels, &ORBITS);
    for (point, orbit) in dots {
        grid.add(*point, ORBITS[layer(*orbit)]);
    }
    grid
}

impl Cloud {
    /// No points yet. Once they are too many to be drawn one by one, they are counted on a grid `pixels` cells wide.
    pub fn new(window: Window, pixels: usize) -> Self {
        Self { window, pixels, dots: vec![], counted: None }
    }

    /// Adds a point of an orbit.
    pub fn add(&mut self, orbit: u64, point: [f64; 2]) {
        if self.is_crowded() {
            self.grid().add(point, ORBITS[layer(orbit)]);
        } else {
            self.dots.push((point, orbit));
        }
    }

    /// Whether another point is one too many to be drawn as a dot.
    pub fn is_crowded(&self) -> bool {
        self.counted.is_some() || self.dots.len() >= MOST_DOTS
    }

    /// A counter for counting points elsewhere, in the [`layer`] of their orbit.
    pub fn counter(&self) -> Density {
        Grid::new(self.window, self.pixels, &ORBITS).into_density()
    }

    /// Adds points that were counted by a [`counter`](Self::counter).
    pub fn merge(&mut self, counts: &Density) {
        self.grid().merge(counts);
    }

    /// The grid on which points are counted from now on.
    fn grid(&mut self) -> &mut Grid {
        let Self { window, pixels, dots, counted } = self;
        counted.get_or_insert_with(|| on_grid(*window, *pixels, &std::mem::take(dots)))
    }

    /// All points, counted.
    pub(super) fn counts(&self) -> Cow<'_, Grid> {
        match &self.counted {
            Some(grid) => Cow::Borrowed(grid),
            None => Cow::Owned(on_grid(self.window, self.pixels, &self.dots)),
        }
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

    /// Draws the points, or the image that they are [`shaded`](Self::shaded) to, into a view of the window, together with `guides`:
    /// below dots, but above an image, which would hide them.
    pub(super) fn draw(&self, svg: &mut Svg, view: &View, shaded: Option<&[u8]>, guides: impl FnOnce(&mut Svg, Style)) {
        if let Some(png) = shaded {
            svg.image(png, view.corner(), view.size());
            return guides(svg, Style::line(Colour::MIDDLE, HAIRLINE));
        }
        guides(svg, Style::line(Colour::GUIDE, HAIRLINE));
        for (diameter, opacity, places) in sized(&self.places(view)) {
            for (colour, places) in ORBITS.iter().zip(places) {
                svg.dots(places, diameter, *colour, opacity);
            }
        }
    }

    /// The places on the page of each orbit's points, each place once, the orbits with the fewest places first.
    fn places(&self, view: &View) -> Vec<(usize, Vec<[f64; 2]>)> {
        let mut known = BTreeSet::new();
        let mut of_orbit: BTreeMap<u64, Vec<[f64; 2]>> = BTreeMap::new();
        for (point, orbit) in &self.dots {
            let place = view.place(*point);
            if known.insert((orbit, place.map(|x| libm::round(x / SAME).to_bits()))) {
                of_orbit.entry(*orbit).or_default().push(place);
            }
        }
        let mut orbits: Vec<_> = of_orbit.into_iter().map(|(orbit, places)| (layer(orbit), places)).collect();
        orbits.sort_by_key(|(_, places)| places.len());
        orbits
    }
}

/// Places on the page closer together than this (in points) count as one.
const SAME: f64 = 0.05;

/// Sizes of dots: up to how many dots, their diameter and opacity. The more dots, the smaller, so that curves stay curves.
const SIZES: [(usize, f64, f64); 4] = [(300, 1.6, 1.0), (2000, 1.0, 1.0), (8000, 0.7, 0.9), (usize::MAX, 0.5, 0.8)];

/// Sizes, each with its opacity and the places in the layers of their orbits, smaller ones first, so that a periodic orbit is
/// visible on top of others. The size for an orbit is that for the total number of dots of all orbits with no more dots than it.
fn sized(orbits: &[(usize, Vec<[f64; 2]>)]) -> impl Iterator<Item = (f64, f64, [Vec<[f64; 2]>; ORBITS.len()])> {
    let mut sizes = SIZES.map(|(_, diameter, opacity)| (diameter, opacity, ORBITS.map(|_| vec![])));
    let mut dots = 0;
    for alike in orbits.chunk_by(|a, b| a.1.len() == b.1.len()) {
        dots += alike.iter().map(|orbit| orbit.1.len()).sum::<usize>();
        let size = SIZES.iter().position(|(most, ..)| dots <= *most).unwrap_or(SIZES.len() - 1);
        for (layer, places) in alike {
            sizes[size].2[*layer].extend(places);
        }
    }
    sizes.into_iter().rev()
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

    #[test]
    fn of_a_periodic_orbit_every_place_is_one_dot_that_is_seen_among_many() {
        let mut cloud = Cloud::new(Window::unit_disk(0.0), 16);
        for i in 0..MOST_DOTS as u64 / 2 {
            let t = 1e-4 * i as f64;
            cloud.add(0, [t - 0.5, 1e-9 + [-0.5, 0.0, 0.5][(i % 3) as usize]]);
            cloud.add(9, [0.25, [-0.5, 0.0, 0.5][(i % 3) as usize] + 1e-13 * t]);
        }
        let view = View::fit(Window::unit_disk(0.0), [0.0, 0.0], 200.0, 200.0);
        let of = |layer: usize| {
            let places = cloud.places(&view);
            let sizes = sized(&places).filter(|size| !size.2[layer].is_empty());
            sizes.map(|(diameter, _, places)| (diameter, places[layer].len())).collect::<Vec<_>>()
        };
        assert_eq!(of(1), [(1.6, 3)]);
        assert!(matches!(of(0)[..], [(0.5 | 0.7, 3000..)]), "{:?}", of(0));
    }

    #[test]
    fn many_orbits_of_few_places_are_small_all_together() {
        let orbits: Vec<_> = (0..200).map(|orbit| (orbit % 8, vec![[0.0; 2]; 50 + orbit % 2])).collect();
        let mut sorted = orbits.clone();
        sorted.sort_by_key(|orbit| orbit.1.len());
        let sizes: Vec<_> = sized(&sorted).filter(|size| size.2.iter().any(|of| !of.is_empty())).collect();
        assert_eq!(sizes.iter().map(|size| size.0).collect::<Vec<_>>(), [0.5, 0.7]);
        let dots: usize = sizes.iter().flat_map(|size| &size.2).map(Vec::len).sum();
        assert_eq!(dots, orbits.iter().map(|orbit| orbit.1.len()).sum::<usize>());
    }
}

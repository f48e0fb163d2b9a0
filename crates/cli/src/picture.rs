//! Pictures of orbits and of phase space, for print: thin lines, a serif face, true proportions, nothing superfluous.
//!
//! Pictures know nothing of tables and laws. They are drawn from [`Material`], plain numbers that a run has collected.

mod axes;
mod cloud;
mod counts;
mod grid;
mod ink;
mod orbit;
mod phase_portrait;
mod png;
mod stroke;
mod svg;
mod velocity_portrait;
mod view;

pub use axes::{Axis, Label, MARGIN as AXES_MARGIN, WIDEST_DIGIT, draw as axes, ticks};
pub use cloud::{Cloud, MOST_DOTS, layer};
pub use grid::{Grid, Shading};
pub use ink::{Colour, ORBITS};
pub use orbit::draw as orbit;
pub use phase_portrait::{Reduced, WIDTH as REDUCED_WIDTH};
pub use png::Raster;
pub use stroke::{Solid, Stroke};
pub use svg::{Anchor, Outline, Style, Svg, escape};
pub use velocity_portrait::cloud as velocities;
pub use view::{View, Window};

/// Width of a picture in points of 1/72 inch: one column of 8 cm.
pub const COLUMN: f64 = 226.8;
/// Most legs of orbits that a picture shows: more lines would only blacken the page.
pub const MOST_LEGS: usize = 20_000;

/// A picture a scene can ask for.
#[derive(Clone, Copy, Debug)]
pub struct Picture {
    /// Its name in a scene, and of its files.
    pub name: &'static str,
    /// What it is drawn from.
    pub needs: Needs,
    /// The files that it may be drawn into.
    pub files: &'static [&'static str],
    /// Draws it.
    pub draw: fn(&Material) -> Vec<File>,
}

/// The material that a run must collect for a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    /// [`Material::solids`], [`Material::outline`], [`Material::guides`], [`Material::radius`], [`Material::window`] and [`Material::paths`].
    Paths,
    /// [`Material::velocities`].
    Velocities,
    /// [`Material::reduced`].
    Reduced,
}

/// What a run has collected.
#[derive(Clone, Debug, Default)]
pub struct Material {
    /// The insides of obstacles, each followed by the hollows in it.
    pub solids: Vec<Solid>,
    /// The walls.
    pub outline: Vec<Stroke>,
    /// Lines that are not walls: around the region of centres of a particle of positive radius, and of lattice cells.
    pub guides: Vec<Stroke>,
    /// Radius of the particle.
    pub radius: f64,
    /// The part of an infinite table that is shown; all other tables are shown completely.
    pub window: Option<Window>,
    /// Each orbit in the plane.
    pub paths: Vec<Path>,
    /// Velocities after collisions, scaled to length one: the pairs (v0, v·t), where t = J ν. See [`velocities`].
    pub velocities: Option<Cloud>,
    /// Reduced phase space.
    pub reduced: Option<Reduced>,
}

/// An orbit in the plane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    /// Connected parts, each a chain of points; more than one where it crosses the edge of a lattice cell.
    pub chains: Vec<Vec<[f64; 2]>>,
    /// How an orbit leaves that meets no wall any more; more than one leg where it crosses edges of lattice cells.
    pub escape: Vec<Leaving>,
    /// Where it is when its time is over, if it leaves until then.
    pub rest: Option<[f64; 2]>,
    /// The last collision whose position is known, if the lines continue beyond it.
    pub horizon: Option<[f64; 2]>,
}

/// A straight leg of an orbit on its way to infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaving {
    /// Where it begins.
    pub from: [f64; 2],
    /// Its direction.
    pub direction: [f64; 2],
    /// How far it goes, in units of the direction; infinite for ever, on a plane that is not folded.
    pub until: f64,
}

/// A file of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct File {
    /// Its name, without a folder.
    pub name: String,
    /// Its content.
    pub content: Vec<u8>,
}

/// Every picture a scene can ask for.
pub const PICTURES: &[Picture] =
    &[orbit::PICTURE, velocity_portrait::PICTURE, phase_portrait::PICTURE, counts::VELOCITIES, counts::REDUCED];

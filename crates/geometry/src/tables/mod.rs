//! Named tables: the classical billiards, each in one file.
//!
//! Each has a constructor, such as [`stadium`](fn@stadium), and an [`Entry`] by which scene files find it. To add one, write a
//! file beside the others, and add its `mod` and `pub use` lines and its line in [`all`].
//!
//! Besides the errors that each constructor lists, those of planar tables return [`Error::Length`](crate::Error::Length) if the
//! greatest coordinate of the boundary, or that of a lattice vector, is not between 10⁻¹⁵⁰ and 10¹⁵⁰.
mod ball;
mod channel;
mod circle;
mod cuboid;
mod ellipse;
mod equilateral;
mod flower;
mod hexagon;
mod isosceles;
mod lorentz;
mod moon;
mod mushroom;
mod perturbed_polygon;
mod pocket;
mod polygon;
mod rectangle;
mod registry;
mod sinai;
mod sinai_torus;
mod slab;
mod spatial;
mod square;
mod stadium;
mod strip;
mod triangle;
mod vertices;
mod wedge;

pub use ball::ball;
pub use channel::channel;
pub use circle::circle;
pub use cuboid::cuboid;
pub use ellipse::ellipse;
pub use equilateral::equilateral;
pub use flower::flower;
pub use hexagon::hexagon;
pub use isosceles::isosceles;
pub use lorentz::lorentz;
pub use moon::moon;
pub use mushroom::mushroom;
pub use perturbed_polygon::perturbed_polygon;
pub use pocket::pocket;
pub use polygon::polygon;
pub use rectangle::rectangle;
pub use registry::{Build, Entry, Kind, Parameter, Value, Values};
pub use sinai::sinai;
pub use sinai_torus::sinai_torus;
pub use slab::slab;
pub use spatial::{SpatialTable, WallAt};
pub use square::square;
pub use stadium::stadium;
pub use strip::strip;
pub use triangle::triangle;
pub use vertices::MOST_VERTICES;
pub use wedge::wedge;

/// Every named table.
pub fn all() -> &'static [Entry] {
    const ALL: &[Entry] = &[
        strip::ENTRY,
        wedge::ENTRY,
        circle::ENTRY,
        ellipse::ENTRY,
        square::ENTRY,
        rectangle::ENTRY,
        equilateral::ENTRY,
        isosceles::ENTRY,
        triangle::ENTRY,
        hexagon::ENTRY,
        polygon::ENTRY,
        perturbed_polygon::ENTRY,
        stadium::ENTRY,
        mushroom::ENTRY,
        pocket::ENTRY,
        moon::ENTRY,
        flower::ENTRY,
        sinai::ENTRY,
        sinai_torus::ENTRY,
        lorentz::ENTRY,
        channel::ENTRY,
        slab::ENTRY,
        cuboid::ENTRY,
        ball::ENTRY,
    ];
    ALL
}

/// The table with a name.
pub fn find(name: &str) -> Option<&'static Entry> {
    all().iter().find(|entry| entry.name == name)
}
